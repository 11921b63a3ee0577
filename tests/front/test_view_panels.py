"""test_view_panels.py: tests the panels of the window. Usage: see case.py."""
import shlex
import sys

sys.dont_write_bytecode = True  # the source tree stays clean
from case import CRACKED, PLAIN, main  # noqa: E402
from desktop import PATIENCE, wait_until  # noqa: E402
from test_view import CHECKED, WindowCase, png_pixels, png_size  # noqa: E402


class Panels(WindowCase):
    FIRST_ROW = 312      # where it lies: pixels in the window
    BESIDE = (350, 200)  # no panel there

    def start_with_panels(self, *arguments):
        window = self.start('sphere', '--size', '360x340', '--overlay', 'on', *arguments,
                            plain=CRACKED)
        self.press_for(window, 'space', 'sphere, paused')
        return window

    def command(self, window):
        """What the key for it prints. While a line of text is being left, it may be lost there."""
        before = len(self.printed())

        def look():
            line = self.printed()[before:]
            return line.endswith('\n') and line.splitlines()[-1]
        return wait_until('a command', look, self.words, act=lambda: self.press(window, 'c'),
                          again=5)

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

    def at_rest(self, what, look):
        """What look() finds, and finds again."""
        seen = [None]

        def twice():
            seen.append(look())
            return seen[-1] == seen[-2] and seen[-1]
        return wait_until(what, twice, self.words)

    def choose(self, window, row, entry):
        """
        Clicks on an entry of a list, when this is open and still: heights in the window. Where it
        does not open, or is not yet still, nothing or another entry is chosen; then try again.
        """
        def look():
            pixels = self.desktop.pixels(window)
            return [pixels[3 * (y * 360 + 100):3 * (y * 360 + 160)]
                    for y in range(entry - 3, entry + 3)]
        self.desktop.do('mousemove', '--window', window, *self.BESIDE)  # no words about a row
        closed = self.at_rest('a panel at rest', look)
        self.move(window, (60, row))
        try:
            wait_until('an open list', lambda: look() != closed, patience=PATIENCE / 12)
        except AssertionError:
            return
        self.at_rest('a list at rest', look)
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
        size = len(self.printed())
        wait_until('a command', lambda: len(self.printed()) > size, act=click(115, 90))
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
        shown = self.desktop.pixels(window)
        self.press_until(window, 'Tab', 'a frame around a widget',
                         lambda: self.desktop.pixels(window) != shown)
        self.press(window, 'Left')
        self.press(window, 'Down')
        self.press(window, 'Escape')
        self.assertNotIn('--eye', self.command(window))
        self.wait_for_command(window, '--eye', act=lambda: self.press(window, 'Left'))
        self.press_to_end(window, 'Escape')  # nothing has the keys but the picture

    def test_panels_in_files_if_asked_for(self):
        words = ('sphere', *CHECKED, *PLAIN, '--time-step', 1, '--frames', 3)
        self.view(*words, '--screenshot', 'a.png')
        self.view(*words, '--overlay', 'on', '--screenshot', 'b.png', '--screenshot', 'b.exr')
        self.assertNotEqual(png_pixels(self.folder / 'a.png'), png_pixels(self.folder / 'b.png'))
        self.assertEqual(png_size(self.folder / 'b.png'), (200, 150))


if __name__ == '__main__':
    main()
