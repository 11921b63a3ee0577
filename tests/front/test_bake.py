"""test_bake.py: tests `firn bake`, which draws the surroundings of an object to a file.

Usage: see case.py.
"""
import base64
import json
import pathlib
import struct
import sys

sys.dont_write_bytecode = True  # the source tree stays clean
from case import (  # noqa: E402
    CANT_CREATE, DATA, NO_INPUT, SMALL, USAGE, Case, long, main, unsanitized)
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


class Bake(Case):
    def bake(self, *arguments):
        self.succeed('bake', *arguments, '--validate', '-q', '-o', 'env.exr')
        return Exr((self.folder / 'env.exr').read_bytes())

    def draw(self, name, *arguments):
        self.succeed('render', *arguments, '--validate', '-q', '-o', name)
        return Exr((self.folder / name).read_bytes())

    def planes(self, exr):
        return exr.read_planes(exr.channels)

    @unsanitized
    def test_six_faces(self):
        done = self.succeed('bake', 'room')
        self.assertEqual(done.stderr, b'env.exr: six faces of 512x512\n')
        self.assertEqual(done.stdout, b'')
        exr = Exr((self.folder / 'env.exr').read_bytes())
        self.assertEqual(exr.size, (512, 3072))
        self.assertEqual(exr.channels, {name: 'half' for name in 'ABGR'})
        x, y, z = map(float, exr.text('firn/center').split(','))
        self.assertLess(max(abs(x), abs(y), abs(z)), 1e-5)
        self.assertIn('scene=room ', exr.text('firn/settings'))
        piped = self.succeed('bake', 'room', '-o', '-', '-q')
        self.assertEqual(piped.stdout, (self.folder / 'env.exr').read_bytes())
        self.assertEqual(piped.stderr, b'')

    @long
    def test_faces_of_any_size(self):
        """A texel of a coarse cube shows what the four do that it covers, where all is smooth."""
        fine, coarse = (self.planes(self.bake('room', '--size', str(side))) for side in (40, 20))
        self.assertEqual(len(coarse['R']), 6 * 20 * 20)
        differences = []
        for i in range(6 * 20 * 20):
            at = i // 20 * 2 * 40 + i % 20 * 2
            four = [fine['A'][at + step] for step in (0, 1, 40, 41)]
            differences.append(abs(sum(four) / 4 / coarse['A'][i] - 1))
        differences.sort()
        self.assertLess(differences[len(differences) // 2], 5e-3)
        done = self.succeed('bake', 'sphere', '--size', '1')
        self.assertEqual(done.stderr, b'env.exr: six faces of 1x1\n')
        exr = self.bake('sphere', '--size', '24')
        self.assertEqual(exr.size, (24, 144))
        drawn = self.draw('a.exr', 'sphere', *SMALL, '--env', 'env.exr')
        self.assertIn('env_cube.dynamic=off', drawn.text('firn/settings'))

    def test_walls_are_as_far_as_they_are(self):
        """The middles of the faces of a room whose walls are known."""
        side = 128
        walls = {0: 7.2, 1: 4.5, 2: 3.6, 4: 6.3, 5: 3.6}  # the table is below
        alpha = self.planes(self.bake('room', '--size', str(side)))['A']
        for face, distance in walls.items():
            at = face * side * side + side // 2 * side + side // 2
            self.assertAlmostEqual(alpha[at] * distance, 1, delta=2e-3)

    @long
    def test_stands_in_for_what_is_drawn(self):
        for scene, *arguments in (
                ('room', '--set', 'refract.lookup=box'),
                ('room', '--set', 'refract.lookup=distance', '--refraction', 'bounce'),
                ('valley', '--set', 'frost.amount=0.5', '--set', 'cracks.refract=gap', '--set',
                 'cracks.count=2', '--set', 'bubbles.count=40'),
                ('sphere', '--background', '0.2,0.4,0.6')):
            with self.subTest(scene=scene, arguments=arguments):
                around = arguments if '--background' in arguments else ()
                self.bake(scene, '--size', '64', *around)
                drawn = self.draw('a.exr', scene, *SMALL, *arguments)
                baked = self.draw('b.exr', scene, *SMALL, *arguments, '--env', 'env.exr')
                self.assertIn('env_cube.dynamic=off', baked.text('firn/settings'))
                ours, theirs = self.planes(drawn), self.planes(baked)
                worst = max(abs(a - b) for name in ours
                            for a, b in zip(ours[name], theirs[name]))
                print(f'{scene}: baked and drawn differ by {worst} at most')
                self.assertEqual(worst, 0)  # halves, stored as they are

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

    def test_wrong_words(self):
        (self.folder / 'faces.exr').write_bytes(strip(4))
        self.refuse(USAGE, 'bake', names=['SCENE'])
        self.refuse(USAGE, 'bake', 'room', '-o', 'a.png', names=['a.png', '.exr'])
        self.refuse(USAGE, 'bake', 'room', '-o', 'a.exr', '-o', 'b.exr', names=['b.exr'])
        self.refuse(USAGE, 'bake', 'room', '--env', 'faces.exr', names=['--env', 'faces.exr'])
        for wrong in ('64x64', '0', '4097', '-1', '9.5', ''):
            self.refuse(USAGE, 'bake', 'room', '--size', wrong, names=['--size', '1 to 4096'])
        self.refuse(NO_INPUT, 'bake', 'gone.obj', names=['gone.obj'])
        self.refuse(CANT_CREATE, 'bake', 'room', '-o', 'gone/a.exr', names=['gone/a.exr'])
        self.assertEqual([name for name in self.files() if pathlib.Path(name).stem != 'faces'], [])


if __name__ == '__main__':
    main()
