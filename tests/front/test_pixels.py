"""test_pixels.py: what options do to the pixels of a picture. Usage: see case.py."""
import json
import pathlib
import re
import struct
import sys

sys.dont_write_bytecode = True  # the source tree stays clean
sys.path.append(str(pathlib.Path(__file__).parents[1] / 'support'))
from case import DATA, PLAIN, USAGE, Case, long, main, unsanitized  # noqa: E402
from exr_file import Exr, attribute, write_exr  # noqa: E402
from gltf_file import boxes, glass  # noqa: E402
from png_file import Png  # noqa: E402

TINY = ('sphere', '--size', '32x24', *PLAIN, '-q')
HAS_REFERENCE = '--without' not in sys.argv


class Pixels(Case):
    def draw(self, *arguments, scene=TINY):
        """An EXR."""
        self.succeed('render', *scene, *arguments, '-o', 'a.exr')
        return Exr((self.folder / 'a.exr').read_bytes())


class PixelFilter(Pixels):
    @unsanitized
    def test_each_has_its_samples(self):
        traced = ('-r', 'reference', '--set', 'reference.russian_roulette=off')
        for more in ((), ('--tiles', '2x1')) + ((traced,) if HAS_REFERENCE else ()):
            with self.subTest(more=more):
                one = self.draw(*more)
                point = self.draw('--samples', '2', '--pixel-filter', 'point', *more)
                self.assertEqual(point.pixels, one.pixels)
                box = self.draw('--samples', '2', *more)
                self.assertNotEqual(box.pixels, one.pixels)
                wide = self.draw('--samples', '2', '--pixel-filter', 'blackman-harris', *more)
                self.assertNotIn(wide.pixels, (box.pixels, one.pixels))
                self.assertIn(' pixel-filter=blackman-harris ', wide.text('firn/settings'))

    def test_all_but_the_box_are_recorded(self):
        self.assertNotIn('pixel-filter', self.draw('--pixel-filter', 'box').text('firn/settings'))
        point = self.draw('--pixel-filter', 'point', '--frames', '3')
        self.assertIn(' pixel-filter=point ', point.text('firn/settings'))

    def test_others_are_refused(self):
        for name in ('', 'Box', 'gauss'):
            self.refuse(USAGE, 'render', *TINY, '--pixel-filter', name,
                        names=['--pixel-filter', name, 'box, point or blackman-harris'])


class Adaptive(Pixels):
    @unsanitized
    def test_a_small_picture_is_one_part(self):
        """Samples that are all alike have no noise."""
        words = ('render', *TINY[:-1], '--samples', 'auto', '-o', 'a.exr', '-o', 'a.png')
        for more, counts in (((), (16, 64)), (('--pixel-filter', 'point'), (4,))):
            said = self.succeed(*words, *more).stderr.decode()
            count = int(re.search(r'a\.exr: 32x24, (\d+) samples on average\n', said)[1])
            self.assertIn(count, counts)
            found = Exr((self.folder / 'a.exr').read_bytes())
            self.assertIn(' samples=auto ', found.text('firn/settings'))
            self.assertEqual(found.pixels, self.draw('--samples', count, *more).pixels)
        self.succeed(*words)
        self.assertEqual(self.succeed(*words, '--resume').stderr.count(b'up to date'), 2)

    @long
    def test_each_cell_has_its_own(self):
        """And the pixels of a picture with as many everywhere, in all layers."""
        width, height, cell = 512, 320, 32
        (self.folder / 'even.hdr').write_bytes(
            b'#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 4 +X 8\n' + bytes((128,) * 4) * 32)
        scene = ('sphere', '--size', f'{width}x{height}', *PLAIN, '-q', '--env', 'even.hdr',
                 '--background', 'none', '--eye', '-2,1,12', '--target', '-2,1,0',
                 '--aov', 'N,refraction')
        layers = (*'RGB', 'refraction.G', 'N.X')
        planes = [self.draw('--samples', count, scene=scene).read_planes(layers)
                  for count in ('auto', 4, 16, 64)]
        counts = []
        for top in range(0, height, cell):
            for left in range(0, width, cell):
                cells = [[plane[name][y * width + left:y * width + left + cell]
                          for name in layers for y in range(top, top + cell)] for plane in planes]
                counts.append([i for i in (1, 2, 3) if cells[i] == cells[0]])
        self.assertNotIn([], counts)
        self.assertEqual(counts[0], [1, 2, 3])  # nothing is there
        self.assertTrue(0 < sum(1 not in each for each in counts) < 60, counts)

    def test_what_it_cannot_do(self):
        for words, name in ((('--tiles', '2x1'), '--tiles'),) + (
                ((('-r', 'reference'), '--noise'),) if HAS_REFERENCE else ()):
            self.refuse(USAGE, 'render', *TINY, '--samples', 'auto', *words,
                        names=['--samples auto', name])
        for value in ('Auto', '0', '4x', '65537'):
            self.refuse(USAGE, 'render', *TINY, '--samples', value,
                        names=['--samples', value, '1 to 65536, or auto'])


