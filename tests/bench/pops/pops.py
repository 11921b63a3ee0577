"""Counts the pixels that show something else in one frame of a turntable alone.

pops.py FIRN [FRAMES [SCENE[:LEVEL]...]]: prints, of each scene and rung, the mean number of such
pixels a frame, at 1024 x 768 with one sample, and how many are the rung's own. It is drawn with
--plain, or with all that is in it, at a --quality. A pixel pops where its
green differs by more than a tenth, the same way, from both frames beside it, which differ from one
another by less than a third of that. Detail finer than a pixel pops in the reference, too: a rung's
own pops are those that the reference has neither there nor in a pixel beside it.
"""
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / 'front'))
sys.dont_write_bytecode = True  # the source tree stays clean
from case import environment  # noqa: E402
from exr_file import Exr  # noqa: E402

FIRN = sys.argv[1]
FRAMES = int(sys.argv[2]) if len(sys.argv) > 2 else 8
SCENES = sys.argv[3:] or ['valley', 'sphere', 'teapot', 'valley:normal', 'ice-cube:normal']
STEP = 0.8  # degrees a frame
LEAST = 0.1
WIDTH, HEIGHT = 1024, 768
RUNGS = ('reference', 'trace', 'bounce')
PICTURE = ('--size', f'{WIDTH}x{HEIGHT}', '--samples', 1, '--pixel-filter', 'point',
           '-q', '--set', 'motion.fps=1', '--set', f'motion.ice={STEP}', '--set',
           'motion.objects=0')


def draw(scene, rung, folder):
    """The green of each frame."""
    name, _, level = scene.partition(':')
    how = ('--quality', level) if level else ('--plain',)
    words = ('render', name, '-r', rung, *how, *PICTURE, '--frames', f'0-{FRAMES + 1}',
             '-o', folder / '#.exr')
    subprocess.run((FIRN, *map(str, words)), env=environment({}), check=True)
    for i in range(FRAMES + 2):
        yield Exr((folder / f'{i}.exr').read_bytes()).read_planes(['G'])['G']


def is_pop(before, now, after):
    one, other = now - before, now - after
    least = min(abs(one), abs(other))
    return least > LEAST and one * other > 0 and abs(after - before) < least / 3


def find_pops(scene, rung):
    """A set of pixels for each frame."""
    with tempfile.TemporaryDirectory() as folder:
        frames = draw(scene, rung, pathlib.Path(folder))
        before, now, pops = next(frames), next(frames), []
        for after in frames:
            pops.append({i for i, three in enumerate(zip(before, now, after)) if is_pop(*three)})
            before, now = now, after
    return pops


def main():
    for scene in SCENES:
        truth = None
        for rung in RUNGS:
            pops = find_pops(scene, rung)
            around = [{i + x + WIDTH * y for i in frame for x in (-1, 0, 1) for y in (-1, 0, 1)}
                      for frame in truth or pops]
            own = [frame - near for frame, near in zip(pops, around)]
            truth = truth or pops
            print(f'{scene}, {rung}: {sum(map(len, pops)) / FRAMES:.0f} pixels a frame, '
                  f'{sum(map(len, own)) / FRAMES:.0f} of its own', flush=True)


main()
