"""test_panorama.py: an environment as a latlong picture and as cubes. Usage: see case.py."""
import math
import sys

sys.dont_write_bytecode = True  # the source tree stays clean
from case import DATA, NO_DRIVER, PLAIN, Case, main  # noqa: E402
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


def sheet(rows, more=b''):
    """An EXR of rows of pixels."""
    pixels = [pixel for row in rows for pixel in row]
    return write_exr((len(rows[0]), len(rows)),
                     {name: [p[i] for p in pixels] for i, name in enumerate('RGB')}, more)


def latlong():
    return sheet([[light(math.sin(a) * math.sin(b), math.cos(a), -math.sin(a) * math.cos(b))
                   for b in (math.pi * s for s in middles(4 * SIDE))]
                  for a in (math.pi / 2 * (t + 1) for t in middles(2 * SIDE))])


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
    def draw(self, data, *words):
        (self.folder / 'env.exr').write_bytes(data)
        self.succeed('render', 'sphere', '--size', '32x24', *PLAIN, '-q', '-r', 'reference',
                     '--env', 'env.exr', *words, '-o', 'a.exr', env=NO_DRIVER)
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

    def test_an_ordinary_picture_is_no_cross(self):
        (self.folder / 'env.exr').write_bytes(sheet([[(0.1, 0.2, 0.3)] * 64] * 48))
        self.refuse(DATA, 'render', 'sphere', '--env', 'env.exr', '-o', 'a.exr',
                    names=('env.exr', '64 x 48', '2:1'), env=NO_DRIVER)


if __name__ == '__main__':
    main()