class Caustics(Pixels):
    @long
    def test_noise_falls_with_samples(self):
        """Each sample has photons and directions of its own; those of the first are as ever."""
        pool = ('pool', '--size', '32x24', '-q', '--pixel-filter', 'point', '--aov', 'caustics')
        for method in ('naive', 'gather'):
            words = ('--set', f'caustics.method={method}', '--set', 'caustics.photons=20000',
                     '--set', 'caustics.directions=1', '--set', 'caustics.sun=15')
            light = [self.draw(*words, '--samples', count, scene=pool).read_planes(
                ['caustics.Z'])['caustics.Z'] for count in (1, 4, 16)]
            errors = [sum((a - b) ** 2 for a, b in zip(found, light[2])) for found in light[:2]]
            self.assertGreater(errors[1], 0)
            self.assertGreater(errors[0], 2.5 * errors[1])


class ToneCurve(Pixels):
    def test_each_differs_and_is_recorded(self):
        words = ('render', *TINY, '-o', 'a.png', '-o', 'a.exr')
        pictures, linear = set(), set()
        for curve in ('neutral', 'clip', 'agx', 'aces', 'hable'):
            self.succeed(*words, '--tone-curve', curve)
            picture = Exr((self.folder / 'a.exr').read_bytes())
            self.assertIn(f' tonemap.curve={curve} ', picture.text('firn/settings') + ' ')
            pictures.add((self.folder / 'a.png').read_bytes())
            linear.add(picture.pixels)
        self.assertEqual((len(pictures), len(linear)), (5, 1))
        self.refuse(USAGE, *words, '--tone-curve', 'filmic', names=['--tone-curve', 'agx'])


