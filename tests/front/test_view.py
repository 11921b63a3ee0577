"""test_view.py: the window, `firn view`, on a screen of its own. Usage: see case.py."""
import os
import pathlib
import re
import shutil
import signal
import struct
import subprocess
import sys
import time

sys.dont_write_bytecode = True  # the source tree stays clean
from case import (  # noqa: E402
    NO_DEVICE, NO_INPUT, PLAIN, SMALL, USAGE, Case, environment, long, main, unsanitized)
from desktop import PATIENCE, Desktop, wait_until  # noqa: E402
from gltf_file import boxes, glass, slide, with_nodes  # noqa: E402

SIZE = '200x150'
CHECKED = ('--validate', '--size', SIZE, '--set', 'motion.count=2', '--overlay', 'off',
           '--samples', '1')
FRAMES = 800
MORE = 64  # KiB; 1 KiB a frame makes three times as much of a quarter of them
PARITY = (
    ('valley', 'paper'), ('sphere', 'one-sided'), ('teapot', 'paper'),
)
SUBMITS = {'VK_LAYER_ENABLES': 'VALIDATION_CHECK_ENABLE_SYNCHRONIZATION_VALIDATION_QUEUE_SUBMIT'}
TRIANGLES = 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n'


def png_size(path):
    return struct.unpack('>II', path.read_bytes()[16:24])


def png_pixels(path):
    return subprocess.run(['convert', path, '-depth', '8', 'rgb:-'], capture_output=True,
                          check=True).stdout


class WindowCase(Case):
    CHECKED = CHECKED

    @classmethod
    def setUpClass(cls):
        cls.desktop = Desktop()
        cls.addClassCleanup(cls.desktop.close)

    def env(self):
        return {'DISPLAY': self.desktop.env['DISPLAY'], **SUBMITS}

    def view(self, *arguments):
        return self.succeed('view', *arguments, env=self.env())

    def start(self, scene, *arguments, title=None, plain=PLAIN):
        """Runs on; the number of its window, once it shows the scene."""
        words = [Case.program, 'view', *filter(None, [scene]), *self.CHECKED, *plain,
                 *map(str, arguments)]
        with open(self.folder / 'stdout', 'wb') as out, open(self.folder / 'stderr', 'wb') as log:
            self.process = subprocess.Popen(words, env=environment(self.env()), cwd=self.folder,
                                            stdin=subprocess.DEVNULL, stdout=out, stderr=log)
        self.addCleanup(self.end)
        return self.find(title or f'{scene}, paused')

    def end(self):
        if self.process.poll() is None:
            self.process.kill()
        self.process.wait(timeout=PATIENCE)

    def find(self, scene, act=None):
        def look():
            self.assertIsNone(self.process.poll(), self.words())
            return self.desktop.ask('xdotool', 'search', '--onlyvisible', '--name',
                                    f'^firn: {scene}$').split()
        window = wait_until(f'a window with {scene}', look, self.words, act=act)[0]
        self.desktop.do('windowfocus', '--sync', window)
        return window

    def words(self):
        return (self.folder / 'stderr').read_text()

    def printed(self):
        return (self.folder / 'stdout').read_text()

    def turns(self):
        """(how often it has waited for something, once at least in each turn of its loop; the
        processor's time until then, hundredths of seconds)"""
        self.assertIsNone(self.process.poll(), self.words())
        folder = pathlib.Path(f'/proc/{self.process.pid}')
        count = re.search(r'\nvoluntary_ctxt_switches:\s*(\d+)', (folder / 'status').read_text())
        times = (folder / 'stat').read_text().rpartition(')')[2].split()[11:13]
        return int(count[1]), sum(map(int, times))

    def at_rest(self, window):
        """What it shows when it draws no frames any more."""
        def look():
            turns, spent = self.turns()
            time.sleep(0.3)  # samples are drawn in short parts, after each of which it waits
            wait_until('turns of its loop', lambda: self.turns()[0] >= turns + 6, self.words)
            return self.turns()[1] <= spent + 1
        wait_until('a window at rest', look, self.words)
        return self.desktop.pixels(window)

    def press(self, window, key):
        self.desktop.do('windowfocus', '--sync', window, 'key', key)

    def press_until(self, window, key, what, happens):
        wait_until(what, happens, self.words, act=lambda: self.press(window, key))

    def press_for(self, window, key, scene):
        """Until the title says so."""
        self.find(scene, act=lambda: self.press(window, key))

    def shoot(self, window, number, *endings):
        """Presses the key; what it writes."""
        paths = [self.folder / f'firn-{number:04}{end}' for end in endings or ('.png', '.exr')]

        def look():
            self.assertIsNone(self.process.poll(), self.words())
            return all(path.exists() for path in paths)
        self.press_until(window, 'p', f'screenshot {number}', look)
        return paths[0]

    def press_to_end(self, window, key):
        def press():
            try:
                self.press(window, key)
            except subprocess.CalledProcessError:  # the window is gone, the process not yet
                pass
        wait_until('the end', lambda: self.process.poll() is not None, self.words, act=press)
        self.assertEqual(self.process.returncode, 0, self.words())

    def close(self, window):
        """As the window manager does it."""
        self.press_to_end(window, 'alt+F4')
        self.assertNotIn('firn: ', self.words())  # nothing went wrong
        self.assertRegex(self.words(), r'\d+ frame')


