"""test_stage.py: the floor below a model file (--ground). Usage: see case.py."""
import base64
import json
import struct
import sys

sys.dont_write_bytecode = True  # the source tree stays clean
from case import NO_DRIVER, SMALL_CUBE, USAGE, Case, main, unsanitized  # noqa: E402
from exr_file import Exr  # noqa: E402
from gltf_file import boxes, glass, slide  # noqa: E402

WIDTH, HEIGHT = 96, 64
VIEW = ('--size', f'{WIDTH}x{HEIGHT}', '--orbit', '28,25,9', '--fov', 40, *SMALL_CUBE,
        '--set', 'light.count=0', '-q')
OPAQUE = {'pbrMetallicRoughness': {'metallicFactor': 0, 'roughnessFactor': 1}}
RADIUS = 3 ** 0.5  # of the box of glass, which is 2 wide


class Ground(Case):
    def setUp(self):
        super().setUp()
        self.write('box', (glass(), [0, 4, 0], 1))

    def write(self, name, *parts):
        (self.folder / f'{name}.gltf').write_text(boxes(*parts))

    def ground(self, *words):
        """The ground that a model's report names."""
        done = self.succeed('info', '--json', *words, env=NO_DRIVER)
        return json.loads(done.stdout)['ground']

    def draw(self, *words):
        """Radiance and position of each pixel."""
        self.succeed('render', *words, *VIEW, '--aov', 'P', '-o', 'a.exr')
        exr = Exr((self.folder / 'a.exr').read_bytes())
        return exr.read_planes(['R', 'G', 'B', 'A', 'P.X', 'P.Y', 'P.Z'])

    def floor(self, planes, inner, outer):
        """Pixels of the floor between two distances from the middle."""
        at = zip(planes['P.X'], planes['P.Y'], planes['P.Z'])
        return [i for i, (x, y, z) in enumerate(at)
                if 2.99 < y < 2.999 and inner <= max(abs(x), abs(z)) <= outer]

    def test_who_has_one(self):
        floor, wall = (OPAQUE, [0, 1, 0], 2), (OPAQUE, [0, 5, 0], 40)
        self.write('table', floor, (glass(), [0, 4, 0], 1))
        self.write('room', wall, (glass(), [0, 4, 0], 1))
        self.write('pole', (OPAQUE, [0, 2.5, 0], 0.5), (glass(), [0, 4, 0], 1))
        self.write('stone', floor)
        hall = json.loads(boxes(floor))
        data = base64.b64decode(hall['buffers'][0]['uri'].split(',')[1])
        indices = struct.unpack('<36H', data[96:])[::-1]  # wound inwards
        data = base64.b64encode(data[:96] + struct.pack('<36H', *indices)).decode()
        hall['buffers'][0]['uri'] = f'data:application/octet-stream;base64,{data}'
        (self.folder / 'hall.gltf').write_text(json.dumps(hall))
        for words, expected in ((['box.gltf'], 'studio'), (['pole.gltf'], 'studio'),
                                (['table.gltf'], 'none'), (['room.gltf'], 'none'),
                                (['stone.gltf'], 'studio'), (['hall.gltf'], 'none'),
                                (['sphere'], 'none'), (['amber'], 'none'),
                                (['box.gltf', '--ground', 'none'], 'none'),
                                (['table.gltf', '--ground', 'slate'], 'slate'),
                                (['box.gltf', '--ground', '.1,.2,1'], '0.1,0.2,1')):
            found = self.ground(*words)
            if ',' in expected:
                found = ','.join(f'{float(x):g}' for x in found.split(','))
            self.assertEqual(found, expected, words)

    def test_what_is_refused(self):
        self.refuse(USAGE, 'render', 'sphere', '--ground', 'wood', names=['--ground', 'sphere'])
        for value in ('grass', '1,2,3', '1,1'):
            self.refuse(USAGE, 'render', 'box.gltf', '--ground', value, names=['--ground'])

    @unsanitized
    def test_without(self):
        """No floor with --plain, --env, --background or none, and none brings the usual light."""
        words = ['--samples', 1, '-r', 'paper']
        bare = self.draw('box.gltf', *words, '--ground', 'none')
        for more in (['--env', 'studio'], ['--background', 'none'], ['--plain'],
                     ['--plain', '--ground', 'none']):
            planes = self.draw('box.gltf', *words, *more)
            self.assertFalse(self.floor(planes, 0, 1e9), more)
            if more[0] == '--plain':
                self.assertEqual(planes, bare)
        self.assertTrue(self.floor(self.draw('box.gltf', *words), 1.2, 9))

    def test_ice(self):
        """Ice on a floor has no cracks, planes of air and invisible lights, unless they are set."""
        off = {'air.count=0', 'cracks.count=0', 'light.count=0'}
        for words, expected in (([], off), (['--ground', 'none'], set()),
                                (['--set', 'cracks.count=3'], off - {'cracks.count=0'})):
            self.succeed('render', 'box.gltf', '-m', 'ice', '--size', '16x16', '--samples', 1,
                         *words, '-o', 'a.exr')
            text = Exr((self.folder / 'a.exr').read_bytes()).text('firn/settings')
            self.assertEqual(off & set(text.split()), expected, words)

    @unsanitized
    def test_contact(self):
        """The floor is dark where a box of dark glass stands, whatever draws it. The faces of a
        clear one are windows, through which the sun shines at its foot."""
        self.write('box', (glass(color=(.1, .1, .1)), [0, 4, 0], 1))
        for model in ('paper', 'bounce', 'trace', 'reference'):
            planes = self.draw('box.gltf', '--samples', 2, '-r', model, '--set',
                               'reference.photons=20000')
            foot = [planes['G'][i] for i in self.floor(planes, 1.02, 1.4)]
            away = [planes['G'][i] for i in self.floor(planes, 2 * RADIUS - .3, 2 * RADIUS + .3)]
            self.assertGreater(min(len(foot), len(away)), 8)
            self.assertLess(sorted(foot)[len(foot) // 40], 0.7 * sorted(away)[len(away) // 2],
                            model)

    @unsanitized
    def test_no_horizon(self):
        """Far away the floor has the radiance of the panorama above it."""
        for ground in ('studio', '.9,.1,.1'):
            planes = self.draw('box.gltf', '--samples', 1, '-r', 'paper', '--ground', ground,
                               '--orbit', '28,4,9', '--fov', 30)
            column = [planes['G'][WIDTH * y + 4] for y in range(HEIGHT)]
            steps = [abs(a - b) / b for a, b in zip(column, column[1:])]
            self.assertLess(max(steps), 0.12, ground)

    @unsanitized
    def test_shadow_catcher(self):
        """It shows the panorama, but for shadow; without background it is black with an alpha."""
        words = ['box.gltf', '--samples', 1, '-r', 'bounce', '--env', 'window', '--set',
                 'env.sun=own']
        bare, caught = self.draw(*words), self.draw(*words, '--ground', 'shadow')
        far, near = self.floor(caught, 12, 30), self.floor(caught, 1.02, 4)
        self.assertLess(max(abs(caught['G'][i] / bare['G'][i] - 1) for i in far), 0.03)
        self.assertLess(min(caught['G'][i] / bare['G'][i] for i in near), 0.7)
        clear = self.draw(*words, '--ground', 'shadow', '--background', 'none')
        self.assertLess(max(clear['A'][i] for i in far), 0.03)
        self.assertGreater(max(clear['A'][i] for i in near), 0.3)

    @unsanitized
    def test_poses_share_it(self):
        """The floor of an animated model stays where the first pose stands."""
        text = boxes((glass(), [0, 4, 0], 1))
        (self.folder / 'box.gltf').write_text(slide(text, 0, 1, [[0, 4, 0], [0, 6, 0]]))
        planes = self.draw('box.gltf', '--samples', 1, '-r', 'paper', '--set', 'motion.time=1')
        self.assertTrue(self.floor(planes, 2, 9))
        self.assertGreater(max(y for y in planes['P.Y'] if y < 1e9), 5)


main()
