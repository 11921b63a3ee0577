"""rg_dump_forms.py: tests that text, JSON and page agree for plans made by hand and random ones.

Usage: rg_dump_forms.py PRINT_PLAN [CHROMIUM]   without a browser, pages are not drawn
"""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True  # the source tree stays clean
for place in ('support', 'front'):
    sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / place))
import plan_dumps  # noqa: E402
from browser import Browser  # noqa: E402

SEEDS = range(1, 41)

program, chromium = '', ''  # set by main()


def dump(form, plan):
    return subprocess.run([program, form, str(plan)], check=True, capture_output=True).stdout


class Forms(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        if chromium:
            cls.browser = Browser(chromium, cls.folder / 'profile')
            cls.addClassCleanup(cls.browser.close)

    def draw(self, html, dark=False):
        """Returns the elements of a page as XML, after its script has run."""
        (self.folder / 'plan.html').write_bytes(html)
        self.browser.open(self.folder / 'plan.html', dark=dark)
        document = self.browser.run('new XMLSerializer().serializeToString(document)')
        self.assertEqual(self.browser.complaints(), [])
        self.assertEqual([url for url in self.browser.requests() if not url.startswith('file:')],
                         [])
        return document

    def check_page(self, name):
        text, html = dump('json', name).decode('utf-8'), dump('html', name)
        plan = json.loads(text)
        self.assertEqual(plan_dumps.embedded(html.decode('utf-8')), text)
        if chromium:
            self.assertEqual(plan_dumps.Page(self.draw(html), plan).faults, [])
        return plan

    def check(self, name):
        plan = self.check_page(name)
        self.assertEqual(dump('text', name).decode().splitlines(),
                         list(plan_dumps.text_lines(plan)))
        return plan

    def test_everything(self):
        plan = self.check('everything')
        self.assertTrue(plan['initial_barriers'] and plan['final_barriers'])
        self.assertEqual(len(plan['blocks']), 2)

    def test_random(self):
        passes = 0
        for seed in SEEDS:
            with self.subTest(seed=seed):
                passes += len(self.check(seed)['passes'])
                self.assertNotRegex(dump('text', seed), rb'[/|]0x', 'a flag without a name')
        self.assertGreater(passes, len(SEEDS))

    def test_awkward_names(self):
        """The lines of the text are of no use here: names have line feeds."""
        self.check_page('awkward')

    def test_faults(self):
        plan = self.check_page('faults')
        self.assertEqual([fault['text'] for fault in plan['faults']], [
            '<tech> "&" \ufffd row 7 (pass): image is read before anything writes it;'
            ' write it first',
            'no output is requested; ask for one',
        ])

    def test_panel_and_colours(self):
        """The panel shows what the focused item is; labels contrast with boxes in both modes."""
        if not chromium:
            self.skipTest('no browser')
        for dark in (False, True):
            self.draw(dump('html', 'everything'), dark)
            self.browser.run('document.querySelector("[data-pass]").focus()')
            self.assertRegex(self.browser.run('detail.textContent'), r'^pass 0 draw raster 64x48')
            lightness = self.browser.run(
                'const light = colour => colour.match(/\\d+/g).reduce((a, b) => a + +b, 0) / 765;'
                '[...document.querySelectorAll("b")].map(box => getComputedStyle(box)).map('
                'style => [light(style.backgroundColor), light(style.color)])')
            self.assertEqual(len(lightness), 5)
            for box, text in lightness:
                self.assertGreater(text - box if dark else box - text, 0.4)

    def test_the_same_again(self):
        for form in ('text', 'json', 'html'):
            self.assertEqual(dump(form, 1), dump(form, 1))


def main():
    global program, chromium
    program = sys.argv.pop(1)
    chromium = sys.argv.pop(1) if len(sys.argv) > 1 else ''
    unittest.main()


if __name__ == '__main__':
    main()
