"""What the loop around a window costs, beside the passes of its frames.

loop.py FIRN: of five runs at 1024x768 without panels, medians of the milliseconds that `firn view`
reports. Fails if the loop's own are above 2; until the screen has a picture is the window system's
time (with a device in software it copies every pixel). On a machine that does other things as well
it says little: `chrt -r 5` helps.
"""
import pathlib
import re
import statistics
import subprocess
import sys

sys.path.append(str(pathlib.Path(__file__).parents[2] / 'front'))
from case import environment  # noqa: E402
from desktop import Desktop  # noqa: E402

RUNS, MOST = 5, 2.0
WORDS = ['sphere', '--size', '1024x768', '--frames', '40', '--time-step', '0.04']
for cheap in ('env_cube.dynamic=off', 'cracks.count=0', 'bubbles.count=0', 'air.count=0',
              'light.count=0', 'bump.strength=0'):
    WORDS += ['--set', cheap]


def main():
    desktop = Desktop(1100, 850)
    found = []
    try:
        env = environment({'DISPLAY': desktop.env['DISPLAY']})
        for _ in range(RUNS):
            words = subprocess.run([sys.argv[1], 'view', *WORDS], env=env, check=True,
                                   stderr=subprocess.PIPE, text=True).stderr
            found.append([float(x) for x in re.findall(r'(-?[\d.]+) ms', words)])
            print(words, end='')
    finally:
        desktop.close()
    frame, passes, loop, screen = (statistics.median(column) for column in zip(*found))
    print(f'of {frame:.2f} ms a frame {frame - passes:.2f} are beside the passes: {screen:.2f} '
          f'until the screen has it, {loop:.2f} of the loop, at most {MOST} wanted')
    sys.exit(loop > MOST)


main()
