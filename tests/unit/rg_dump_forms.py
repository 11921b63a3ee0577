"""rg_dump_forms.py: tests that text, JSON and page agree for plans made by hand and random ones.

Usage: rg_dump_forms.py PRINT_PLAN
"""
import json
import pathlib
import subprocess
import sys
import unittest

sys.dont_write_bytecode = True  # the source tree stays clean
sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / 'support'))
import plan_dumps  # noqa: E402

SEEDS = range(1, 41)

program = ''  # set by main()


def dump(form, plan):
    return subprocess.run([program, form, str(plan)], check=True, capture_output=True).stdout


class Forms(unittest.TestCase):
    def check_page(self, name):
        plan = json.loads(dump('json', name).decode('utf-8'))
        html = dump('html', name).decode('utf-8')
        self.assertEqual(plan_dumps.Page(html, plan).faults, [])
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

    def test_the_same_again(self):
        for form in ('text', 'dot', 'json', 'html'):
            self.assertEqual(dump(form, 1), dump(form, 1))


def main():
    global program
    program = sys.argv.pop(1)
    unittest.main()


if __name__ == '__main__':
    main()
