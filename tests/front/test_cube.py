"""test_cube.py: tests --env with a cube map: a strip of six faces, instead of the drawn cube.

Usage: see case.py.
"""
import base64
import json
import pathlib
import struct
import sys

sys.dont_write_bytecode = True  # the source tree stays clean
from case import (  # noqa: E402
    DATA, SMALL, Case, long, main, unsanitized)
from exr_file import Exr, write_exr  # noqa: E402

SMOOTH = tuple(word for name in ('bump.strength', 'light.count', 'cracks.count', 'air.count',
                                 'bubbles.count') for word in ('--set', f'{name}=0'))
MIRROR = (*SMOOTH, '--set', 'refract.fresnel=crossfade', '--set', 'refract.crossfade=0')
COLOURS = ((1, 0, 0), (0, 1, 1), (0, 1, 0), (1, 0, 1), (0, 0, 1), (1, 1, 0))
# where the eye stands to see each face in a mirror: +X -X +Y -Y +Z -Z
ORBITS = ((90, 0), (270, 0), (0, 90), (0, -90), (0, 0), (180, 0))


def strip(side, alpha=None):
    """Six faces of one colour each."""
    planes = {name: [float(COLOURS[face][c]) for face in range(6) for _ in range(side * side)]
              for c, name in enumerate('RGB')}
    if alpha is not None:
        planes['A'] = [alpha] * (6 * side * side)
    return write_exr((side, 6 * side), planes)


