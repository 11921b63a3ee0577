"""test_diff.py: tests `firn diff`, which compares two pictures. Usage: see case.py."""
import json
import math
import pathlib
import random
import struct
import sys
import zlib

sys.dont_write_bytecode = True  # the source tree stays clean
sys.path.append(str(pathlib.Path(__file__).parents[1] / 'support'))
from case import (  # noqa: E402
    CANT_CREATE, DATA, NO_DRIVER, NO_INPUT, USAGE, WRITE, Case, main, unsanitized)
from exr_file import Exr, write_exr  # noqa: E402
from test_show import HEIGHT, WIDTH, Png  # noqa: E402
import flip  # noqa: E402

FAILED = 1
NAN, INF = math.nan, math.inf


def write_png(width, height, pixels, alpha=False, bits=8):
    """Pixels are tuples of bytes."""
    def chunk(kind, data):
        return struct.pack('>I', len(data)) + kind + data + struct.pack('>I', zlib.crc32(
            kind + data))
    rows = b''.join(b'\0' + bytes(sum(pixels[y * width:(y + 1) * width], ()))
                    for y in range(height))
    head = struct.pack('>2I5B', width, height, bits, 6 if alpha else 2, 0, 0, 0)
    return (b'\x89PNG\r\n\x1a\n' + chunk(b'IHDR', head) + chunk(b'IDAT', zlib.compress(rows)) +
            chunk(b'IEND', b''))


def rows_of(width, values):
    return [values[i:i + width] for i in range(0, len(values), width)]


class Diff(Case):
    def png(self, name, width, height, pixels, **how):
        (self.folder / name).write_bytes(write_png(width, height, pixels, **how))
        return name

    def exr(self, name, width, height, planes):
        (self.folder / name).write_bytes(write_exr((width, height), planes))
        return name

    def rgb(self, name, width, height, pixels, **more):
        """An EXR file of pixels and further planes."""
        planes = {c: [pixel[i] for pixel in pixels] for i, c in enumerate('RGB')}
        return self.exr(name, width, height, {**planes, **more})

    def diff(self, *arguments, code=0):
        done = self.firn('diff', *arguments, '--json', env=NO_DRIVER)
        self.assertEqual(done.returncode, code, done.stderr.decode())
        return json.loads(done.stdout)

    def near(self, got, want, tolerance=1e-5):
        self.assertLessEqual(abs(got - want), tolerance, f'{got}, not {want}')