class NoBackground(Pixels):
    INSIDE = ('--samples', '4', '--set', 'cracks.count=2', '--set', 'bubbles.count=40')
    HIDE = ('--background', '0.5,0.5,0.5', '--background', 'none', *INSIDE)
    SHOW = ('--background', '0.5,0.5,0.5', *INSIDE)

    def check(self, *words):
        """Over the sky, which is grey, the image has the luminance of the one with the sky."""
        names = ('R', 'G', 'B', 'A')
        shown = self.draw(*self.SHOW, *words).read_planes(names)
        picture = self.draw(*self.HIDE, *words)
        self.assertIn(' background=none ', picture.text('firn/settings'))
        hidden = picture.read_planes(names)
        self.assertEqual(set(shown['A']), {1})
        self.assertIn(0, hidden['A'])
        self.assertTrue(any(0.3 < alpha < 0.7 for alpha in hidden['A']))
        self.assertTrue(all(0 <= alpha <= 1 for alpha in hidden['A']))
        for before, after, alpha in zip(*(zip(*(planes[c] for c in 'RGB'))
                                          for planes in (shown, hidden)), hidden['A']):
            before, after = (0.2126 * r + 0.7152 * g + 0.0722 * b for r, g, b in (before, after))
            self.assertLess(abs(after + (1 - alpha) * 0.5 - before), 2e-3)
            self.assertTrue(alpha or after == 0)
        return hidden

    @unsanitized
    def test_coverage(self):
        for words in [(), ('-r', 'bounce'), ('--tiles', '2x1')] + [
                ('-r', 'reference', '--set', 'motion.count=0')] * HAS_REFERENCE:
            with self.subTest(words=words):
                self.check(*words)

    def test_straight_alpha(self):
        hidden = self.check('--set', 'tonemap.curve=clip')
        for bits in ('8', '16'):
            self.succeed('render', *TINY, *self.HIDE, '--tone-curve', 'clip', '--png-bits', bits,
                         '--set', 'tonemap.resolve=linear', '-o', 'a.png')
            png = Png((self.folder / 'a.png').read_bytes())
            most = 2 ** int(bits) - 1
            self.assertEqual((png.channels, png.bits), (4, int(bits)))
            for value, alpha in zip(png.values[3::4], hidden['A']):  # halves in EXR files
                self.assertAlmostEqual(value / most, alpha, delta=0.5 / most + 5e-4)
            for c, name in enumerate('RGB'):
                for value, linear, alpha in zip(png.values[c::4], hidden[name], hidden['A']):
                    if alpha == 0:  # libpng makes 16 bits white there
                        continue
                    x = min(linear / alpha, 1)
                    wanted = 12.92 * x if x <= 0.0031308 else 1.055 * x ** (1 / 2.4) - 0.055
                    self.assertLess(abs(value / most - wanted), 3e-3)
        again = ('render', *TINY[:-1], *self.HIDE, '--tone-curve', 'clip', '--png-bits', '16',
                 '--set', 'tonemap.resolve=linear', '--resume', '-o', 'a.png')
        self.assertIn(b'up to date', self.succeed(*again).stderr)

    @unsanitized
    def test_plate(self):
        """Alpha is 1 - the luminance of a plate's transmittance, and 1 before an opaque wall."""
        color, plate = (0.9, 0.5, 0.2), glass()
        plate['extensions']['KHR_materials_volume'].update(
            attenuationDistance=0.2, attenuationColor=color)
        wall = {'pbrMetallicRoughness': {'metallicFactor': 0}}
        (self.folder / 'a.gltf').write_text(boxes(
            (plate, [0, 0, 0], [1, 1, 0.1]), (wall, [0, 1.1, -3], [1, 0.9, 0.1])))
        through = 0.96 ** 2 * (0.2126 * color[0] + 0.7152 * color[1] + 0.0722 * color[2])
        for model in ['bounce', 'trace'] + ['reference'] * HAS_REFERENCE:
            alpha = self.draw(
                '--env', 'studio', '--background', 'none', '-r', model, '--samples', '1', '--eye',
                '0,0,20', '--target', '0,0,0', '--fov', '8', '--size', '33x33', '--plain', '-q',
                scene=['a.gltf']).read_planes('A')['A']
            self.assertAlmostEqual(alpha[16 * 33 + 16], 1 - through, delta=3e-3, msg=model)
            self.assertEqual((alpha[6 * 33 + 16], alpha[0]), (1, 0), model)

    def test_wrong_word(self):
        self.refuse(USAGE, 'render', *TINY, '--background', 'nothing', names=['or none'])


