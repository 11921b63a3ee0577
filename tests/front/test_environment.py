"""test_environment.py: tests firn in unusual environments: users, locales, masks, closed files.

Usage: see case.py.
"""
import json
import os
import pathlib
import shutil
import signal
import stat
import subprocess
import sys

sys.dont_write_bytecode = True  # the source tree stays clean
from case import (BARE, CANT_CREATE, NO_DEVICE, PLAIN, WRITE, Case, command,  # noqa: E402
                  environment, long, main)

TENT = 'v 0 1 0\nv -1 -1 1\nv 1 -1 1\nv 0 -1 -1\nf 1 2 3\nf 1 3 4\nf 1 4 2\nf 2 4 3\n'
NOBODY = 65534
MEASURED = ('sphere', *BARE, '--runs', '2', '--warmup', '1', '--clock', 'submits',
            '-q')
PRINTING = (
    ('list',), ('list', 'devices'), ('--help',), ('help', 'render'), ('ladder', '--help'),
    ('--version',), ('graph', 'valley'), ('graph', 'sphere', '--json'),
    ('graph', 'sphere', '--html'), ('diff', 'a.exr', 'a.exr'),
    ('profile', *MEASURED), ('profile', *MEASURED, '--json', '-'),
    ('profile', *MEASURED, '--sweep', 'size=32x24,16x16'), ('render', 'sphere', *BARE, '-o', '-'),
)


