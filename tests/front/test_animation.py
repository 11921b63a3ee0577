"""test_animation.py: animations of model files, in sequences and alone. Usage: see case.py."""
import json
import subprocess
import sys
import time

sys.dont_write_bytecode = True  # the source tree stays clean
from case import (DATA, NO_DRIVER, USAGE, Case, command, environment, long,  # noqa: E402
                  main, unsanitized)
from exr_file import Exr, write_exr  # noqa: E402
from gltf_file import boxes, glass, slide, with_nodes  # noqa: E402

SMALL = ('--size', '32x24', '-q')
TRACED = ('-r', 'reference', '--set', 'reference.photons=1000')
STILL = ('--ground', 'none', '--set', 'motion.ice=0', '--set', 'motion.lights=0')


class Animation(Case):
    def setUp(self):
        super().setUp()
        text = boxes((glass(), [0, 0, 0], 1))
        text = slide(text, 0, 2, ([0, 0, 0], [4, 0, 0]))
        (self.folder / 'a.gltf').write_text(slide(text, 0, 1, ([0, 0, 0], [0, 3, 0]), 'rise'))
        lens = {'type': 'perspective', 'perspective': {'yfov': 0.8, 'znear': 0.1}}
        seen = with_nodes(boxes((glass(), [0, 0, 0], 1)), {'name': 'cam', 'camera': 0},
                          cameras=[lens])
        (self.folder / 'seen.gltf').write_text(slide(seen, 1, 2, ([0, 0, 6], [2, 0, 6])))

    def pixels(self, name):
        return Exr((self.folder / name).read_bytes()).read_planes(['R', 'G', 'B'])

    def draw(self, name, *words, **how):
        self.succeed('render', *words, *SMALL, *STILL, '-o', name, **how)
        return '#' not in name and self.pixels(name)

    def check_sequence(self, scene, *words, **how):
        """Frames of a sequence, of its parts and alone have the same pixels; none are equal."""
        self.draw('all.##.exr', scene, *words, '--frames', '0-30x10', **how)
        for part in (1, 2):
            self.draw('part.##.exr', scene, *words, '--frames', '0-30x10', '--chunk',
                      f'{part}/2', **how)
        frames = [self.pixels(f'all.{frame:02}.exr') for frame in (0, 10, 20, 30)]
        for i, frame in enumerate((0, 10, 20, 30)):
            whole = (self.folder / f'all.{frame:02}.exr').read_bytes()
            self.assertEqual((self.folder / f'part.{frame:02}.exr').read_bytes(), whole)
            self.assertNotIn(frames[i], frames[:i])
        alone = self.draw('alone.exr', scene, *words, '--set', 'motion.time=0.8', **how)
        self.assertEqual(alone, frames[2])
        return frames

    def test_sequences(self):
        moving = self.check_sequence('a.gltf', *TRACED, env=NO_DRIVER)
        rising = self.draw('b.exr', 'a.gltf', *TRACED, '--animation', 'rise', '--set',
                           'motion.time=0.8', env=NO_DRIVER)
        self.assertNotIn(rising, moving)
        at_rest = self.draw('b.exr', 'a.gltf', *TRACED, '--animation', 'none', '--set',
                            'motion.time=0.8', env=NO_DRIVER)
        self.assertEqual(at_rest, moving[0])

    @long
    def test_fifty_objects_move(self):
        """What rays meet is posed anew: frames are those of processes of their own."""
        places = [[3 * (i % 10), 3 * (i // 10), -(i % 3)] for i in range(50)]
        text = boxes(*((glass(1.3 + 0.005 * i), place, 1) for i, place in enumerate(places)))
        for i, (x, y, z) in enumerate(places):
            text = slide(text, i, 2, ([x, y, z], [x + i % 4, y + i % 3, z + 1]))
        scene = json.loads(text)
        channels = [{'sampler': i, 'target': one['channels'][0]['target']}
                    for i, one in enumerate(scene['animations'])]
        scene['animations'] = [{'channels': channels, 'samplers': [
            one['samplers'][0] for one in scene['animations']]}]
        (self.folder / 'fifty.gltf').write_text(json.dumps(scene))
        words = ('fifty.gltf', '-r', 'trace', '--env', 'studio')
        self.check_sequence(*words)
        query = ('--set', 'trace.traversal=query')
        if b'no ray queries' not in self.succeed('render', *words, *SMALL, *query, '-o',
                                                 'a.exr').stderr:
            self.check_sequence(*words, *query)

    def test_cameras_move(self):
        frames = self.check_sequence('seen.gltf', *TRACED, env=NO_DRIVER)
        eye = self.draw('eye.exr', 'seen.gltf', *TRACED, '--eye', '0.8,0,6', '--target', '0.8,0,0',
                        '--fov', '45.836624', '--animation', 'none', env=NO_DRIVER)
        far = max(abs(a - b) for a, b in zip(eye['G'], frames[2]['G']))
        self.assertLess(far, 0.05)

    def test_files_are_read_once(self):
        """Pictures and cracks of files, which vanish while there are poses to come."""
        files = [self.folder / name for name in ('waves.exr', 'crack.obj')]
        files[0].write_bytes(write_exr((4, 1), {'Y': [0, 90, 0, 90]}))
        files[1].write_text('v -1 -1 0\nv 1 -1 0\nv 0 1 0.2\nf 1 2 3\n')
        words = ('render', 'a.gltf', '--material', 'ice', *TRACED, '--size', '8x6', '-q', '--bump',
                 files[0], '--cracks', files[1], '--frames', '0-4', '-o', '#.exr',
                 '--set', 'air.count=0', '--set', 'bubbles.count=0')
        with subprocess.Popen(command(*words), cwd=self.folder,
                              env=environment(NO_DRIVER)) as process:
            while process.poll() is None and not (self.folder / '0.exr').exists():
                time.sleep(0.001)
            for file in files:
                file.unlink()
            self.assertEqual(process.wait(), 0)

    @unsanitized
    def test_sixty_frames(self):
        """A whole sequence and its parts: the same bytes, and each frame is another picture."""
        words = ('render', 'a.gltf', '--size', '8x6', '-q', *TRACED, '--background', '0.4,0.5,0.6',
                 *STILL, '--frames', '0-59', '--set', 'motion.fps=30', '--aov', 'P')
        self.succeed(*words, '-o', 'all.##.exr', env=NO_DRIVER)
        for part in (1, 2, 3):
            self.succeed(*words, '--chunk', f'{part}/3', '-o', 'part.##.exr', env=NO_DRIVER)
        files = [(self.folder / f'all.{i:02}.exr').read_bytes() for i in range(60)]
        self.assertEqual(len(set(files)), 60)
        for i, file in enumerate(files):
            self.assertEqual((self.folder / f'part.{i:02}.exr').read_bytes(), file)

    @unsanitized
    def test_drawn_sequences(self):
        self.check_sequence('a.gltf', '--tiles', '2x1')

    def test_files_that_are_there_stay(self):
        words = ('a.gltf', *SMALL, *TRACED, '--frames', '0-2', '-o', 'a.#.exr')
        self.succeed('render', *words, env=NO_DRIVER)
        before = [(self.folder / f'a.{i}.exr').stat().st_mtime_ns for i in range(3)]
        self.succeed('render', *words, '--resume', env=NO_DRIVER)
        after = [(self.folder / f'a.{i}.exr').stat().st_mtime_ns for i in range(3)]
        self.assertEqual(before, after)
        self.succeed('farm', 'status', *words, '--set', 'motion.time=0', env=NO_DRIVER)
        self.assertEqual(self.firn('farm', 'status', *words, '--animation', 'rise',
                                   env=NO_DRIVER).returncode, 1)

    def test_info(self):
        said = json.loads(self.succeed('info', 'a.gltf', '--json', env=NO_DRIVER).stdout)
        self.assertEqual(said['animations'], [{'name': 'slide', 'seconds': 2.0},
                                              {'name': 'rise', 'seconds': 1.0}])
        text = self.succeed('info', 'a.gltf', env=NO_DRIVER).stdout.decode()
        self.assertRegex(text, r'(?m)^  1 +rise +1$')
        high = slide(boxes((glass(), [0, 0, 0], 1)), 0, 1, ([0, 7, 0], [0, 3, 0]))
        (self.folder / 'high.gltf').write_text(high)
        for name, low in (('slide', 6), ('none', -1)):
            said = self.succeed('info', 'high.gltf', '--json', '--animation', name, env=NO_DRIVER)
            self.assertAlmostEqual(json.loads(said.stdout)['min'][1], low, 3)

    def test_animations_that_are_not_there(self):
        (self.folder / 'a.obj').write_text('v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n')
        still = (self.folder / 'still.gltf')
        still.write_text(boxes((glass(), [0, 0, 0], 1)))
        for code, words, names in (
                (DATA, ('a.gltf', '--animation', 'slyde'), ("'slide'?", "1 'rise'")),
                (DATA, ('a.gltf', '--animation', '2'), ("'2'", "0 'slide'")),
                (DATA, ('still.gltf', '--animation', '0'), ('there are 0',)),
                (DATA, ('a.obj', '--animation', '0'), ('only glTF',)),
                (USAGE, ('sphere', '--animation', '0'), ('--animation', 'sphere'))):
            self.refuse(code, 'render', *words, *SMALL, names=names, env=NO_DRIVER)


if __name__ == '__main__':
    main()