class Place(Pixels):
    POINTS = ((0, 1, 0.2), (-1, -1, 1), (1, -1, 0.5), (0.3, -0.4, -1))

    def model(self, name, change):
        """A tetrahedron without a plane of symmetry, its points changed."""
        lines = ['v {} {} {}'.format(*change(*point)) for point in self.POINTS]
        (self.folder / name).write_text('\n'.join(
            [*lines, 'f 1 2 3', 'f 1 3 4', 'f 1 4 2', 'f 2 4 3', '']))
        return name, '--size', '32x24', *PLAIN, '-q', '--env', 'sky.exr', '--aov', 'P'

    @unsanitized
    def test_as_if_the_file_were_so(self):
        (self.folder / 'sky.exr').write_bytes(write_exr((2, 1), {'Y': [0.5, 1]}))
        plain = self.model('a.obj', lambda *p: p)
        for words, change in (
                (('--up', 'z'), lambda x, y, z: (x, z, -y)),
                (('--scale', '2.5'), lambda x, y, z: (2.5 * x, 2.5 * y, 2.5 * z)),
                (('--rotate', '90,0,0'), lambda x, y, z: (x, -z, y)),
                (('--rotate', '0,90,0'), lambda x, y, z: (z, y, -x)),
                (('--rotate', '90,90,0'), lambda x, y, z: (y, -z, -x)),
                (('--up', 'z', '--rotate', '0,0,-90', '--scale', '2'),
                 lambda x, y, z: (2 * z, -2 * x, -2 * y))):
            with self.subTest(words=words):
                found = self.draw(*words, scene=plain).read_planes(['P.X', 'P.Y', 'P.Z', 'R'])
                wanted = self.draw(scene=self.model('b.obj', change)).read_planes(found)
                for name, plane in found.items():
                    pairs = list(zip(plane, wanted[name], strict=True))
                    self.assertLess(sum(abs(a - b) > 1e-2 for a, b in pairs), 5)
                self.assertGreater(sum(x != 0 for x in found['P.X']), 30)

    def test_refused(self):
        for words, names in ((('--up', 'x'), ['y or z']), (('--scale', '0'), ['1e-6']),
                             (('--rotate', '1,2'), ['X,Y,Z']),
                             (('--scale', '2'), ['sphere', 'model file'])):
            self.refuse(USAGE, 'graph', 'sphere', *words, names=[words[0], *names])
        self.model('a.obj', lambda *p: p)
        self.refuse(DATA, 'graph', 'a.obj', '--scale', '1e6', '--rotate', '0,0,45',
                    names=['a.obj', '--scale'])


class Resolve(Pixels):
    def draw_both(self, *words):
        self.succeed('render', *TINY[:-1], *words, '-o', 'a.exr', '-o', 'a.png')
        return [(self.folder / name).read_bytes() for name in ('a.exr', 'a.png')]

    @unsanitized
    def test_weights_are_of_png_files(self):
        for words in [(), ('--png-bits', '16')] + [('-r', 'reference')] * HAS_REFERENCE:
            for samples in '1', '3':
                with self.subTest(words=words, samples=samples):
                    more = (*words, '--samples', samples, '--set')
                    linear, weighted = (self.draw_both(*more, f'tonemap.resolve={value}')
                                        for value in ('linear', 'weighted'))
                    planes, same = (Exr(exr).read_planes('RGBA') for exr in
                                    (linear[0], weighted[0]))
                    self.assertEqual(planes, same)
                    pairs = list(zip(*(Png(png).values for _, png in (linear, weighted))))
                    self.assertEqual(any(a != b for a, b in pairs), samples != '1')
                    self.assertGreaterEqual(sum(a for a, _ in pairs), sum(b for _, b in pairs))


    @unsanitized
    def test_filter_is_of_the_level(self):
        def draw(*words):
            self.succeed('render', 'sphere', '--size', '32x24', '-q', '--quality', 'high',
                         '--samples', '2', *words, '-o', 'a.exr', '-o', 'a.png')
            return (self.folder / 'a.exr').read_bytes(), (self.folder / 'a.png').read_bytes()
        for words in [()] + [('-r', 'reference')] * HAS_REFERENCE:
            for more, value in (((), 'filtered'), (('--plain',), 'weighted'),
                                (('--pixel-filter', 'box'), 'weighted')):
                with self.subTest(words=words, more=more):
                    exr, png = draw(*words, *more)
                    self.assertEqual((exr, png), draw(
                        *words, *more, '--set', f'tonemap.resolve={value}'))
                    others = [draw(*words, *more, '--set', f'tonemap.resolve={name}')
                              for name in {'filtered', 'weighted', 'linear'} - {value}]
                    for other in others:
                        self.assertEqual(Exr(exr).pixels, Exr(other[0]).pixels)
                        self.assertNotEqual(Png(png).values, Png(other[1]).values)