class Hands(WindowCase):
    def drag(self, window, button, *more):
        self.desktop.do('mousemove', '--window', window, 60, 70, *more, 'mousedown', button,
                        'mousemove', '--window', window, 90, 75, 'mouseup', button,
                        'keyup', 'shift')

    def test_mouse_and_keys_move_the_camera(self):
        window = self.start('valley')
        first = self.shoot(window, 1)
        shown = self.at_rest(window)
        self.assertEqual(png_size(first), (200, 150))
        self.assertEqual(shown, png_pixels(first))  # the window shows the screenshot's pixels
        moves = (
            lambda: self.drag(window, 1), lambda: self.drag(window, 3),
            lambda: self.drag(window, 1, 'keydown', 'shift'),
            lambda: self.desktop.do('click', 4),
            lambda: self.press(window, 'Left'), lambda: self.press(window, 'minus'),
        )
        pictures = {png_pixels(first)}
        for number, move in enumerate(moves, 2):
            wait_until(f'move {number}', lambda: self.desktop.pixels(window) not in pictures,
                       act=move)
            pictures.add(png_pixels(self.shoot(window, number)))
            self.assertEqual(len(pictures), number)
        self.press_until(window, 'r', 'the first camera',
                         lambda: self.desktop.pixels(window) == shown)
        last = self.shoot(window, len(moves) + 2)
        self.assertEqual(last.read_bytes(), first.read_bytes())
        self.close(window)

    def test_no_screenshot_is_written_over(self):
        (self.folder / 'firn-0001.exr').write_text('mine')
        window = self.start('sphere')
        self.shoot(window, 2)
        self.shoot(window, 3)
        self.close(window)
        self.assertEqual((self.folder / 'firn-0001.exr').read_text(), 'mine')
        self.assertNotIn('firn-0001.png', self.files())

    def test_help_and_quit(self):
        window = self.start('sphere')
        self.press_until(window, 'F1', 'the help', lambda: 'drop a file' in self.printed())
        self.press_to_end(window, 'q')
        for word in ('Space', 'Q, Ctrl Q', 'drop a file'):
            self.assertIn(word, self.printed())
        text = (pathlib.Path(__file__).parents[2] / 'docs' / 'reference' / 'keys.md').read_text()
        table = text.partition('## Mouse and keyboard')[2].partition('\n\n')[2].partition('\n\n')[0]
        rows = [tuple(cell.strip() for cell in line.split('|')[1:3])
                for line in table.splitlines()[2:]]
        lines = self.printed().splitlines()[:len(rows)]
        self.assertEqual(rows, [(line[2:22].strip(), line[23:]) for line in lines])

    def test_closed_while_it_loads(self):
        window = self.start('teapot', title='loading .*', plain=())
        self.close(window)

    def test_resize_to_one_pixel_and_back(self):
        window = self.start('sphere')
        for number, (width, height) in enumerate(((1, 1), (317, 180), (317, 33)), 1):
            self.desktop.do('windowsize', '--sync', window, width, height)
            self.assertEqual(png_size(self.shoot(window, number)), (width, height))
        self.close(window)

    def test_a_window_of_few_pixels(self):
        """Movements get renderers of their own even where the picture is smaller than what these
        are tried with."""
        window = self.start('valley', '--size', '8x6', '--set', 'env_cube.always=on', '--set',
                            'env_cube.size=1024', plain=())
        self.at_rest(window)
        self.close(window)

    def test_minimise_and_restore(self):
        window = self.start('sphere')
        self.desktop.do('windowminimize', '--sync', window)
        wait_until('an icon', lambda: 'Iconic' in self.desktop.ask('xprop', '-id', window,
                                                                   'WM_STATE'), self.words)
        before = self.turns()[0]
        wait_until('turns of its loop', lambda: self.turns()[0] > before + 5, self.words)
        self.desktop.do('windowmap', '--sync', window)
        self.assertEqual(png_size(self.shoot(window, 1)), (200, 150))
        self.close(window)

    def test_fullscreen_and_back(self):
        window = self.start('sphere')
        self.press_until(window, 'f', 'the whole screen',
                         lambda: len(self.desktop.pixels(window)) == 800 * 600 * 3)
        self.assertEqual(png_size(self.shoot(window, 1)), (800, 600))
        self.press_until(window, 'f', 'the window',
                         lambda: len(self.desktop.pixels(window)) == 200 * 150 * 3)
        self.close(window)

    def test_the_end_while_loading(self):
        """It does not wait for the worker thread, whose reader process is stopped here."""
        window = self.start('drink', title='loading drink')

        def readers():
            return [int(pid) for tasks in pathlib.Path(f'/proc/{self.process.pid}/task').iterdir()
                    for pid in (tasks / 'children').read_text().split()]
        wait_until('a reader', readers, self.words)
        reader = readers()[0]
        os.kill(reader, signal.SIGSTOP)
        self.addCleanup(os.kill, reader, signal.SIGKILL)
        self.press_to_end(window, 'ctrl+q')