class Environment(Case):
    def setUp(self):
        super().setUp()
        (self.folder / 'tent.obj').write_text(TENT)

    def shell(self, how, *arguments, env=(), before=''):
        """firn from a shell, which `how` tells what to do with its files."""
        words = command(*arguments)
        return subprocess.run(['sh', '-c', f'{before} exec "$@" {how}', 'sh', *words],
                              env=environment(dict(env)), cwd=self.folder, capture_output=True,
                              timeout=240, check=False)

    def draw(self, output, *more, env=()):
        self.succeed('render', 'tent.obj', *BARE, '-q', '-o', output, *more, env=env)
        return (self.folder / output).read_bytes()

    # ---- files that are closed ----

    def test_what_is_printed_is_printed_or_74(self):
        self.render('a.exr')
        for i, arguments in enumerate(PRINTING):
            how = ('>&-', '>/dev/full')[i % 2]
            done = self.shell(how, *arguments)
            with self.subTest(f'{arguments} {how}'):
                self.assertEqual(done.returncode, WRITE)
                self.assertRegex(done.stderr.decode(), r'\Afirn: sta?n?d?.*out.*written.*\n\Z')

    def test_a_pipe_that_nobody_reads(self):
        """Files were wanted and are not there; words for people end as other programs' do."""
        self.render('a.exr')
        for arguments in PRINTING:
            read, write = os.pipe()
            os.close(read)
            done = self.firn(*arguments, stdout=write)
            os.close(write)
            with self.subTest(arguments):
                if '-' not in arguments:
                    self.assertEqual((done.returncode, done.stderr), (-signal.SIGPIPE, b''))
                    continue
                self.assertEqual(done.returncode, WRITE)
                self.assertRegex(done.stderr.decode(), r'\Afirn: sta?n?d?.*out.*written.*\n\Z')

    def test_closed_files(self):
        """Nor does anything that is opened later get their numbers: see the pictures."""
        wanted = self.draw('a.exr', '-o', 'a.png')
        png = (self.folder / 'a.png').read_bytes()
        for how in ('<&-', '>&-', '2>&-', '<&- >&-', '<&- >&- 2>&-'):
            done = self.shell(how, 'render', 'tent.obj', *BARE, '-o', 'b.exr', '-o', 'b.png',
                              '--aov', 'N')
            with self.subTest(how):
                self.assertEqual(done.returncode, 0, done.stderr.decode())
                self.assertNotEqual((self.folder / 'b.exr').read_bytes(), wanted)  # it has layers
                self.assertEqual((self.folder / 'b.png').read_bytes(), png)
            os.remove(self.folder / 'b.exr')
            os.remove(self.folder / 'b.png')
        done = self.shell('2>&-', 'render', 'gone.obj', '-o', 'b.exr')
        self.assertEqual((done.returncode, done.stderr), (66, b''))

    def test_a_file_never_gets_the_number_of_stderr(self):
        """Words for people would end up in it. Linux tells what a process has open."""
        code = ('import os, subprocess, sys\n'
                'p = subprocess.Popen(sys.argv[1:], stdout=subprocess.PIPE, pipesize=4096,\n'
                '                     preexec_fn=lambda: [os.close(f) for f in (0, 2)])\n'
                'p.stdout.read(1)\n'  # it is at work: a pipe takes less than all
                'for f in (0, 2): print(os.readlink(f"/proc/{p.pid}/fd/{f}"))\n'
                'p.kill()\n')
        words = (Case.program, 'graph', 'valley', '--json', '--aov', 'all')
        done = subprocess.run([sys.executable, '-c', code, *words], env=environment({}),
                              capture_output=True, text=True, timeout=240, check=False)
        self.assertEqual(done.stdout.split(), ['/dev/null', '/dev/null'], done.stderr)

    # ---- whose files ----

    def test_modes_of_files(self):
        for mask, mode in (('000', 0o666), ('022', 0o644), ('077', 0o600)):
            home = self.folder / f'home{mask}'
            home.mkdir()
            done = self.shell('', 'render', 'tent.obj', *BARE, '-o', f'{mask}.exr', '-o',
                              f'{mask}.png', env={'HOME': str(home)}, before=f'umask {mask};')
            self.assertEqual(done.returncode, 0, done.stderr.decode())
            for ending in ('exr', 'png'):
                path = self.folder / f'{mask}.{ending}'
                self.assertEqual(stat.S_IMODE(path.stat().st_mode), mode, path)
            cached = [path for path in home.rglob('*') if 'mesa' not in str(path)]
            self.assertTrue(cached)
            for path in cached:  # nobody else has to do with what is cached
                self.assertEqual(stat.S_IMODE(path.stat().st_mode) & 0o077, 0, path)

    def as_somebody(self, *arguments, env=()):
        """As a user to whom the folder's mode means something: root may write anywhere. The driver
        has words of its own for a folder of its cache."""
        words = command(*arguments)
        if os.geteuid() == 0:
            shutil.copy(Case.program, self.folder / 'bin')  # where anybody can read it
            words = ['setpriv', f'--reuid={NOBODY}', f'--regid={NOBODY}', '--clear-groups',
                     str(self.folder / 'bin'), *words[1:]]
        asan = os.environ.get('ASAN_OPTIONS', '') + ':detect_leaks=0'
        env = {'MESA_SHADER_CACHE_DISABLE': 'true', **dict(env),
               'ASAN_OPTIONS': asan, 'LSAN_OPTIONS': ''}  # it may not read the list
        return subprocess.run(words, env=environment(env), cwd=self.folder / 'closed',
                              stdin=subprocess.DEVNULL, capture_output=True, timeout=240,
                              check=False)

    def test_a_folder_that_cannot_be_written_to(self):
        closed, opened = self.folder / 'closed', self.folder / 'opened'
        closed.mkdir()
        opened.mkdir()
        (closed / 'tent.obj').write_text(TENT)
        self.folder.chmod(0o755)
        opened.chmod(0o777)
        closed.chmod(0o555)
        self.addCleanup(closed.chmod, 0o755)
        draw = ('render', 'tent.obj', *BARE, '-q', '-o')
        for env in ({}, {'HOME': str(closed)}, {'HOME': '/nonexistent'}, {'HOME': ''},
                    {'XDG_CACHE_HOME': str(closed)}, {'XDG_CACHE_HOME': '/dev/null'}):
            done = self.as_somebody(*draw, opened / 'a.exr', env=env)
            with self.subTest(env):
                self.assertEqual((done.returncode, done.stderr), (0, b''))
                self.assertTrue((opened / 'a.exr').read_bytes())
            (opened / 'a.exr').unlink(missing_ok=True)
        done = self.as_somebody(*draw, 'a.exr')
        self.assertEqual(done.returncode, CANT_CREATE, done.stderr.decode())
        self.assertEqual(len(done.stderr.decode().splitlines()), 1)
        self.assertIn('a.exr', done.stderr.decode())
        self.assertEqual([path.name for path in closed.iterdir()], ['tent.obj'])

    # ---- words and numbers ----

    def german(self):
        """An environment where 0.5 is 0,5."""
        subprocess.run(['localedef', '-i', 'de_DE', '-f', 'UTF-8',
                        str(self.folder / 'de_DE.UTF-8')], capture_output=True, check=True)
        env = {'LOCPATH': str(self.folder), 'LC_ALL': 'de_DE.UTF-8'}
        point = subprocess.run(
            [sys.executable, '-c', 'import locale; locale.setlocale(locale.LC_ALL, "");'
             'print(locale.localeconv()["decimal_point"])'],
            env={**os.environ, **env}, capture_output=True, text=True, check=True).stdout
        self.assertEqual(point, ',\n')
        return env

    @long
    def test_a_locale_with_a_decimal_comma(self):
        env = self.german()
        options = ('--set', 'refract_paper.back_weight=0.25', '--fov', '40.5', '--background',
                   '0.1,0.2,.3')
        here, there = self.draw('a.exr', *options), self.draw('b.exr', *options, env=env)
        self.assertTrue(here == there, 'other bytes')
        for arguments in (('graph', 'sphere', '--json'), ('list', 'settings'),
                          ('diff', 'a.exr', 'a.exr', '--json')):
            self.assertEqual(self.succeed(*arguments, env=env).stdout,
                             self.succeed(*arguments).stdout)
        done = self.succeed('profile', 'sphere', '--size', '32x24', *PLAIN, '--runs', '1',
                            '--warmup', '0', '--clock', 'submits', '-q', '--json', '-', env=env)
        self.assertTrue(json.loads(done.stdout))

    def test_names_of_all_kinds(self):
        shutil.copy(self.folder / 'tent.obj', self.folder / 'Té nt.obj')
        self.succeed('render', 'Té nt.obj', *BARE, '-o', 'a.exr')
        wanted = (self.folder / 'a.exr').read_bytes()
        folder = self.folder / "  ein 'Päth' ✓ $x; \\ \""
        folder.mkdir()
        shutil.copy(self.folder / 'tent.obj', folder / 'Té nt.obj')
        for name in ('ö ✓.exr', '50 %.exr', "'.exr", '日本.exr'):
            done = self.firn('render', 'Té nt.obj', *BARE, '-o', name, cwd=folder)
            self.assertEqual(done.returncode, 0, done.stderr.decode())
            self.assertTrue((folder / name).read_bytes() == wanted, name)
            self.assertIn(f'{name}: 64x48', done.stderr.decode())
            self.succeed('diff', folder / name, 'a.exr', '--fail-above', 'rmse=0')
        done = self.firn('render', 'Té nt.obj', *BARE, '--frames', '1-2', '-o', 'ö.####.exr',
                         cwd=folder)
        self.assertEqual(done.returncode, 0, done.stderr.decode())
        self.assertTrue((folder / 'ö.0002.exr').exists())
        raw = os.fsencode(folder) + b'/\xff\xfe.exr'  # no UTF-8 at all
        self.succeed('render', folder / 'Té nt.obj', *BARE, '-q', '-o', os.fsdecode(raw))
        self.assertTrue(os.path.exists(raw))

    def test_no_screen(self):
        done = self.firn('view', 'sphere')
        words = done.stderr.decode()
        self.assertEqual(done.returncode, NO_DEVICE, words)
        self.assertEqual(len(words.splitlines()), 1, words)
        self.assertIn('firn: ', words)

    def test_nothing_in_the_environment(self):
        """Not even a PATH."""
        driver = {name: value for name, value in environment({}).items() if name != 'PATH'}
        done = subprocess.run(command('render', 'tent.obj', *BARE, '-q', '-o', 'a.exr'),
                              env=driver, cwd=self.folder, stdin=subprocess.DEVNULL,
                              capture_output=True, timeout=240, check=False)
        self.assertEqual((done.returncode, done.stderr), (0, b''))
        self.assertTrue(pathlib.Path(self.folder / 'a.exr').exists())


if __name__ == '__main__':
    main()
