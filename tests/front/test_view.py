"""test_view.py: the window, `firn view`, on a screen of its own. Usage: see case.py."""
import pathlib
import shlex
import shutil
import struct
import subprocess
import sys
import time

sys.dont_write_bytecode = True  # the source tree stays clean
from case import NO_DEVICE, NO_INPUT, USAGE, Case, environment, main  # noqa: E402
from desktop import PATIENCE, Desktop, wait_until  # noqa: E402

SIZE = '200x150'
CHECKED = ('--validate', '--size', SIZE, '--set', 'motion.count=2', '--overlay', 'off')
PARITY = (
    ('ice-cube', 'paper'), ('ice-cube', 'one-sided'), ('sphere', 'paper'),
    ('sphere', 'one-sided'), ('teapot', 'paper'),
)
SUBMITS = {'VK_LAYER_ENABLES': 'VALIDATION_CHECK_ENABLE_SYNCHRONIZATION_VALIDATION_QUEUE_SUBMIT'}
TRIANGLES = 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n'


def png_size(path):
    return struct.unpack('>II', path.read_bytes()[16:24])


def png_pixels(path):
    return subprocess.run(['convert', path, '-depth', '8', 'rgb:-'], capture_output=True,
                          check=True).stdout


class WindowCase(Case):
    @classmethod
    def setUpClass(cls):
        cls.desktop = Desktop()
        cls.addClassCleanup(cls.desktop.close)

    def env(self):
        return {'DISPLAY': self.desktop.env['DISPLAY'], **SUBMITS}

    def view(self, *arguments):
        return self.succeed('view', *arguments, env=self.env())

    def start(self, scene, *arguments, title=None, stdout=subprocess.PIPE):
        """Runs on; the number of its window, once it shows the scene."""
        words = [Case.program, 'view', scene, *CHECKED, *map(str, arguments)]
        self.log = open(self.folder / 'stderr', 'wb')
        self.addCleanup(self.log.close)
        self.process = subprocess.Popen(words, env=environment(self.env()), cwd=self.folder,
                                        stdin=subprocess.DEVNULL, stdout=stdout,
                                        stderr=self.log)
        self.addCleanup(self.end)
        return self.find(title or scene)

    def end(self):
        if self.process.poll() is None:
            self.process.kill()
        self.process.communicate(timeout=PATIENCE)

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
        self.press_until(window, key, 'the end', lambda: self.process.poll() is not None)
        self.assertEqual(self.process.returncode, 0, self.words())

    def close(self, window):
        """As the window manager does it."""
        self.press_to_end(window, 'alt+F4')
        self.assertNotIn('firn: ', self.words())  # nothing went wrong
        self.assertRegex(self.words(), r'\d+ frames')


class Hands(WindowCase):
    def drag(self, window, button, *more):
        self.desktop.do('mousemove', '--window', window, 60, 70, *more, 'mousedown', button,
                        'mousemove', '--window', window, 90, 75, 'mouseup', button,
                        'keyup', 'shift')

    def test_mouse_and_keys_move_the_camera(self):
        window = self.start('ice-cube')
        self.press_for(window, 'space', 'ice-cube, paused')
        first = self.shoot(window, 1)
        shown = self.desktop.pixels(window)
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
        self.press(window, 'F1')
        self.press_to_end(window, 'q')
        text = self.process.communicate(timeout=PATIENCE)[0].decode()
        for word in ('Space', 'Esc, Q', 'drop a file'):
            self.assertIn(word, text)

    def test_closed_while_it_loads(self):
        window = self.start('teapot', title='loading .*')
        self.close(window)

    def test_resize_to_one_pixel_and_back(self):
        window = self.start('sphere')
        for number, (width, height) in enumerate(((1, 1), (220, 180), (317, 33)), 1):
            self.desktop.do('windowsize', '--sync', window, width, height)
            self.assertEqual(png_size(self.shoot(window, number)), (width, height))
        self.close(window)

    def test_minimise_and_restore(self):
        window = self.start('sphere')
        self.desktop.do('windowminimize', '--sync', window)
        time.sleep(0.5)  # frames would be drawn now
        self.assertIsNone(self.process.poll(), self.words())
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


