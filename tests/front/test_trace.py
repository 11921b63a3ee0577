"""test_trace.py: the rung trace beside the reference, which traces the same triangles on the CPU.
Usage: see case.py."""
import json
import math
import struct
import sys

sys.dont_write_bytecode = True  # the source tree stays clean
from case import FLAT, NO_DRIVER, SMALL_CUBE, Case, long, main, unsanitized  # noqa: E402
from exr_file import Exr, write_exr  # noqa: E402
from gltf_file import balls, boxes, flat_boxes, glass  # noqa: E402

SIZE = ('--size', '64x48', '--pixel-filter', 'point', '--samples', 1, '--plain', '-q',
        '--set', 'trace.min_branch=0')
INSIDE = ('--eye', '0.005,0.06,0.03', '--target', '0,0.045,0')  # the ball of hollow
FLOOR = 'v -9 -2 -9\nv 9 -2 -9\nv 9 -2 9\nv -9 -2 9\nf 1 3 2\nf 1 4 3\n'
WHITE = ('--background', '1,1,1')


def opaque(grey):
    """A matt material."""
    return {'pbrMetallicRoughness': {'baseColorFactor': [grey, grey, grey, 1], 'metallicFactor': 0,
                                     'roughnessFactor': 1},
            'extensions': {'KHR_materials_specular': {'specularFactor': 0}}}


