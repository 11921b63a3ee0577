"""test_view_at_rest.py: the window's image converges while nothing moves.

Usage: see case.py.
"""
import itertools
import re
import shlex
import sys

sys.dont_write_bytecode = True  # the source tree stays clean
from case import SMALL_CUBE, long, main, unsanitized  # noqa: E402
from desktop import wait_until  # noqa: E402
from exr_file import Exr  # noqa: E402
from test_view import png_pixels  # noqa: E402
from test_view_panels import PanelsCase  # noqa: E402


class Still(PanelsCase):
    STRIP = 15  # of time: rows that high windows have, too

    def setUp(self):
        super().setUp()
        self.samples = 3
        self.drawn = {}  # pixels by command
        self.beside = self.WINDOW[1] - self.PICTURE[1]  # rows above and below the picture

    def picture(self, window, size):
        """What the window shows of it, unless the window has another size."""
        pixels = self.desktop.pixels(window)
        width = len(pixels) // 3 // (size[1] + self.beside)
        return self.picture_of(pixels, width, 0, self.BAR, *size)

    def expect(self, window, *words, size=PanelsCase.PICTURE):
        """The pixels of the command that the window copies, which has these words."""
        command = self.wait_for_command(
            window, f'--size {size[0]}x{size[1]} --samples {self.samples}', *words)
        if command not in self.drawn:
            self.succeed(*shlex.split(command)[1:])
            self.drawn[command] = png_pixels(self.folder / 'firn.png')
        want = self.drawn[command]
        self.desktop.do('mousemove', '--window', window, *self.BESIDE)  # no tip over the picture
        wait_until('the pixels of firn render', lambda: self.picture(window, size) == want,
                   self.words)
        return want

    def labels(self):
        lines = (self.folder / 'ui').read_text().splitlines()
        return [line.split(' ', 4)[4] for line in lines]

    def value(self, name):
        """Numbers and words that the panel of values has after a name."""
        found = [line.split()[1:] for line in self.labels() if line.split()[:1] == [name]]
        return found[0] if found else []

    def pin(self, window, x, y):
        """A click keeps the values of a pixel, until another one, elsewhere: else it is double."""
        def click(x, y):
            return 'mousemove', '--window', window, x, y + self.BAR, 'click', 1
        wait_until('a pinned pixel', lambda: self.value('pixel') == [str(x), str(y), 'pinned'],
                   self.words, act=lambda: self.desktop.do(*click(x, y)))
        self.desktop.do('mousemove', '--window', window, 3, 3 + self.BAR)
        self.at_rest(window)
        self.assertEqual(self.value('pixel'), [str(x), str(y), 'pinned'])
        wait_until('a pixel that is let go', lambda: self.value('pixel') == ['30', '40'],
                   self.words, act=lambda: self.desktop.do(*click(30, 40)))

    @unsanitized
    def test_layers_and_values(self):
        window = self.start_with_panels('--samples', 3, scene='valley')
        words = shlex.split(self.wait_for_command(window, '--samples 3'))[1:-2]
        self.succeed(*words, '-o', 'a.exr', '--aov', 'Z,N,P,object', '-o', 'a.png')
        self.succeed(*words, '-o', 'z.png', '--show', 'Z')
        x, y = 75, 80
        self.press_until(window, 'i', 'the panel of values', lambda: self.control('Layer'))

        def over(at, *name):
            wait_until(f'values of {at}', lambda: self.value('pixel') == [str(at[0]), str(at[1])]
                       and (not name or self.value(*name)), self.words, again=5,
                       act=lambda: self.desktop.do('mousemove', '--window', window, at[0],
                                                   at[1] + self.BAR))
        over((x, y), 'position')
        self.at_rest(window)
        names = [*'RGBZ', *(f'{layer}.{axis}' for layer in 'NP' for axis in 'XYZ')]
        planes = Exr((self.folder / 'a.exr').read_bytes()).read_planes(names)
        at = y * self.PICTURE[0] + x
        for name, channels in (('linear', 'RGB'), ('position', ('P.X', 'P.Y', 'P.Z')),
                               ('normal', ('N.X', 'N.Y', 'N.Z')), ('distance', 'Z')):
            for word, channel in zip(self.value(name), channels):
                self.assertAlmostEqual(float(word), planes[channel][at],
                                       delta=2e-3 * max(1, abs(planes[channel][at])))
        self.assertEqual(self.value('object')[:1], ['1'])
        self.assertEqual(self.value('material'), ['ice'])
        pixels = png_pixels(self.folder / 'a.png')
        self.assertEqual(list(map(int, self.value('8')[1:])), list(pixels[at * 3:at * 3 + 3]))
        self.pin(window, x, y)
        over((3, 3))
        self.assertIn('no surface', self.labels())
        for key, want in (('l', 'z.png'), ('L', 'a.png')):
            want = png_pixels(self.folder / want)
            wait_until(f'what {key} shows', lambda want=want:
                       self.picture(window, self.PICTURE) == want, self.words,
                       act=lambda key=key: self.press(window, key))
        self.channel(window, pixels)
        self.press_until(window, 'z', 'false colours',
                         lambda: self.picture(window, self.PICTURE) != pixels)
        wait_until('a legend', lambda: 'mean of R, G, B' in self.labels(), self.words)
        wait_until('the picture', lambda: self.picture(window, self.PICTURE) == pixels, self.words,
                   act=lambda: self.click(window, 'Reset'))
        self.close(window)

    def channel(self, window, pixels):
        """One alone is grey; there is a histogram of the picture, in stops."""
        wait_until('a histogram', lambda: 'stops relative to 1, number of pixels' in self.labels(),
                   self.words)

        def look():
            shown = self.picture(window, self.PICTURE)
            return shown[0::3] == shown[1::3] == shown[2::3]
        wait_until('one channel, in grey', look, self.words,
                   act=lambda: self.choose(window, 'Channel', 'R'))
        wait_until('the picture', lambda: self.picture(window, self.PICTURE) == pixels, self.words,
                   act=lambda: self.click(window, 'Reset'))

    def drag_until(self, window, start, what, happens):
        """Of each size of a movement that the line below the picture shows. All there were."""
        sizes = set()
        step = itertools.cycle((8, -8))

        def look():
            found = [re.fullmatch(r'(\d+×\d+)  [\d.]+ ms.*', label) for label in self.labels()]
            sizes.update(match[1] for match in found if match)
            return any(map(happens, sizes))
        self.desktop.do('mousemove', '--window', window, *start, 'mousedown', 1)
        wait_until(what, look, self.words, again=0, act=lambda: self.desktop.do(
            'mousemove_relative', '--', next(step), 0))
        self.desktop.do('mouseup', 1)
        return sizes

    @unsanitized
    def test_samples_are_those_of_render(self):
        """At first, and whatever happened in between; then nothing is drawn any more."""
        self.check_samples()

    @long
    def test_64_samples_are_those_of_render(self):
        """What the window draws by default."""
        self.samples = 64
        self.check_samples()

    def check_samples(self):
        window = self.start_with_panels('--samples', self.samples, scene='valley')
        first = self.expect(window)
        self.desktop.do('mousemove', '--window', window, *self.place('refract.ior'))
        self.desktop.do('mousemove', '--window', window, *self.BESIDE)
        self.at_rest(window)
        self.assertEqual(self.picture(window, self.PICTURE), first)
        self.wait_for_command(window, '--eye',
                              act=lambda: self.move(window, self.BESIDE, (60, 105), (65, 110)))
        turned = self.expect(window, '--eye')
        self.assertNotEqual(turned, first)
        self.wait_for_command(window, 'tonemap.exposure=', act=lambda: self.drag_row(
            window, 'tonemap.exposure', 0.5, 0.55, 0.6))
        brighter = self.expect(window, 'tonemap.exposure=')
        self.assertNotEqual(turned, brighter)
        self.wait_for_command(window, without='exposure', act=lambda: self.press(window, 'ctrl+z'))
        self.assertEqual(self.expect(window), turned)
        self.wait_for_command(window, 'exposure=', act=lambda: self.press(window, 'ctrl+y'))
        self.assertEqual(self.expect(window), brighter)
        self.press_for(window, 'w', r'valley, .* \| .*, paused')
        self.press_for(window, 'w', 'valley, paused')
        self.assertEqual(self.expect(window), brighter)
        self.desktop.do('windowsize', '--sync', window, 320, 150)
        self.expect(window, size=(195, 119))
        self.close(window)

    @long
    def test_movements_that_take_long(self):
        """They are smaller, unless a key says otherwise, and then leave no trace. Where the ice
        leaves the picture, other renderers are made, whose maps reach beyond it."""
        size = (600, 500)
        self.beside += self.STRIP
        window = self.start_with_panels('--samples', 3, '--size', '600x500', scene='valley',
                                        plain=('--plain', '-r', 'bounce', *SMALL_CUBE))
        self.press_until(window, 'm', 'what it does', lambda: self.label('full size and quality'))
        self.assertEqual(self.drag_until(window, (65, 105), 'full size', bool), {'600×500'})
        self.press_until(window, 'm', 'what it does', lambda: self.label('fast drafts'))
        self.drag_until(window, self.BESIDE, 'a smaller picture', lambda size: size != '600×500')
        for _ in range(7):
            self.desktop.do('mousemove', '--window', window, *self.BESIDE, 'click', 4)
        self.expect(window, '--eye', size=size)
        self.close(window)


if __name__ == '__main__':
    main()