class PngBits(Pixels):
    def draw_png(self, *arguments):
        self.succeed('render', *TINY, *arguments, '-o', 'a.png')
        return Png((self.folder / 'a.png').read_bytes())

    def tonemap_settings(self):
        """Each setting of tone mapping, except dithering, with one value or with all choices."""
        rows = json.loads(self.succeed('list', 'settings', '--json').stdout)
        for row in rows['settings']:
            if row['name'].startswith('tonemap.') and row['name'] != 'tonemap.dither':
                values = row.get('choices', ['on']) if row['type'] != 'number' else [
                    row['min'] + 9 / 16 * (row['max'] - row['min'])]
                yield from (('--set', f'{row["name"]}={value}') for value in values)

    @unsanitized
    def test_16_bits_are_finer(self):
        more = [(), ('--samples', '2'), ('--tiles', '2x1'), ('--show', 'N'),
                *self.tonemap_settings()]
        for words in more + [('-r', 'reference')] * HAS_REFERENCE:
            with self.subTest(words=words):
                coarse = self.draw_png(*words)
                fine = self.draw_png('--png-bits', '16', *words)
                self.assertEqual((coarse.bits, fine.bits, fine.channels), (8, 16, 3))
                self.assertEqual((fine.chunks['sRGB'], fine.chunks.get('gAMA')), (b'\0', None))
                self.assertLess(max(abs(a - b / 257) for a, b in
                                    zip(coarse.values, fine.values, strict=True)), 0.6)
                self.assertGreater(sum(value % 257 != 0 for value in fine.values), 100)

    def test_only_16_is_recorded(self):
        self.succeed('render', *TINY, '--png-bits', '16', '-o', 'a.exr', '-o', 'a.png')
        self.assertNotIn('png-bits', Exr((self.folder / 'a.exr').read_bytes()).text(
            'firn/settings'))
        again = ('--resume', '-o', 'a.png')
        for bits, count in (('16', 1), ('8', 0), ('8', 1)):
            words = ('render', *TINY[:-1], '--png-bits', bits, *again)
            self.assertEqual(self.succeed(*words).stderr.count(b'up to date'), count)
        self.refuse(USAGE, 'render', *TINY, '--png-bits', '12', names=['--png-bits', '8 or 16'])