class Panels(WindowCase):
    FIRST_ROW = 312      # where it lies: pixels in the window
    BESIDE = (350, 200)  # no panel there

    def start_with_panels(self, *arguments):
        printed = open(self.folder / 'stdout', 'wb')
        self.addCleanup(printed.close)
        window = self.start('sphere', '--size', '360x340', '--overlay', 'on', *arguments,
                            stdout=printed)
        self.press_for(window, 'space', 'sphere, paused')
        return window

    def command(self, window):
        """What the key for it prints. While a line of text is being left, it may be lost there."""
        printed = self.folder / 'stdout'
        before = len(printed.read_bytes())

        def look():
            self.press(window, 'c')
            for _ in range(20):
                line = printed.read_text()[before:]
                if line.endswith('\n'):
                    return line.splitlines()[-1]
                time.sleep(0.1)
            return None
        return wait_until('a command', look)

    def wait_for_command(self, window, *words, without=None, act=None):
        def look():
            command = self.command(window)
            old = without and without in command
            return not old and all(word in command for word in words) and command
        return wait_until(' '.join(words), look, self.words, act=act)

    def move(self, window, start, *ends):
        """Presses the button, goes along, lets it go."""
        words = ['mousemove', '--window', window, *start, 'mousedown', 1]
        for end in ends:
            words += ['mousemove', '--window', window, *end]
        self.desktop.do(*words, 'mouseup', 1)

    def find_row(self, window, name):
        """Leaves no row but this one."""
        for keys in (('key', 'slash', 'key', 'ctrl+a'), ('type', name), ('key', 'Return')):
            self.desktop.do(*keys)

    def drag_row(self, window, name, *places):
        """Along the widget of a setting, which is left alone in the panel."""
        self.find_row(window, name)
        self.move(window, *[(place, self.FIRST_ROW) for place in places])

    def test_settings_change_by_mouse_and_the_command_draws_the_same(self):
        window = self.start_with_panels('--set', 'cracks.count=3')
        self.assertNotIn('exposure', self.command(window))
        first = self.shoot(window, 1)
        for row, change, places in (
                ('tonemap.exposure', 'tonemap.exposure=', (90, 100, 130)),
                ('cracks.surface', 'cracks.surface=on', (23,)),
                ('cracks.count', 'cracks.count=', (40, 110))):
            command = self.wait_for_command(
                window, change, without='cracks.count=3 ' if row == 'cracks.count' else None,
                act=lambda row=row, places=places: self.drag_row(window, row, *places))
        self.assertNotIn('--eye', command)  # nothing of this was for the camera
        command = self.wait_for_command(
            window, '--eye', act=lambda: self.move(window, self.BESIDE, (340, 220), (330, 240)))
        shown = self.shoot(window, 2)
        self.assertNotEqual(png_pixels(shown), png_pixels(first))
        words = shlex.split(command)
        self.assertEqual(words[:2], ['firn', 'render'])
        self.succeed(*words[1:])
        self.assertEqual(png_pixels(self.folder / 'firn.png'), png_pixels(shown))
        self.close(window)

    def names(self, what):
        lines = self.succeed('list', what).stdout.decode().splitlines()
        return [line.split()[0] for line in lines if line.startswith('  ')]

    def choose(self, window, row, entry):
        """Clicks on an entry of a list, when this is open and still. Heights in the window."""
        def look():
            pixels = self.desktop.pixels(window)
            return [pixels[3 * (y * 360 + 100):3 * (y * 360 + 160)]
                    for y in range(entry - 3, entry + 3)]

        def still():
            last = look()
            time.sleep(0.3)
            return look() == last and last
        self.desktop.do('mousemove', '--window', window, *self.BESIDE)  # no words about a row
        before = wait_until('a panel at rest', still)
        self.move(window, (60, row))
        time.sleep(0.5)
        if wait_until('a list at rest', still) != before:
            self.move(window, (60, entry))

    def test_lists_choose_rungs_and_materials(self):
        first, second, *_ = self.names('rungs')
        material = self.names('materials')[-1]
        window = self.start_with_panels()
        self.wait_for_command(window, f' --refraction {second} ',
                              act=lambda: self.choose(window, 149, 188))
        self.find(rf'sphere, {second} \| {first}, paused',
                  act=lambda: self.choose(window, 169, 208))
        self.shoot(window, 1, '.png', '-left.exr', '-right.exr')
        self.press_for(window, 's', 'sphere, paused')
        self.wait_for_command(window, f' --material {material} ',
                              act=lambda: self.choose(window, 189, 150))
        self.close(window)

    def test_only_some_screenshots_have_panels(self):
        window = self.start_with_panels()
        alone = self.shoot(window, 1)
        path = self.folder / 'firn-0002.png'
        self.press_until(window, 'P', 'the screenshot of all', path.exists)
        self.assertNotIn('firn-0002.exr', self.files())
        self.assertNotEqual(png_pixels(path), png_pixels(alone))
        self.press_until(window, 'h', 'no panels',
                         lambda: self.desktop.pixels(window) == png_pixels(alone))
        self.assertEqual(self.shoot(window, 3).read_bytes(), alone.read_bytes())
        self.press_until(window, 'h', 'panels',
                         lambda: self.desktop.pixels(window) != png_pixels(alone))
        self.close(window)

    def test_all_panels_by_key(self):
        window = self.start_with_panels()
        shown = {self.desktop.pixels(window)}
        for key in ('t', 'g', 'F1'):
            self.press_until(window, key, f'the panel of {key}',
                             lambda: self.desktop.pixels(window) not in shown)
            shown.add(self.desktop.pixels(window))
        self.close(window)

    def test_buttons(self):
        def click(x, y):
            return lambda: self.move(window, (x, y))
        window = self.start_with_panels('--size', '640x560')
        self.find('sphere', act=click(38, 90))
        self.find('sphere, paused', act=click(38, 90))
        first = self.shoot(window, 1)
        self.wait_for_command(window, '--eye',
                              act=lambda: self.move(window, (500, 200), (520, 220), (540, 210)))
        self.wait_for_command(window, without='--eye', act=click(279, 90))
        self.wait_for_command(window, 'cracks.count=',
                              act=lambda: self.move(window, (30, 229), (60, 229), (90, 229)))
        self.wait_for_command(window, 'cracks.count=', without='motion.count',
                              act=click(280, 371))  # of its group
        self.wait_for_command(window, without='cracks.count', act=click(208, 271))
        size = (self.folder / 'stdout').stat().st_size
        wait_until('a command', lambda: (self.folder / 'stdout').stat().st_size > size,
                   act=click(115, 90))
        second = self.folder / 'firn-0002.png'
        wait_until('a screenshot', second.exists, act=click(206, 90))
        self.assertNotEqual(png_pixels(second), png_pixels(first))  # nothing moves around it
        self.close(window)

    def test_words_about_what_is_below_the_mouse(self):
        window = self.start_with_panels('--size', '640x560')
        shown = [self.desktop.pixels(window)]
        self.press_until(window, 'g', 'the plan',
                         lambda: self.desktop.pixels(window) not in shown)
        for place in ((400, 472), (400, 479), (400, 500), (110, 90), (90, 229)):
            shown.append(self.desktop.pixels(window))
            wait_until(f'words at {place}', lambda: self.desktop.pixels(window) not in shown,
                       act=lambda place=place: self.desktop.do('mousemove', '--window', window,
                                                               *place))
        self.close(window)

    def test_keys_move_in_a_panel_until_escape(self):
        window = self.start_with_panels()
        self.press(window, 'Tab')
        self.press(window, 'Left')
        self.press(window, 'Down')
        self.press(window, 'Escape')
        self.assertNotIn('--eye', self.command(window))
        self.press(window, 'Left')
        self.wait_for_command(window, '--eye')
        self.press_to_end(window, 'Escape')  # nothing has the keys but the picture

    def test_panels_in_files_if_asked_for(self):
        words = ('sphere', *CHECKED, '--time-step', 1, '--frames', 3)
        self.view(*words, '--screenshot', 'a.png')
        self.view(*words, '--overlay', 'on', '--screenshot', 'b.png', '--screenshot', 'b.exr')
        self.assertNotEqual(png_pixels(self.folder / 'a.png'), png_pixels(self.folder / 'b.png'))
        self.assertEqual(png_size(self.folder / 'b.png'), (200, 150))


