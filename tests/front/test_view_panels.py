"""test_view_panels.py: tests the panels of the window. Usage: see case.py."""
import os
import random
import re
import shlex
import sys

sys.dont_write_bytecode = True  # the source tree stays clean
from case import CRACKED, PAPER, PLAIN, SMALL_CUBE, long, main, unsanitized  # noqa: E402
from desktop import PATIENCE, wait_until  # noqa: E402
from gltf_file import boxes  # noqa: E402
from test_view import CHECKED, TRIANGLES, WindowCase, png_pixels, png_size  # noqa: E402


SURROUND = b'\x14\x17\x1a'  # of the dark theme


class PanelsCase(WindowCase):
    """Hands that know where controls are. All is half as large as it is first: a quarter of the
    pixels, of which a frame's time is."""

    PICTURE, WINDOW, BAR = (180, 170), (305, 201), 18  # pixels; the bar is above the picture
    SIZES = ('--size', '180x170', '--ui-scale', '0.5', '--overlay', 'on', '--ui-dump', 'ui')
    BESIDE = (50, 100)  # in the picture

    def env(self):
        return {**super().env(), 'XDG_DATA_HOME': str(self.folder / 'data'),
                'XDG_STATE_HOME': str(self.folder / 'state'),
                'PATH': f'{self.folder}:{os.environ["PATH"]}'}  # for xclip()

    def xclip(self):
        """Takes the place of the program, and keeps what it is given."""
        path = self.folder / 'xclip'
        path.write_text(f'#!/bin/sh\n[ "$4" = image/png ] && cat > "{self.folder}/clipboard.new"'
                        f' && mv "{self.folder}/clipboard.new" "{self.folder}/clipboard"\n')
        path.chmod(0o755)
        return self.folder / 'clipboard'

    def start_with_panels(self, *arguments, scene='sphere', title=None, plain=CRACKED):
        return self.start(scene, *self.SIZES, *arguments, title=title, plain=plain)

    def control(self, label, last=False):
        """Left, top, width, height of what a hand can use, pixels; None: it does not show."""
        try:
            lines = (self.folder / 'ui').read_text().splitlines()
        except FileNotFoundError:
            return None
        for line in reversed(lines) if last else lines:
            *numbers, name = line.split(' ', 4)
            if name == label:
                return tuple(map(int, numbers))
        return None

    def label(self, begin):
        """What begins so, of all that the window says; []: nothing."""
        lines = (self.folder / 'ui').read_text().splitlines()
        found = [line.split(' ', 4)[4] for line in lines if line.split(' ', 4)[4].startswith(begin)]
        return found and found[0]

    def said(self, pattern):
        """All that the window says and that a pattern describes."""
        lines = (self.folder / 'ui').read_text().splitlines()
        return [words for line in lines if re.fullmatch(pattern, words := line.split(' ', 4)[4])]

    def place(self, label, part=0.5):
        """A point in it, so far from its left."""
        left, top, width, height = wait_until(label, lambda: self.control(label), self.words)
        return left + round(part * width), top + height // 2

    def click(self, window, label):
        self.move(window, self.place(label))

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
        wait_until(f'one row, {name}', lambda: self.control(name) and not self.control('Material'))

    def drag_row(self, window, name, *parts):
        """Along the widget of a setting, which is left alone in the panel."""
        self.find_row(window, name)
        self.move(window, *[self.place(name, part) for part in parts])

    def choose_side_b(self, window):
        """Chooses paper from the open list, whose entries come after buttons of the same name."""
        if not self.control('none'):
            self.click(window, 'Compare with')
        wait_until('an open list', lambda: self.control('none'), self.words)
        self.at_rest(window)
        left, top, width, height = self.control('paper', last=True)
        self.move(window, (left + width // 2, top + height // 2))

    def choose(self, window, row, entry):
        """Opens a list, and clicks on an entry when the list is still."""
        if not self.control(entry):
            self.click(window, row)
        try:
            wait_until('an open list', lambda: self.control(entry), patience=PATIENCE / 12)
        except AssertionError:
            return
        self.at_rest(window)
        if self.control(entry):  # an earlier click may have come late, and closed the list
            self.click(window, entry)

    def picture_of(self, pixels, width, left, top, columns, rows):
        """A part of RGB bytes, row by row."""
        return b''.join(pixels[3 * (y * width + left):3 * (y * width + left + columns)]
                        for y in range(top, top + rows))


class Panels(PanelsCase):
    @unsanitized
    def test_settings_change_by_mouse_and_the_command_draws_the_same(self):
        window = self.start_with_panels('--set', 'cracks.count=3')
        self.assertNotIn('exposure', self.command(window))
        first = self.shoot(window, 1)
        for row, change, places in (
                ('tonemap.exposure', 'tonemap.exposure=', (0.5, 0.6, 0.7)),
                ('cracks.debug', 'cracks.debug=on', (0.5,)),
                ('cracks.count', 'cracks.count=', (0.2, 0.7))):
            command = self.wait_for_command(
                window, change, without='cracks.count=3 ' if row == 'cracks.count' else None,
                act=lambda row=row, places=places: self.drag_row(window, row, *places))
        self.assertNotIn('--eye', command)  # nothing of this was for the camera
        command = self.wait_for_command(
            window, '--eye', act=lambda: self.move(window, self.BESIDE, (60, 110), (65, 120)))
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

    def fold(self, window, group, row, shown):
        """Clicks on the heading of a group until a row of it shows, or does not."""
        def is_so():  # while a list is open, nothing else can be used, headings neither
            return self.control(group) and bool(self.control(row)) == shown

        def click():
            self.at_rest(window)  # while a list closes, the row is missing
            if not is_so():
                self.click(window, group)
        wait_until(f'{group}, {row}', is_so, self.words, act=click)

    def test_objects_are_selected_and_changed(self):
        """By a click in the image and by the list; what changes them can be undone."""
        wood = {'name': 'wood', 'pbrMetallicRoughness': {'baseColorFactor': [0.5, 0.2, 0.1, 1]}}
        (self.folder / 'a.gltf').write_text(boxes((wood, [-1.5, 0, 0], 1), (wood, [1.5, 0, 0], 1)))
        window = self.start_with_panels('--eye', '0,0,9', '--target', '0,0,0', '--ground', 'none',
                                        '--set', 'tonemap.exposure=0', '--size', '300x300',
                                        scene='a.gltf', plain=(*PAPER, *SMALL_CUBE))
        wait_until('a selection', lambda: self.label('selected: box 0, wood'), self.words,
                   act=lambda: self.move(window, (110, 150)))
        self.choose(window, 'Kind', 'crystal')
        self.wait_for_command(window, "--material 'box 0=diamond'",
                              act=lambda: self.click(window, 'diamond'))
        self.press(window, 'ctrl+z')
        wait_until('undo', lambda: self.label('undo: box 0=diamond'), self.words)
        self.assertNotIn('--material', self.command(window))
        self.fold(window, 'Material', 'Material preset', False)
        self.fold(window, 'Object', 'box 1', True)
        model = (self.folder / 'a.gltf').rename(self.folder / 'b.gltf')  # is not read again
        self.wait_for_command(window, '--transform', 'box 0=0,', act=lambda: self.move(
            window, *[self.place('Move Y', x) for x in (0.5, 0.6)]))
        self.press(window, 'ctrl+z')
        self.wait_for_command(window, without='--transform')
        self.press(window, 'ctrl+y')
        self.wait_for_command(window, '--transform')
        self.wait_for_command(window, "--hide 'box 1'",
                              act=lambda: self.click(window, 'show box 1'))
        self.press_until(window, 'ctrl+s', 'a session', lambda: self.label('saved /'))
        saved = self.folder / 'data' / 'firn' / 'sessions' / 'session-0001.firn'
        shown = shlex.split(self.command(window))
        self.press(window, 'ctrl+z')
        self.wait_for_command(window, without='--hide')
        model.rename(self.folder / 'a.gltf')
        self.desktop.drop(window, saved)
        self.wait_for_command(window, "--hide 'box 1'")
        again = shlex.split(self.command(window))
        for option in ('--transform', '--hide'):
            self.assertEqual(again[again.index(option) + 1], shown[shown.index(option) + 1])
        self.close(window)

    def test_drawing_stops_and_continues(self):
        """Keys are for the image, also after a click in the panel."""
        window = self.start_with_panels('--samples', '5000')
        self.click(window, 'smooth')
        for words in (', stopped; Esc continues', '.* left.*'):
            pattern = r'\d+×\d+  \d+/5000' + words
            wait_until(pattern, lambda pattern=pattern: self.said(pattern), self.words,
                       act=lambda: self.press(window, 'Escape'))
        wait_until('it stops', lambda: self.said(r'.*stopped; Esc continues'), self.words,
                   act=lambda: self.click(window, self.said(r'\d+×\d+  .*')[0]))
        self.press(window, 'space')
        wait_until('it plays', lambda: self.control('Pause'), self.words)
        self.close(window)

    @long
    def test_the_camera_group(self):
        window = self.start_with_panels('--size', '480x400', plain=PLAIN)
        for group, row, shown in (('Material', 'Material preset', False),
                                  ('Inside', 'cracks.count', False),
                                  ('Camera', 'Field of view', True)):
            self.fold(window, group, row, shown)
        self.wait_for_command(window, '--fov', act=lambda: self.move(
            window, *[self.place('Field of view', x) for x in (0.4, 0.6)]))
        self.wait_for_command(window, without='--fov', act=lambda: self.click(window, 'first'))
        self.wait_for_command(window, '--eye', act=lambda: self.click(window, 'top'))
        pictures = []
        for projection in ('orthographic', 'perspective'):
            self.click(window, projection)
            pictures.append(self.at_rest(window))
        self.assertNotEqual(*pictures)
        self.press(window, 'ctrl+b')
        self.wait_for_command(window, without='--eye', act=lambda: self.click(window, 'first'))
        self.wait_for_command(window, '--eye', act=lambda: self.press(window, 'ctrl+1'))
        self.wait_for_command(window, 'lens.focus', act=lambda: self.focus(window))
        self.close(window)

    def focus(self, window):
        """Opens the aperture, and focuses on what is at the middle of the image."""
        self.move(window, *[self.place('lens.f_stop', x) for x in (0.02, 0.7)])
        self.at_rest(window)
        self.click(window, 'click a point')
        self.at_rest(window)
        self.move(window, (240, 200))

    def test_lists_choose_rungs_and_materials(self):
        second = self.names('rungs')[1]
        material, ior = 'diamond', 'refract.ior=2.417 '
        window = self.start_with_panels(plain=PLAIN)

        def choose_material():
            self.choose(window, 'Kind', 'crystal')
            wait_until('a closed list', lambda: not self.control('crystal'), self.words)
            self.choose(window, 'Material preset', material)
        self.wait_for_command(window, ior, act=choose_material)
        for group, row, shown in (('Material', 'Material preset', False),
                                  ('Inside', 'cracks.count', False),
                                  ('Quality', 'Refraction model', True)):
            self.fold(window, group, row, shown)
        self.wait_for_command(window, f' --refraction {second} ',
                              act=lambda: self.choose(window, 'Refraction model', second))
        self.find(rf'sphere, {second} \| paper, paused', act=lambda: self.choose_side_b(window))
        self.shoot(window, 1, '.png', '-left.exr', '-right.exr')
        self.press_for(window, 'w', 'sphere, paused')
        self.pictures(window, ior)
        self.close(window)

    def pictures(self, window, ior):
        """In a higher panel rungs have one each, of its own, as materials have."""
        self.desktop.do('windowsize', '--sync', window, 305, 340)
        rungs = [name for name in self.names('rungs') if name != 'reference']
        wait_until('buttons of rungs', lambda: all(map(self.control, rungs)), self.words)
        # A line of text has 15 rows of pixels; a button at the edge is cut until it is scrolled.
        wait_until('whole buttons', lambda: self.control('paper')[3] > 25, self.words)

        def each_has_its_own():  # they come one by one
            shown = self.desktop.pixels(window)
            parts = {self.picture_of(shown, 305, left + 4, top + 4, width - 8, 16)  # above its name
                     for left, top, width, _ in map(self.control, rungs)}
            return len(parts) == len(rungs)
        wait_until('a picture of each rung', each_has_its_own, self.words)
        self.wait_for_command(window, ' --refraction wyman ',
                              act=lambda: self.click(window, 'wyman'))
        self.fold(window, 'Quality', 'Refraction model', False)
        self.fold(window, 'Material', 'Material preset', True)
        self.wait_for_command(window, ior, act=lambda: self.click(window, 'diamond'))

    @unsanitized
    def test_files_have_no_panels(self):
        copied = self.xclip()
        window = self.start_with_panels()
        alone = self.shoot(window, 1)
        self.press_until(window, 'ctrl+c', 'a copy', copied.exists)
        self.assertEqual(copied.read_bytes(), alone.read_bytes())
        self.assertEqual(png_size(alone), self.PICTURE)
        self.press_until(window, 'h', 'no panels', lambda: self.desktop.pixels(window) ==
                         png_pixels(self.shoot_next(window)))
        hidden = self.desktop.pixels(window)
        self.press_until(window, 'h', 'panels', lambda: self.desktop.pixels(window) != hidden)
        self.close(window)

    def test_nothing_covers_the_picture(self):
        """Its pixels beside the panels are those of its file; the window has room for them."""
        window = self.start_with_panels()
        shot = self.shoot(window, 1)
        self.assertEqual(png_size(shot), self.PICTURE)
        left, top, width, _ = self.control('search')
        wait_until('the picture beside the panels', lambda: self.picture_of(
            self.desktop.pixels(window), self.WINDOW[0], 0, self.BAR, *self.PICTURE) == png_pixels(
                shot))
        self.assertGreater(left, self.PICTURE[0])
        self.press_until(window, 'Tab', 'a picture as large as the window',
                         lambda: len(self.desktop.pixels(window)) ==
                         len(png_pixels(self.shoot_next(window))))
        self.close(window)

    def test_all_panels_by_key(self):
        window = self.start_with_panels()
        self.press_until(window, 'b', 'the passes', lambda: not self.control('search'))
        self.press_until(window, 'b', 'the settings', lambda: self.control('search'))
        shown = {self.desktop.pixels(window)}
        self.press_until(window, 'b', 'what costs', lambda: self.label('the last '))
        self.assertTrue(self.said(r'[\d.]+ MiB of memory, [\d.]+ without aliasing'))
        for key in ('F1', 'ctrl+t', 'ctrl+plus'):
            self.press_until(window, key, key, lambda: self.desktop.pixels(window) not in shown)
            shown.add(self.desktop.pixels(window))
        self.close(window)

    def keys_fit(self, window):
        """All of both columns of keys, in a window of 700x500, half as large as all else here, and
        lower by what its lines lose to rounding."""
        ends = ('D', 'drop a file')
        self.desktop.do('windowsize', '--sync', window, 350, 230)
        self.press_until(window, 'F1', 'the keys', lambda: all(map(self.control, ends)))
        self.assertLessEqual(max(sum(self.control(name)[1::2]) for name in ends), 230)
        self.press_until(window, 'F1', 'no keys', lambda: not self.control('D'))

    def test_a_cursor_that_rests_where_the_window_opens(self):
        """Its first press is where it is: on the picture, which follows."""
        self.desktop.do('mousemove', 400, 300)  # in the middle, where windows open
        window = self.start_with_panels()
        wait_until('a hint', lambda: self.label('drag: orbit'), self.words)
        self.desktop.do('mousedown', 1, 'mousemove_relative', '--', 9, 5, 'mouseup', 1)
        self.wait_for_command(window, '--eye')
        wait_until('no hint any more', lambda: not self.label('drag: orbit'), self.words)
        self.close(window)

    def time(self, window):
        """Of the scene, seconds, as the command says it."""
        return float(self.command(window).partition('motion.time=')[2].split()[0])

    def test_buttons(self):
        window = self.start_with_panels('--size', '320x380')
        self.find('sphere', act=lambda: self.click(window, 'Play'))
        self.find('sphere, paused', act=lambda: self.click(window, 'Pause'))
        wait_until('another time', lambda: abs(self.time(window) - 4) < 0.3, self.words, again=5,
                   act=lambda: self.move(window, self.place('time', 0.2), self.place('time', 0.4)))
        before = self.time(window) + 1e-3  # a frame on and a frame back are not quite nothing
        for key, later in (('period', True), ('comma', False)):
            self.press_until(window, key, key, lambda later=later:
                             (self.time(window) > before) == later)
        first = self.shoot(window, 1)
        self.wait_for_command(window, '--eye',
                              act=lambda: self.move(window, (250, 100), (260, 110), (270, 105)))
        self.wait_for_command(window, without='--eye', act=lambda: self.press(window, 'r'))
        row = 'bump.strength'  # not as it is by default
        self.wait_for_command(window, without=row, act=lambda: self.click(window, f'reset {row}'))
        self.wait_for_command(window, f'{row}=', act=lambda: self.move(
            window, *[self.place(row, part) for part in (0.3, 0.4, 0.5)]))
        self.wait_for_command(window, 'air.count', without=row,
                              act=lambda: self.click(window, 'reset Material'))
        self.wait_for_command(window, without='air.count',
                              act=lambda: self.click(window, 'Reset all'))
        size = len(self.printed())
        wait_until('a command', lambda: len(self.printed()) > size,
                   act=lambda: self.click(window, 'Copy'))
        second = self.folder / 'firn-0002.png'
        wait_until('a screenshot', second.exists, act=lambda: self.click(window, 'Save'))
        self.assertNotEqual(png_pixels(second), png_pixels(first))  # nothing moves around it
        self.close(window)

    def find_and_choose(self, window, entry):
        """By the palette; where a key was lost, nothing is chosen."""
        self.press_until(window, 'ctrl+k', 'the palette', lambda: self.control('palette'))
        self.desktop.do('key', 'ctrl+a', 'type', entry)
        try:
            wait_until(entry, lambda: self.control(entry) and not self.control('open pool'),
                       patience=PATIENCE / 12)
        except AssertionError:
            self.press(window, 'Escape')
            return
        self.press_until(window, 'Return', 'a choice', lambda: not self.control('palette'))

    @unsanitized
    def test_undo_palette_presets_and_next_scenes(self):
        window = self.start_with_panels()
        self.wait_for_command(window, 'refract.ior=1.5 ',
                              act=lambda: self.find_and_choose(window, 'material glass'))
        self.wait_for_command(window, without='refract.ior',
                              act=lambda: self.press(window, 'ctrl+z'))
        self.wait_for_command(window, 'refract.ior',
                              act=lambda: self.press(window, 'ctrl+shift+z'))
        self.wait_for_command(window, 'highlight.shininess=', act=lambda: self.move(
            window, *[self.place('highlight.shininess', part) for part in (0.5, 0.4, 0.3, 0.2)]))
        self.wait_for_command(window, 'refract.ior', without='highlight.shininess',
                              act=lambda: self.press(window, 'ctrl+z'))  # all of the movement
        presets = self.folder / 'data' / 'firn' / 'presets'
        self.press_until(window, 'ctrl+shift+s', 'a preset', lambda: list(presets.glob('*.txt')))
        self.assertIn('refract.ior=1.5\n', (presets / 'preset-0001.txt').read_text())
        self.wait_for_command(window, without='refract.ior',
                              act=lambda: self.click(window, 'Reset all'))
        self.wait_for_command(window, 'refract.ior=1.5 ', 'bump.strength=0', act=lambda:
                              self.find_and_choose(window, 'preset preset-0001.txt'))
        self.keys_fit(window)
        seen = self.desktop.pixels(window)
        self.press_until(window, 'o', 'another projection',
                         lambda: self.desktop.pixels(window) != seen)
        self.find('room, paused', act=lambda: self.find_and_choose(window, 'open room'))
        scenes = self.names('scenes')
        last = scenes[scenes.index('room') - 1]
        self.press_for(window, 'Prior', f'{last}, paused')
        self.close(window)

    @unsanitized
    def test_what_a_scene_brings_goes_with_it(self):
        """And comes with it: by opening, by undo. What a hand or an option has set stays."""
        cheap = ('bubbles.count=0', 'air.count=0', 'cracks.count=0', 'env_cube.size=64')
        sets = [word for setting in (*cheap, 'ice_caustics.light=none')  # no light: the default
                for word in ('--set', setting)]
        window = self.start_with_panels('--quiet', *sets, scene='ice-cube', plain=PAPER)
        cube = self.command(window)
        self.assertIn('light.count=0 ', cube)
        self.assertIn('--env alps ', cube)
        self.wait_for_command(window, 'exposure=1.4 ', act=lambda: self.press(window, 'e'))
        self.find_row(window, 'tonemap.exposure')
        self.wait_for_command(window, 'exposure=0.9 ',
                              act=lambda: self.click(window, 'reset tonemap.exposure'))
        valley = self.open_other(window, 'valley')
        self.assertEqual(set(re.findall(r'--set (\S+)', valley)),
                         {*cheap, 'motion.count=2', 'tonemap.dither=off',
                          'tonemap.resolve=filtered'})
        self.assertIn(' --quality high ', valley)
        self.assertNotIn('--env ', valley)
        mine = self.wait_for_command(window, 'tonemap.exposure=0.5 ',
                                     act=lambda: self.press(window, 'e'))
        brighter = self.open_other(window, 'ice-cube')
        self.assertEqual(brighter.replace('exposure=0.5', 'exposure=0.9'), cube)
        self.find('valley, paused', act=lambda: self.press(window, 'ctrl+z'))
        self.assertEqual(self.command(window), mine)
        self.press_to_end(window, 'alt+F4')

    @unsanitized
    def test_reset_returns_to_the_metered_exposure(self):
        (self.folder / 'a.obj').write_text('v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n'
                                           'f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n')
        window = self.start_with_panels('--quiet', '--ground', '1,1,1', scene='a.obj', plain=PAPER)
        said = re.search(r'exposure=(\S+) ', self.command(window))
        self.assertNotEqual(float(said[1]), 0)
        self.wait_for_command(window, f'exposure={float(said[1]) + 0.5:.4g} ',
                              act=lambda: self.press(window, 'e'))
        self.find_row(window, 'tonemap.exposure')
        self.wait_for_command(window, said[0],
                              act=lambda: self.click(window, 'reset tonemap.exposure'))
        self.press_to_end(window, 'alt+F4')

    def open_other(self, window, scene):
        """Its command."""
        self.find(f'{scene}, paused', act=lambda: self.find_and_choose(window, f'open {scene}'))
        return self.command(window)

    @long
    def test_files_sizes_and_a_point(self):
        model = self.folder / 'shape.obj'
        model.write_text(TRIANGLES)
        window = self.start_with_panels()
        self.assertTrue(self.desktop.drop(window, model))
        self.find(f'{model}, paused')
        recent = self.folder / 'state' / 'firn' / 'recent'
        self.assertEqual(recent.read_text(), f'{model}\n')
        self.find('sphere, paused', act=lambda: self.find_and_choose(window, 'open sphere'))
        self.find(f'{model}, paused', act=lambda: self.find_and_choose(window, 'recent shape.obj'))
        small = self.folder / 'firn-0001.png'
        wait_until('a small picture', small.exists, self.words, act=lambda: self.find_and_choose(
            window, 'save the image, 64x48'))
        self.assertEqual(png_size(small), (64, 48))
        point = (90, 115)
        command = self.wait_for_command(window, '--target', act=lambda: self.desktop.do(
            'mousemove', '--window', window, *point, 'click', '--repeat', 2, '--delay', 20, 1))
        target = command.partition('--target ')[2].split()[0].split(',')
        self.press_until(window, 'i', 'the panel of values', lambda: self.control('Layer'))

        def look():  # what is in the middle of the picture now
            lines = (self.folder / 'ui').read_text().splitlines()
            found = [line.split()[5:8] for line in lines if line.split()[4:5] == ['position']]
            return found and max(abs(float(a) - float(b)) for a, b in zip(found[0], target)) < 0.02
        wait_until(f'the point {target}', look, self.words, act=lambda: self.desktop.do(
            'mousemove', '--window', window, 90, self.BAR + 85))
        self.press_to_end(window, 'q')

    def test_words_about_what_is_below_the_mouse(self):
        window = self.start_with_panels()
        shown = [self.desktop.pixels(window)]
        for label in ('Play', 'Passes', 'refract.ior'):
            shown.append(self.desktop.pixels(window))
            wait_until(f'words at {label}', lambda: self.desktop.pixels(window) not in shown,
                       act=lambda label=label: self.desktop.do('mousemove', '--window', window,
                                                               *self.place(label)))
        self.close(window)

    def test_keys_move_in_a_panel_until_escape(self):
        window = self.start_with_panels()
        shown = self.at_rest(window)
        self.press_until(window, 'F6', 'a frame around a widget',
                         lambda: self.desktop.pixels(window) != shown)
        self.press(window, 'Left')
        self.press(window, 'Down')
        self.press(window, 'Escape')
        self.assertNotIn('--eye', self.command(window))
        self.wait_for_command(window, '--eye', act=lambda: self.press(window, 'Left'))
        self.press(window, 'Escape')  # ends nothing
        self.press_to_end(window, 'ctrl+q')

    def test_a_larger_window_shows_the_last_picture(self):
        """At once, scaled: no column of it is of one colour."""
        window = self.start_with_panels('--overlay', 'off')
        self.desktop.do('windowsize', window, 350, 250)

        def look():
            pixels = self.desktop.pixels(window)
            return len(pixels) == 350 * 250 * 3 and pixels
        pixels = wait_until('a larger window', look)
        self.assertNotIn(b'\xff\xff\xff' * 100, pixels)
        for number in range(1, 9):
            if png_size(self.shoot_next(window)) == (350, 250):
                break
        self.assertLess(number, 8)
        self.close(window)

    @long
    def test_no_frame_is_empty_in_200_resizes(self):
        """Little is ever white; what was in the window stays until its next frame, which shows
        the last picture, as large as it fits. So few looks, if any, see less of a picture."""
        rng, size, early = random.Random(1), (300, 200), 0
        window = self.start_with_panels('--overlay', 'off', '--size', '300x200')
        self.assertLess(self.share(self.at_rest(window), SURROUND), 0.02)
        drawn = [size]
        for number in range(200):
            size = rng.randrange(120, 700), rng.randrange(90, 560)
            least = min(self.fit(shape, size) for shape in drawn)
            drawn = [size] if number % 4 == 3 else [*drawn, size]
            self.desktop.do('windowsize', '--sync', window, *size)

            def look(size=size, most=0.02 if number % 4 == 3 else 1.02 - least):
                pixels = self.desktop.pixels(window)
                self.assertEqual(len(pixels), 3 * size[0] * size[1])
                # snow is; a window that is enlarged before its frame was, where it is new
                self.assertLess(self.share(pixels, b'\xff\xff\xff'), 0.1, size)
                return self.share(pixels, SURROUND) < most
            early += number % 4 != 3 and not look()
            wait_until(f'a picture of {size}', look, self.words)
        print(f'{early} of 150 first looks came before the next frame')
        self.close(window)

    @staticmethod
    def fit(shape, size):
        """The part of a size that a picture of some shape fills."""
        scale = min(new / old for old, new in zip(shape, size))
        return scale * scale * shape[0] * shape[1] / (size[0] * size[1])

    @staticmethod
    def share(pixels, color):
        """Of pixels that are of a colour, by every seventh."""
        some = range(0, len(pixels) // 3, 7)
        return sum(pixels[3 * i:3 * i + 3] == color for i in some) / len(some)

    def shoot_next(self, window):
        """A file that was not there before."""
        before = {path for path in self.folder.glob('firn-*.png')}

        def look():
            return set(self.folder.glob('firn-*.png')) - before
        return wait_until('a screenshot', look, self.words,
                          act=lambda: self.press(window, 'p')).pop()


if __name__ == '__main__':
    main()
