"""test_view_device.py: the window when a call of Vulkan fails. Usage: see test_device.py."""
import sys

sys.dont_write_bytecode = True  # the source tree stays clean
from case import FLAT, PLAIN, long, main  # noqa: E402
from desktop import Desktop  # noqa: E402
from test_device import (  # noqa: E402
    EVERY_OTHER, OLDER, TRY_AGAIN, WINDOW, Fault, LayerCase)

WHOLE = ('view', 'sphere', '-r', 'one-sided', '--size', '64x48', '--time-step', '0.1', '--frames',
         '6', '--screenshot', 'a.png')
VIEW = (*WHOLE, *PLAIN, *FLAT)
ANEW = 'firn: warning: the device was lost: reopening it once'


class Window(LayerCase):
    output = 'a.png'
    without = ('VK_ERROR_DEVICE_LOST',)  # see below

    @classmethod
    def setUpClass(cls):
        cls.desktop = Desktop()
        cls.addClassCleanup(cls.desktop.close)

    def setUp(self):
        super().setUp()
        self.env['DISPLAY'] = self.desktop.env['DISPLAY']

    def test_window(self):
        """An image that is out of date is no failure: the swapchain is made anew."""
        self.sweep(*VIEW, only=WINDOW, sample=True, parts=EVERY_OTHER)

    def lose(self, command, call, words):
        """Every instance loses its device there. What is said beside the layer's words."""
        _, words, code, left = self.run_with((*words, '-q'),
                                             Fault(command, call, 'VK_ERROR_DEVICE_LOST'))
        lines = [line for line in words.splitlines() if not line.startswith('fail_layer: ')]
        return lines, code, left

    @long
    def test_a_device_is_lost_once(self):
        """The window goes on with another, and with the same picture."""
        counts = self.count(*WHOLE, '-q')
        picture = (self.folder / 'a.png').read_bytes()
        for command, call in (('vkQueueSubmit2', counts['vkQueueSubmit2'] - 3),
                              ('vkWaitForFences', counts['vkWaitForFences'] - 5),
                              ('vkAcquireNextImageKHR', 5), ('vkQueuePresentKHR', 5)):
            for words in (WHOLE, (*WHOLE, '--validate', '--overlay', 'on')):
                lines, code, left = self.lose(command, call, words)
                with self.subTest(f'{command} {call} {words}: {lines}'):
                    self.assertEqual(code, 0)
                    self.assertEqual(len(lines), 2)
                    self.assertIn(f'firn: {command}', lines[0])
                    self.assertIn('VK_ERROR_DEVICE_LOST', lines[0])
                    self.assertEqual(lines[1], ANEW)
                    self.assertEqual(list(left), ['a.png'])
                    if words == WHOLE:
                        self.assertEqual(left['a.png'], picture)

    def test_a_device_is_lost_at_the_end(self):
        """While the last frames end, and while the image is saved. The last fence is that of a
        frame before, which has ended, too."""
        counts = self.count(*VIEW, '-q')
        picture = (self.folder / 'a.png').read_bytes()
        for command in ('vkQueueSubmit2', 'vkWaitForFences'):
            for back in range(command == 'vkWaitForFences', 4):
                lines, code, left = self.lose(command, counts[command] - back, VIEW)
                with self.subTest(f'{command} {back}: {lines}'):
                    self.assertEqual(code, 0)
                    self.assertEqual(lines[1:], [ANEW])
                    self.assertEqual(left, {'a.png': picture})
        shown = VIEW[:-len(PLAIN + FLAT) - 2] + PLAIN + FLAT  # no output
        last = self.count(*shown, '-q')['vkWaitForFences']
        for back in range(1, 4):
            lines, code, _ = self.lose('vkWaitForFences', last - back, shown)
            with self.subTest(f'no output, {back}: {lines}'):
                self.assertEqual((code, len(lines)), (TRY_AGAIN, 1))

    def test_a_device_is_lost_again(self):
        """While it loads, at its first frame, and later: the second time is the last."""
        for command, call in (('vkQueueSubmit2', 3), ('vkQueuePresentKHR', 1),
                              ('vkWaitForFences', 1), ('vkCreateSwapchainKHR', 1)):
            lines, code, left = self.lose(command, call, VIEW)
            with self.subTest(f'{command} {call}: {lines}'):
                self.assertEqual(code, TRY_AGAIN)
                self.assertEqual(len(lines), 3)
                self.assertEqual(lines[1], ANEW)
                for line in (lines[0], lines[2]):
                    self.assertIn(f'firn: {command}', line)
                self.assertEqual(left, {'a.png': OLDER})


if __name__ == '__main__':
    main()