class Numbers(Diff):
    """Against flip.py and against what can be worked out."""

    @unsanitized
    def test_ldr_flip(self):
        width, height, chance = 23, 17, random.Random(1)
        one = [tuple(chance.randrange(256) for _ in 'RGB') for _ in range(width * height)]
        two = [tuple(min(max(value + chance.randrange(-40, 41), 0), 255) for value in pixel)
               for pixel in one]
        a, b = self.png('a.png', width, height, one), self.png('b.png', width, height, two)
        shown = [rows_of(width, [[flip.decode(value / 255) for value in pixel] for pixel in pixels])
                 for pixels in (one, two)]
        for ppd, words in ((flip.PPD, ()), (20, ('--ppd', '20'))):
            said = self.diff(a, b, *words)['flip']
            self.near(said['mean'], flip.mean(flip.ldr(*shown, ppd)), 2e-5)
            self.assertEqual(said['kind'], 'ldr')
            self.near(said['ppd'], ppd)

    @unsanitized
    def test_hdr_flip(self):
        width, height, chance = 16, 12, random.Random(2)
        one = [tuple(2 ** chance.uniform(-6, 4) for _ in 'RGB') for _ in range(width * height)]
        two = [tuple(value * chance.uniform(0.5, 2) for value in pixel) for pixel in one]
        a, b = self.rgb('a.exr', width, height, one), self.rgb('b.exr', width, height, two)
        rows = rows_of(width, one), rows_of(width, two)
        for curve in ('aces', 'hable', 'reinhard'):
            said = self.diff(a, b, '--curve', curve, '--ppd', '24')['flip']
            stops = flip.exposures(rows[0], curve)
            self.near(said['mean'], flip.mean(flip.hdr(*rows, curve, 24)), 2e-5)
            self.assertEqual((said['kind'], said['curve']), ('hdr', curve))
            self.assertEqual(said['exposures'], len(stops))
            self.near(said['first_stop'], stops[0])
            self.near(said['last_stop'], stops[-1])

    def test_exposure_makes_it_ldr(self):
        width, height, chance = 12, 9, random.Random(3)
        one = [tuple(chance.uniform(-0.1, 0.7) for _ in 'RGB') for _ in range(width * height)]
        two = [tuple(value + chance.uniform(-0.1, 0.1) for value in pixel) for pixel in one]
        a, b = self.rgb('a.exr', width, height, one), self.rgb('b.exr', width, height, two)
        shown = [rows_of(width, [[min(max(2 * value, 0), 1) for value in pixel]
                                 for pixel in pixels]) for pixels in (one, two)]
        said = self.diff(a, b, '--exposure', '1', '--ppd', '30')
        self.near(said['flip']['mean'], flip.mean(flip.ldr(*shown, 30)), 2e-5)
        self.assertEqual((said['flip']['kind'], said['flip']['exposure']), ('ldr', 1))

    def test_flat_pictures(self):
        # HyAB 100 of black and white; only the colours tell, for there is no feature
        most = flip.MAX_COLOUR_ERROR
        error = 0.95 + 0.05 * (100 ** 0.7 - 0.4 * most) / (0.6 * most)
        black = self.png('black.png', 8, 8, [(0, 0, 0)] * 64)
        white = self.png('white.png', 8, 8, [(255, 255, 255)] * 64)
        green = self.png('green.png', 8, 8, [(0, 255, 0)] * 64)
        blue = self.png('blue.png', 8, 8, [(0, 0, 255)] * 64)
        self.near(self.diff(black, white)['flip']['mean'], error)
        self.near(self.diff(green, blue)['flip']['mean'], 1.0)
        self.assertEqual(self.diff(blue, blue)['flip']['mean'], 0.0)
        self.near(self.diff(black, white)['rmse'], 1.0)
        self.near(self.diff(white, black)['relmse'], 1 / 1.01)

    def test_png_of_16_bits(self):
        one = self.png('8.png', 2, 1, [(200, 3, 77), (0, 0, 0)])
        two = self.png('16.png', 2, 1, [(200, 190, 3, 20, 76, 250), (0,) * 6], bits=16)
        self.assertEqual(self.diff(one, two)['rmse'], 0)

    def test_rmse_and_layers(self):
        grey = [(0.5, 0.5, 0.5)] * 4
        a = self.rgb('a.exr', 2, 2, grey, **{'Z': [1, 2, 3, 4], 'x.U': [0] * 4, 'x.V': [0] * 4,
                                             'old.R': [1] * 4})
        b = self.rgb('b.exr', 2, 2, [(0.5, 0.5, 0.5)] * 3 + [(1.1, 0.5, 0.5)],
                     **{'Z': [1, 2, 3, 2], 'x.U': [3] * 4, 'x.V': [0, 0, 0, -4], 'N.X': [0] * 4})
        said = self.diff(a, b)
        self.near(said['rmse'], math.sqrt(0.36 / 12), 1e-7)
        self.near(said['relmse'], 0.36 / 0.26 / 12, 1e-7)
        self.near(said['mae'], 0.5 / 12, 1e-12)  # 1.1 is shown as 1
        self.near(said['mae_unclipped'], 0.6 / 12, 1e-7)
        text = self.succeed('diff', a, b).stdout.decode()
        self.assertRegex(text, r'MAE +0\.0416667 +linear, clipped to 0 and 1\n'
                               r'MAE +0\.05 +linear, unclipped\n')
        layers = {layer['name']: layer for layer in said['layers']}
        self.assertEqual(list(layers), ['beauty', 'Z', 'x'])
        self.near(layers['beauty']['largest'], 0.6, 1e-6)
        self.assertEqual((layers['Z']['rmse'], layers['Z']['largest']), (1, 2))
        self.near(layers['x']['rmse'], math.sqrt((4 * 9 + 16) / 8), 1e-12)
        self.assertEqual((layers['x']['largest'], layers['x']['values']), (4, 8))
        self.assertEqual((said['only_reference'], said['only_test']), (['old.R'], ['N.X']))

    def test_exit_and_tir(self):
        def turned(degrees):
            return math.sin(math.radians(degrees)), 0, math.cos(math.radians(degrees))

        def planes(directions, classes):
            return {**{f'exit.{c}': [d[i] for d in directions] for i, c in enumerate('XYZ')},
                    'tir.Z': classes}
        none = 0, 0, 0
        a = self.exr('a.exr', 5, 2, planes([turned(0)] * 6 + [none] * 4, [1] * 10))
        b = self.exr('b.exr', 5, 2, planes([turned(d) for d in (0, 2, 4, 6, 90)] + [none] +
                                           [turned(0)] * 2 + [none] * 2, [1] * 7 + [0] * 3))
        said = self.diff(a, b)
        for key, want in (('mean', 20.4), ('median', 4), ('most_95', 90), ('largest', 90)):
            self.near(said['exit'][key], want, 1e-4)
        self.assertEqual([said['exit'][key] for key in ('pixels', 'only_reference', 'only_test')],
                         [5, 1, 2])
        self.near(said['exit']['mismatch'], 3 / 8, 1e-12)
        self.assertEqual((said['tir']['pixels'], said['tir']['differs']), (8, 1))
        self.near(said['tir']['mismatch'], 1 / 8, 1e-12)
        self.assertNotIn('flip', said)
        text = self.succeed('diff', a, b).stdout.decode()
        self.assertIn('mean 20.4, median 4, 95 % 90, largest 90 degrees', text)
        self.assertIn('differs in 12.5 % of 8 pixels', text)

    def test_the_same_file(self):
        a = self.rgb('a.exr', 4, 3, [(i, 0.25, 0) for i in range(12)],
                     **{f'exit.{c}': [c == 'Z'] * 12 for c in 'XYZ'})
        said = self.diff(a, a, *(f'--fail-above={name}=0' for name in
                                 ('flip', 'rmse', 'relmse', 'mae', 'angle')))
        self.assertEqual((said['flip']['mean'], said['rmse'], said['relmse']), (0, 0, 0))
        self.assertEqual(said['exit']['largest'], 0)
        self.assertEqual(said['failed'], [])

    def test_black(self):
        """No luminance to expose by."""
        black = self.rgb('black.exr', 4, 4, [(0, 0, 0)] * 16)
        spot = self.rgb('spot.exr', 4, 4, [(0, 0, 0)] * 15 + [(1, 1, 1)])
        self.assertEqual(self.diff(black, black)['flip']['mean'], 0)
        self.assertGreater(self.diff(black, spot)['flip']['mean'], 0)
        said = self.diff(spot, black)['flip']  # the median of what is not black
        for key in ('first_stop', 'last_stop'):
            self.near(said[key], math.log2(flip.bright('aces')))
        self.assertGreater(said['mean'], 0)

    def test_hdr_files(self):
        head = b'#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n'
        (self.folder / 'a.hdr').write_bytes(head + bytes((128, 64, 32, 129)) * 2)
        a = self.rgb('a.exr', 2, 1, [(1, 0.5, 0.25)] * 2)
        self.assertEqual(self.diff('a.hdr', a)['rmse'], 0)


