"""test_panorama.py: an environment as a latlong picture and as cubes. Usage: see case.py."""
import math
import sys

sys.dont_write_bytecode = True  # the source tree stays clean
from case import (  # noqa: E402
    DATA, NO_DRIVER, PLAIN, SMALL, SMALL_CUBE, Case, long, main, unsanitized)
from exr_file import Exr, attribute, write_exr  # noqa: E402
from gltf_file import boxes, glass  # noqa: E402

SIDE = 32
CUBE = attribute('envmap', 'envmap', b'\1')
# Forward, right and up of a picture on each side, as seen from inside, with -Z ahead.
LEFT, FRONT, RIGHT, BACK, UP, DOWN = (
    ((-1, 0, 0), (0, 0, -1), (0, 1, 0)), ((0, 0, -1), (1, 0, 0), (0, 1, 0)),
    ((1, 0, 0), (0, 0, 1), (0, 1, 0)), ((0, 0, 1), (-1, 0, 0), (0, 1, 0)),
    ((0, 1, 0), (1, 0, 0), (0, 0, 1)), ((0, -1, 0), (1, 0, 0), (0, 0, -1)))
UPSIDE_DOWN = ((0, 0, 1), (1, 0, 0), (0, -1, 0))


def light(x, y, z):
    """Radiance of a direction: no two sides are alike."""
    return (0.6 + 0.4 * x + 0.2 * y * z, 0.5 + 0.3 * y - 0.2 * z * x, 0.5 + 0.4 * z + 0.1 * x)


def unit(v):
    length = math.hypot(*v)
    return [c / length for c in v]


def seen(side, s, t):
    """Right and down from -1 to 1."""
    forward, right, up = side
    return light(*unit([f + s * r - t * u for f, r, u in zip(forward, right, up)]))


def middles(count):
    return [(2 * i + 1) / count - 1 for i in range(count)]


def sheet(rows, more=b'', names='RGB', **windows):
    """An EXR of rows of pixels."""
    pixels = [pixel for row in rows for pixel in row]
    return write_exr((len(rows[0]), len(rows)), {
        name: [p[i % 3] for p in pixels] for i, name in enumerate(names)}, more, **windows)


def latlong_rows(width=4 * SIDE, height=2 * SIDE):
    return [[light(math.sin(a) * math.sin(b), math.cos(a), -math.sin(a) * math.cos(b))
             for b in (math.pi * s for s in middles(width))]
            for a in (math.pi / 2 * (t + 1) for t in middles(height))]


def latlong():
    return sheet(latlong_rows())


def of_sides(table):
    return sheet([[seen(side, s, t) if side else (0, 0, 0) for side in row for s in middles(SIDE)]
                  for row in table for t in middles(SIDE)])


def openexr():
    """As ImfEnvmap.cpp: +Z in the middle of a latlong picture; middles of texels at the edges."""
    faces = [[[None] * SIDE for _ in range(SIDE)] for _ in range(6)]
    for i in range(SIDE):
        for j in range(SIDE):
            a, b, last = (2 * i / (SIDE - 1) - 1), (2 * j / (SIDE - 1) - 1), SIDE - 1
            for face, (x, y), way in ((0, (j, last - i), (1, a, b)),
                                      (1, (last - j, last - i), (-1, a, b)),
                                      (2, (i, last - j), (a, 1, b)), (3, (i, j), (a, -1, b)),
                                      (4, (last - i, last - j), (a, b, 1)),
                                      (5, (i, last - j), (a, b, -1))):
                x_dir, y_dir, z_dir = unit(way)
                faces[face][y][x] = light(-x_dir, y_dir, -z_dir)
    return sheet([row for face in faces for row in face], CUBE)


def vulkan():
    """Right and up in the picture: Vulkan 1.3, Cube Map Face Selection."""
    return [((1, 0, 0), (0, 0, -1), (0, 1, 0)), ((-1, 0, 0), (0, 0, 1), (0, 1, 0)),
            ((0, 1, 0), (1, 0, 0), (0, 0, -1)), ((0, -1, 0), (1, 0, 0), (0, 0, 1)),
            ((0, 0, 1), (1, 0, 0), (0, 1, 0)), ((0, 0, -1), (-1, 0, 0), (0, 1, 0))]


