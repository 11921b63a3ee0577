"""What the rung trace costs, and how its error falls with samples.

rays.py FIRN [TURNS]: prints
- frames of an ice cube and the teapot, in turns, as multiples of bounce's with one exit;
- the exponent of the frame's time in the number of a sphere's triangles;
- the exponents of the root mean square and the mean absolute error in the number of samples, of
  three rough boxes, to 1024 samples. The second is above the first's while few samples find the
  lights that rough glass mirrors: a pixel in which none has is wrong by little.
"""
import json
import math
import pathlib
import statistics
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / 'front'))
sys.dont_write_bytecode = True  # the source tree stays clean
from case import environment  # noqa: E402
from exr_file import Exr  # noqa: E402
from gltf_file import boxes, glass  # noqa: E402

FIRN = sys.argv[1]
TURNS = int(sys.argv[2]) if len(sys.argv) > 2 else 7
PICTURE = ('--plain', '--size', '1024x768', '--set', 'env_cube.size=512',
           '--set', 'refract.steps=4')
BOUNCE = ('-r', 'bounce', '--set', 'refract_bounce.exits=1')
TRACE = ('-r', 'trace')
CUBE = ('--set', 'trace.surroundings=cube')
RAYS = ('--set', 'trace.surroundings=rays')
EXACT = ('--set', 'trace.min_branch=0')
KINDS = {'default': CUBE, 'trace.min_branch=0': CUBE + EXACT, 'trace.surroundings=rays': RAYS,
         'both': RAYS + EXACT}
VIEWS = {'ice cube that fills a fifth': ('valley',),
         'ice cube that fills the picture': ('valley', '--fov', '20'), 'teapot': ('teapot',)}
TRIANGLES = (1000, 4000, 16000, 64000, 256000)
SAMPLES = (1, 4, 16, 64)


def run(*words):
    return subprocess.run((FIRN, *map(str, words)), env=environment({}), check=True,
                          stdout=subprocess.PIPE).stdout


def frame(*words):
    """The time of a frame, milliseconds."""
    profile = json.loads(run('profile', *words, *PICTURE, '-n', 3, '--warmup', 1, '--json', '-'))
    return statistics.median(profile['plain']['ms'])


def slope(points):
    """The exponent of a power of x that fits best."""
    x, y = ([math.log(point[k]) for point in points] for k in (0, 1))
    return statistics.linear_regression(x, y).slope


def beside_bounce(view, words):
    ratios = {name: [] for name in KINDS}
    for _ in range(TURNS):
        for name, settings in KINDS.items():
            plain = frame(*words, *BOUNCE)
            ratios[name].append(frame(*words, *TRACE, *settings) / plain)
    for name, found in ratios.items():
        print(f'{view}, {name}: {statistics.median(found):.2f} of bounce with one '
              f'exit ({min(found):.2f} to {max(found):.2f})')


def by_triangles():
    times = [min(frame('sphere', *TRACE, '--set', f'object.triangles={count}')
                 for _ in range(TURNS)) for count in TRIANGLES]
    print(f'frame by triangles, {TRIANGLES[0]} to {TRIANGLES[-1]}: exponent '
          f'{slope(list(zip(TRIANGLES, times))):.2f}:', *(f'{ms:.0f}' for ms in times), 'ms')


def by_samples(folder):
    scene = pathlib.Path(folder) / 'rough.gltf'
    scene.write_text(boxes((glass(1.5, roughness=0.3), [0, 0, 0], 1),
                           (glass(1.3, roughness=0.1), [0.1, 0.1, 0], 0.6),
                           (glass(1.5, roughness=0.2), [2.5, 0, -2], 1)))

    def draw(samples):
        path = pathlib.Path(folder) / 'a.exr'
        run('render', scene, '--env', 'studio', *TRACE, '--size', '128x96', '--pixel-filter',
            'point', '-q', '--samples', samples, '-o', path)
        planes = Exr(path.read_bytes()).read_planes(['R', 'G', 'B'])
        return [x for name in 'RGB' for x in planes[name]]
    truth = draw(1024)
    off = [[a - b for a, b in zip(draw(count), truth)] for count in SAMPLES]
    for name, errors in (
            ('root mean square', [math.sqrt(statistics.fmean(x * x for x in d)) for d in off]),
            ('mean absolute', [statistics.fmean(map(abs, d)) for d in off])):
        print(f'{name} error by samples, {SAMPLES[0]} to {SAMPLES[-1]}: exponent '
              f'{slope(list(zip(SAMPLES, errors))):.2f}:', *(f'{error:.5f}' for error in errors))


def main():
    with tempfile.TemporaryDirectory() as folder:
        by_samples(folder)
    by_triangles()
    for view, words in VIEWS.items():
        beside_bounce(view, words)


main()
