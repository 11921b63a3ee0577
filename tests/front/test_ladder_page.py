"""test_ladder_page.py: tests the page of firn ladder in a browser, by keyboard and mouse.

Usage: test_ladder_page.py FIRN CHROMIUM [TEST...]
"""
import pathlib
import sys
import tempfile

sys.dont_write_bytecode = True  # the source tree stays clean
from browser import Browser  # noqa: E402
from case import SMALL_CUBE, Case, main  # noqa: E402

WIDTH, HEIGHT = 240, 180
chromium = sys.argv.pop(2) if len(sys.argv) > 2 else ''


class Page(Case):
    def setUp(self):
        super().setUp()
        self.succeed('ladder', 'sphere', '--plain', *SMALL_CUBE,
                     '--size', f'{WIDTH}x{HEIGHT}', '--runs', 0,
                     '--rungs', 'paper,bounce', '-o', 'page.html')
        profile = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        self.addCleanup(profile.cleanup)
        self.browser = Browser(chromium, pathlib.Path(profile.name))
        self.addCleanup(self.browser.close)
        self.browser.open(self.folder / 'page.html')

    def run_js(self, expression):
        return self.browser.run(expression)

    def shown(self):
        """What is seen on the left and on the right of the divider, and where that is, per cent."""
        share = float(self.run_js('getComputedStyle(ab).getPropertyValue("--at")').rstrip('% '))
        self.run_js('ab.scrollIntoView()')
        seen = self.run_js('[-3, 3].map(d => { const b = ab.getBoundingClientRect();'
                           f'const e = document.elementFromPoint(b.left + {share} / 100 * b.width'
                           ' + d, b.top + 9); return ab.contains(e) ? e.alt : null; })')
        return (*seen, share)

    def test_a_divider(self):
        self.assertEqual(self.shown(), ('bounce', 'reference', 50))
        self.assertRegex(self.run_js('says.textContent'), r'^FLIP 0\.\d{4}, MAE 0\.\d{4}$')
        sizes = self.run_js('[...document.images].map(i => [i.naturalWidth, i.naturalHeight])')
        self.assertEqual(sizes[:3], [[WIDTH, HEIGHT]] * 3)
        first = self.run_js('says.textContent')

        self.browser.press('Tab', 'ArrowUp')
        self.assertEqual(self.shown(), ('paper', 'reference', 50))
        self.assertNotEqual(self.run_js('says.textContent'), first)
        self.browser.press('Tab', 'ArrowLeft')
        self.assertEqual(self.shown(), ('paper', 'reference', 49.5))
        self.browser.press('End')
        self.assertEqual(self.shown(), ('paper', None, 100))
        self.browser.press('Home')
        self.assertEqual(self.shown(), (None, 'reference', 0))

        box = self.run_js('(b => [b.left, b.top, b.width, b.height])(ab.getBoundingClientRect())')
        self.assertEqual(box[2:], [WIDTH, HEIGHT])
        self.run_js('ab.scrollIntoView()')
        left, top = self.run_js('(b => [b.left, b.top])(ab.getBoundingClientRect())')
        self.browser.call('Input.dispatchMouseEvent', type='mouseMoved', x=left + WIDTH * 3 / 4,
                          y=top + HEIGHT / 2)
        self.browser.settle()
        self.assertEqual(self.shown(), ('paper', 'reference', 75))
        self.assertEqual(self.browser.complaints(), [])
        self.assertEqual([url for url in self.browser.requests()
                          if not url.startswith(('data:', 'file:'))], [])


if __name__ == '__main__':
    main()
