"""test_goldens.py: pictures like those in tests/golden/pictures, and what seeds change.

Usage: see case.py; test_goldens.py FIRN --update rewrites these pictures: look at each.
Not byte by byte: two releases of Mesa differ in 0.56 % of the values, by one unit in the last place
of a half, which is at most 1/1024 of the value.
"""
import math
import pathlib
import sys

sys.dont_write_bytecode = True  # the source tree stays clean
from case import CRACKED, Case, long, main, unsanitized  # noqa: E402
from exr_file import Exr  # noqa: E402

FOLDER = pathlib.Path(__file__).resolve().parents[1] / 'golden' / 'pictures'
TOLERANCE = 1 / 1024  # of max(1, |value|)
SHARE = 0.999  # of the values are within it
MEAN = 1e-4

PAPER = ('--refraction', 'paper')
# Anisotropic filtering differs between drivers, by up to .6 in a pixel with bumps.
EQUAL = ('--set', 'env_cube.size=512', '--set', 'texture.anisotropy=1')
PICTURES = {
    'ice-cube': ('valley', *PAPER),
    'sphere': ('sphere', *PAPER),
    'teapot': ('teapot', *PAPER),
    'pool': ('pool',),
    'ice-cube-one-sided': ('valley', '--refraction', 'one-sided', '--set',
                           'refract.fresnel=paper', '--set', 'refract.lookup=infinite'),
    'ice-cube-bounce': ('valley', '--refraction', 'bounce', '--set', 'refract.lookup=distance',
                        '--set', 'refract.fresnel=exact'),
    'ice-cube-frost-gap': ('valley', *PAPER, '--set', 'frost.amount=0.5', '--set',
                           'cracks.refract=gap'),
}


def fault(planes, golden, width):
    """What is wrong with a picture; None if nothing is."""
    values = [(math.inf if not math.isfinite(value) else abs(value - want),
               max(1, abs(want)), name, i)
              for name in golden for i, (value, want) in enumerate(zip(planes[name], golden[name]))]
    far = sum(difference > TOLERANCE * scale for difference, scale, _, _ in values)
    mean = sum(difference for difference, _, _, _ in values) / len(values)
    if mean <= MEAN and far <= (1 - SHARE) * len(values):
        return None
    _, _, name, i = max(values, key=lambda value: value[0] / value[1])
    return (f'{far} of {len(values)} values are not the same, mean difference {mean:g}; worst: '
            f'{name} at {i % width},{i // width} is {planes[name][i]:g}, not {golden[name][i]:g}')


class Goldens(Case):
    update = False

    def draw(self, *arguments):
        done = self.succeed('render', *arguments, '-q', '-o', 'a.exr')
        self.assertEqual(done.stderr, b'')
        return (self.folder / 'a.exr').read_bytes()

    @unsanitized
    def test_pictures(self):
        for name, arguments in PICTURES.items():
            with self.subTest(name):
                data = self.draw(*arguments, *EQUAL, '--size', '160x120')
                if Goldens.update:
                    (FOLDER / f'{name}.exr').write_bytes(data)
                picture, golden = Exr(data), Exr((FOLDER / f'{name}.exr').read_bytes())
                self.assertEqual(picture.size, golden.size)
                said = fault(picture.read_planes('RGB'), golden.read_planes('RGB'),
                             golden.size[0])
                if said:
                    self.fail(said)

    def test_there_are_no_others(self):
        self.assertEqual({path.name for path in FOLDER.iterdir()},
                         {f'{name}.exr' for name in PICTURES})

    @unsanitized
    def test_validation(self):
        for name, arguments in PICTURES.items():
            with self.subTest(name):
                self.draw(*arguments, '--size', '64x48', *CRACKED, '--validate')

    @long
    def test_seeds(self):
        for name in ('cracks.seed', 'air.seed', 'bubbles.seed', 'bump.seed'):
            with self.subTest(name):
                first, again, other = (
                    self.draw('valley', '--size', '160x120', '--set', f'{name}={seed}')
                    for seed in (7, 7, 8))
                self.assertTrue(first == again, 'other bytes')
                self.assertFalse(Exr(first).pixels == Exr(other).pixels, 'the same picture')


if __name__ == '__main__':
    if '--update' in sys.argv:
        sys.argv.remove('--update')
        Goldens.update = True
    main()