class Environment(Pixels):
    def panorama(self, turned=0):
        """A file of 16 x 8 texels, each column another colour, turned by so many columns."""
        def shade(x, channel):
            return [0.1, 0.2, 0.9, 1.7][((x + turned) % 16 // 4 + channel) % 4]
        planes = {name: [shade(x, c) for _ in range(8) for x in range(16)]
                  for c, name in enumerate('RGB')}
        (self.folder / f'{turned}.exr').write_bytes(write_exr((16, 8), planes))
        return '--env', f'{turned}.exr'

    @unsanitized
    def test_turned_as_if_its_columns_were(self):
        for words in [()] + [('-r', 'reference')] * HAS_REFERENCE:
            with self.subTest(words=words):
                straight, turned = self.draw(*self.panorama(), *words), self.draw(
                    *self.panorama(4), *words)
                for degrees in ('90', '-270'):
                    found = self.draw(*self.panorama(), '--env-rotate', degrees, *words)
                    wanted = turned.read_planes('RGB')
                    for name, plane in found.read_planes('RGB').items():
                        self.assertLess(max(abs(a - b) for a, b in zip(plane, wanted[name])), 0.02)
                    self.assertNotEqual(found.pixels, straight.pixels)
                self.assertEqual(self.draw(*self.panorama(), '--env-rotate', '0', *words).pixels,
                                 straight.pixels)

    def test_exposed(self):
        words = ('--env-exposure', '2')
        for more in [()] + [('-r', 'reference')] * HAS_REFERENCE:
            dark = self.draw(*self.panorama(), *more).read_planes('RGB')
            bright = self.draw(*self.panorama(), *words, *more)
            self.assertIn(' env-exposure=2 ', bright.text('firn/settings'))
            ratios = [b / a for name, plane in bright.read_planes('RGB').items()
                      for a, b in zip(dark[name], plane) if a]
            self.assertAlmostEqual(sorted(ratios)[len(ratios) // 2], 4, 2)

    def test_cube_is_not_turned(self):
        (self.folder / 'cube.exr').write_bytes(
            write_exr((4, 24), {name: [1.0] * 96 for name in 'RGB'}))
        self.refuse(USAGE, 'render', *TINY, '--env', 'cube.exr', '-o', 'a.exr', '--env-rotate',
                    '45', names=['--env-rotate', 'cube'])

    @long
    def test_other_chromaticities(self):
        def sky(color, *primaries):
            more = attribute('chromaticities', 'chromaticities', struct.pack('<8f', *primaries)) \
                if primaries else b''
            planes = {name: [value] * 2 for name, value in zip('RGB', color)}
            (self.folder / 'p.exr').write_bytes(write_exr((2, 1), planes, more))
            done = self.succeed('render', *TINY, '--env', 'p.exr', '-o', 'c.exr', '-n', '1',
                                '--surroundings', 'far.obj', '--set', 'motion.count=0')
            planes = Exr((self.folder / 'c.exr').read_bytes()).read_planes('RGB')
            return [planes[name][0] for name in 'RGB'], done.stderr
        (self.folder / 'far.obj').write_text(
            'v 90 1 0\nv 89 -1 1\nv 91 -1 1\nv 90 -1 -1\nf 1 2 3\nf 1 3 4\nf 1 4 2\nf 2 4 3\n')
        rec2020 = (0.708, 0.292, 0.170, 0.797, 0.131, 0.046, 0.3127, 0.3290)
        for color, wanted in (((0.5, 0.5, 0.5), (0.5, 0.5, 0.5)),
                              ((0.2, 0.6, 0.3), (0, 0.6524, 0.2716)),
                              ((0.6, 0.5, 0.4), (0.6734, 0.4884, 0.3863))):
            found, said = sky(color, *rec2020)
            self.assertEqual(said, b'')
            for a, b in zip(found, wanted):
                self.assertAlmostEqual(a, b, delta=2e-3)
            self.assertLess(abs(sky(color)[0][1] - color[1]), 1e-3)
        self.assertIn(b'p.exr', sky((0.5, 0.5, 0.5), *[0] * 8)[1])

    def test_refused(self):
        for size in ((8, 5), (16, 2), (1, 1)):
            (self.folder / 'p.exr').write_bytes(write_exr(size, {'Y': [1] * (size[0] * size[1])}))
            self.refuse(DATA, 'render', *TINY, '--env', 'p.exr', '-o', 'a.exr',
                        names=['p.exr', '2:1', f'{size[0]} x {size[1]}'])
        for words, names in ((('--env-rotate', '45'), ['--env is missing']),
                             (('--env-exposure', '1'), ['--env is missing']),
                             (('--env-rotate', '400'), ['-360 to 360']),
                             (('--env-exposure', 'nan'), ['-16 to 16'])):
            self.refuse(USAGE, 'render', *TINY, *words, '-o', 'a.exr', names=[words[0], *names])


if __name__ == '__main__':
    if not HAS_REFERENCE:
        sys.argv.remove('--without')
    main()