class Panorama(Case):
    def draw(self, data, *words, model='reference'):
        (self.folder / 'env.exr').write_bytes(data)
        done = self.succeed('render', 'sphere', '--size', '32x24', *PLAIN, '-q', '-r', model,
                            '--env', 'env.exr', *words, '-o', 'a.exr',
                            env=NO_DRIVER if model == 'reference' else ())
        self.said = done.stderr.decode()
        return Exr((self.folder / 'a.exr').read_bytes()).read_planes(['R', 'G', 'B'])

    def test_cubes_are_panoramas(self):
        truth = self.draw(latlong())
        for name, data in (('openexr', openexr()), ('row', of_sides([vulkan()])),
                           ('cross', of_sides([[None, UP, None, None], [LEFT, FRONT, RIGHT, BACK],
                                               [None, DOWN, None, None]])),
                           ('tall cross', of_sides([[None, UP, None], [LEFT, FRONT, RIGHT],
                                                    [None, DOWN, None],
                                                    [None, UPSIDE_DOWN, None]]))):
            found = self.draw(data)
            worst = max(abs(a - b) for c in 'RGB' for a, b in zip(truth[c], found[c]))
            self.assertLess(worst, 0.01, name)
        turned = self.draw(data, '--env-rotate', '90')
        self.assertGreater(max(abs(a - b) for a, b in zip(truth['R'], turned['R'])), 0.1)

    def test_the_background_is_blurred(self):
        """Where it is visible directly; what the sphere refracts stays the same."""
        stripes = sheet([[(i % 2, i % 2, i % 2) for i in range(64)]] * 32)
        sharp, blurred = (self.draw(stripes, *words, model='paper')['R']
                          for words in ((), ('--set', 'env.blur=30')))
        edge, middle = slice(0, 8), 12 * 32 + 16  # 32 x 24 pixels
        self.assertGreater(max(sharp[edge]) - min(sharp[edge]), 0.5)
        self.assertLess(max(blurred[edge]) - min(blurred[edge]), 0.2)
        self.assertEqual(sharp[middle], blurred[middle])

    def test_the_display_window_is_the_panorama(self):
        rows, black = latlong_rows(), (0, 0, 0)
        width, height, even = 4 * SIDE, 2 * SIDE, [[(0.5, 0.5, 0.5)] * 5] * 3
        whole = 0, 0, width - 1, height - 1
        framed = [[black] * 3 + row + [black] * 9 for row in [rows[-1]] * 2 + rows + [rows[0]]]
        half = sheet([[black] * width] * SIDE + rows[SIDE:])
        said = attribute('envmap', 'envmap', b'\0')
        for found, wanted in (
                (sheet(framed, at=(-3, -2), display=whole), sheet(rows)),
                (sheet(rows, at=(-70, 90)), sheet(rows)),
                (sheet(rows[SIDE:], at=(0, SIDE), display=whole), half),
                (sheet(rows[SIDE:], at=(5, 5), display=(5, 5 - SIDE, width + 4, SIDE + 4)), half),
                (sheet(rows, said, display=(0, 0, 1919, 1079)), sheet(rows)),
                (sheet(even, at=(200, 0), display=whole), sheet([[black] * width] * height))):
            self.assertEqual(self.draw(found), self.draw(wanted))
        (self.folder / 'env.exr').write_bytes(sheet(rows, at=(-1, 2), display=(1, 0, 300, 99)))
        self.refuse(DATA, 'render', 'sphere', '--env', 'env.exr', '-o', 'a.exr', env=NO_DRIVER,
                    names=('2:1', '300 x 100', 'display window', f'{width} x {height} at -2, 2'))

    def test_layers(self):
        rows = latlong_rows()
        plain = self.draw(sheet(rows))
        dark = [f'z.{c}' for c in 'RGB']
        names = [f'View Layer.Combined.{c}' for c in 'RGB']
        self.assertEqual(self.draw(sheet(rows, names=names)), plain)
        self.assertEqual(self.said, '')
        self.assertEqual(self.draw(sheet(rows, names=[*names, *dark, 'a.R', 'a.G'])), plain)
        self.assertRegex(self.said, r"\Afirn: note: env.exr: .* 'View Layer.Combined' .* 'z'\n\Z")
        self.assertEqual(self.draw(sheet(rows, names=['R', 'G', 'B', *dark])), plain)
        self.assertEqual(self.said, '')
        (self.folder / 'env.exr').write_bytes(sheet(rows, names=('RY', 'BY', 'Y')))
        self.refuse(DATA, 'render', 'sphere', '--env', 'env.exr', '-o', 'a.exr', env=NO_DRIVER,
                    names=('R, G and B, or Y', 'luminance and chroma'))

    def test_sizes_that_miss_two_to_one_by_a_pixel(self):
        truth = self.draw(latlong())
        for width, height in ((127, 64), (128, 63), (129, 64)):
            found = self.draw(sheet(latlong_rows(width, height)))
            worst = max(abs(a - b) for c in 'RGB' for a, b in zip(truth[c], found[c]))
            self.assertLess(worst, 0.005, (width, height))
        for width, height in ((124, 64), (5, 3)):
            (self.folder / 'env.exr').write_bytes(sheet(latlong_rows(width, height)))
            self.refuse(DATA, 'render', 'sphere', '--env', 'env.exr', '-o', 'a.exr',
                        names=('2:1', f'{width} x {height}'), env=NO_DRIVER)

    def test_invalid_texels_are_counted(self):
        rows, black = latlong_rows(), (0, 0, 0)
        for i, value in enumerate((math.nan, math.inf, -math.inf, -1)):
            rows[i][7] = (value, 0, value)
        found = self.draw(sheet(rows))
        self.assertRegex(self.said, r'\Afirn: note: env.exr: 4 texels .* taken as 0\n\Z')
        for i in range(4):
            rows[i][7] = black
        self.assertEqual(found, self.draw(sheet(rows)))

    @unsanitized
    def test_a_background_beside_it_is_behind_all(self):
        (self.folder / 'env.exr').write_bytes(latlong())
        for rung in ('reference', 'trace', 'bounce'):
            words = ('render', 'sphere', '--size', '32x24', *PLAIN, '-q', '-r', rung, '-o', 'a.exr')
            planes = []
            for more in (), ('--background', '.5,.25,2'), ('--background', 'none'):
                self.succeed(*words, '--env', 'env.exr', *more)
                planes.append(Exr((self.folder / 'a.exr').read_bytes()).read_planes('RGBA'))
            lit, plate, hidden = planes
            self.assertEqual(min(hidden['A']), 0)
            self.assertLessEqual(max(hidden['A']), 1)  # of glass, less
            for name, value in zip('RGB', (0.5, 0.25, 2)):
                self.assertEqual(plate[name], [b if a else value for a, b in
                                               zip(hidden['A'], lit[name])], rung)

    def test_it_lights_partly_transmissive_objects(self):
        """What is white shows an even light everywhere."""
        half = glass()
        half['extensions']['KHR_materials_transmission']['transmissionFactor'] = 0.4
        (self.folder / 'a.gltf').write_text(boxes((half, [0, 0, 0], 1)))
        (self.folder / 'even.exr').write_bytes(sheet([[(0.5, 0.25, 0.125)] * 16] * 8))
        self.succeed('render', 'a.gltf', '--size', '16x12', '-q', '-r', 'reference', '--env',
                     'even.exr', '--aov', 'remaining', '-o', 'a.exr', env=NO_DRIVER)
        planes = Exr((self.folder / 'a.exr').read_bytes()).read_planes(
            ['R', 'G', 'B', 'remaining.R'])
        for name, wanted in zip('RGB', (0.5, 0.25, 0.125)):
            for found, cut in zip(planes[name], planes['remaining.R']):
                self.assertAlmostEqual(found / wanted + cut, 1, delta=0.02)

    # ---- the sun of a file ----

    def sunny(self, *words, sun='0 50 0.8 0.6 0.4', rung='reference'):
        """A floor around (-3, 0, 0) from above: under even light and that of the sun, in which is
        a black box without refraction, 3 m above the origin."""
        black = glass(1)
        black['extensions']['KHR_materials_volume'].update(
            attenuationDistance=1e-3, attenuationColor=[1e-3] * 3)
        floor = {'pbrMetallicRoughness': {'baseColorFactor': [0.5, 0.5, 0.5, 1],
                                          'metallicFactor': 0},
                 'extensions': {'KHR_materials_specular': {'specularFactor': 0}}}
        clear = glass(1)
        (self.folder / 'a.gltf').write_text(boxes(
            (floor, [0, -2000, 0], 2000), (black, [0, 3, 0], 1), (clear, [-3, 1, 3], 0.5)))
        (self.folder / 'even.exr').write_bytes(sheet(
            [[(0.25, 0.25, 0.25)] * 16] * 8, attribute('firn/sun', 'string', sun.encode())))
        done = self.succeed('render', 'a.gltf', '--size', '33x33', '-r', rung, '-q', '--env',
                            'even.exr', '--eye', '-3,12,0.001', '--target=-3,0,0', '--fov', '40',
                            *SMALL_CUBE, *words, '-o', 'a.exr',
                            env=NO_DRIVER if rung == 'reference' else ())
        planes = Exr((self.folder / 'a.exr').read_bytes()).read_planes('RGB')
        pixels = {'open': 16 * 33 + 2, 'shadow': 16 * 33 + 16, 'through': 27 * 33 + 16}
        return {name: [planes[c][at] for c in 'RGB'] for name, at in pixels.items()}, done

    def check_light(self, found, sun, height_deg, delta=0.004):
        rise = math.sin(math.radians(height_deg))
        for value, light_of_sun in zip(found, sun):
            self.assertAlmostEqual(value, 0.5 * (0.25 + light_of_sun * rise), delta=delta)

    @unsanitized
    def test_the_sun_of_a_file_lights_surfaces(self):
        sun, dark = (0.8, 0.6, 0.4), (0, 0, 0)
        own = ('--set', 'env.sun=own', '--set', 'env.sun_strength=0.3', '--set')
        for rung in ('reference', 'bounce', 'trace'):
            for words, light_there, height in (
                    ((), sun, 50), (('--set', 'env.sun=none'), dark, 0),
                    (('--env-exposure', '1', '--set', 'env.sun_strength=0.25'), None, 50),
                    ((*own, 'env.sun_elevation=30'), (0.3,) * 3, 30)):
                if rung != 'reference' and light_there is not sun:
                    continue
                seen_there, _ = self.sunny(*words, rung=rung)
                with self.subTest((rung, words)):
                    if light_there is None:  # twice the light of all but the sun, and half of its
                        self.check_light([v - 0.125 for v in seen_there['open']],
                                         [v / 2 for v in sun], height)
                        continue
                    self.check_light(seen_there['open'], light_there, height)
                    if rung != 'bounce':  # which looks up the environment cube
                        self.check_light(seen_there['through'], light_there, height)

    @long
    def test_objects_have_shadows(self):
        """The sun is turned with the panorama, from +Z to +X, so the shadow is beside the box."""
        for rung in ('reference', 'bounce', 'trace'):
            found, _ = self.sunny('--set', 'motion.ice=0', '--set', 'ao.strength=0',
                                  '--env-rotate', '90', sun='0 45 0.8 0.6 0.4', rung=rung)
            with self.subTest(rung):
                self.check_light(found['open'], (0.8, 0.6, 0.4), 45)
                self.check_light(found['shadow'], (0, 0, 0), 45)

    def test_its_disc_is_seen(self):
        """As bright as it has to be for its light."""
        for rung in ('reference', 'paper'):
            (self.folder / 'even.exr').write_bytes(sheet(
                [[(0.25, 0.25, 0.25)] * 16] * 8,
                attribute('firn/sun', 'string', b'180 30 0.02 0.01 0')))
            self.succeed('render', 'sphere', *SMALL, '-r', rung, '-q', '--env', 'even.exr', '--eye',
                         '0,0,-5', '--target', '0,5.7735,-15', '--set', 'caustics.sun=20', '--fov',
                         '60', '-o', 'a.exr', env=NO_DRIVER if rung == 'reference' else ())
            planes = Exr((self.folder / 'a.exr').read_bytes()).read_planes('RGB')
            sums = [sum(planes[c]) - 0.25 * len(planes[c]) for c in 'RGB']
            radius = math.radians(10)
            pixels = math.pi * (24 * math.tan(radius) / math.tan(math.radians(30))) ** 2
            for found, light_there in zip(sums, (0.02, 0.01, 0)):
                wanted = pixels * light_there / radius ** 2
                self.assertAlmostEqual(found, wanted, delta=0.04 * wanted + 0.01)

    def test_a_sun_that_is_none(self):
        for text in ('0 50 1 1', '0 91 1 1 1', '0 50 nan 1 -1'):
            found, done = self.sunny(sun=text)
            with self.subTest(text):
                self.check_light(found['open'], (0, 0, 0), 50)
                self.assertRegex(done.stderr.decode(),
                                 rf'\Afirn: warning: even.exr: firn/sun: expected .*{text}.*\n\Z')

    def test_an_ordinary_picture_is_no_cross(self):
        even = (0.1, 0.2, 0.3)
        dotted = [[even if y // 16 == 1 or x // 16 == 1 else (0, 0, 0) for x in range(64)]
                  for y in range(48)]
        dotted[47][63] = even
        for rows in [[even] * 64] * 48, dotted:
            (self.folder / 'env.exr').write_bytes(sheet(rows))
            self.refuse(DATA, 'render', 'sphere', '--env', 'env.exr', '-o', 'a.exr',
                        names=('env.exr', '64 x 48', '2:1'), env=NO_DRIVER)


if __name__ == '__main__':
    main()