class Masks(Diff):
    def setUp(self):
        super().setUp()
        self.a = self.rgb('a.exr', 4, 4, [(0.5, 0.5, 0.5)] * 16,
                          **{'A': [0, 1, 0.5, -1] + [NAN] * 12, 'in.Z': [0] * 15 + [3]})
        self.b = self.rgb('b.exr', 4, 4, [(0.5, 0.5, 0.5)] * 15 + [(0.8, 0.8, 0.8)])

    def test_of_exr(self):
        said = self.diff(self.a, self.b, '--mask', self.a)
        self.assertEqual((said['pixels'], said['rmse'], said['mask']), (2, 0, 'a.exr'))
        said = self.diff(self.a, self.b, '--mask', self.a, '--mask-channel', 'in.Z')
        self.assertEqual(said['pixels'], 1)
        self.near(said['rmse'], 0.3, 1e-6)
        whole = self.diff(self.a, self.b)
        self.assertEqual(whole['pixels'], 16)
        self.assertNotIn('mask', whole)
        self.assertGreater(said['flip']['mean'], whole['flip']['mean'])
        text = self.succeed('diff', self.a, self.b, '--mask', self.a, '--mask-channel=in.Z').stdout
        self.assertIn(b', 1 selected by the mask\n', text)

    def test_of_png(self):
        self.png('mask.png', 4, 4, [(0, 0, 0, 0)] * 12 + [(9, 9, 9, 1)] * 4, alpha=True)
        self.assertEqual(self.diff(self.a, self.b, '--mask', 'mask.png')['pixels'], 4)
        self.png('red.png', 4, 4, [(0, 1, 1)] * 13 + [(255, 0, 0)] * 3)
        self.assertEqual(self.diff(self.a, self.b, '--mask', 'red.png', '--mask-channel',
                                   'R')['pixels'], 3)

    def test_wrong_ones(self):
        self.png('opaque.png', 4, 4, [(1, 1, 1)] * 16)
        self.png('small.png', 2, 2, [(1, 1, 1, 1)] * 4, alpha=True)
        self.exr('empty.exr', 4, 4, {'A': [0] * 15 + [-1]})
        for code, mask, names in ((DATA, 'opaque.png', ['opaque.png', 'A', '--mask-channel']),
                                  (DATA, 'small.png', ['small.png', '2 x 2', '4 x 4']),
                                  (DATA, 'empty.exr', ['empty.exr', 'A']),
                                  (NO_INPUT, 'gone.exr', ['gone.exr']),
                                  (USAGE, 'mask.tiff', ['mask.tiff', '.png'])):
            self.refuse(code, 'diff', self.a, self.b, '--mask', mask, names=names)
        self.refuse(USAGE, 'diff', self.a, self.b, '--mask-channel', 'A', names=['--mask'])
        self.refuse(DATA, 'diff', self.a, self.b, '--mask', self.a, '--mask-channel', 'B.C',
                    names=['B.C'])


