"""test_shell.py: tests the man pages and the completions of shells.

Usage: test_shell.py FIRN FOLDER [TEST...]   FOLDER: that of the build, with man/ and completions/
"""
import pathlib
import re
import subprocess
import sys

sys.dont_write_bytecode = True  # the source tree stays clean
from case import Case, main  # noqa: E402
sys.path.append(str(pathlib.Path(__file__).parents[2] / 'man'))
import settings  # noqa: E402
from help import names  # noqa: E402

FOLDER = pathlib.Path(sys.argv.pop(2)).resolve()
COMMANDS = ('render', 'view', 'profile', 'graph', 'diff', 'ladder', 'sheet', 'farm',
            'merge', 'info', 'selftest', 'list')
HARNESS = '''
source "$1"
shift
COMP_WORDS=("$@")
COMP_CWORD=$(($# - 1))
_firn
printf '%s\\n' "${COMPREPLY[@]}"
'''


class Pages(Case):
    def read(self, name, section=1):
        page = FOLDER / 'man' / f'{name}.{section}'
        done = subprocess.run(['man', '-l', '--warnings=w', page],
                              capture_output=True, text=True, check=True,
                              env={'PATH': '/usr/bin:/bin', 'MANWIDTH': '300', 'LC_ALL': 'C.UTF-8'})
        self.assertEqual(done.stderr, '')
        return done.stdout

    def test_every_option_of_the_help(self):
        for command in COMMANDS:
            page = self.read(f'firn-{command}')
            for option in re.findall(r'(?m)^ .*?(--[\w-]+\S*)',
                                     self.succeed(command, '--help').stdout.decode()):
                self.assertIn(option.split('[')[0], page)
            self.assertRegex(page, rf'(?m)^ +firn-{command} - \w')

    def test_every_setting(self):
        page = self.read('firn-settings', 5)
        for line in self.succeed('list', 'settings').stdout.decode().splitlines()[1:]:
            name, what = line.split(None, 1)
            self.assertIn(name, page)
            self.assertIn(' '.join(what.split()), ' '.join(page.split()))

    def test_the_same_in_the_docs(self):
        """python3 man/settings.py FIRN > docs/reference/settings.md rebuilds it."""
        docs = pathlib.Path(__file__).parents[2] / 'docs/reference/settings.md'
        self.assertEqual(docs.read_text(), settings.page(Case.program))

    def test_each_setting_has_a_strip(self):
        words = (pathlib.Path(__file__).parents[2] / 'docs/strips.txt').read_text().splitlines()
        have = [line.split()[0] for line in words if line and line[0] != '#']
        self.assertEqual(sorted(have), sorted(names(Case.program, 'settings')))

    def test_what_it_is(self):
        page = self.read('firn')
        for word in (*(f'firn-{command}' for command in COMMANDS), 'EXIT STATUS', '75'):
            self.assertIn(word, page)

    def test_no_day(self):
        """The same source gives the same page."""
        for path in (FOLDER / 'man').glob('*.[157]'):
            self.assertIn(f' "{path.suffix[1]}" ""\n', path.read_text())

    def test_lists(self):
        for kind in ('layers', 'materials'):
            page = self.read(f'firn-{kind}', 7)
            for line in self.succeed('list', kind).stdout.decode().splitlines()[1:]:
                self.assertIn(line.split()[0], page)


class Completions(Case):
    def offered(self, *words):
        """After these words; the last one is being typed."""
        done = subprocess.run(['bash', '-c', HARNESS, 'bash', FOLDER / 'completions/firn', 'firn',
                               *words], capture_output=True, text=True, check=True,
                              cwd=self.folder)
        self.assertEqual(done.stderr, '')
        return done.stdout.split()

    def test_commands_and_options(self):
        self.assertEqual(self.offered('re'), ['render'])
        self.assertEqual(set(COMMANDS) - set(self.offered('')), set())
        self.assertEqual(self.offered('render', '--ref'), ['--refraction'])
        self.assertEqual(self.offered('help', 'gr'), ['graph'])
        self.assertNotIn('--frames', self.offered('diff', '--'))

    def test_values(self):
        self.assertEqual(self.offered('render', '--refraction', 'bo'), ['bounce'])
        self.assertEqual(self.offered('render', '-m', 'wa'), ['water'])
        self.assertIn('ice-cube', self.offered('graph', 'i'))
        self.assertEqual(self.offered('list', 'ref'), ['refractions'])
        self.assertEqual(self.offered('render', '--aov', 'N,alb'), ['N,albedo'])
        self.assertEqual(self.offered('render', '--set', 'cracks.cou'), ['cracks.count='])
        self.assertEqual(self.offered('render', '--set', 'refract.lookup', '=', 'd'),
                         ['distance'])
        self.assertEqual(set(self.offered('render', '--set', 'refract.fresnel', '=')),
                         {'paper', 'exact', 'crossfade', 'auto'})

    def test_files(self):
        """Only file types that the option or command reads are completed."""
        for name in ('statue.glb', 'statue.hdr', 'statue.txt'):
            (self.folder / name).touch()
        (self.folder / 'steps').mkdir()
        self.assertEqual(self.offered('render', 'sta'), ['statue.glb'])
        self.assertEqual(self.offered('diff', 'st'), ['steps', 'statue.hdr'])
        self.assertEqual(self.offered('render', '--env', 'st'),
                         ['studio', 'stage', 'steps', 'statue.hdr'])
        self.assertEqual(self.offered('selftest', 'st'), [])
        self.assertEqual(self.offered('render', '--refraction', 'st'), [])

    def test_other_shells(self):
        (self.folder / 'statue.hdr').touch()
        subprocess.run(['zsh', '-n', FOLDER / 'completions/_firn'], check=True)
        fish = FOLDER / 'completions/firn.fish'
        done = subprocess.run(['fish', '-c', f'source "{fish}"; complete -C "firn render --refr"; '
                               'complete -C "firn la"; complete -C "firn render -m wa"; '
                               'complete -C "firn render --aov N,alb"; '
                               'complete -C "firn diff sta"'],
                              capture_output=True, text=True, check=True, cwd=self.folder,
                              env={'HOME': str(self.folder), 'PATH': '/usr/bin:/bin'})
        names = [line.split('\t')[0] for line in done.stdout.splitlines()]
        self.assertEqual(names, ['--refraction', 'ladder', 'water', 'N,albedo', 'statue.hdr'])


if __name__ == '__main__':
    main()