class Drop(WindowCase):
    def test_a_model_and_what_is_none(self):
        model = self.folder / 'shape one.obj'
        model.write_text(TRIANGLES)
        broken = self.folder / 'broken.obj'
        broken.write_bytes(b'\0\1\2 no model')
        window = self.start('sphere')
        self.assertTrue(self.desktop.drop(window, model))
        self.find(str(model))
        self.shoot(window, 1)
        self.assertTrue(self.desktop.drop(window, broken))
        wait_until('a line about it', lambda: 'broken.obj' in self.words())
        self.find(str(model))
        self.shoot(window, 2)
        self.press_to_end(window, 'Escape')
        self.assertEqual(self.words().count('firn: '), 1, self.words())

    def test_an_environment(self):
        self.succeed('render', 'sphere', '--size', '64x32', '-o', 'around.exr')
        window = self.start('sphere')
        self.press_for(window, 'space', 'sphere, paused')
        before = self.desktop.pixels(window)
        self.assertTrue(self.desktop.drop(window, self.folder / 'around.exr'))
        wait_until('another picture', lambda: self.desktop.pixels(window) != before)
        self.close(window)


class Automatic(WindowCase):
    def test_the_pixels_are_those_of_render(self):
        for scene, rung in PARITY:
            with self.subTest(scene=scene, rung=rung):
                words = (scene, '--refraction', rung, '--size', SIZE)
                self.view(*words, '--frames', 1, '--screenshot', 'a.png', '--screenshot', 'a.exr')
                self.succeed('render', *words, '-o', 'b.png', '-o', 'b.exr')
                for kind in ('png', 'exr'):
                    self.assertEqual((self.folder / f'a.{kind}').read_bytes(),
                                     (self.folder / f'b.{kind}').read_bytes())

    def test_locked_time_is_that_of_a_sequence(self):
        self.view('ice-cube', '--size', SIZE, '--frames', 5, '--time-step', 0.25,
                  '--screenshot', 'a.png', '--samples', 4)
        self.succeed('render', 'ice-cube', '--size', SIZE, '--set', 'motion.time=1',
                     '-o', 'b.png', '--samples', 4)
        self.assertEqual((self.folder / 'a.png').read_bytes(),
                         (self.folder / 'b.png').read_bytes())

    def test_every_present_mode(self):
        for mode in ('fifo', 'mailbox', 'immediate'):
            done = self.view('sphere', *CHECKED, '--frames', 20, '--present', mode,
                             '--fps-limit', 200)
            self.assertRegex(done.stderr.decode(), r'\A20 frames, .* until the screen has them\n\Z')

    def test_quiet(self):
        self.assertEqual(self.view('sphere', '--size', SIZE, '--frames', 3, '-q').stderr, b'')

    def test_wrong_input(self):
        for code, *words in ((NO_INPUT, 'gone.obj'), (NO_INPUT, 'sphere', '--env', 'gone.hdr'),
                             (NO_DEVICE, 'sphere', '--device', 'none such')):
            self.refuse(code, 'view', *words, env=self.env())

    def sizes(self, *words):
        """KiB, looked at again and again until it ends."""
        command = [Case.program, 'view', 'sphere', '-q', '--time-step', '0.04', *words]
        sizes = []
        with subprocess.Popen(command, env=environment(self.env()), cwd=self.folder) as process:
            status = pathlib.Path(f'/proc/{process.pid}/status')
            while process.poll() is None:
                lines = status.read_text().splitlines()
                sizes += [int(line.split()[1]) for line in lines if line.startswith('VmRSS')]
                time.sleep(0.05)
        self.assertEqual(process.returncode, 0)
        return sizes

    def test_memory_stays_the_same(self):
        cheap = [word for row in ('env_cube.dynamic=off', 'air.count=0', 'cracks.count=0',
                                  'bubbles.count=0') for word in ('--set', row)]
        for words in (('--size', '64x48'), ('--size', '64x48', '--overlay', 'on')):
            with self.subTest(words=words):
                sizes = self.sizes(*words, *cheap, '--frames', '2000')
                early, late = max(sizes[:len(sizes) // 4]), max(sizes[len(sizes) * 3 // 4:])
                print(f'2000 frames: {early} KiB in the first quarter, {late} KiB in the last')
                self.assertLess(late, early + 2048)


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
        for option in ('--frames', '--time-step', '--screenshot', '--present', '--fps-limit',
                       '--overlay'):
            self.assertIn(option, text)
        self.assertNotIn('--resume', text)
        self.assertEqual(self.succeed('help', 'view').stdout.decode(), text)

    def test_wrong_words(self):
        self.refuse(USAGE, 'view')
        for option, value in (('--frames', '0'), ('--frames', '1-5'), ('--time-step', '-1'),
                              ('--time-step', 'nan'), ('--present', 'relaxed'),
                              ('--fps-limit', '0'), ('--screenshot', 'a.gif'),
                              ('--overlay', 'maybe')):
            self.refuse(USAGE, 'view', 'sphere', option, value, names=[option, value])


if __name__ == '__main__':
    main()
