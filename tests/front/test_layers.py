"""test_layers.py: layers of the first surface: object, albedo, motion, geometry. See case.py."""
import json
import math
import struct
import sys

sys.dont_write_bytecode = True  # the source tree stays clean
from case import BARE, Case, long, main, unsanitized  # noqa: E402
from exr_file import Exr  # noqa: E402
from gltf_file import boxes, glass, slide, with_nodes  # noqa: E402

PLANES = ('object.Z', 'albedo.R', 'albedo.G', 'albedo.B', 'motion.X', 'motion.Y', 'Z')
FLAT = {'type': 'orthographic', 'orthographic': {'xmag': 4, 'ymag': 3, 'znear': 0, 'zfar': 99}}
RUNGS = ('bounce', 'trace', 'reference')[:2 if '--without' in sys.argv else 3]
BLUE = (0.1, 0.2, 0.8)


def matt(name, *color, **more):
    return {'name': name, 'pbrMetallicRoughness': {'baseColorFactor': color, 'metallicFactor': 0},
            **more}


def transform(matrix, *vector):
    """Multiplies a row vector by the matrix of an EXR attribute."""
    return [sum(v * matrix[4 * i + k] for i, v in enumerate(vector)) for k in range(4)]


class Layers(Case):
    """Six metres are 48 pixels. Boxes of 1 m: glass in the middle; on the left a hole, on the right
    a pane of alpha 0.4, each before a blue box; below a pane of alpha 0.6."""
    def setUp(self):
        super().setUp()
        blue = matt('blue', *BLUE, 1, extras={'class': 7})
        text = boxes((glass(), [0, 0, 0], 0.5), (blue, [-2, 0, -2], 0.5),
                     (matt('hole', 1, 0, 0, 0.3, alphaMode='MASK'), [-2, 0, 0], 0.5),
                     (matt('far', *BLUE, 1), [2, 0, -2], 0.5),
                     (matt('thin', 1, 0, 0, 0.4, alphaMode='BLEND'), [2, 0, 0], 0.5),
                     (matt('thick', 0, 1, 0, 0.6, alphaMode='BLEND'), [0, -2, 0], 0.5))
        text = with_nodes(text, {'name': 'front', 'camera': 0, 'translation': [0, 0, 9]},
                          cameras=[FLAT])
        (self.folder / 'a.gltf').write_text(slide(text, 3, 2, ([2, 0, -2], [4, -4, -2])))

    def draw(self, *words):
        """The names and a function, from metres to a pixel, of a rung and of the reference."""
        for rung in RUNGS:
            self.succeed('render', 'a.gltf', *BARE, '-r', rung, '--aov', 'object,albedo,motion,Z',
                         *words, '-o', 'a.exr')
            exr = Exr((self.folder / 'a.exr').read_bytes())
            planes = exr.read_planes(PLANES)
            names = dict(line.split(' ', 1) for line in exr.text('firn/objects').splitlines())
            yield names, lambda x, y, planes=planes: [
                round(planes[name][int(24 - 8 * y) * 64 + int(32 + 8 * x)], 3) for name in PLANES]

    def test_first_surfaces(self):
        for names, at in self.draw():
            self.assertEqual(at(3.8, 2.8), [0, 0, 0, 0, 0, 0, 1e10])
            for x, y, name, color, z in ((-1.9, 0.1, 'box 1', BLUE, 10.5),
                                         (2.1, 0.1, 'box 3', BLUE, 10.5),
                                         (0.1, -1.9, 'box 5', (0, 1, 0), 8.5),
                                         (0.1, 0.1, 'box 0', (1, 1, 1), 8.5)):
                pixel = at(x, y)
                self.assertEqual(names[str(int(pixel[0]))], name)
                for found, wanted in zip(pixel[1:], (*color, 0, 0, z)):
                    self.assertAlmostEqual(found, wanted, delta=0.001)

    def test_geometry_follows_from_the_camera(self):
        """P is projected to its pixel; distance and N.camera are P and N in the camera's axes."""
        self.succeed('render', 'teapot', *BARE, '--size', '64x48', '--samples', '1', '-r', 'bounce',
                     '--aov', 'P,N,Z,distance,N.camera', '-o', 'b.exr')
        exr = Exr((self.folder / 'b.exr').read_bytes())
        names = [f'{n}.{axis}' for n in ('P', 'N', 'N.camera') for axis in 'XYZ']
        planes = exr.read_planes((*names, 'Z', 'distance.Z'))
        camera, ndc = (struct.unpack('<16f', exr.attributes[name][1])
                       for name in ('worldToCamera', 'worldToNDC'))
        rows = list(zip(*(planes[name] for name in (*names, 'Z', 'distance.Z'))))
        self.assertGreater(sum(row[9] < 1e9 for row in rows), 200)
        for i, (*values, z, distance) in enumerate(rows):
            point, n, seen = values[:3], values[3:6], values[6:]
            if z > 1e9:
                self.assertEqual((*seen, distance), (0, 0, 0, z))
                continue
            x, y, back, _ = transform(camera, *point, 1)
            self.assertAlmostEqual(distance / math.hypot(x, y, back), 1, delta=1e-5)
            self.assertAlmostEqual(z / -back, 1, delta=1e-5)
            right, up, behind, _ = transform(camera, *n, 0)
            for found, wanted in zip(seen, (right, -up, -behind)):
                self.assertAlmostEqual(found, wanted, delta=1e-5)
            x, y, _, w = transform(ndc, *point, 1)
            self.assertAlmostEqual(32 + 32 * x / w, i % 64 + 0.5, delta=1e-3)
            self.assertAlmostEqual(24 + 24 * y / w, i // 64 + 0.5, delta=1e-3)

    def test_traced_layers(self):
        """Ordered surfaces, numbers, and the end of the refracted path: equal for all models, any
        number of samples, and in tiles. Holes and thin panes are no surfaces."""
        names = [f'{n}.{k}' for n in ('depths', 'objects') for k in range(3)]
        names += [f'{n}.Z' for n in ('material', 'class', 'boundary', 'refracted.object')]
        names += ['refracted.Z', 'transmittance.G', 'flow.refract.X']
        found = []
        for words in (*(('-r', rung) for rung in RUNGS[::-1]), ('--samples', '3'),
                      ('--tiles', '3x2'), ('--tiles', '4x2', '--interleaved')):
            self.succeed('render', 'a.gltf', *BARE, *words, '-o', 'a.exr', '--aov',
                         'depths,objects,material,class,boundary,refracted.object,refracted.Z,'
                         'transmittance,flow.refract')
            exr = Exr((self.folder / 'a.exr').read_bytes())
            self.assertEqual({exr.channels[name] for name in names[3:10]}, {'uint'})
            self.assertEqual({exr.channels[name] for name in names[:3] + names[10:]}, {'float'})
            found.append({name: ['NaN' if math.isnan(value) else value for value in values]
                          for name, values in exr.read_planes(names).items()})
            for name in names:
                self.assertTrue(found[-1][name] == found[0][name], (name, words))
        materials, objects = (dict(line.split(' ', 1)[::-1] for line in exr.text(name).splitlines())
                              for name in ('firn/materials', 'firn/objects'))
        far, none, clear = 1e10, 0, (1 - 0.04) ** 2
        for x, y, depths, name, material, kind, edge, end, z, passed in (
                (0.1, 0.1, (8.5, 9.5, far), 'box 0', 'material', 0, 0, none, far, clear),
                (0.4, 0.1, (8.5, 9.5, far), 'box 0', 'material', 0, 1, none, far, clear),
                (-1.9, 0.1, (10.5, 11.5, far), 'box 1', 'blue', 7, 0, 'box 1', 10.5, 1),
                (2.1, 0.1, (10.5, 11.5, far), 'box 3', 'far', 0, 0, 'box 3', 10.5, 0.36),
                (0.1, -1.9, (8.5, 9.5, far), 'box 5', 'thick', 0, 0, 'box 5', 8.5, 1)):
            at = int(24 - 8 * y) * 64 + int(32 + 8 * x)
            number = int(objects[name])
            wanted = [*depths, number, number, 0, int(materials[material]), kind, edge,
                      int(objects[end]) if end else 0, z, passed, 0 if end else 'NaN']
            for channel, value in zip(names, wanted):
                self.assertAlmostEqual(found[0][channel][at], value, delta=0.001,
                                       msg=f'{channel} at {x}, {y}')
        self.refuse(2, 'render', 'a.gltf', *BARE, '-r', 'bounce', '--aov', 'object.last',
                       names=['object.last', 'bounce'])

    @unsanitized
    def test_last_objects(self):
        """Boxes of glass: one before another, one before a blue box, one before a hole in it."""
        text = boxes((glass(), [-2, 0, 0], 0.5), (glass(1.2), [-2, 0, -2], 0.4),
                     (glass(), [0, 0, 0], 0.5), (matt('blue', *BLUE, 1), [0, 0, -2], 0.5),
                     (glass(), [2, 0, 0], 0.5),
                     (matt('hole', 1, 0, 0, 0.3, alphaMode='MASK'), [2, 0, -2], 0.5),
                     (matt('far', *BLUE, 1), [2, 0, -4], 0.5), (glass(1.4), [0, 2, 0], 0.5),
                     (matt('beside', *BLUE, 1), [2, 2, 0], 0.5))
        (self.folder / 'a.gltf').write_text(with_nodes(
            text, {'name': 'front', 'camera': 0, 'translation': [0, 0, 9]}, cameras=[FLAT]))
        for rung, hole in (('trace', 6), ('trace --set trace.surroundings=cube', 5),
                           ('reference', 6))[:len(RUNGS)]:
            self.succeed('render', 'a.gltf', *BARE, '-r', *rung.split(), '--aov',
                         'object.last,object', '-o', 'a.exr')
            exr = Exr((self.folder / 'a.exr').read_bytes())
            planes = exr.read_planes(('object.last.Z', 'object.Z'))
            names = dict(line.split(' ', 1) for line in exr.text('firn/objects').splitlines())
            for x, y, first, last in ((-1.9, 0.1, 0, 1), (0.1, 0.1, 2, 3), (2.1, 0.1, 4, hole),
                                      (0.1, 2.1, 7, 7), (2.1, 2.1, 8, 8)):
                at = int(24 - 8 * y) * 64 + int(32 + 8 * x)
                found = [names[str(int(planes[name][at]))] for name in ('object.Z',
                                                                        'object.last.Z')]
                self.assertEqual(found, [f'box {first}', f'box {last}'], rung)
            self.assertEqual((planes['object.Z'][0], planes['object.last.Z'][0]), (0, 0))

    @unsanitized
    def test_objects_of_one_material(self):
        """Opaque boxes that touch have equal vertices at their common corners, and a number each;
        so have moving objects, and what is around them."""
        places = [(x, y) for x in (-1, 0, 1) for y in (-1, 0, 1)]
        scene = json.loads(boxes(*((matt('stone', *BLUE, 1), [x, y, 0], 0.5) for x, y in places)))
        for mesh in scene['meshes']:
            mesh['primitives'][0]['material'] = 0
        text = with_nodes(json.dumps(scene), {'name': 'front', 'camera': 0,
                                              'translation': [0, 0, 9]}, cameras=[FLAT])
        (self.folder / 'a.gltf').write_text(text)
        for names, at in self.draw():
            self.assertEqual(names['1'], 'surroundings')
            for i, (x, y) in enumerate(places):
                for dx, dy in ((-0.3, 0.2), (0.2, -0.3), (-0.4, -0.3), (0.3, 0.4)):
                    self.assertEqual(at(x + dx, y + dy)[0], i + 2)
                self.assertEqual(names[str(i + 2)], f'box {i}')
        for names, at in self.draw('--set', 'motion.count=9'):
            found = {at(x / 8 - 3.9, y / 8 - 2.9)[0] for x in range(60) for y in range(44)}
            self.assertEqual(max(found), 11)
            self.assertEqual(names['11'], 'moving objects')

    def test_blended_surfaces_skip_independent_samples(self):
        """Six surfaces of one material: both sides of three boxes."""
        scene = json.loads(boxes(*((matt('veil', 0, 0, 0, 0.3, alphaMode='BLEND'), [0, 0, z], 0.5)
                                   for z in (2, -1, -4))))
        for mesh in scene['meshes']:
            mesh['primitives'][0]['material'] = 0
        (self.folder / 'a.gltf').write_text(json.dumps(scene))
        self.succeed('render', 'a.gltf', *BARE, '--background', '1,1,1', '--eye', '0,0,20',
                     '--target', '0,0,0', '--fov', '3', '--samples', '16', '-o', 'a.exr')
        plane = Exr((self.folder / 'a.exr').read_bytes()).read_planes('R')['R']
        middle = [plane[64 * y + x] for y in range(14, 34) for x in range(22, 42)]
        self.assertAlmostEqual(sum(middle) / len(middle), 0.7 ** 6, delta=0.03)

    def test_objects_around(self):
        """A file of surroundings: its refractive objects, then its opaque ones."""
        (self.folder / 'b.gltf').write_text(boxes(
            (matt('stone', *BLUE, 1), [2, 2, 0], 0.5), (glass(), [-2, 2, 0], 0.5),
            (glass(1.3), [-3.5, 2, 0], 0.5), (matt('wood', *BLUE, 1), [-2, -2, 0], 0.5)))
        for names, at in self.draw('--surroundings', 'b.gltf'):
            for x, y, name in ((2.1, 2.1, 'box 0'), (-1.9, 2.1, 'box 1'), (-3.4, 2.1, 'box 2'),
                               (-1.9, -1.9, 'box 3')):
                self.assertEqual(names[str(int(at(x, y)[0]))], name)

    @long
    def test_motion(self):
        """A box moves by 1 and -2 m a second, at 4 frames a second; at first it rests."""
        for words, place, moved in ((('--set', 'motion.time=0.5'), (2.7, -1.1), [2, 4]),
                                    ((), (2.1, 0.1), [0, 0])):
            for _, at in self.draw('--set', 'motion.fps=4', '--set', 'motion.ice=0', *words):
                self.assertEqual(at(*place)[4:6], moved)
                self.assertEqual(at(-1.9, 0.1)[4:6], [0, 0])

    @unsanitized
    def test_turning(self):
        """The middle of a turning box's front, 0.5 m from the axis, at 8 pixels a metre."""
        for _, at in self.draw('--set', 'motion.fps=10', '--set', 'motion.ice=90', '--set',
                               'motion.time=4', '--animation', 'none'):
            self.assertAlmostEqual(at(0, 0)[4], 4 * math.sin(math.radians(9)), delta=0.02)


class Small(Case):
    def test_target_scale(self):
        """Air at half the size is where it was; what the ice refracts stays, bit by bit."""
        found = []
        for scale in ('1', '0.5'):
            self.succeed('render', 'valley', '-r', 'paper', '--size', '96x72', '-q', '--set',
                         f'inclusions.scale={scale}', '--set', 'air.size=0.1', '--set',
                         'air.frequency=2', '--aov', 'air,refraction', '-o', 'a.exr')
            found.append(Exr((self.folder / 'a.exr').read_bytes()).read_planes(
                ('air.A', 'refraction.G')))
        self.assertEqual(found[0]['refraction.G'], found[1]['refraction.G'])
        whole, small = found[0]['air.A'], found[1]['air.A']
        self.assertLess(sum(abs(a - b) for a, b in zip(whole, small)), 0.2 * sum(whole))
        self.assertNotEqual(whole, small)

    @unsanitized
    def test_light_of_bubbles(self):
        """In even light, bubbles are invisible; scattering media attenuate those behind them."""
        def green(scene, *words):
            self.succeed('render', scene, '-r', 'bounce', '--quality', 'high', '--samples', 1,
                         '--size', '96x72', '-q', *words, '-o', 'a.exr')
            return Exr((self.folder / 'a.exr').read_bytes()).read_planes(('G',))['G']

        def effect(scene, *words):
            pairs = zip(*(green(scene, *words, '--set', f'bubbles.count={count}')
                          for count in (300, 0)))
            return [abs(a - b) for a, b in pairs]

        large = ('--plain', '--set', 'bubbles.size=0.1')
        for shape in ('sphere', 'mixed'):
            words = ('--set', f'bubbles.shape={shape}', *large)
            self.assertGreater(sum(effect('sphere', *words)), 50)
            self.assertLess(max(effect('sphere', '--background', '1,1,1', *words)), 0.01)
        milky, clear = (sum(effect('sphere', *large, '--set', 'air.model=even', '--set',
                                   f'air.count={count}')) for count in (1, 0))
        self.assertGreater(clear, milky)


if __name__ == '__main__':
    if '--without' in sys.argv:
        sys.argv.remove('--without')
    main()
