"""test_view_split.py: two rungs in one window. Usage: see case.py."""
import sys

sys.dont_write_bytecode = True  # the source tree stays clean
from case import PLAIN, USAGE, Case, main  # noqa: E402
from desktop import wait_until  # noqa: E402
from test_view import SIZE, WindowCase, png_pixels  # noqa: E402

WIDTH, HEIGHT = map(int, SIZE.split('x'))
BRIGHT, DARK = b'\xff\xff\xff', b'\0\0\0'
PAPER = ('--refraction', 'paper')
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

    def test_files_have_the_pixels_of_render(self):
        for words in (('--samples', 1, '--aov', 'N'), ('--samples', 3, '--aov', 'N', *PLAIN)):
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
        window = self.start('sphere', *PAPER, '--split', 'one-sided', title=f'{TITLE}, paused')
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

    def test_the_key(self):
        pictures = self.pictures('--set', 'motion.count=2', *PLAIN, right='trace')
        window = self.start('sphere', *PAPER)
        wait_until('one picture', lambda: self.desktop.pixels(window) == pictures[0])
        self.press_for(window, 's', r'sphere, paper \| trace, paused')
        self.settle(window, 100, pictures)
        self.desktop.do('windowsize', '--sync', window, 80, 60)
        self.shoot(window, 1, '.png', '-left.exr', '-right.exr')
        self.desktop.do('windowsize', '--sync', window, WIDTH, HEIGHT)
        self.settle(window, 100, pictures)
        self.press_for(window, 's', 'sphere, paused')
        wait_until('one picture', lambda: self.desktop.pixels(window) == pictures[0])
        self.shoot(window, 2)  # 1 is taken
        self.close(window)


class Words(Case):
    def test_wrong_ones(self):
        self.refuse(USAGE, 'view', 'sphere', '--split', 'two-sided', names=['two-sided'])
        self.refuse(USAGE, 'view', 'sphere', '--split', 'paper', '--screenshot', '-',
                    names=['--screenshot'])
        self.refuse(USAGE, 'render', 'sphere', '--split', 'paper', names=['--split'])


if __name__ == '__main__':
    main()
