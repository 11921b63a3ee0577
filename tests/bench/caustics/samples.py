"""samples.py: how the noise of caustics falls with --samples: slopes of -0.5 are 1 / sqrt(samples).

Usage: samples.py FIRN
Prints the RMS difference of the layer `caustics` from a picture of many samples, and the slope of
its logarithm. Fails if a slope is not -0.5 within 0.1.
"""
import math
import pathlib
import statistics
import subprocess
import sys
import tempfile

TESTS = pathlib.Path(__file__).parents[2]
sys.dont_write_bytecode = True  # the source tree stays clean
sys.path.append(str(TESTS / 'front'))
from case import environment  # noqa: E402
from exr_file import Exr  # noqa: E402

COUNTS, TRUTH = (1, 4, 16, 64), 256
METHODS = {'naive': ('caustics.photons=30000',),
           'gather': ('caustics.directions=4', 'caustics.cone=10', 'caustics.sun=4')}
WORDS = ('pool', '--size', '96x72', '--pixel-filter', 'point', '-q', '--aov', 'caustics', '--eye',
         '0,4.6,0.01', '--target', '0,0,0')


def light(firn, folder, settings, samples):
    sets = [word for assignment in settings for word in ('--set', assignment)]
    file = pathlib.Path(folder) / 'a.exr'
    subprocess.run([firn, 'render', *WORDS, *sets, '--samples', str(samples), '-o', file],
                   check=True, env=environment({}))
    return Exr(file.read_bytes()).read_planes(['caustics.Z'])['caustics.Z']


def rms(a, b):
    return math.sqrt(sum((x - y) ** 2 for x, y in zip(a, b)) / len(a))


def main():
    good = True
    print('samples'.ljust(10), *(f'{count:8}' for count in COUNTS), '   slope')
    with tempfile.TemporaryDirectory() as folder:
        for method, settings in METHODS.items():
            settings = (f'caustics.method={method}', *settings)
            truth = light(sys.argv[1], folder, settings, TRUTH)
            errors = [rms(light(sys.argv[1], folder, settings, count), truth) for count in COUNTS]
            logs = [[math.log(value) for value in values] for values in (COUNTS, errors)]
            found = statistics.linear_regression(*logs).slope
            good = good and abs(found + 0.5) <= 0.1
            print(method.ljust(10), *(f'{error:8.4f}' for error in errors), f'{found:8.2f}')
    return 0 if good else 1


if __name__ == '__main__':
    sys.exit(main())