class Refused(Diff):
    def setUp(self):
        super().setUp()
        self.a = self.rgb('a.exr', 4, 3, [(0.5, 0.5, 0.5)] * 12)
        self.p = self.png('p.png', 4, 3, [(9, 9, 9)] * 12)

    def test_not_two(self):
        self.refuse(USAGE, 'diff', names=['REFERENCE'])
        self.refuse(USAGE, 'diff', self.a, names=['two images'])
        self.refuse(USAGE, 'diff', self.a, self.a, 'c.exr', names=['c.exr', 'at most 2'])
        self.refuse(USAGE, 'render', 'sphere', 'teapot', names=['teapot', 'sphere'])

    def test_other_sizes(self):
        self.rgb('wide.exr', 5, 3, [(0.5, 0.5, 0.5)] * 15)
        self.rgb('high.exr', 4, 4, [(0.5, 0.5, 0.5)] * 16)
        self.refuse(DATA, 'diff', self.a, 'wide.exr', names=['4 x 3', '5 x 3', 'a.exr'])
        self.refuse(DATA, 'diff', self.a, 'high.exr', names=['4 x 3', '4 x 4'])

    def test_other_kinds(self):
        self.refuse(USAGE, 'diff', self.a, self.p, names=['a.exr', 'p.png'])
        self.refuse(USAGE, 'diff', self.p, self.a, names=['a.exr', 'p.png'])
        self.refuse(USAGE, 'diff', self.p, self.p, '--exposure', '1', names=['--exposure'])
        self.refuse(USAGE, 'diff', self.a, 'a.tiff', names=['a.tiff', '.exr'])
        self.exr('z.exr', 4, 3, {'Z': [0] * 12})
        self.refuse(DATA, 'diff', self.a, 'z.exr', names=['a.exr', 'z.exr', 'channel'])

    def test_missing_and_damaged(self):
        self.refuse(NO_INPUT, 'diff', self.a, 'gone.exr', names=['gone.exr'])
        self.refuse(NO_INPUT, 'diff', 'gone.png', self.p, names=['gone.png'])
        for name in (self.a, self.p):
            data = (self.folder / name).read_bytes()
            for cut in (0, 4, len(data) // 2, len(data) - 16):
                bad = f'bad{name[-4:]}'
                (self.folder / bad).write_bytes(data[:cut])
                self.refuse(DATA, 'diff', name, bad, names=[bad])

    def test_options(self):
        for option, value in (('exposure', 'x'), ('exposure', '41'), ('exposure', 'nan'),
                              ('curve', 'filmic'), ('ppd', '0'), ('ppd', '401'), ('ppd', ''),
                              ('output', 'e.jpg'), ('output', '-'), ('fail-above', 'flip'),
                              ('fail-above', 'flip='), ('fail-above', 'psnr=1'),
                              ('fail-above', 'flip=-1'), ('fail-above', 'flip=nan'),
                              ('fail-above', 'fli=1'), ('fail-above', 'flip=1x')):
            self.refuse(USAGE, 'diff', self.a, self.a, f'--{option}', value,
                        names=[f'--{option}', value])
        self.refuse(USAGE, 'diff', self.a, self.a, '--dot', names=['--dot'])
        self.refuse(USAGE, 'graph', 'sphere', '--ppd', '67', names=['--ppd'])

    def test_help_fits(self):
        text = self.succeed('diff', '--help').stdout.decode()
        self.assertEqual([line for line in text.splitlines() if len(line) > 110], [])
        for option in ('--mask', '--exposure', '--fail-above', '--json', '-o,'):
            self.assertIn(option, text)


class Results(Diff):
    def setUp(self):
        super().setUp()
        grey, bright = (0.5, 0.5, 0.5), (0.9, 0.9, 0.9)
        self.a = self.rgb('a.exr', WIDTH, HEIGHT, [grey] * (WIDTH * HEIGHT))
        self.b = self.rgb('b.exr', WIDTH, HEIGHT, [
            bright if x < 20 else grey for y in range(HEIGHT) for x in range(WIDTH)])

    def test_limits(self):
        said = self.diff(self.a, self.b)
        mean = said['flip']['mean']
        self.diff(self.a, self.b, '--fail-above', f'flip={mean * 1.01}')
        done = self.firn('diff', self.a, self.b, '--fail-above', f'flip={mean * 0.99}',
                         '--fail-above', 'rmse=9', '--fail-above', 'relmse=0')
        self.assertEqual(done.returncode, FAILED)
        words = done.stderr.decode().splitlines()
        self.assertEqual([line.split()[1] for line in words], ['flip', 'relmse'])
        self.assertIn('FLIP', done.stdout.decode())
        said = self.diff(self.a, self.b, '--fail-above', 'rmse=0', code=FAILED)
        self.assertEqual(said['failed'], ['rmse'])
        self.refuse(DATA, 'diff', self.a, self.b, '--fail-above', 'angle=1', names=['exit.X'])

    def test_not_finite(self):
        pixels = [(0.5, 0.5, 0.5)] * 9
        a = self.rgb('na.exr', 3, 3, pixels, **{'Z': [INF] * 9})
        b = self.rgb('nb.exr', 3, 3, [(NAN, 0.5, INF)] + pixels[1:], **{'Z': [INF] * 8 + [1]})
        said = self.diff(a, b)
        layers = {layer['name']: layer for layer in said['layers']}
        self.assertEqual((layers['beauty']['not_finite'], layers['beauty']['values']), (2, 25))
        self.assertEqual((layers['Z']['not_finite'], layers['Z']['rmse']), (9, None))
        self.assertGreaterEqual(said['flip']['mean'], 1 / 9)
        self.assertRegex(self.succeed('diff', a, b).stdout.decode(), r'(?m)^Z +- +- +9$')
        for limit in ('flip=1', 'rmse=9', 'relmse=9', 'mae=9'):
            done = self.firn('diff', a, b, '--fail-above', limit)
            self.assertEqual(done.returncode, FAILED)
            self.assertIn('2 values of layer beauty are not finite', done.stderr.decode())

    def test_error_picture(self):
        self.succeed('diff', self.a, self.b, '-o', 'e.png', '-o', 'e.exr')
        picture = Png((self.folder / 'e.png').read_bytes())
        self.assertEqual(picture[60, 24], (2, 4, 35))  # no error
        self.assertGreater(sum(picture[5, 24]), 120)
        numbers = Exr((self.folder / 'e.exr').read_bytes())
        self.assertEqual(numbers.channels, {'flip.Z': 'float'})
        errors = numbers.read_planes(['flip.Z'])['flip.Z']
        self.near(sum(errors) / len(errors), self.diff(self.a, self.b)['flip']['mean'], 1e-6)
        self.assertEqual(errors[WIDTH - 1], 0)

    def test_error_picture_of_a_mask(self):
        self.exr('mask.exr', WIDTH, HEIGHT, {'A': [x < 10 for y in range(HEIGHT)
                                                   for x in range(WIDTH)]})
        self.succeed('diff', self.a, self.b, '--mask', 'mask.exr', '-o', 'e.png')
        picture = Png((self.folder / 'e.png').read_bytes())
        self.assertEqual(picture[15, 24], (0, 0, 0))
        self.assertGreater(sum(picture[5, 24]), 120)

    def test_error_picture_of_angles(self):
        up = self.exr('up.exr', 2, 1, {'exit.X': [0, 0], 'exit.Y': [1, 0], 'exit.Z': [0, 0]})
        on = self.exr('on.exr', 2, 1, {'exit.X': [0, 0], 'exit.Y': [0, 0], 'exit.Z': [1, 1]})
        self.succeed('diff', up, on, '-o', 'e.exr')
        planes = Exr((self.folder / 'e.exr').read_bytes()).read_planes(['angle.Z'])
        self.near(planes['angle.Z'][0], 90, 1e-4)
        self.assertEqual(planes['angle.Z'][1], 0)
        self.refuse(DATA, 'diff', up, on, '-o', 'e.png', names=['e.png', 'R, G and B'])

    def test_outputs_that_fail(self):
        self.refuse(CANT_CREATE, 'diff', self.a, self.b, '-o', 'gone/e.png', names=['gone'])
        with open('/dev/full', 'wb') as full:
            self.assertEqual(self.firn('diff', self.a, self.b, stdout=full).returncode, WRITE)

    def test_text_is_narrow(self):
        names = {f'{"layer" * (i % 7)}{i:02}.Z': [0] * 4 for i in range(60)}
        a = self.exr('many.exr', 2, 2, {'R': [0] * 4, **names})
        b = self.exr('few.exr', 2, 2, {'R': [0] * 4, 'N.X': [0] * 4})
        lines = self.succeed('diff', a, b).stdout.decode().splitlines()
        self.assertEqual([line for line in lines if len(line) > 100], [])
        said = ' '.join(lines)
        for name in names:
            self.assertIn(name, said)
        self.assertIn('only in the test: N.X', said)

    def test_names_that_are_not_utf8(self):
        name = self.folder / b'\xff\n.exr'.decode('utf-8', 'surrogateescape')
        name.write_bytes((self.folder / self.a).read_bytes())
        said = self.diff(str(name), self.a)
        self.assertTrue(said['reference'].endswith('?\n.exr'))
        self.assertEqual(said['rmse'], 0)


if __name__ == '__main__':
    main()
