"""How fluid a drag is, and how soon a picture in full size follows.

drag.py FIRN [SCENE]: of three runs of the scene, ice-cube, in the size of the first window, medians
of what `firn view` reports of movements, beside what is wanted, as ratios. On a machine that does
other things as well it says little: `chrt -r 5` helps. Fails if pictures of a movement take longer
than one in full size.
"""
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile

sys.path.append(str(pathlib.Path(__file__).parents[2] / 'front'))
from case import environment  # noqa: E402
from desktop import Desktop, wait_until  # noqa: E402

RUNS, MOVES, STEP = 3, 150, 0.016
SCENE = sys.argv[2] if len(sys.argv) > 2 else 'ice-cube'
WANTED = (('from picture to picture', 1000 / 30), ('the same, 95 %', 50), ('hand to picture', 50),
          ('the same, 95 %', 100), ('full size after', 300), ('a sample after', 500))
LINE = (r'moving: \d+ images, median ([\d.]+) ms, 95 % ([\d.]+) ms; input to image ([\d.]+) ms, '
        r'95 % ([\d.]+) ms; full size after (\d+) ms, a sample after (\d+) ms')


def run(desktop, firn, folder):
    words = [firn, 'view', SCENE]
    with subprocess.Popen(words, env=environment({'DISPLAY': desktop.env['DISPLAY']}), cwd=folder,
                          stderr=subprocess.PIPE, text=True) as process:
        window = desktop.find(f'firn: {SCENE}, paused')
        desktop.do('windowfocus', '--sync', window, 'mousemove', '--window', window, 400, 400)
        for _ in range(2):  # the first drag learns what a frame costs
            moves = ['mousemove_relative', '--', 2, 1, 'sleep', STEP] * MOVES
            desktop.do('mousedown', 1, *moves, 'mouseup', 1, 'sleep', 3, 'mousemove', '--window',
                       window, 400, 400)
        wait_until('the end', lambda: process.poll() is not None,
                   act=lambda: desktop.do('windowfocus', '--sync', window, 'key', 'ctrl+q'))
        return process.stderr.read()


def full_frame(desktop, firn, folder):
    """Milliseconds."""
    words = subprocess.run([firn, 'view', SCENE, '--frames', '10', '--time-step', '0.04'],
                           cwd=folder, check=True, stderr=subprocess.PIPE,
                           env=environment({'DISPLAY': desktop.env['DISPLAY']}), text=True).stderr
    return float(re.search(r'frames, ([\d.]+) ms each', words)[1])


def main():
    firn = pathlib.Path(sys.argv[1]).resolve()  # it runs in another folder
    found = []
    desktop = Desktop(1600, 1000)
    try:
        with tempfile.TemporaryDirectory() as folder:
            for _ in range(RUNS):
                words = run(desktop, firn, folder)
                print(words, end='')
                found.append([float(x) for x in re.search(LINE, words).groups()])
            full = full_frame(desktop, firn, folder)
    finally:
        desktop.close()
    medians = [statistics.median(column) for column in zip(*found)]
    for (name, wanted), median in zip(WANTED, medians):
        print(f'{name}: {median:.1f} ms, {median / wanted:.2f} of the {wanted:.0f} ms wanted')
    print(f'a picture of a movement takes {medians[0] / full:.2f} of one in full size, '
          f'{full:.1f} ms')
    sys.exit(medians[0] > full)


main()