class Drop(WindowCase):
    def test_a_model_and_what_is_none(self):
        model = self.folder / 'shape one.obj'
        model.write_text(TRIANGLES)
        broken = self.folder / 'broken.obj'
        broken.write_bytes(b'\0\1\2 no model')
        window = self.start('sphere')
        self.assertTrue(self.desktop.drop(window, model))
        self.find(f'{model}, paused')
        self.shoot(window, 1)
        self.assertTrue(self.desktop.drop(window, broken))
        wait_until('a line about it', lambda: 'broken.obj' in self.words())
        self.find(f'{model}, paused')
        self.shoot(window, 2)
        self.press_to_end(window, 'q')
        self.assertEqual(self.words().count('firn: note: '), 1, self.words())  # of the model
        self.assertEqual(self.words().count('firn: '), 2, self.words())

    def test_an_environment(self):
        self.render('around.exr', '--size', '64x32')
        window = self.start('sphere')
        self.process.send_signal(signal.SIGSTOP)
        self.desktop.leave(window)  # the answer is refused by the X server
        self.process.send_signal(signal.SIGCONT)
        before = self.desktop.pixels(window)
        self.assertTrue(self.desktop.drop(window, self.folder / 'around.exr'))
        wait_until('another picture', lambda: self.desktop.pixels(window) != before)
        self.find('sphere, paused')
        self.close(window)

    def test_pictures(self):
        """What has not the shape of a panorama is compared with; a PNG file that firn wrote has
        settings, any other is a picture; what can be neither is refused."""
        self.render('drawn.exr', '--size', '200x150', '-o', 'drawn.png')
        subprocess.run(['convert', '-size', '200x150', 'xc:#c04020', self.folder / 'red.png'],
                       check=True)
        (self.folder / 'photo.jpg').write_bytes(b'\xff\xd8\xff\xe0 a photograph')
        window = self.start('sphere')
        self.assertTrue(self.desktop.drop(window, self.folder / 'drawn.exr'))
        self.find(r'sphere, paper \| image, paused')
        self.press_for(window, 'ctrl+z', 'sphere, paused')
        self.assertTrue(self.desktop.drop(window, self.folder / 'red.png'))
        self.find(r'sphere, paper \| image, paused')
        red = bytes([0xc0, 0x40, 0x20])
        wait_until('its right half', lambda: self.desktop.pixels(window)[-3:] == red, self.words)
        self.press_for(window, 'w', 'sphere, paused')
        self.assertTrue(self.desktop.drop(window, self.folder / 'drawn.png'))
        self.press_until(window, 'c', 'its settings', lambda: 'cracks.count=0' in self.printed())
        self.find('sphere, paused')
        self.assertTrue(self.desktop.drop(window, self.folder / 'photo.jpg'))
        wait_until('what it is not', lambda: 'photo.jpg' in self.words(), self.words)
        self.press_to_end(window, 'ctrl+q')


