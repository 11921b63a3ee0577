"""test_adding_a_technique.py: builds and draws the technique of docs/how-to.

Usage: test_adding_a_technique.py FIRN ROOT BUILD MESON [--without] [TEST...]
    ROOT, BUILD: the source tree and its build folder; --without: it cannot trace
The page's files and its edit of meson.build go into a copy of the tree. The copy is built with the
compiler and the options of BUILD, and begins with the objects of BUILD, of which ninja keeps those
that include nothing new.
"""
import json
import math
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True  # the source tree stays clean
from case import PLAIN, Case, environment, main  # noqa: E402
from exr_file import Exr  # noqa: E402

ROOT, BUILD = (pathlib.Path(sys.argv.pop(2)).resolve() for _ in range(2))
MESON = sys.argv.pop(2)
WITHOUT = '--without' in sys.argv
if WITHOUT:
    sys.argv.remove('--without')
TESTS = [f'tests/unit/test-{name}' for name in ('shaders', 'affects', 'settings')]
OPTIONS = ('debug', 'optimization', 'werror', 'warning_level', 'b_ndebug', 'b_lto', 'reference',
           'shader_debug', 'view')
# What of BUILD is copied, besides what ninja remembers
FOLDERS = ('graph', 'shaders', 'src', 'firn.p', *(f'{name}.p' for name in TESTS))
EYE, DENSITY = (0.5, 1.0, 4.0), 0.2
VIEW = ('sphere', '--size', '48x36', '--eye', ','.join(map(str, EYE)), '--target', '0,0,0',
        '--aov', 'P,Z', '--samples', '1', *PLAIN, '-q')
NOTHING = 1e10  # Z where no surface is seen
ROUNDING = 2 ** -9  # of halves, relative, added up by two blends


def sources():
    """Paths of the source tree; without git, of all but build folders."""
    if shutil.which('git'):
        done = subprocess.run(['git', '-c', 'safe.directory=*', 'ls-files', '-z', '--cached',
                               '--others', '--exclude-standard'], cwd=ROOT, capture_output=True,
                              text=True, check=False)
        if done.returncode == 0 and done.stdout:
            return [name for name in done.stdout.split('\0') if (ROOT / name).is_file()]
    found = []
    for folder, folders, files in os.walk(ROOT):
        folders[:] = [name for name in folders if name not in ('.git', '__pycache__', 'out') and
                      not pathlib.Path(folder, name, 'meson-private').exists()]
        found += [os.path.relpath(pathlib.Path(folder, name), ROOT) for name in files]
    return found


def files_of(page):
    """{path: text} of the code blocks below a line that is nothing but their path."""
    return dict(re.findall(r'^`([\w./]+)`:\n\n```\w+\n(.*?)^```$', page, re.M | re.S))


def edits_of(page):
    """(path, lines, the same with those that are added) of what is shown as a difference."""
    for path, block in re.findall(r'^The edit of `([\w./]+)`[^:]*:\n\n```diff\n(.*?)^```$', page,
                                  re.M | re.S):
        lines = block.splitlines(keepends=True)
        yield (path, ''.join(line[1:] for line in lines if line[0] == ' '),
               ''.join(line[1:] for line in lines))


def must(command, **options):
    """What it prints, of a command that has to succeed."""
    done = subprocess.run(command, check=False, stdin=subprocess.DEVNULL, text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, **options)
    if done.returncode:
        raise AssertionError(f'{command}: {done.returncode}\n{done.stdout[-8000:]}')
    return done.stdout


def compilers():
    """CC and CXX as BUILD calls them."""
    words = {}
    for row in json.loads((BUILD / 'compile_commands.json').read_text(encoding='utf-8')):
        name = 'CXX' if row['file'].endswith('.cpp') else 'CC'
        words.setdefault(name, row['command'].partition(' -')[0])
    return words


def options():
    rows = json.loads((BUILD / 'meson-info' / 'intro-buildoptions.json').read_text('utf-8'))
    for row in rows:
        if row['name'] in OPTIONS:
            yield f'-D{row["name"]}={str(row["value"]).lower()}'


