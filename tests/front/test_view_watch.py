"""test_view_watch.py: tests shaders that are reloaded while a window uses them.

Usage: see case.py.
"""
import os
import pathlib
import shutil
import sys
import time

sys.dont_write_bytecode = True  # the source tree stays clean
from case import CRACKED, NO_INPUT, Case, long, main  # noqa: E402
from desktop import wait_until  # noqa: E402
from test_view import WindowCase, png_pixels  # noqa: E402

SHADERS = pathlib.Path(__file__).parents[2] / 'shaders'
LAST = 'encoded = vec4(tonemap_encode(c, params), 1.0);'
# Nothing moves, so that all frames before and after a change are alike, whichever is captured.
STILL = ('--set', 'motion.ice=0', '--set', 'motion.lights=0')


class WatchCase(WindowCase):
    WORDS = ()

    def setUp(self):
        super().setUp()
        self.shaders = self.folder / 'my shaders'
        shutil.copytree(SHADERS, self.shaders)
        self.window = self.start('sphere', f'--watch={self.shaders}', *STILL, *self.WORDS,
                                 plain=CRACKED)
        self.first = self.settled(self.window)

    def settled(self, window):
        """What it shows twice in turn; it looks at files all the time, so it is never idle."""
        seen = [None]

        def twice():
            time.sleep(0.3)  # longer than from a draft to the first sample
            seen.append(self.desktop.pixels(window))
            return seen[-1] == seen[-2]
        wait_until('the same picture twice', twice, self.words)
        return seen[-1]

    def save(self, name, before, after):
        """As some editors do it: another file takes its place."""
        path = self.shaders / name
        text = path.read_text()
        self.assertIn(before, text)
        other = path.with_name('.saved')
        other.write_text(text.replace(before, after))
        os.replace(other, path)

    def expect(self, pixels):
        wait_until('these pixels', lambda: self.desktop.pixels(self.window) == pixels)

    def expect_words(self, *words, times=1):
        """In so many lines."""
        wait_until(words, lambda: times <= sum(all(word in line for word in words)
                                               for line in self.words().splitlines()), self.words)

    def quit(self):
        self.press_to_end(self.window, 'q')


class Watch(WatchCase):
    def test_a_saved_shader_is_shown(self):
        inverted = bytes(255 - value for value in self.first)
        turned = LAST.replace('tonemap_encode', '1.0 - tonemap_encode')
        self.save('output/tonemap.frag', LAST, turned)
        self.expect(inverted)
        self.expect_words('my shaders/output/tonemap.frag: compiled')
        shot = self.shoot(self.window, 1)
        self.assertEqual(png_pixels(shot), inverted)  # in files, too
        self.save('output/tonemap.frag', turned, turned.replace('_encode', '_encdoe'))
        self.expect_words('firn: ', 'tonemap.frag:', "'tonemap_encdoe'", 'previous shaders stay')
        self.assertEqual(self.desktop.pixels(self.window), inverted)
        self.save('output/tonemap.frag', turned.replace('_encode', '_encdoe'), LAST)
        self.expect(self.first)
        self.quit()

    @long
    def test_an_included_file(self):
        """Shaders that include it change together, or not at all."""
        path = 'inclusions/cracks.vert'  # of two shaders
        text = (self.shaders / path).read_text()
        self.save(path, text, '#error not yet\n' + text)
        self.expect_words('firn: ', 'not yet', 'previous shaders stay')
        self.save('output/present.frag', 'shown = vec4(', 'shown = 1.0 - vec4(')
        self.expect_words('firn: ', 'not yet', 'previous shaders stay', times=2)
        self.assertEqual(self.desktop.pixels(self.window), self.first)
        self.save(path, '#error not yet\n', '')
        self.expect(bytes(255 - value for value in self.first))
        self.expect_words('my shaders: 4 shaders compiled')  # of present.frag are two, too
        self.quit()

    @long
    def test_a_file_of_several_shaders(self):
        """Each is compiled with flags of its own."""
        name = 'refract/refract_paper.frag'
        text = (self.shaders / name).read_text()
        fault = text + '#if defined REFRACT_BUMP && !defined REFRACT_LAYERS\n#error bumps\n#endif\n'
        self.save(name, text, fault)
        self.expect_words('firn: ', name, 'bumps', 'previous shaders stay')
        self.save(name, fault, text)
        self.expect_words('my shaders: 6 shaders compiled')
        self.expect(self.first)  # not at once: what has changed is first drawn as movements are
        self.quit()

    def test_a_binding_that_no_pass_gives(self):
        self.save('output/tonemap.frag', 'void main()',
                  'layout(set = 0, binding = 9) uniform sampler2D more;\nvoid main()')
        self.save('output/tonemap.frag', 'gl_FragCoord.xy), 0).rgb',
                  'gl_FragCoord.xy), 0).rgb * texelFetch(more, ivec2(0), 0).rgb')
        self.expect_words('firn: ', 'tonemap.frag', 'binding 9')
        self.assertEqual(self.desktop.pixels(self.window), self.first)
        self.quit()

    def test_a_file_that_is_gone(self):
        (self.shaders / 'output' / 'tonemap.frag').unlink()
        self.expect_words('firn: ', 'tonemap.frag', 'deleted')
        shutil.copy(SHADERS / 'output' / 'tonemap.frag', self.shaders / 'output')
        self.expect_words('tonemap.frag: compiled')
        self.expect(self.first)
        self.quit()


class WatchWithPanels(WatchCase):
    WORDS = ('--overlay', 'on')
    RED = b'\xff\x8a\x80'  # of what is wrong, in the dark theme

    def is_red(self):
        pixels = self.desktop.pixels(self.window)
        return self.RED in (pixels[i:i + 3] for i in range(0, len(pixels), 3))

    def test_the_fault_is_in_the_panel(self):
        self.assertFalse(self.is_red())
        self.save('output/tonemap.frag', LAST, '#error not yet\n' + LAST)
        wait_until('the fault in red', self.is_red)
        self.save('output/tonemap.frag', '#error not yet\n', '')
        wait_until('no fault', lambda: not self.is_red())
        self.quit()


class Start(Case):
    def test_no_shaders_there(self):
        self.refuse(NO_INPUT, 'view', 'sphere', '--watch', names=['shaders/', '--watch=FOLDER'])
        self.refuse(NO_INPUT, 'view', 'sphere', '--watch=gone', names=['gone'])

    def test_no_compiler(self):
        self.refuse(1, 'view', 'sphere', f'--watch={SHADERS}', env={'PATH': str(self.folder)},
                    names=['glslc'])


if __name__ == '__main__':
    main()