class Automatic(WindowCase):
    @unsanitized
    def test_the_pixels_are_those_of_render(self):
        for scene, rung in PARITY:
            with self.subTest(scene=scene, rung=rung):
                words = (scene, '--refraction', rung, '--size', '64x48')
                self.view(*words, '--frames', 1, '--screenshot', 'a.png', '--screenshot', 'a.exr')
                self.succeed('render', *words, '-o', 'b.png', '-o', 'b.exr')
                for kind in ('png', 'exr'):
                    self.assertEqual((self.folder / f'a.{kind}').read_bytes(),
                                     (self.folder / f'b.{kind}').read_bytes())

    def test_locked_time_is_that_of_a_sequence(self):
        self.view('valley', *SMALL, '--frames', 5, '--time-step', 0.25,
                  '--screenshot', 'a.png', '--samples', 4)
        self.succeed('render', 'valley', *SMALL, '--set', 'motion.time=1',
                     '-o', 'b.png', '--samples', 4)
        self.assertEqual((self.folder / 'a.png').read_bytes(),
                         (self.folder / 'b.png').read_bytes())

    @unsanitized
    def test_animations_play(self):
        """As frames of a sequence; the camera follows that of the file."""
        lens = {'type': 'perspective', 'perspective': {'yfov': 0.8, 'znear': 0.1}}
        text = with_nodes(boxes((glass(), [0, 0, 0], 1)), {'camera': 0, 'translation': [0, 0, 6]},
                          cameras=[lens])
        for node, path in ((0, ([0, 0, 0], [4, 0, 0])), (1, ([0, 0, 6], [2, 0, 6]))):
            (self.folder / 'a.gltf').write_text(slide(text, node, 2, path))
            self.view('a.gltf', *SMALL, '--frames', 4, '--time-step', 0.25, '--screenshot', 'a.png')
            for name, when in (('b.png', 0.75), ('c.png', 0)):
                self.succeed('render', 'a.gltf', *SMALL, '--set', f'motion.time={when}', '-o', name)
            played, drawn, first = (png_pixels(self.folder / name)
                                    for name in ('a.png', 'b.png', 'c.png'))
            self.assertEqual(played, drawn)
            self.assertNotEqual(played, first)

    def test_every_present_mode(self):
        for mode in ('fifo', 'mailbox', 'immediate'):
            done = self.view('sphere', *CHECKED, *SMALL, '--frames', 8, '--present', mode)
            self.assertRegex(done.stderr.decode(), r'\A8 frames, .* ms presentation\n\Z')

    def test_quiet(self):
        self.assertEqual(self.view('sphere', *SMALL, '--frames', 3, '-q').stderr, b'')

    def test_wrong_input(self):
        for code, *words in ((NO_INPUT, 'gone.obj'), (NO_INPUT, 'sphere', '--env', 'gone.hdr'),
                             (NO_DEVICE, 'sphere', '--device', 'none such')):
            self.refuse(code, 'view', *words, env=self.env())

    def sizes(self, *words):
        """(processor time, KiB by then), looked at again and again until it ends."""
        options = os.environ.get('ASAN_OPTIONS', '')  # what is freed is freed
        env = {**environment(self.env()), 'ASAN_OPTIONS': ':'.join(
            filter(None, (options, 'quarantine_size_mb=0:thread_local_quarantine_size_kb=0')))}
        command = [Case.program, 'view', 'sphere', *SMALL, '-q', '--time-step', '0.04', *words]
        sizes = []
        with subprocess.Popen(command, env=env, cwd=self.folder) as process:
            folder = pathlib.Path(f'/proc/{process.pid}')
            while process.poll() is None:
                size = re.search(r'RssAnon:\s*(\d+)', (folder / 'status').read_text())
                times = (folder / 'stat').read_text().rpartition(')')[2].split()[11:13]
                if size:
                    sizes.append((sum(map(int, times)), int(size[1])))
                time.sleep(0.01)
        self.assertEqual(process.returncode, 0)
        return sizes

    @long
    def test_memory_stays_the_same(self):
        """A leak grows in each quarter of the processor's time; what a library keeps does once."""
        cheap = [word for row in ('env_cube.dynamic=off', 'cracks.count=0', 'bubbles.count=0')
                 for word in ('--set', row)]
        for words in ((), ('--overlay', 'on')):
            with self.subTest(words=words):
                sizes = self.sizes(*words, *cheap, '--frames', str(FRAMES))
                end = sizes[-1][0]
                most = [max(size for when, size in sizes if q - 1 <= 4 * when / end <= q)
                        for q in (1, 2, 3, 4)]
                print(f'{FRAMES} frames: {most} KiB in each quarter')
                self.assertLess(min(b - a for a, b in zip(most, most[1:])), MORE)


