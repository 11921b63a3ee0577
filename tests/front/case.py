"""case.py: base class, runner and cheap render options for all tests of the program `firn`.

Usage: TEST.py FIRN [TEST...]   FIRN: the program; TEST: as unittest names them
Every run has its own folder and a minimal environment. If lavapipe is installed, it is the device,
so that results are the same everywhere.
"""
import glob
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

USAGE, DATA, NO_INPUT, NO_DEVICE, CANT_CREATE, WRITE, TRY_AGAIN = 2, 65, 66, 69, 73, 74, 75
# Cheaper renders for tests: without inclusions (--plain), which take half of a small image's time.
SMALL_CUBE = ('--set', 'env_cube.size=64')  # the default cube map would take most of the time
PAPER = ('--refraction', 'paper')  # takes half the time of the default refraction model
PLAIN = ('--plain', *PAPER, *SMALL_CUBE)
# Options that set the quality of `firn render`; without them, tests render one sample per pixel.
QUALITIES = {'--quality', '--samples', '-n', '--preset', '--noise', '--time'}
SMALL = ('--size', '64x48', *PLAIN)
# Constant background instead of sky and landscape, which take a quarter of the remaining time.
FLAT = ('--background', '0.4,0.5,0.6')
BARE = (*SMALL, *FLAT)
# The cheaper inclusions: cracks and bubbles, without air planes and bumps.
CRACKED = ('--set', 'air.count=0', '--set', 'bump.strength=0', *PAPER, *SMALL_CUBE)
SANITIZED = os.environ.get('FAIL_SAMPLE') == '1'  # built with sanitizers
NO_DRIVER = {'VK_DRIVER_FILES': '/nonexistent.json'}


def environment(extra):
    """Returns a minimal environment: PATH, test device, sanitizer options; no HOME or DISPLAY."""
    env = {'PATH': os.environ.get('PATH', '/usr/bin:/bin')}
    env.update({name: value for name, value in os.environ.items() if name.endswith('SAN_OPTIONS')})
    drivers = [file for folder in ('/usr/share', '/usr/local/share', '/etc')
               for file in glob.glob(f'{folder}/vulkan/icd.d/lvp_icd*.json')]
    if drivers:
        env['VK_DRIVER_FILES'] = drivers[0]
    return {**env, **extra}


def command(*arguments):
    """Returns the command line of firn; adds --samples 1 if no option sets the quality."""
    words = [str(word) for word in arguments]
    at = 1 if words[:1] == ['render'] else 2 if words[:2] == ['farm', 'status'] else 0
    if at and not QUALITIES & set(words):
        words[at:at] = '--samples', '1'
    return [Case.program, *words]


class Case(unittest.TestCase):
    program = ''  # set by main()

    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix='firn ')  # the space tests quoting
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)

    def firn(self, *arguments, env=(), cwd=None, stdout=subprocess.PIPE):
        return subprocess.run(command(*arguments), env=environment(dict(env)),
                              cwd=cwd or self.folder, stdin=subprocess.DEVNULL, stdout=stdout,
                              stderr=subprocess.PIPE, timeout=240, check=False)

    def succeed(self, *arguments, **how):
        done = self.firn(*arguments, **how)
        self.assertEqual(done.returncode, 0, f'{arguments}: {done.stderr.decode()}')
        return done

    def render(self, output, *arguments, **how):
        """Renders a small image, and returns the content of the output file."""
        self.succeed('render', 'sphere', *SMALL, '-o', output, *arguments, **how)
        return (self.folder / output).read_bytes()

    def refuse(self, code, *arguments, names=(), **how):
        """Checks that firn fails with exit code `code` and one line on stderr with `names`."""
        with self.subTest(arguments=arguments):
            done = self.firn(*arguments, **how)
            words = done.stderr.decode()
            self.assertEqual(done.returncode, code, words)
            self.assertFalse(done.stdout)
            self.assertEqual(len(words.splitlines()), 1, words)
            self.assertTrue(words.startswith('firn: ') and words.endswith('\n'), words)
            for name in names:
                self.assertIn(name, words)

    def files(self):
        return sorted(path.name for path in self.folder.iterdir())


def long(test):
    """Decorator of a long test, which runs only with `--long` or by its name."""
    test.is_long = True
    return test


def unsanitized(test):
    """
    Decorator of a test that sanitizer builds skip, because it compares pixels or tests third-party
    code, and cheaper tests already cover the same code.
    """
    test.is_unsanitized = True
    return test


def is_marked(test, name):
    return getattr(getattr(test, test.id().split('.')[-1], None), name, False)


class Part(unittest.TestLoader):
    """Loads one shard of the tests: every N-th from the K-th on, of either long or normal tests."""
    def __init__(self, number, count, is_long):
        super().__init__()
        self.number, self.count, self.is_long = number, count, is_long

    def loadTestsFromModule(self, module, *args, **kwargs):
        tests = [test for case in super().loadTestsFromModule(module, *args, **kwargs)
                 for test in case
                 if is_marked(test, 'is_long') == self.is_long and
                 not (SANITIZED and is_marked(test, 'is_unsanitized'))]
        return self.suiteClass(tests[self.number - 1::self.count])


def main():
    """
    Runs the tests of the program given as first argument. "--part=K/N" after it selects shard K of
    N, and a following "--long" the tests marked @long.
    """
    if len(sys.argv) < 2 or not os.access(sys.argv[1], os.X_OK):
        sys.exit(f'{sys.argv[0]}: no program to test: {sys.argv[1:2] or "(none given)"}')
    Case.program = os.path.abspath(sys.argv.pop(1))
    part = 1, 1
    if sys.argv[1:] and sys.argv[1].startswith('--part='):
        part = map(int, sys.argv.pop(1).removeprefix('--part=').split('/'))
    is_long = sys.argv[1:2] == ['--long']
    if is_long:
        sys.argv.pop(1)
    unittest.main(testLoader=Part(*part, is_long))
