"""test_firn.py: the Python package firn beside the program firn, and its data sets.

Usage: test_firn.py FIRN [unittest argument...]
$FIRN_LIBRARY names libfirn, $FIRN_READER its reader, $FIRN_ASSETS the folder of scenes.
"""
import json
import os
import pathlib
import pickle
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True  # the source tree stays clean
HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent.parent / 'python'), str(HERE.parent / 'front')]
import numpy as np  # noqa: E402
try:
    import cv2
except ImportError:
    cv2 = None
import firn  # noqa: E402
from exr_file import Exr  # noqa: E402
from firn import dataset  # noqa: E402
from gltf_file import boxes, glass, with_nodes  # noqa: E402

FIRN = os.path.abspath(sys.argv.pop(1)) if len(sys.argv) > 1 else 'firn'
SIZE = (64, 48)
FORMATS = ('exr', 'npz', 'coco', 'bop', 'colmap')  # of data sets
SKEWED = [[90.0, 0, 20.5], [0, 70.0, 30.25], [0, 0, 1]]  # off-centre, pixels are not square
VIEW = firn.Camera.look_at((0.3, 0.35, 0.9), (0, 0.02, 0), 30, SIZE)
OPTIONS = {'env': 'studio', 'plain': True, 'refraction': 'bounce', 'quality': 'normal'}


def icosphere(steps):
    """Returns a triangulated unit sphere: positions and indices."""
    g = (1 + 5 ** .5) / 2
    points = [np.roll((0, a, b), k) for k in range(3) for a in (-1, 1) for b in (-g, g)]
    points = np.array(points) / np.linalg.norm(points[0])
    near = np.linalg.norm(points[:, None] - points, axis=2) < 1.2
    faces = [(a, b, c) for a in range(12) for b in range(a) for c in range(b)
             if near[a, b] and near[b, c] and near[a, c]]
    faces = [f if np.linalg.det(points[list(f)]) > 0 else f[::-1] for f in faces]
    for _ in range(steps):
        corners = points[np.array(faces)]
        a, b, c = (corners[:, i] for i in range(3))
        ab, bc, ca = a + b, b + c, c + a
        corners = np.concatenate([np.stack(t, axis=1) for t in (
            (a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))])
        corners /= np.linalg.norm(corners, axis=2, keepdims=True)
        points, faces = np.unique(corners.reshape(-1, 3).round(12), axis=0, return_inverse=True)
        faces = faces.reshape(-1, 3)
    return points, np.array(faces)


def decode(coded):
    """Decodes COCO's compressed run lengths to a mask, as COCO's own decoder does."""
    runs, text, at = [], coded['counts'], 0
    while at < len(text):
        value, shift, more = 0, 0, True
        while more:
            bits = ord(text[at]) - 48
            value |= (bits & 31) << shift
            more, shift, at = bool(bits & 32), shift + 5, at + 1
            if not more and bits & 16:
                value |= -1 << shift
        runs.append(value + (runs[-2] if len(runs) > 2 else 0))
    flat = np.repeat(np.arange(len(runs)) % 2 == 1, runs)
    return flat.reshape(coded['size'], order='F')


class WithoutDevice(unittest.TestCase):
    """Tests that need neither the library nor a device."""
    def test_cameras(self):
        """All conventions agree, and projection follows OpenCV's definition."""
        camera = firn.Camera(SKEWED, VIEW.R, VIEW.t, SIZE, time=2)
        again = firn.Camera.from_colmap('PINHOLE', (90, 70, 21, 30.75), camera.quaternion,
                                        camera.t, SIZE)
        opengl = np.array(json.loads(camera.to_json())['world_from_camera_opengl'])
        K = np.add(SKEWED, [[0, 0, .5], [0, 0, .5], [0, 0, 0]])
        for other in (again, firn.Camera.opengl(K, opengl, SIZE),
                      firn.Camera.from_bop(camera.K, camera.R, 1000 * camera.t, SIZE)):
            for name in ('K', 'R', 't'):
                np.testing.assert_allclose(getattr(other, name), getattr(camera, name), atol=1e-12)
        x, y, z = camera.R @ (0.1, 0.2, 0.3) + camera.t
        np.testing.assert_allclose(camera.project([0.1, 0.2, 0.3]),
                                   (90 * x / z + 20.5, 70 * y / z + 30.25))
        for bad in ({'K': np.eye(4)}, {'R': 2 * np.eye(3)}, {'size': (0, 3)},
                    {'K': [[1, 2, 0], [0, 1, 0], [0, 0, 1]]}, {'t': (np.nan, 0, 0)}):
            with self.assertRaises(firn.UsageError):
                firn.Camera(**{'K': SKEWED, 'R': VIEW.R, 't': VIEW.t, 'size': SIZE, **bad})

    def test_masks(self):
        """Run lengths decode to the mask; boxes contain the mask."""
        rng = np.random.default_rng(1)
        for density in (0, 0.02, 0.5, 0.98, 1):
            mask = rng.uniform(size=(37, 53)) < density
            np.testing.assert_array_equal(decode(dataset.rle(mask)), mask)
        mask = np.zeros((20, 30), bool)
        mask[3:9, 5:15] = True
        self.assertEqual(dataset.box_of(mask), [5, 3, 10, 6])
        self.assertEqual(dataset.box_of(mask & False), [0, 0, 0, 0])
        self.assertEqual(dataset.share(range(7), 1, 3), [1, 4])


