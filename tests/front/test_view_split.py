"""test_view_split.py: A and B in one window, and what new users want first. Usage: see case.py."""
import json
import shlex
import shutil
import sys

sys.dont_write_bytecode = True  # the source tree stays clean
from case import DATA, PLAIN, USAGE, Case, long, main, unsanitized  # noqa: E402
from desktop import wait_until  # noqa: E402
from gltf_file import boxes, glass  # noqa: E402
from test_view import SIZE, TRIANGLES, WindowCase, png_pixels  # noqa: E402
from test_view_panels import PanelsCase  # noqa: E402

WIDTH, HEIGHT = map(int, SIZE.split('x'))
BRIGHT, DARK = b'\xff\xff\xff', b'\0\0\0'
PAPER = ('--refraction', 'paper')
AHEAD = ('--size', '480x400', '--samples', 1, '--eye', '0,0,9', '--target', '0,0,0')
RIGHT_BOX = (300, 218)  # a point in the image of AHEAD
TITLE = r'sphere, paper \| one-sided'


def columns(pixels, first, last):
    """RGB bytes of these columns, row by row."""
    return [pixels[3 * (y * WIDTH + first):3 * (y * WIDTH + last)] for y in range(HEIGHT)]


class Split(WindowCase):
    def expect(self, pixels, line, left, right):
        """Left of the line one picture, right of it the other."""
        for first, last, want in ((0, line, left), (line + 2, WIDTH, right)):
            self.assertEqual(columns(pixels, first, last), columns(want, first, last))
        self.assertEqual(columns(pixels, line, line + 2), [BRIGHT + DARK] * HEIGHT)

    def pictures(self, *arguments, right='one-sided'):
        """What render draws, left and right."""
        pixels = []
        for rung in ('paper', right):
            self.succeed('render', 'sphere', '--size', SIZE, *arguments, '--refraction', rung,
                         '-o', f'{rung}.png', '-o', f'{rung}.exr')
            pixels.append(png_pixels(self.folder / f'{rung}.png'))
        self.assertNotEqual(*pixels)
        return pixels

    @unsanitized
    def test_files_have_the_pixels_of_render(self):
        for samples in (1, 3):
            words = ('--samples', samples, '--aov', 'N', *PLAIN)
            left, right = self.pictures(*words)
            self.view('sphere', *PAPER, '--validate', '--size', SIZE, *words,
                      '--split', 'one-sided', '--frames', 1, '--screenshot', 'a.png',
                      '--screenshot', 'a.exr')
            self.expect(png_pixels(self.folder / 'a.png'), WIDTH // 2, left, right)
            for side, rung in (('left', 'paper'), ('right', 'one-sided')):
                self.assertEqual((self.folder / f'a-{side}.exr').read_bytes(),
                                 (self.folder / f'{rung}.exr').read_bytes())
            self.assertNotIn('a.exr', self.files())
        self.assertIn(b' split=one-sided ', (self.folder / 'a.png').read_bytes())

    def settle(self, window, line, pictures, act=None):
        wait_until(f'a line in column {line}', lambda: columns(
            self.desktop.pixels(window), line, line + 2) == [BRIGHT + DARK] * HEIGHT, act=act)

        def look():  # a window that was resized shows the last picture, scaled, for a while
            pixels = self.desktop.pixels(window)
            return all(columns(pixels, *part) == columns(want, *part) for *part, want in
                       ((0, line, pictures[0]), (line + 2, WIDTH, pictures[1])))
        wait_until(f'pictures beside column {line}', look)

    def test_hands_move_the_divider(self):
        pictures = self.pictures('--set', 'motion.count=2', *PLAIN)
        window = self.start('sphere', *PAPER, '--split', 'one-sided', '--quality', 'normal',
                            title=f'{TITLE}, paused')
        self.settle(window, 100, pictures)
        self.settle(window, 50, pictures, lambda: self.desktop.do(
            'mousemove', '--window', window, 103, 20, 'mousedown', 1, 'mousemove',
            '--window', window, 60, 90, 'mousemove', '--window', window, 50, 60,
            'mouseup', 1))  # and the camera is where it was
        self.desktop.do('mousemove', '--window', window, 150, 60)  # without it
        for key, line in (('bracketright', 56), ('bracketleft', 50), ('bracketleft', 44)):
            self.settle(window, line, pictures, lambda key=key: self.press(window, key))
        shot = self.shoot(window, 1, '.png', '-left.exr', '-right.exr')
        self.expect(png_pixels(shot), 44, *pictures)
        self.settle(window, 0, pictures, lambda: self.desktop.do(
            'mousemove', '--window', window, 47, 20, 'mousedown', 1,
            'mousemove_relative', '--', -60, 0, 'mouseup', 1))  # beyond the edge
        self.close(window)

    @unsanitized
    def test_the_key(self):
        pictures = self.pictures('--set', 'motion.count=2', *PLAIN, right='trace')
        window = self.start('sphere', *PAPER, '--quality', 'normal')
        wait_until('one picture', lambda: self.desktop.pixels(window) == pictures[0])
        self.press_for(window, 'w', r'sphere, paper \| trace, paused')
        self.settle(window, 100, pictures)
        self.desktop.do('windowsize', '--sync', window, 80, 60)
        self.shoot(window, 1, '.png', '-left.exr', '-right.exr')
        self.desktop.do('windowsize', '--sync', window, WIDTH, HEIGHT)
        self.settle(window, 100, pictures)
        self.press_for(window, 'w', 'sphere, paused')
        wait_until('one picture', lambda: self.desktop.pixels(window) == pictures[0])
        self.shoot(window, 2)  # 1 is taken
        self.close(window)


class Sides(PanelsCase):
    """A and B are anything: a state, the reference, a picture. One window, so that it is cheap."""
    COLUMNS, ROWS = 80, 150  # of a side; below them are the names of both

    def half(self, pixels, width, top, right):
        return self.picture_of(pixels, width, right * (self.PICTURE[0] - self.COLUMNS - 5), top,
                               self.COLUMNS, self.ROWS)

    def expect_sides(self, window, *files, act=None):
        """Each half is that of a file, but for the columns around the divider."""
        want = [self.half(png_pixels(file), self.PICTURE[0], 0, right)
                for right, file in enumerate(files)]
        wait_until('both sides', lambda: [
            self.half(self.desktop.pixels(window), self.WINDOW[0], self.BAR, right)
            for right in (0, 1)] == want, self.words, act=act)

    def render_command(self, command, name, *more):
        words = shlex.split(command)[1:]
        self.succeed(*words[:-1], name, *more)
        return self.folder / name

    @long
    def test_anything_is_compared(self):
        window = self.start_with_panels('--samples', 2)
        first = self.render_command(self.command(window), 'first.png')
        self.press_until(window, 's', 'a stored state', lambda: self.label('stored as B'))
        self.drag_light(window)
        other = self.render_command(self.command(window), 'other.png')
        self.press_for(window, 'w', r'sphere, (.*) \| \1, paused')
        self.expect_sides(window, other, first)
        self.press_until(window, 'd', 'a difference', lambda: self.label('FLIP: mean'))
        self.at_rest(window)
        flip = json.loads(self.succeed('diff', first, other, '--json').stdout)['flip']
        self.assertAlmostEqual(float(self.label('FLIP: mean').split()[2].strip(',')), flip['mean'],
                               delta=2e-3)
        for key, *sides in (('d', other, first), ('t', first, first), ('t', other, first)):
            self.expect_sides(window, *sides, act=lambda key=key: self.press(window, key))
        truth = self.render_command(self.command(window), 'truth.png', '--refraction', 'reference')
        self.press_for(window, 'W', r'sphere, .* \| reference, paused')
        wait_until('all samples', lambda: self.label('B reference 2/2'), self.words)
        self.expect_sides(window, other, truth)
        self.press_for(window, 'ctrl+z', r'sphere, (.*) \| \1, paused')
        sessions = self.folder / 'data' / 'firn' / 'sessions'
        self.press_until(window, 'ctrl+s', 'a session', lambda: list(sessions.glob('*.firn')))
        self.close(window)
        self.sessions(sessions / 'session-0001.firn', other)

    def sessions(self, path, picture):
        """One shows what was there; a wrong one is refused in a line, at the start and by hand."""
        bad = self.folder / 'bad.firn'
        bad.write_text(path.read_text().replace('\nrung=', '\nrung=gone'))
        self.refuse(DATA, 'view', '--session', bad, names=['bad.firn:', 'rung'],
                           env=self.env())
        window = self.start(None, *self.SIZES, '--samples', 2, '--session', path, plain=(),
                            title='sphere, paused')
        self.expect_sides(window, picture, picture)
        self.assertTrue(self.desktop.drop(window, bad))
        wait_until('what is wrong', lambda: self.label('the session was not opened: '), self.words)
        self.expect_sides(window, picture, picture)
        self.press_to_end(window, 'ctrl+q')

    def drag_light(self, window):
        """One movement is one step of undo."""
        def drag(*held):
            for key in held:
                self.desktop.do('keydown', key)
            self.move(window, self.BESIDE, (65, 100), (80, 105))
            for key in held:
                self.desktop.do('keyup', key)
        self.wait_for_command(window, 'sky.sun_elevation=', act=lambda: drag('ctrl', 'shift'))
        self.wait_for_command(window, without='sun_', act=lambda: self.press(window, 'ctrl+z'))
        self.wait_for_command(window, 'sky.sun_azimuth=', without='sun_elevation',
                              act=lambda: drag('ctrl'))
        self.wait_for_command(window, without='sun_azimuth',
                              act=lambda: self.press(window, 'ctrl+z'))
        self.wait_for_command(window, 'sky.sun_azimuth=',
                              act=lambda: self.press(window, 'ctrl+y'))


class FirstMinutes(PanelsCase):
    """What new users want first, each with the acts that it takes, at most: a key, a click, a drag,
    or something dropped is one. An act that a busy machine has lost is done again."""

    def do(self, what, most, acts, done):
        self.assertLessEqual(len(acts), most, what)
        for act in acts[:-1]:
            act()
        self.assertIsNone(self.process.poll(), self.words())
        wait_until(what, done, self.words, act=acts[-1], again=15)

    def names_come_first(self, window):
        """Settings whose help alone has the word come after those that are called so."""
        self.press_until(window, 'ctrl+k', 'the palette', lambda: self.control('palette'))
        named = 'Reflectance model (refract.fresnel)'
        helped = 'Refracted fraction (refract.crossfade)'
        wait_until('names first', lambda: self.control(helped) and self.control(named)[1] <
                   self.control(helped)[1], self.words,
                   act=lambda: self.desktop.do('key', 'ctrl+a', 'type', 'fresn'), again=15)
        self.press_until(window, 'Escape', 'no palette', lambda: not self.control('palette'))

    @long
    def test_what_it_takes(self):
        model = self.folder / 'shape.obj'
        model.write_text(TRIANGLES)
        copied = self.xclip()
        window = self.start_with_panels('--size', '480x400', '--samples', 1, plain=PLAIN)
        picture = wait_until('a picture', lambda: self.at_rest(window))  # nothing has to be done

        def key(name):
            return lambda: self.press(window, name)

        def click(label):
            return lambda: self.click(window, label)

        def drag(*places):
            return lambda: self.move(window, *places)

        def other():
            return self.desktop.pixels(window) != picture

        def light():
            self.desktop.do('keydown', 'ctrl')
            self.move(window, self.BESIDE, (130, 200), (160, 210))
            self.desktop.do('keyup', 'ctrl')
        self.do('turn it', 1, [drag(self.BESIDE, (130, 210), (160, 220))], other)
        self.do('make it glass', 3, [lambda: self.choose(window, 'Kind', 'glass'), click('glass')],
                lambda: self.label('Refractive index '))
        self.do('undo', 1, [key('ctrl+z')], lambda: self.label('undo: Refractive index '))
        self.do('rotate the light', 1, [light], lambda: self.label('Sun azimuth '))
        self.do('brighter', 1, [key('e')], lambda: self.label('Exposure 0 -> 0.5'))
        self.do('fewer bubbles', 1, [drag(*[self.place('bubbles.count', x) for x in (0.1, 0.3)])],
                lambda: self.label('Bubbles '))
        self.do('how wrong, and where', 2, [key('d')], lambda: self.label('FLIP: mean'))
        self.do('compare with the truth', 1, [key('W')], lambda: self.label('B reference'))
        self.press_for(window, 'w', 'sphere, paused')
        self.do('normals', 2, [click('shown layer'), lambda: self.control('N') and self.click(
            window, 'N')], lambda: self.label('N: ') or not self.control('Z'))
        self.do('what is this pixel', 1, [key('i')], lambda: self.control('Layer'))
        self.do('save a picture', 1, [key('F12')], lambda: 'firn-0001.png' in self.files())
        self.do('show a colleague', 1, [key('ctrl+c')], copied.exists)
        self.do('which keys', 1, [key('F1')], lambda: 'Ctrl Shift Z' in self.printed())
        self.press(window, 'F1')
        self.do('find a setting', 2, [key('ctrl+k'), lambda: self.desktop.do(
            'key', 'ctrl+a', 'type', 'shini')],
                lambda: self.control('Highlight sharpness (highlight.shininess)'))
        self.press_until(window, 'Escape', 'no palette', lambda: not self.control('palette'))
        self.names_come_first(window)
        self.press(window, 'slash')  # a line of text has the keys: Ctrl still acts
        self.press_until(window, 'ctrl+s', 'a session', lambda: self.label('saved /'))
        self.press(window, 'Escape')
        around = self.folder / 'around.exr'
        self.render(around.name, '--size', '64x32')
        self.do('other environment', 1, [lambda: self.desktop.drop(window, around)],
                lambda: self.label(f'opened environment {around}'[:40]))
        self.do('open my model', 1, [lambda: self.desktop.drop(window, model)],
                lambda: self.desktop.ask('xdotool', 'search', '--name', 'shape.obj'))
        shutil.copy(model, self.folder / 'shape2.obj')
        self.do('next model', 1, [key('Next')],
                lambda: self.desktop.ask('xdotool', 'search', '--name', 'shape2.obj'))
        self.press_to_end(window, 'ctrl+q')


class OpaqueFile(PanelsCase):
    """The same on a file of opaque objects, one of which is selected first."""
    do = FirstMinutes.do

    @long
    def test_what_it_takes(self):
        wood = {'pbrMetallicRoughness': {'baseColorFactor': [0.5, 0.2, 0.1, 1]}}
        (self.folder / 'a.gltf').write_text(boxes((wood, [-1.5, 0, 0], 1), (wood, [1.5, 0, 0], 1)))
        window = self.start_with_panels(*AHEAD, scene='a.gltf', plain=PLAIN)
        self.do('select', 1, [lambda: self.move(window, RIGHT_BOX)],
                lambda: self.label('selected: box 1'))

        def key(name):
            return lambda: self.press(window, name)

        def light():
            self.desktop.do('keydown', 'ctrl')
            self.move(window, self.BESIDE, (130, 200), (160, 210))
            self.desktop.do('keyup', 'ctrl')
        picture = self.at_rest(window)
        self.do('turn it', 1, [lambda: self.move(window, self.BESIDE, (130, 210), (160, 220))],
                lambda: self.desktop.pixels(window) != picture)
        self.do('make it glass', 2, [lambda: self.choose(window, 'Kind', 'glass'),
                                     lambda: self.click(window, 'glass')],
                lambda: self.label('box 1=glass'))
        self.do('undo', 1, [key('ctrl+z')], lambda: self.label('undo: box 1=glass'))
        self.do('rotate the light', 1, [light],
                lambda: self.label('panorama rotation ') or self.label('Sun azimuth '))
        self.do('brighter', 1, [key('e')], lambda: self.label('Exposure '))
        self.do('what is this pixel', 1, [key('i')], lambda: self.control('Layer'))
        self.do('save a picture', 1, [key('F12')], lambda: 'firn-0001.png' in self.files())
        self.do('which keys', 1, [key('F1')], lambda: 'Ctrl Shift Z' in self.printed())
        self.press(window, 'F1')
        self.press_to_end(window, 'ctrl+q')


class Materials(PanelsCase):
    @long
    def test_an_opaque_model_becomes_glass(self):
        """What --material does, by clicks; undo brings back the materials of the file."""
        model = self.folder / 'stone.gltf'
        model.write_text(boxes(({'pbrMetallicRoughness': {'metallicFactor': 0}}, [0, 0, 0], 1)))
        window = self.start_with_panels('--size', '480x400', scene='stone.gltf', plain=PLAIN)
        self.assertNotIn('--material', self.command(window))

        self.choose(window, 'Kind', 'glass')
        command = self.wait_for_command(window, ' --material glass ',
                                        act=lambda: self.click(window, 'glass'))
        shown = self.shoot(window, 1)
        self.succeed(*shlex.split(command)[1:])
        self.assertEqual(png_pixels(self.folder / 'firn.png'), png_pixels(shown))
        self.wait_for_command(window, without='--material',
                              act=lambda: self.press(window, 'ctrl+z'))
        self.close(window)


    @long
    def test_a_node_of_a_file_that_is_not_read_again(self):
        """The copied command draws the same pixels from the file."""
        model = self.folder / 'pair.gltf'
        model.write_text(boxes((glass(), [-1.5, 0, 0], 1), (glass(), [1.5, 0, 0], 1)))
        window = self.start_with_panels(*AHEAD, scene='pair.gltf', plain=PLAIN)
        wait_until('a selection', lambda: self.label('selected: box 1'), self.words,
                   act=lambda: self.move(window, RIGHT_BOX))
        self.choose(window, 'Kind', 'crystal')
        away = model.rename(self.folder / 'away.gltf')
        command = self.wait_for_command(window, "--material 'box 1=diamond'",
                                        act=lambda: self.click(window, 'diamond'))
        away.rename(model)
        shown = self.shoot(window, 1)
        self.succeed(*shlex.split(command)[1:])
        self.assertEqual(png_pixels(self.folder / 'firn.png'), png_pixels(shown))
        self.close(window)


class Words(Case):
    def test_wrong_ones(self):
        self.refuse(USAGE, 'view', 'sphere', '--split', 'two-sided', names=['two-sided'])
        self.refuse(USAGE, 'view', 'sphere', '--split', 'paper', '--screenshot', '-',
                    names=['--screenshot'])
        self.refuse(USAGE, 'render', 'sphere', '--split', 'paper', names=['--split'])


if __name__ == '__main__':
    main()
