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
import firn  # noqa: E402
from exr_file import Exr  # noqa: E402
from firn import dataset  # noqa: E402

FIRN = os.path.abspath(sys.argv.pop(1)) if len(sys.argv) > 1 else 'firn'
SIZE = (64, 48)
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

    def test_refractive_flow(self):
        """Flow of `bounce` equals the path tracer's, and a ball inverts the image."""
        flows = []
        for model in ('bounce', 'reference'):
            frame = self.sphere(refraction=model).renderer(('exit', 'object')).render(VIEW)
            flows.append(frame.refractive_flow()[frame.object > 0])
        both = np.isfinite(flows[0]).all(axis=1) & np.isfinite(flows[1]).all(axis=1)
        self.assertGreater(both.sum(), 30)
        self.assertLess(np.median(np.linalg.norm(flows[0] - flows[1], axis=1)[both]), 0.5)
        for axis, at in ((1, np.nonzero(frame.object)[0]), (0, np.nonzero(frame.object)[1])):
            before = at < np.median(at)
            self.assertGreater(np.nanmedian(flows[0][before, axis]), 0)
            self.assertLess(np.nanmedian(flows[0][~before, axis]), 0)

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
        scene.add(mesh, scene.add_material('diamond'), 'small')
        with dataset.Writer(self.folder / name, ('exr', 'npz', 'coco', 'bop', 'colmap'),
                            seed=3) as writer:
            renderer = scene.renderer(('rgb', 'depth', 'object'))
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
            rows, columns = np.nonzero(mask)
            x, y, width, height = one['bbox']
            self.assertEqual((x, y, x + width - 1, y + height - 1),
                             (columns.min(), rows.min(), columns.max(), rows.max()))
        bop = json.loads((whole / 'bop/000001/scene_camera.json').read_text())
        meta = json.loads((whole / 'meta/000001.json').read_text())
        np.testing.assert_allclose(bop['1']['cam_t_w2c'], 1000 * np.array(meta['camera']['t']))
        arrays = np.load(whole / 'npz/000001.npz')
        planes = Exr((whole / 'exr/000001.exr').read_bytes()).read_planes(['Z'])
        np.testing.assert_array_equal(arrays['Z'].ravel(), np.float32(planes['Z']))


if __name__ == '__main__':
    unittest.main()