class Cube(Case):
    def draw(self, name, *arguments):
        self.succeed('render', *arguments, '--validate', '-q', '-o', name)
        return Exr((self.folder / name).read_bytes())

    def planes(self, exr):
        return exr.read_planes(exr.channels)

    @long
    def test_faces_are_where_they_are_told(self):
        (self.folder / 'faces.exr').write_bytes(strip(4))
        for colour, (azimuth, elevation) in zip(COLOURS, ORBITS):
            picture = self.draw('a.exr', 'sphere', '--size', '33x33', '--env', 'faces.exr',
                                '--background', '0,0,0', '--orbit', f'{azimuth},{elevation},4',
                                *MIRROR)
            planes = self.planes(picture)
            seen = tuple(planes[name][16 * 33 + 16] for name in 'RGB')
            self.assertEqual(seen, colour)

    def test_background_and_surroundings_stay(self):
        (self.folder / 'faces.exr').write_bytes(strip(4))
        plain = self.planes(self.draw('a.exr', 'room', *SMALL, *MIRROR, '--aov', 'exit'))
        other = self.planes(self.draw('b.exr', 'room', *SMALL, *MIRROR, '--env', 'faces.exr'))
        changed = 0
        for i, length in enumerate(zip(*(plane for name, plane in plain.items()
                                         if name.startswith('exit')))):
            same = all(plain[name][i] == other[name][i] for name in 'RGB')
            self.assertTrue(same or any(length))
            changed += not same
        self.assertGreater(changed, 300)

    @unsanitized
    def test_alpha_says_how_far(self):
        """Without it all is infinitely far away; a near sphere shows other colours."""
        def draw(lookup, *alpha):
            (self.folder / 'faces.exr').write_bytes(strip(4, *alpha))
            return self.planes(self.draw('a.exr', 'sphere', *SMALL, *SMOOTH, '--env', 'faces.exr',
                                         '--set', f'refract.lookup={lookup}'))
        far = draw('infinite')
        self.assertEqual(far, draw('infinite', 0.7))
        near = draw('distance', 0.7)
        self.assertNotEqual(far, near)
        def difference(a, b):
            return sum(abs(x - y) for x, y in zip(a['R'], b['R'])) / len(a['R'])
        self.assertLess(difference(far, draw('distance')), 0.01 * difference(far, near))

    def test_no_box_is_said(self):
        """The surroundings are one, as are six numbers that are not inside out."""
        box = ('render', *SMALL, '-q', '-o', 'a.exr', '--set', 'refract.lookup=box')
        bare = ('sphere', '--background', '1,1,1')
        sides = dict(min_x=-2, max_x=2, min_y=-2, max_y=2, min_z=-2, max_z=2)
        words = [word for side, at in sides.items() for word in ('--set', f'env_box.{side}={at}')]
        self.assertEqual(self.succeed(*box, 'room').stderr, b'')
        self.assertEqual(self.succeed(*box, *bare, *words).stderr, b'')
        for wrong in ((), (*words, '--set', 'env_box.max_y=-3'), ('--set', 'env_box.min_x=-1')):
            said = self.succeed(*box, *bare, *wrong).stderr.decode()
            self.assertEqual(len(said.splitlines()), 1, said)
            self.assertIn('refract.lookup=box', said)

    def write_walls(self, box):
        """A far triangle, and the box that its node names."""
        corners = struct.pack('<9f', 90, 0, 0, 91, 0, 0, 90, 1, 0)
        data = base64.b64encode(corners).decode()
        model = {
            'asset': {'version': '2.0'}, 'scene': 0, 'scenes': [{'nodes': [0]}],
            'nodes': [{'name': 'walls', 'mesh': 0, 'extras': {'firn': {'box': box}}}],
            'meshes': [{'primitives': [{'attributes': {'POSITION': 0}}]}],
            'accessors': [{'bufferView': 0, 'componentType': 5126, 'count': 3, 'type': 'VEC3',
                           'min': [90, 0, 0], 'max': [91, 1, 0]}],
            'bufferViews': [{'buffer': 0, 'byteLength': len(corners)}],
            'buffers': [{'byteLength': len(corners),
                         'uri': f'data:application/octet-stream;base64,{data}'}],
        }
        (self.folder / 'walls.gltf').write_text(json.dumps(model))

    def test_box_of_a_model(self):
        """It is as good as one of the settings, which count before it."""
        sides = dict(min_x=-2, max_x=3, min_y=-1.5, max_y=2, min_z=-4, max_z=2.5)
        words = [word for side, at in sides.items() for word in ('--set', f'env_box.{side}={at}')]
        common = ('sphere', *SMALL, *SMOOTH, '--surroundings', 'walls.gltf', '--set',
                  'refract.lookup=box')
        (self.folder / 'faces.exr').write_bytes(strip(4))
        def draw(*more):
            return self.planes(self.draw('a.exr', *common, '--env', 'faces.exr', *more))
        self.write_walls([[-2, -1.5, -4], [3, 2, 2.5]])
        named = draw()
        self.assertEqual(named, draw(*words))
        self.write_walls([[-9, -9, -9], [9, 9, 9]])
        self.assertEqual(named, draw(*words))
        self.assertNotEqual(named, draw())
        self.write_walls([[3, 0, 0], [1, 1, 1]])
        self.refuse(DATA, 'render', *common, '-o', 'a.exr', names=['walls.gltf', 'nodes[0]', 'box'])

    def test_plan_imports_it(self):
        (self.folder / 'faces.exr').write_bytes(strip(4))
        plan = self.succeed('graph', 'sphere', '--env', 'faces.exr').stdout.decode()
        self.assertNotIn('env_cube.sky', plan)
        self.assertIn('env_cube.color', plan)

    def test_bad_strips(self):
        head = b'#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n'
        for width, height in ((4, 23), (4, 25), (4, 5), (1, 2)):
            size = f'-Y {height} +X {width}\n'.encode()
            (self.folder / 'bad.hdr').write_bytes(head + size + bytes(4 * width * height))
            self.refuse(DATA, 'render', 'sphere', *SMALL, '-o', 'a.exr', '--env', 'bad.hdr',
                        names=['bad.hdr', f'{width} x {height}', '1:6'])
        whole = strip(4)
        for size in (10, len(whole) // 2, len(whole) - 1):
            (self.folder / 'cut.exr').write_bytes(whole[:size])
            self.refuse(DATA, 'render', 'sphere', *SMALL, '-o', 'a.exr', '--env', 'cut.exr',
                        names=['cut.exr'])
        (self.folder / 'gray.exr').write_bytes(write_exr((1, 6), {'Z': [1.0] * 6}))
        self.refuse(DATA, 'render', 'sphere', *SMALL, '-o', 'a.exr', '--env', 'gray.exr',
                    names=['gray.exr', 'R, G and B'])


if __name__ == '__main__':
    main()