class Firn(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.device = firn.Device()

    @classmethod
    def tearDownClass(cls):
        cls.device.close()

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def sphere(self, **options):
        scene = self.device.scene(**{**OPTIONS, **options})
        self.addCleanup(scene.close)
        points, faces = icosphere(4)
        mesh = scene.add_mesh(0.1 * points, faces)
        scene.add(mesh, scene.add_material('glass'), 'ball')
        return scene

    def add_table(self, scene, y):
        corners = np.array([(-1, y, -1), (-1, y, 1), (1, y, 1), (1, y, -1)])
        scene.add(scene.add_mesh(corners, [(0, 1, 2), (0, 2, 3)]),
                  scene.add_material(firn.Material(metallic=0)), 'table')

    def test_equals_the_program(self):
        """Bit-identical, for the scene's camera and for one of the caller."""
        with self.device.load('ice-cube', **OPTIONS) as scene:
            renderer = scene.renderer(('rgb', 'Z', 'object', 'display'), samples=2)
            frame = renderer.render(size=SIZE)
            again, turned = renderer.iter([frame.camera, VIEW])
        subprocess.run([FIRN, 'render', 'ice-cube', '--env', 'studio', '--plain', '-r', 'bounce',
                        '--quality', 'normal', '--samples', '2', '--size', '64x48', '--aov',
                        'Z,object', '-q', '-o', self.folder / 'a.exr'], check=True)
        planes = Exr((self.folder / 'a.exr').read_bytes()).read_planes(['R', 'G', 'B', 'Z'])
        for index, name in enumerate('RGB'):
            np.testing.assert_array_equal(np.float16(frame.rgb[..., index]).ravel(),
                                          np.float16(planes[name]))
        np.testing.assert_array_equal(frame.depth.ravel(), np.float32(planes['Z']))
        # matrices of a camera have other rounding errors than its eye and target
        self.assertLess(firn.diff(frame.rgb, again.rgb)['flip'], 1e-3)
        self.assertGreater(firn.diff(frame.rgb, turned.rgb)['flip'], 0.05)
        self.assertEqual((frame.rgb.dtype, frame.object.dtype), (np.float32, np.uint32))
        np.testing.assert_array_equal(np.from_dlpack(frame.Z), frame.Z)
        self.assertEqual(firn.diff(frame.rgb, frame.rgb, errors=True)['errors'].max(), 0)

    def test_changes_are_drawn(self):
        """Changes of a material, a setting and an option equal those of the command line."""
        scene = self.sphere()
        renderer = scene.renderer(('rgb',))
        images = [renderer.render(VIEW).rgb]
        ball = scene.objects['ball']
        ball.material.ior = 1.2
        self.assertAlmostEqual(scene.objects[0].material.ior, 1.2, places=6)
        images.append(renderer.render(VIEW).rgb)
        scene.settings['refract.ior_outside'] = 1.1
        images.append(renderer.render(VIEW).rgb)
        scene.set('env', 'sky')
        images.append(renderer.render(VIEW).rgb)
        for a, b in zip(images, images[1:]):
            self.assertGreater(np.abs(a - b).max(), 0.01)
        for words in ({'set': 'no.such=1'}, {'no_such': 1}):
            with self.assertRaisesRegex(firn.UsageError, 'no.such'):
                self.device.load('ice-cube', **words)

    def test_geometry(self):
        """Points are projected by K, R and t; depths are those of the sphere."""
        scene = self.sphere()
        renderer = scene.renderer(('P', 'Z', 'object'))
        frame = renderer.render(firn.Camera(SKEWED, VIEW.R, VIEW.t, SIZE))
        ball = frame.object == scene.objects['ball'].id
        self.assertGreater(ball.sum(), 50)
        rows, columns = np.nonzero(ball)
        found = frame.camera.project(frame.P[ball])
        self.assertLess(np.abs(found - np.stack([columns, rows], axis=1)).max(), 1e-3)
        radii = np.linalg.norm(frame.P[ball], axis=1)
        self.assertLess(np.abs(radii / 0.1 - 1).max(), 2e-3)  # triangles lie below the sphere
        z = (frame.P[ball] @ frame.camera.R.T + frame.camera.t)[:, 2]
        np.testing.assert_allclose(frame.Z[ball], z, rtol=1e-5)

    def test_depths_and_projection(self):
        """Depths are exact to 1e-5, and OpenCV projects P to the pixels, with any K."""
        scene = self.device.scene(**OPTIONS)
        self.addCleanup(scene.close)
        points, faces = icosphere(6)
        scene.add(scene.add_mesh(0.1 * points, faces), scene.add_material('glass'), 'ball')
        self.add_table(scene, -.2)
        camera = firn.Camera(SKEWED, VIEW.R, VIEW.t, SIZE)
        frame = scene.renderer(('P', 'Z', 'N', 'object', 'depths', 'objects')).render(camera)
        columns, rows = np.meshgrid(*map(np.arange, SIZE))
        ahead = np.stack([(columns - 20.5) / 90, (rows - 30.25) / 70, np.ones(columns.shape)], -1)
        direction = ahead @ camera.R  # for a depth of 1
        b, c = direction @ camera.position, camera.position @ camera.position - 0.01
        a = (direction ** 2).sum(axis=-1)
        with np.errstate(invalid='ignore'):
            ball = (-b - np.sqrt(b * b - a * c)) / a
            far = (-b + np.sqrt(b * b - a * c)) / a
        table = (-.2 - camera.position[1]) / direction[..., 1]
        for name, wanted in (('ball', ball), ('table', table)):
            seen = frame.object == scene.objects[name].id
            if name == 'ball':  # at a silhouette, the chords of its edges are visible
                seen &= (frame.N * direction).sum(axis=-1) < -0.8 * np.sqrt(a)
            self.assertGreater(seen.sum(), 40)
            self.assertLess(np.abs(frame.Z[seen] / wanted[seen] - 1).max(), 1e-5)
            np.testing.assert_allclose(frame.depths[..., 0][seen], frame.Z[seen], rtol=1e-6)
            if name == 'ball':
                self.assertLess(np.abs(frame.depths[..., 1][seen] / far[seen] - 1).max(), 1e-5)
                self.assertTrue((frame.objects[..., 1][seen] == scene.objects[name].id).all())
        solid = frame.object > 0
        if not cv2:
            self.skipTest('OpenCV is missing: reprojection was not compared')
        found, _ = cv2.projectPoints(frame.P[solid].astype(float), cv2.Rodrigues(camera.R)[0],
                                     camera.t, camera.K, None)
        pixels = np.stack([columns[solid], rows[solid]], axis=1)
        self.assertLess(np.abs(found[:, 0] - pixels).max(), 1e-3)

    def test_refracted_path(self):
        """The path's end does not depend on the model, and agrees with `exit`."""
        layers = ('exit', 'object', 'flow.refract', 'refracted.object', 'refracted.P',
                  'refracted.Z', 'transmittance')
        frames = [self.sphere(refraction=model).renderer(layers).render(VIEW)
                  for model in ('bounce', 'reference')]
        flow, ball = frames[0]['flow.refract'], frames[0].object > 0
        np.testing.assert_array_equal(flow, frames[1]['flow.refract'])
        rows, columns = np.nonzero(ball)
        inside = np.isfinite(flow[ball]).all(axis=1)
        self.assertGreater(inside.sum(), 30)
        for frame in frames:  # the background is at infinity
            found = VIEW.project(VIEW.position + 1e6 * frame.exit[ball][:, :3])
            found -= np.stack([columns, rows], axis=1)
            self.assertLess(np.median(np.linalg.norm(found - flow[ball], axis=1)[inside]), 0.5)
        for axis, at in ((1, rows), (0, columns)):  # a ball inverts the image
            before = at < np.median(at)
            self.assertGreater(np.nanmedian(flow[ball][before, axis]), 0)
            self.assertLess(np.nanmedian(flow[ball][~before, axis]), 0)
        middle = frames[0].transmittance[24, 32]  # clear glass, two surfaces
        np.testing.assert_allclose(middle, (1 - ((1.5 - 1) / (1.5 + 1)) ** 2) ** 2, atol=0.03)
        self.assertTrue((frames[0].transmittance[~ball] == 1).all())
        self.assertTrue((flow[~ball] == 0).all())
        scene = self.sphere()
        self.add_table(scene, -.11)
        frame = scene.renderer(layers).render(VIEW)
        lands = (np.isfinite(frame['flow.refract']).all(axis=-1) &
                 (frame.object == scene.objects['ball'].id) &
                 (frame['refracted.object'] == scene.objects['table'].id))
        rows, columns = np.nonzero(lands)
        self.assertGreater(lands.sum(), 10)
        points = frame['refracted.P'][lands]
        np.testing.assert_allclose(points[:, 1], -.11, atol=1e-6)
        found = VIEW.project(points) - np.stack([columns, rows], axis=1)
        self.assertLess(np.abs(found - frame['flow.refract'][lands]).max(), 1e-3)
        z = (points @ VIEW.R.T + VIEW.t)[:, 2]
        np.testing.assert_allclose(frame['refracted.Z'][lands], z, rtol=1e-5)

    def test_orthographic(self):
        """A file's orthographic camera is drawn; its frame has no camera with a matrix K."""
        flat = {'type': 'orthographic',
                'orthographic': {'xmag': 4, 'ymag': 3, 'znear': 0, 'zfar': 99}}
        (self.folder / 'a.gltf').write_text(with_nodes(
            boxes((glass(), [0, 0, 0], 0.5)),
            {'name': 'front', 'camera': 0, 'translation': [0, 0, 9]}, cameras=[flat]))
        with self.device.load(self.folder / 'a.gltf', ground='none', **OPTIONS) as scene:
            frame = scene.renderer(('Z', 'depths')).render(size=SIZE)
        self.assertIsNone(frame.camera)
        self.assertEqual(frame.size, SIZE)
        np.testing.assert_allclose(frame.Z[24, 32], 8.5, rtol=1e-5)
        np.testing.assert_allclose(frame.depths[24, 32, :3], (8.5, 9.5, 1e10), rtol=1e-5)

    def test_pairs_on_a_table(self):
        """Equal generators make the same shapes with glass, opaque, and the table without them."""
        camera = firn.Camera.look_at((0, .4, .8), (0, .05, 0), 35, SIZE)
        layers = ('rgb', 'Z', 'object', 'objects', 'boundary', 'material', 'class')
        frames, names = {}, {}
        for show in ('glass', 'opaque', 'background'):
            with dataset.tabletop(self.device, np.random.default_rng(5), vessels=(3, 3),
                                  level=(0.3, 0.8), show=show, **OPTIONS) as scene:
                frames[show] = scene.renderer(layers).render(camera)
                names[show] = {one.id: one.name for one in scene.objects.all()}
        glass, opaque, empty = frames.values()
        self.assertTrue(set(names['glass'].values()) > {'vessel 1', 'vessel 3', 'liquid 1'})
        self.assertEqual(set(names['background'].values()), {'light squares', 'dark squares'})
        vessels = [i for i, name in names['glass'].items() if 'vessel' in name]
        seen = np.isin(glass.object, vessels)
        self.assertGreater(seen.sum(), 100)
        same = np.abs(glass.Z / opaque.Z - 1) < 1e-6
        self.assertGreater(same[seen].mean(), 0.98)  # silhouettes are rasterised twice
        self.assertTrue((empty.Z > glass.Z)[seen].all())
        whole = dataset.amodal_masks(glass)
        for number, mask in dataset.visible_masks(glass).items():
            self.assertTrue((whole[number] | ~mask).all())
            self.assertLessEqual(dataset.visible_fractions(glass)[number], 1)
        liquid = next(i for i, name in names['glass'].items() if name == 'liquid 1')
        self.assertGreater(whole[liquid].sum(), 20)  # visible through the glass alone
        self.assertEqual((glass.object == liquid).sum(), 0)
        edge = glass.boundary[1:, :] > 0
        differs = glass.object[1:, :] != glass.object[:-1, :]
        self.assertTrue(edge[differs].all())
        self.assertEqual(set(np.unique(glass.boundary)), {0, 1, 2})

    def test_opaque(self):
        """An opaque twin has the glass's shapes and numbers, and nothing is seen through it."""
        scene = self.sphere()
        renderer = scene.renderer(('rgb', 'Z', 'object', 'refracted.object'))
        glass = renderer.render(VIEW)
        with dataset.opaque(scene, (0.5, 0, 0)):
            twin = renderer.render(VIEW)
        ball = glass.object > 0
        for name in ('Z', 'object'):
            np.testing.assert_array_equal(glass[name], twin[name])
        self.assertTrue((glass['refracted.object'][ball] == 0).all())
        self.assertGreater((twin['refracted.object'] == twin.object)[ball].mean(), 0.95)
        self.assertTrue((twin.rgb[ball][:, 0] > 1.5 * twin.rgb[ball][:, 1]).mean() > 0.8)
        np.testing.assert_array_equal(renderer.render(VIEW).rgb, glass.rgb)

    def test_views(self):
        """Layers that a model lacks are refused; plans are shown; opaque materials can change."""
        scene = self.sphere()
        with self.assertRaisesRegex(firn.UsageError, 'object.last.*bounce'):
            scene.renderer(('object.last',)).render(VIEW)
        with self.assertRaisesRegex(firn.UsageError, 'transmission'):
            scene.objects['ball'].material = firn.Material(metallic=0)
        renderer = scene.renderer(('rgb', 'display', 'class'))
        self.assertIn('<iframe srcdoc=', firn.Plan(renderer, SIZE)._repr_html_())
        self.add_table(scene, -.1)
        white = renderer.render(VIEW)
        scene.objects['table'].material = firn.Material(
            metallic=0, base_color=(0.5, 0, 0, 1), class_id=9)
        red = renderer.render(VIEW)
        table = red['class'] == 9
        self.assertGreater(table.sum(), 200)
        self.assertTrue((red.rgb[table][:, 1] < 0.2 * white.rgb[table][:, 1]).all())
        # views in flight keep their exposure
        ticket = renderer.iter([VIEW, VIEW])
        first = next(ticket).display
        scene.settings['tonemap.exposure'] = 3
        np.testing.assert_array_equal(next(ticket).display, first)
        self.assertGreater(renderer.render(VIEW).display.mean(), first.mean() + 20)

    def test_kept_arrays_are_not_reused(self):
        with self.device.load('ice-cube', **OPTIONS) as scene:
            renderer = scene.renderer(('rgb', 'Z'), samples=1)
            first = renderer.render(size=SIZE)
            kept, view = first.Z, first.rgb[10:, :, 1]
            copies = kept.copy(), view.copy()
            del first
            addresses = []
            for _ in range(4):
                other = renderer.render(VIEW)
                self.assertGreater(np.abs(other.Z - kept).max(), 0)
                addresses.append(other.Z.ctypes.data)
            self.assertLess(len(set(addresses)), 4, 'arrays are reused')
        np.testing.assert_array_equal(kept, copies[0])
        np.testing.assert_array_equal(view, copies[1])

    def test_missing_reader(self):
        """The error names the variable that names the program."""
        (self.folder / 'a.glb').write_bytes(b'glTF')
        with firn.Device(vulkan=False, reader=self.folder / 'firn-reader') as device:
            with self.assertRaisesRegex(firn.Error, 'FIRN_READER'):
                device.load(self.folder / 'a.glb')

    def test_mistakes(self):
        """Errors become exceptions, and the device remains usable."""
        (self.folder / 'a.glb').write_bytes(b'glTF\2\0\0\0')
        scene = self.sphere()
        renderer = scene.renderer(('rgb',))
        closed = self.sphere()
        closed.close()
        closed.close()
        for kind, call in (
                (firn.DataError, lambda: self.device.load(self.folder / 'a.glb')),
                (firn.InputError, lambda: self.device.load(self.folder / 'b.glb')),
                (firn.UsageError, lambda: scene.renderer(('no such',))),
                (firn.UsageError, lambda: scene.add_mesh([[1, 2]], [[0, 0, 0]])),
                (firn.UsageError, lambda: firn.diff(np.zeros((2, 2)), np.zeros((2, 2)))),
                (firn.ClosedError, lambda: closed.objects),
                (TypeError, lambda: pickle.dumps(scene))):
            with self.assertRaises(kind):
                call()
        images = [renderer.render(VIEW)]

        def interrupt(_done, _all):
            raise KeyboardInterrupt
        with self.assertRaises(KeyboardInterrupt):
            renderer.render(VIEW, progress=interrupt)
        images.append(renderer.render(VIEW))
        np.testing.assert_array_equal(images[0].rgb, images[1].rgb)

    def test_fork(self):
        """The child of a process that has a device gets an error."""
        child = os.fork()
        if not child:
            try:
                firn.Device()
            except firn.Error as error:
                os._exit(0 if 'fork' in str(error) else 2)
            os._exit(1)
        self.assertEqual(os.waitpid(child, 0)[1], 0)

    def make_set(self, name, indices):
        scene = self.sphere()
        points, faces = icosphere(2)
        mesh = scene.add_mesh(0.05 * points + (0.1, 0, 0.1), faces)
        scene.add(mesh, scene.add_material('diamond'), 'small 2')
        with dataset.Writer(self.folder / name, FORMATS, seed=3) as writer:
            renderer = scene.renderer(('rgb', 'depth', 'object', 'objects'))
            for index in writer.missing(indices):
                rng = writer.rng(index)
                variation = dataset.vary(scene, rng, ior=(1.2, 1.8), attenuation=(0, 1))
                camera = dataset.random_camera(rng, scene, SIZE)
                writer.write(index, renderer.render(camera), scene, variation)
        return self.folder / name

    def test_data_set(self):
        """The set depends only on its seed, can be resumed, and has the objects' positions."""
        whole = self.make_set('whole', range(3))
        self.make_set('parts', [2])
        parts = self.make_set('parts', range(3))
        for path in sorted(whole.rglob('*')):
            if path.is_file():
                other = parts / path.relative_to(whole)
                self.assertEqual(path.read_bytes(), other.read_bytes(), path)
        coco = json.loads((whole / 'coco.json').read_text())
        self.assertEqual([one['name'] for one in coco['categories']], ['ball', 'small'])
        self.assertEqual([one['id'] for one in coco['images']], [0, 1, 2])
        for one in coco['annotations']:
            mask = decode(one['segmentation'])
            self.assertEqual(one['area'], mask.sum())
            amodal = decode(one['amodal_segmentation'])
            self.assertTrue((amodal | ~mask).all())
            self.assertEqual(one['visible_fraction'], mask.sum() / amodal.sum())
            rows, columns = np.nonzero(mask)
            x, y, width, height = one['bbox']
            self.assertEqual((x, y, x + width - 1, y + height - 1),
                             (columns.min(), rows.min(), columns.max(), rows.max()))
        with dataset.Writer(whole, FORMATS, seed=3, categories=('small',)):
            pass
        kept = json.loads((whole / 'coco.json').read_text())
        self.assertEqual(kept['categories'], [{'id': 1, 'name': 'small'}])
        self.assertEqual([one['segmentation'] for one in kept['annotations']],
                         [one['segmentation'] for one in coco['annotations']
                          if one['category_id'] == 2])
        (parts / 'meta/000000.json').write_text('{')  # half a file
        self.assertEqual(dataset.Writer(parts, FORMATS, seed=3).missing(range(3)), [0])
        with self.assertRaisesRegex(firn.UsageError, 'images of seed 3'):
            dataset.Writer(whole, FORMATS, seed=4)
        bop = json.loads((whole / 'bop/000001/scene_camera.json').read_text())
        meta = json.loads((whole / 'meta/000001.json').read_text())
        np.testing.assert_allclose(bop['1']['cam_t_w2c'], 1000 * np.array(meta['camera']['t']))
        arrays = np.load(whole / 'npz/000001.npz')
        planes = Exr((whole / 'exr/000001.exr').read_bytes()).read_planes(['Z'])
        np.testing.assert_array_equal(arrays['Z'].ravel(), np.float32(planes['Z']))


if __name__ == '__main__':
    unittest.main()