class NoWindow(Case):
    def test_without_display(self):
        self.refuse(NO_DEVICE, 'view', 'sphere', names=['firn render'])
        self.render('a.png')  # needs none

    def test_without_the_program_for_windows(self):
        alone = self.folder / 'firn'
        shutil.copy(Case.program, alone)
        done = subprocess.run([alone, 'view', 'sphere'], env=environment({}), cwd=self.folder,
                              capture_output=True, timeout=PATIENCE, check=False)
        self.assertEqual(done.returncode, NO_DEVICE)
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)

    def test_help_needs_no_display(self):
        text = self.succeed('view', '--help').stdout.decode()
        for option in ('--frames', '--time-step', '--screenshot', '--present',
                       '--overlay'):
            self.assertIn(option, text)
        self.assertNotIn('--resume', text)
        self.assertEqual(self.succeed('help', 'view').stdout.decode(), text)

    def test_wrong_words(self):
        for option, value in (('--frames', '0'), ('--frames', '1-5'), ('--time-step', '-1'),
                              ('--time-step', 'nan'), ('--present', 'relaxed'),
                              ('--screenshot', 'a.gif'),
                              ('--overlay', 'maybe')):
            self.refuse(USAGE, 'view', 'sphere', option, value, names=[option, value])


if __name__ == '__main__':
    main()