class Technique(Case):
    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory(prefix='firn-technique-')
        cls.addClassCleanup(temporary.cleanup)
        cls.tree = pathlib.Path(temporary.name).resolve()
        cls.build = cls.tree / 'build'
        cls.page = (ROOT / 'docs' / 'how-to' / 'adding-a-technique.md').read_text(encoding='utf-8')
        for name in sources():
            (cls.tree / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / name, cls.tree / name)  # with its time, which ninja looks at
        cls.environment = {**os.environ, **compilers(), 'CCACHE_BASEDIR': str(cls.tree),
                           'CCACHE_NOHASHDIR': '1'}
        cls.edit()
        cls.set_up()
        cls.make('firn', *TESTS)

    @classmethod
    def edit(cls):
        """Does what the page says."""
        for path, text in files_of(cls.page).items():
            (cls.tree / path).write_text(text, encoding='utf-8')
        for path, before, after in edits_of(cls.page):
            text = (cls.tree / path).read_text(encoding='utf-8')
            if text.count(before) != 1:
                raise AssertionError(f'{path} has these lines {text.count(before)} times:\n'
                                     f'{before}')
            (cls.tree / path).write_text(text.replace(before, after), encoding='utf-8')

    @classmethod
    def set_up(cls):
        must([MESON, 'setup', '-Dtests=enabled', *options(), cls.build, cls.tree],
             env=cls.environment)
        for name in ('.ninja_log', '.ninja_deps'):
            if (BUILD / name).exists():
                shutil.copy2(BUILD / name, cls.build / name)
        for path in BUILD.rglob('*'):
            name = path.relative_to(BUILD)
            if path.is_file() and str(name).startswith(FOLDERS):
                target = cls.build / name
                target.parent.mkdir(parents=True, exist_ok=True)
                if not target.exists():  # meson has made it, for this tree
                    shutil.copy2(path, target)

    @classmethod
    def make(cls, *targets):
        return must(['ninja', '-C', cls.build, *targets], env=cls.environment)

    def draw(self, name, *arguments):
        """What the program with fog prints."""
        return must([self.build / 'firn', 'render', *VIEW, *arguments, '-o', self.folder / name],
                    env=environment({}))

    def planes(self, name):
        return Exr((self.folder / name).read_bytes()).read_planes(['R', 'G', 'B', 'Z', 'P.X',
                                                                   'P.Y', 'P.Z'])

    def test_what_the_page_adds(self):
        files = files_of(self.page)
        self.assertEqual(sorted(files), ['shaders/output/fog.frag', 'shaders/output/fog.h',
                                         'src/tech/output/fog.c'])
        self.assertEqual([path for path, _, _ in edits_of(self.page)], ['meson.build'])
        command, = re.findall(r'^    (python3 man/settings.py .*)$', self.page, re.M)
        must(command, shell=True, cwd=self.tree)
        page = self.tree / 'docs' / 'reference' / 'settings.md'
        self.assertIn('`fog.density`', page.read_text('utf-8'))
        must([sys.executable, self.tree / 'tests' / 'style.py', self.tree])

    def test_pixels_are_as_the_formula_says(self):
        self.draw('clear.exr')
        self.draw('fog.exr', '--set', f'fog.density={DENSITY}')
        clear, fog = self.planes('clear.exr'), self.planes('fog.exr')
        radiance = re.search(r'color = vec3\((.*?)\)', self.page)[1].split(', ')
        seen = set()
        for i, along in enumerate(clear['Z']):
            is_sky = along >= NOTHING
            seen.add(is_sky)
            length = math.dist(EYE, [clear[f'P.{axis}'][i] for axis in 'XYZ'])
            share = 1.0 if is_sky else 1.0 - math.exp(-DENSITY * length)
            for channel, color in zip('RGB', map(float, radiance)):
                expected = share * color + (1.0 - share) * clear[channel][i]
                self.assertAlmostEqual(fog[channel][i], expected, delta=ROUNDING * expected,
                                       msg=f'pixel {i}, {channel}')
        self.assertEqual(seen, {True, False})  # both the sky and what is before it

    def test_it_is_off_unless_asked_for(self):
        for scene in ('sphere', 'pool'):
            plans = [must([self.build / 'firn', 'graph', scene, *more], env=environment({}))
                     for more in ((), ('--set', f'fog.density={DENSITY}'))]
            self.assertEqual(['fog.screen' in plan for plan in plans], [False, True], scene)
        self.assertIn('fog.density', must([self.build / 'firn', 'list', 'settings']))

    def test_the_reference_says_that_it_leaves_it_out(self):
        if not WITHOUT:
            words = must([self.build / 'firn', 'render', *VIEW[:-1], '--refraction', 'reference',
                          '--set', f'fog.density={DENSITY}', '-o', self.folder / 'a.exr'],
                         env=environment({}))
            self.assertRegex(words, r'reference.* without .*\bfog\b')

    def test_other_tests_take_it_in(self):
        for test in TESTS:
            must([self.build / test], cwd=self.build)

    def test_a_wrong_binding_is_found(self):
        shader = self.tree / 'shaders' / 'output' / 'fog.frag'
        text = shader.read_text(encoding='utf-8')
        wrong = text.replace('binding = FOG_POSITION', 'binding = 7')
        self.assertNotEqual(text, wrong)
        self.addCleanup(self.make, *TESTS[:1])
        self.addCleanup(shader.write_text, text, encoding='utf-8')
        shader.write_text(wrong, encoding='utf-8')
        self.make(*TESTS[:1])
        with self.assertRaisesRegex(AssertionError,
                                    "fog.screen.*binding 7 of 'fog_frag' is not in the row"):
            must([self.build / TESTS[0]], cwd=self.build)


if __name__ == '__main__':
    main()