class Trace(Case):
    def planes(self, *words, **how):
        self.succeed('render', *words, '--aov', 'fresnel', '-o', 'a.exr', **how)
        return Exr((self.folder / 'a.exr').read_bytes()).read_planes(['R', 'G', 'B', 'fresnel.Z'])

    def check(self, limit, *words, rung=('-r', 'trace')):
        """The mean difference on the objects, clipped to 1."""
        found = self.planes(*words, *rung)
        truth = self.planes(*words, '-r', 'reference', '--set', 'reference.cutoff=0.001',
                            env=NO_DRIVER)
        objects = [i for i, share in enumerate(truth['fresnel.Z']) if share > 0]
        pairs = [(found[name][i], truth[name][i]) for name in 'RGB' for i in objects]
        self.assertGreater(len(pairs), 600)
        self.assertTrue(all(a >= 0 for a, _ in pairs), 'below 0, or no number')
        error = sum(abs(min(a, 1) - min(b, 1)) for a, b in pairs) / len(pairs)
        self.assertLess(error, limit, words)
        return error

    def check_white(self, light, noise=0.06, bias=1e-3):
        """Paths are chosen at random: the mean is exact, pixels have noise."""
        values = [x for name in 'RGB' for x in light[name]]
        self.assertLess(max(abs(x - 1) for x in values), noise)
        self.assertLess(abs(sum(values) / len(values) - 1), bias)

    def write(self, name, *parts):
        (self.folder / name).write_text(boxes(*parts))

    @unsanitized
    def test_nested(self):
        for scene in ('hollow', 'amber'):
            self.check(0.003, scene, '--env', 'studio', *SIZE, '--set', 'ground.light=open')

    @unsanitized
    def test_nested_by_bounce(self):
        """A ball in a hollow one, and a solid one in another behind them."""
        (self.folder / 'nested.gltf').write_text(balls(
            0.75, (glass(1.5), [0, 0, 0], 1), (glass(1.3), [0.1, 0, 0], 0.4),
            (glass(1.3), [3, 0.2, -3], 1), (glass(1.6), [3, 0.2, -3], 0.5)))
        words = ('nested.gltf', '--env', 'studio', *SIZE, '--size', '128x96', '--eye', '2,1,6',
                 '--target', '1,0,0', '--set', 'reference.russian_roulette=on')
        self.check(0.064, *words, rung=('-r', 'bounce'))
        self.assertGreater(self.check(0.1, *words, rung=(
            '-r', 'bounce', '--set', 'refract_bounce.nested=off')), 0.064)

    @unsanitized
    def test_light_through_objects(self):
        """The sun's light on a floor, through both walls of a hollow ball."""
        (self.folder / 'hollow.gltf').write_text(balls(0.75, (glass(1.5), [0, 0, 0], 1)))
        (self.folder / 'floor.obj').write_text(FLOOR)
        words = ('hollow.gltf', '--surroundings', 'floor.obj', '--env', 'sky', *SIZE, '--set',
                 'ice_caustics.light=sun', '--set', 'sky.sun_elevation=60', '--set',
                 'trace.surroundings=rays', '--set', 'reference.photons=200000',
                 '--eye', '0,4,7', '--target', '0,-1,0')
        found = self.planes(*words, '-r', 'trace')
        truth = self.planes(*words, '-r', 'reference', env=NO_DRIVER)
        ground = [i for i, share in enumerate(truth['fresnel.Z']) if share == 0]
        error = sum(abs(min(found[name][i], 1) - min(truth[name][i], 1))
                    for name in 'RGB' for i in ground) / len(ground) / 3
        self.assertLess(error, 0.0018)  # photons from the sun's view alone: 0.0021
        self.assertGreater(max(found['G'][i] for i in ground), 1.3)

    @unsanitized
    def test_concave_by_bounce(self):
        """A ball with an empty cavity: its far wall is there unless `nested` is off."""
        (self.folder / 'hollow.gltf').write_text(balls(0.75, (glass(1.5), [0, 0, 0], 1)))
        words = ('hollow.gltf', '--env', 'studio', *SIZE, '--set', 'reference.russian_roulette=on',
                 '--eye', '0.5,1,5', '--target', '0,0,0')
        self.check(0.06, *words, rung=('-r', 'bounce'))
        self.assertGreater(self.check(0.1, *words, rung=(
            '-r', 'bounce', '--set', 'refract_bounce.nested=off')), 0.06)

    @long
    def test_a_drink(self):
        # a pixel of dew is many lenses; the reference scatters light in clouds at random
        self.check(0.028, 'drink', '--env', 'studio', *SIZE, '--set', 'ground.light=open',
                   '--set', 'air.media=0', '--set', 'trace.footprint=off')

    @unsanitized
    def test_a_film_below_glass(self):
        """Black ground mirrors a ninth of white light, its film none below glass of its index."""
        black = {**opaque(0), 'extensions': {'KHR_materials_ior': {'ior': 2}}}
        black['pbrMetallicRoughness']['roughnessFactor'] = 0
        for film, below in ((True, 0), (False, 8 / 81)):
            self.write('film.gltf', ({**black, 'extras': {'film': film}}, [0, -50, 0], 50),
                       (glass(2), [0, 0, 0], 1))
            for rung in ('trace', 'reference'):
                found = self.planes('film.gltf', '-r', rung, *SIZE, *WHITE, '--eye', '0,9,0.01',
                                    '--target', '0,0,0', '--set', 'trace.surroundings=rays')['G']
                ground, ice = found[24 * 64 + 8], found[24 * 64 + 32]
                self.assertAlmostEqual(ground, 1 / 9, delta=0.002)
                self.assertAlmostEqual(ice, 1 / 9 + below, delta=0.002)

    def check_contact(self, truth, *cases):
        """Boxes of which some share faces look like others that share none."""
        words = ('--env', 'studio', *SIZE, '--eye', '-5,1.5,4', '--target', '0,0,0', '--set',
                 'trace.surroundings=rays')
        for rung in ('trace', 'reference'):
            images = []
            for boxes_of in (truth, *cases):
                (self.folder / 'a.gltf').write_text(flat_boxes(*boxes_of))
                planes = self.planes('a.gltf', '-r', rung, *words)
                images.append([x for c in 'RGB' for x in planes[c]])
            for found, parts in zip(images[1:], cases):
                error = sum(abs(a - b) for a, b in zip(found, images[0])) / len(found)
                self.assertLess(error, 0.002, (rung, len(parts)))

    @unsanitized
    def test_faces_that_objects_share(self):
        """A block in two parts is one block; three media at an edge are as if they overlapped by
        priority; so are faces that are less than a ten-thousandth of the objects apart."""
        many = [(glass(), [0, -2, 0.1 * i], 0.01) for i in range(30)]  # more than a mask has bits
        block = [(glass(), [0, 0, 0], [2, 1, 1])]
        first, second, third = (glass(ior, extras={'priority': priority})
                                for ior, priority in ((1.5, 3), (1.33, 2), (1.31, 1)))
        edge = [(first, [-1, 0, 0], 1), (second, [0.8, 0.5, 0], [1.2, 0.5, 1]),
                (third, [0.8, -0.3, 0], [1.2, 0.7, 1])]
        halves = ([(glass(), [-1, 0, 0], 1), (glass(), [1 + gap, 0, 0], 1)] for gap in (0, 1e-4))
        self.check_contact(block, *halves)
        parts, _ = thirds = [
            [(glass(1.5), [-1, 0, 0], 1), (glass(1.33), [1 + gap, 0.5, 0], [1, 0.5, 1]),
             (glass(1.31), [1 + gap, -0.5 - gap, 0], [1, 0.5, 1])] for gap in (1e-4, 0)]
        self.check_contact(edge, *thirds)
        self.check_contact(edge + many, parts + many)

    def test_shared_faces_are_named(self):
        def notes(command, ior, **more):
            self.write('a.gltf', (glass(1.5, **more), [-1, 0, 0], 1), (glass(ior), [1, 0, 0], 1))
            lines = self.succeed(*command, 'a.gltf').stderr.decode().splitlines()
            return [line for line in lines if 'share faces' in line]
        for command in (['info'], ['render', '--size', '8x6', '-o', 'a.exr']):
            line, = notes(command, 1.33)
            self.assertIn('box 0 and box 1 share', line)
            self.assertIn('the medium of box 1 applies', line)
            self.assertEqual(notes(command, 1.33, extras={'priority': 1}), [])
            self.assertEqual(notes(command, 1.5), [])  # no interface

    @unsanitized
    def test_thin_and_dispersive(self):
        self.write('thin.gltf', (glass(thickness=0, color=[1, 0.5, 0.5]), [0, 0, 0], 1),
                   (glass(1.4), [0.5, 0, -3], 1))
        self.check(0.004, 'thin.gltf', '--env', 'studio', *SIZE, '--set', 'refract.dispersion=3')

    def test_queries(self):
        """By ray queries of the device, if it has them, pictures are those by trees."""
        query = ('-r', 'trace', '--set', 'trace.traversal=query')
        words = ('hollow', '--env', 'studio', *SIZE, '--set', 'ground.light=open')
        if b'no ray queries' in self.succeed('render', *words, '--size', '8x6', *query,
                                             '-o', 'a.exr').stderr:
            self.skipTest('the device has no ray queries')
        ice = ('valley', *SIZE, '--set', 'bubbles.count=9', '--set', 'trace.surroundings=rays')
        cube = ('valley', *SIZE, '--size', '32x24', '--set', 'trace.surroundings=cube')
        for words in (words, ice, cube):
            found = self.planes(*words, *query)
            truth = self.planes(*words, '-r', 'trace', '--set', 'trace.traversal=tree')
            differ = sum(a != b for a, b in zip(found['G'], truth['G']))
            self.assertLessEqual(differ, 3, words)

    @unsanitized
    def test_the_eye_inside(self):
        self.check(0.005, 'hollow', '--env', 'studio', *SIZE, *INSIDE)
        self.check(0.02, 'valley', *SIZE[:-2], *SMALL_CUBE[:-1], 'env_cube.size=256', '--eye',
                   '0.002,0.03,0.001', '--target', '0.01,0.03,0', rung=())

    def test_surroundings(self):
        self.check(0.004, 'sphere', *SIZE, '--set', 'trace.surroundings=rays',
                   '--set', 'refract.fresnel=exact', '--set', 'motion.count=2')
        # of a clear object first reflections inside are followed without a word
        self.check(0.002, 'valley', *SIZE[:-2], '--set', 'trace.surroundings=rays')

    @unsanitized
    def test_a_floor_of_two_triangles(self):
        (self.folder / 'floor.obj').write_text(FLOOR)
        self.check(0.004, 'sphere', *SIZE, '--set', 'trace.surroundings=rays',
                   '--set', 'refract.fresnel=exact', '--surroundings', 'floor.obj')

    @long
    def test_rough(self):
        self.write('rough.gltf', (glass(1.5, roughness=0.3), [0, 0, 0], 1),
                   (glass(1.5), [2.5, 0, -2], 1))
        words = ('rough.gltf', '--env', 'studio', *SIZE, '--samples', 16)
        self.check(0.02, *words)
        self.assertEqual(*(self.planes(*words, '-r', 'trace') for _ in range(2)))

    @long
    def test_bubbles_and_cracks(self):
        """Met as the reference does, from outside and from inside the ice."""
        inclusions = ('--set', 'bubbles.count=60', '--set', 'bubbles.size=0.1', '--set',
                      'cracks.count=2')
        rays = ('--set', 'trace.surroundings=rays')
        shapes = ('--set', 'bubbles.shape=mixed')
        for more in (('--set', 'motion.time=1', '--set', 'absorb.red=20', *shapes),
                     ('--eye', '0.002,0.03,0.001', '--target', '0.01,0.02,0')):
            self.check(0.003, 'valley', *SIZE, *inclusions, *rays, *more)
        for more in ((), (*rays, *shapes)):
            light = self.planes('valley', *WHITE, *SIZE, '-r', 'trace', *inclusions, *more)
            self.check_white(light, noise=0.9, bias=5e-3)  # cracks reflect colours

    def ground(self, *words, **how):
        """The mean of the picture's middle."""
        planes = self.planes(words[0], *WHITE, *SIZE, '--size', '8x6', *words[1:], **how)
        return sum(planes['G'][i] for i in (19, 20, 27, 28)) / 4

    @long
    def test_another_medium_around(self):
        """A ball that bends light apart; and bubbles of air in water without a surface."""
        sphere = ('sphere', *SIZE, *SMALL_CUBE, '--set')
        for rung, limit in (('bounce', 0.02), ('trace', 0.001)):
            self.check(limit, *sphere, 'refract.ior=1.3', '--set', 'refract.ior_outside=1.5',
                       rung=('-r', rung))
        self.check(0.001, *sphere, 'refract.ior=1.34', '--set', 'refract.ior_outside=1.333',
                   '--set', 'bubbles.count=3', '--set', 'bubbles.size=0.3')

    @long
    def test_light_on_surroundings(self):
        """A floor under a black box in even light, against the box's share of the hemisphere; in
        light that passes glass."""
        self.write('dark.gltf', (opaque(0.5), [0, -50, 0], 50), (opaque(0), [0, 5, 0], 2),
                   (glass(), [0, 2, -90], 0.9))
        floor = ('v -9 -1 -9', 'v 9 -1 -9', 'v 9 -1 9', 'v -9 -1 9', 'f 1 3 2', 'f 1 4 3')
        (self.folder / 'floor.obj').write_text('\n'.join(floor))
        below = ('--surroundings', 'floor.obj', '--eye', '0,1,5', '--target', '0,-1,0', '--fov', 2)
        view = ('--eye', '0,1,9', '--target', '0,0,0', '--fov', 2)
        traced = ('--set', 'ground.light=traced')
        # The box's lower face: half as wide as it is high above the floor.
        a = 2 / 3
        share = 4 / math.pi * a / math.hypot(1, a) * math.atan(a / math.hypot(1, a))
        for rung in (('-r', 'trace'), ('-r', 'reference')):
            self.assertAlmostEqual(self.ground('dark.gltf', *view, *rung), 0.5, 3)
            found = self.ground('dark.gltf', *view, *traced, *rung, '--samples', 256)
            self.assertAlmostEqual(found, 0.5 * (1 - share), delta=0.01)
            white = self.ground('sphere', *below, *rung)
            found = self.ground('sphere', *below, *traced, *rung, '--samples', 16)
            self.assertAlmostEqual(found / white, 1, delta=0.01)

    @unsanitized
    def test_smooth_light_on_surroundings(self):
        """Fewer rays, smoothed, are nearer to many rays, and lose no light. A picture of 32
        samples is not smoothed, nor are tiles, which do not know each other."""
        self.write('dark.gltf', (opaque(0.5), [0, -50, 0], 50), (opaque(0), [0, 5, 0], 2),
                   (glass(), [0, 2, -90], 0.9))
        words = ('dark.gltf', *WHITE, *SIZE, '--size', '96x72', '--eye', '0,4,9', '--target',
                 '0,0,0', '--fov', 60, '-r', 'trace', '--set', 'ground.light=traced', '--set')
        truth, few, smooth, many = (
            self.planes(*words, f'ground.denoise={switch}', '--samples', samples)['G']
            for switch, samples in (('off', 32), ('off', 4), ('on', 4), ('on', 32)))
        errors = [sum(abs(a - b) for a, b in zip(x, truth)) for x in (few, smooth)]
        self.assertLess(errors[1], 0.5 * errors[0])
        self.assertAlmostEqual(sum(smooth) / sum(truth), 1, delta=0.005)
        self.assertEqual(many, truth)
        words = [word for word in words if word != '-q']
        tiled = self.succeed('render', *words, 'ground.denoise=on', '--samples', 4, '--tiles',
                             '2x1', '-o', 'tiled.exr')
        self.assertIn(b'ground.denoise', tiled.stderr)
        planes = Exr((self.folder / 'tiled.exr').read_bytes()).read_planes(['G'])['G']
        self.assertEqual(planes, few)

    @unsanitized
    def test_light_on_the_floor_of_water(self):
        """A small lamp in the sky makes no bright dots where few rays find it through the water."""
        self.write('wet.gltf', (opaque(0.5), [0, -50, 0], 50),
                   (glass(1.333), [0, -3.7, 0], 4))
        sky = [8.0 if 8 <= y < 11 and 20 <= x < 23 else 0.1 for y in range(32) for x in range(64)]
        (self.folder / 'lamp.exr').write_bytes(write_exr((64, 32), {'Y': sky}))
        planes = self.planes('wet.gltf', '--env', 'lamp.exr', *SIZE, '--eye', '0,9,3', '--target',
                             '0,0,0', '--fov', 30, '--set', 'ground.light=traced', '-r', 'trace')
        light = sorted(planes['G'])
        self.assertLess(light[-1], 8 * light[len(light) // 2])

    @unsanitized
    def test_what_a_pixel_sees_of_the_sky(self):
        """A hollow ball of glass crowds small lamps: one sample is nearer to many if it sees them
        as blurred as its pixel does, and many are as sharp as without."""
        (self.folder / 'hollow.gltf').write_text(balls(0.75, (glass(1.5), [0, 0, 0], 1)))
        sky = [4.0 if x % 8 < 2 and y % 8 < 2 else 0.1 for y in range(128) for x in range(256)]
        (self.folder / 'lamps.exr').write_bytes(write_exr((256, 128), {'Y': sky}))
        words = ('hollow.gltf', '--env', 'lamps.exr', *SIZE, '--size', '48x36', '--pixel-filter',
                 'box', '--set', 'trace.surroundings=rays', '-r', 'trace')
        one, many = ('--set', 'trace.footprint=on'), ('--samples', 64)
        truth, seen, blurred, sharp = (
            self.planes(*words, *more)['G'] for more in (many, (), one, (*one, *many)))
        errors = [sum(abs(a - b) for a, b in zip(x, truth)) for x in (seen, blurred, sharp)]
        self.assertLess(errors[1], 0.8 * errors[0])
        self.assertLess(errors[2], 0.1 * errors[0])

    @unsanitized
    def test_a_bar_before_the_sky(self):
        """Behind a ball and beside it: the lookup by distance takes half of the error, or more."""
        bar = ('v -.25 -6 -4 .1 .05 .02', 'v .25 -6 -4 .1 .05 .02', 'v .25 6 -4 .1 .05 .02',
               'v -.25 6 -4 .1 .05 .02', 'f 1 2 3', 'f 1 3 4')
        (self.folder / 'bar.obj').write_text('\n'.join(bar))
        words = ('sphere', *SIZE, *SMALL_CUBE[:-1], 'env_cube.size=512', '--background',
                 '.75,.8,.88', '--surroundings', 'bar.obj', '--target', '0,0,0')
        for rung, eye, share in (('bounce', '0,0,5', 0.3), ('trace', '0,0,5', 0.3),
                                 ('bounce', '2,1,4', 0.4)):
            errors = [self.check(1, *words, '--eye', eye, '--set', f'refract.lookup={lookup}',
                                 rung=('-r', rung)) for lookup in ('distance', 'infinite')]
            self.assertLess(errors[0], share * errors[1])

    @unsanitized
    def test_light_that_stays_inside(self):
        """What bounce does not follow to its exit sees the mean of the surroundings."""
        self.check(0.066, 'valley', *SIZE, '--size', '96x72', *SMALL_CUBE[:-1],
                   'env_cube.size=256', '--set', 'refract.ior=2.417', rung=('-r', 'bounce'))

    @unsanitized
    def test_faces_beyond_the_picture(self):
        """What rays of bounce meet beside a picture that the ice fills; tiles meet the same."""
        near = ('valley', *SIZE[:-2], '--orbit', '28,9,1.5', '--set', 'env_cube.size=256')
        errors = [self.check(0.03, *near, '--set', f'refract_bounce.margin={margin}',
                             rung=('-r', 'bounce')) for margin in ('on', 'off')]
        self.assertLess(errors[0], 0.9 * errors[1])
        self.assertEqual(*(self.planes(*near, '-r', 'bounce', *tiles)
                           for tiles in ((), ('--tiles', '2x2'))))

    @long
    def test_a_teapot_that_fills_the_picture(self):
        """Rays of bounce among faces of which some hide others."""
        self.check(0.034, 'teapot', *SIZE, '--size', '320x240', '--orbit', '28,9,1.1', '--set',
                   'env_cube.size=512', rung=('-r', 'bounce'))

    @unsanitized
    def test_furnace(self):
        self.write('nested.gltf', (glass(1.5), [0, 0, 0], 1), (glass(1.2), [0.1, 0.1, 0], 0.6),
                   (glass(thickness=0), [2.5, 0, -2], 1))
        for more in ((), ('--eye', '0.3,0.2,0.9', '--target', '0,0,0')):
            light = self.planes('nested.gltf', *WHITE, *SIZE, '-r', 'trace', *more)
            self.check_white(light)
        shells = [(glass(index), at, size) for index, at, size in (
            (1.8, [0, 0, 0], 1), (1, [0.02, 0, 0], 0.96), (1.8, [0, 0.02, 0], 0.92),
            (1, [0.02, 0, 0], 0.88), (1.8, [0, 0.02, 0], 0.84))]
        (self.folder / 'shells.gltf').write_text(balls(0.75, *shells))  # of very many reflections
        light = self.planes('shells.gltf', *WHITE, *SIZE, '-r', 'trace', '--orbit', '28,9,4.98')
        self.check_white(light)
        light = self.planes('teapot', *WHITE, *SIZE, '-r', 'trace')
        self.check_white(light)

    def test_light_is_that_of_the_environment(self):
        """A file's own material has no highlights of lights that are not there."""
        self.write('ball.gltf', (glass(1), [0, 0, 0], 1))
        (self.folder / 'white.exr').write_bytes(write_exr((4, 2), {'Y': [1] * 8}))
        for rung in ('bounce', 'trace'):
            light = self.planes('ball.gltf', '--env', 'white.exr', '--size', '64x48', '-q',
                                '-r', rung)
            self.assertLess(max(abs(x - 1) for name in 'RGB' for x in light[name]), 1e-3)

    def test_panes(self):
        """Parallel panes before a white wall: light that is reflected between them is all there."""
        wall = {'extensions': {'KHR_materials_unlit': {}}}
        for count, degrees in ((1, 60), (4, 45), (8, 75)):
            scene = json.loads(boxes((wall, [0, 0, -901], 900), *[
                (glass(), [0, 0, -0.02 * i], 1) for i in range(count)]))
            for node in scene['nodes'][1:]:
                node['scale'] = [40, 40, 0.002]  # wide, so that smooth normals are even
            (self.folder / 'panes.gltf').write_text(json.dumps(scene))
            x, z = (1.5 * f(math.radians(degrees)) for f in (math.sin, math.cos))
            inner = math.sqrt(1 - (x / 1.5 / 1.5) ** 2)
            r = 0.5 * sum(((a - b) / (a + b)) ** 2
                          for a, b in ((z / 1.5, 1.5 * inner), (inner, z)))  # of one surface
            for rung in ('trace', 'reference'):
                light = self.planes(
                    'panes.gltf', '--eye', f'{x},0,{z - 0.1}', '--target', '0,0,-0.1', '--fov', 2,
                    '--size', '8x8', '--background', '0,0,0', '--plain', '-q', '--samples', 16,
                    '-r', rung)['G']
                self.assertAlmostEqual(sum(light) / len(light),
                                       (1 - r) / (1 + (2 * count - 1) * r), delta=0.005,
                                       msg=f"{count} panes, {degrees} degrees, {rung}")

    @long
    def test_clouds(self):
        """Those of the rungs are an estimate, without noise, of what the reference traces."""
        cloudy = glass(1.31, extras={'cloud': 8})
        (self.folder / 'cloudy.gltf').write_text(balls(0.3, (cloudy, [0, 0, 0], 1)))
        for rung in ('trace', 'bounce', 'one-sided'):
            light = self.planes('cloudy.gltf', *WHITE, *SIZE, '-r', rung)
            self.check_white(light, noise=0.06 if rung == 'trace' else 2e-3)
        sky = write_exr((4, 2), {'Y': [1] * 4 + [0] * 4})  # that is all, and is seen from above
        (self.folder / 'sky.exr').write_bytes(sky)
        lit = ('cloudy.gltf', '--env', 'sky.exr', *SIZE, '--eye', '0,5,5', '--target', '0,0,0',
               '--fov', 45)
        truth = self.planes(*lit, '-r', 'reference', '--samples', 16, env=NO_DRIVER)
        objects = [i for i, share in enumerate(truth['fresnel.Z']) if share > 0]

        def mean(planes):
            return sum(planes['G'][i] for i in objects) / len(objects)
        light, gained = {}, {}
        clear = {rung: self.planes(*lit, '-r', rung, '--set', 'air.media=0')
                 for rung in ('trace', 'bounce')}
        for rung in clear:
            light[rung] = mean(self.planes(*lit, '-r', rung))
            gained[rung] = light[rung] - mean(clear[rung])
        self.assertAlmostEqual(light['trace'], mean(truth), delta=0.01)
        self.assertGreater(gained['trace'], 0.1)
        self.assertAlmostEqual(gained['bounce'], gained['trace'], delta=0.01)
        none = self.planes(*lit, '-r', 'bounce', '--set', 'air.steps=0')
        self.assertEqual(none, clear['bounce'])

    @long
    def test_no_light_is_made(self):
        """What is opaque or absorbs takes light, and so do rough surfaces, whose light is scattered
        once alone; none adds any."""
        self.write('rough.gltf', (glass(1.5, roughness=0.3), [0, 0, 0], 1),
                   (glass(1.2, roughness=0.2), [0.1, 0.1, 0], 0.6),
                   (glass(1.4, roughness=0.5), [2.5, 0, -2], 1))
        rough = ('--samples', 4, '--orbit', '28,9,9', '--fov', 45)
        for scene, most, *more in (('rough.gltf', 0.2, *rough), ('drink', 1),
                                   ('hollow', 1)):
            light = self.planes(scene, *WHITE, *SIZE, *more, '-r', 'trace')
            found = [light[name][i] for name in 'RGB'
                     for i, share in enumerate(light['fresnel.Z']) if share > 0]
            self.assertTrue(all(0 <= x < 1.002 for x in found), scene)
            self.assertLess(1 - sum(found) / len(found), most, scene)

    @long
    def test_many_objects(self):
        """Sets of objects are other ones if there are many, with the same pictures."""
        kinds = [glass(1.3 + 0.1 * k, color=[1, 1 - 0.2 * k, 0.6 + 0.2 * k]) for k in range(3)]
        near = [(kinds[(i + k) % 3], [2.2 * (i % 4), 2.2 * (i // 4), -k * 0.8], 1 - 0.3 * k)
                for i in range(8) for k in range(3)]
        far = [(kinds[0], [i, -100, 0], 0.01) for i in range(41)]
        self.write('few.gltf', *near, far[0], far[-1])
        self.write('many.gltf', *near, *far)
        for eye in ('9,7,12', '0.3,0.2,-0.2'):
            words = ('--env', 'studio', *SIZE, '--eye', eye, '--target', '3.3,2.2,-3')
            few, many = (self.planes(f'{name}.gltf', *words, '-r', 'trace')
                         for name in ('few', 'many'))
            self.assertEqual(few, many)
            self.assertGreater(len(set(few['R'])), 900)

    def test_the_tree_is_reported(self):
        def lines(rung):
            words = ('profile', 'sphere', *FLAT, '--plain', '-s', '16x12', '-n', 1, '-r', rung)
            return self.succeed(*words).stdout.decode()
        self.assertRegex(lines('trace'), r'\nBVH: \d{3,} triangles, \d+\.\d+ ms, 0\.\d MiB\n')
        self.assertNotIn('tree:', lines('bounce'))
        self.write('two.gltf', (glass(), [0, 0, 0], 1), (glass(), [3, 0, 0], 1))
        tree = json.loads(self.succeed('info', 'two.gltf', '--json', env=NO_DRIVER).stdout)['tree']
        # triangles have six words of 16 bytes; nodes, and the grid of a part, have two
        self.assertEqual(tree['triangles'], 24)
        self.assertEqual(tree['bytes'], 32 * (tree['nodes'] + 1) + 96 * 24)
        self.assertGreater(tree['ms'], 0)
        self.assertTrue(3 < tree['cost'] < 24, tree['cost'])
        self.assertEqual(tree['surrounding_cost'], 0)
        text = self.succeed('info', 'two.gltf', env=NO_DRIVER).stdout.decode()
        self.assertRegex(text, r'\nBVH for ray tracing: \d+ nodes, 24 triangles, 0\.0 MiB')
        self.assertRegex(text, r'\ncost of a ray, in triangle tests: \d+\.\d through ')
        for name in ('sphere', 'two.gltf'):  # that bounce draws, and trace
            self.assertIn(b'\nBVH for ray tracing: ',
                          self.succeed('info', name, env=NO_DRIVER).stdout)
        count = 200001
        row = b''.join(struct.pack('<12fH', 0, 0, 1, i, 0, 0, i + 1, 0, 0, i, 1, 0, 0)
                       for i in range(count))
        (self.folder / 'large.stl').write_bytes(bytes(80) + struct.pack('<I', count) + row)
        self.assertIn(b'\nBVH for ray tracing: not built for more than 200000 triangles;',
                      self.succeed('info', 'large.stl', env=NO_DRIVER).stdout)
        self.assertRegex(self.succeed('list', 'devices').stdout,
                         b'(?m); (traces rays|not usable: ).*$')

    def test_settings_without_effect_are_named(self):
        words = ('render', 'sphere', *FLAT, '--plain', '-s', '16x12', '-o', 'a.exr', '--set',
                 'bump.strength=0.5', '--set', 'cracks.clip=convex', '--set')
        named = b'bump.strength, cracks.clip: no effect with --refraction trace'
        for more, rung, is_said in (('cracks.count=1', 'trace', True),
                                    ('cracks.count=0', 'trace', False),
                                    ('cracks.count=1', 'paper', False)):
            self.assertEqual(named in self.succeed(*words, more, '-r', rung).stderr, is_said)

    def test_too_many_materials(self):
        self.write('many.gltf', *((glass(name=f'glass {i}'), [3 * i, 0, 0], 1)
                                  for i in range(256)))
        self.refuse(65, 'render', 'many.gltf', *SIZE, '-r', 'trace', '-o', 'a.exr',
                    names=('trace', '256', '255'))


if __name__ == '__main__':
    main()
