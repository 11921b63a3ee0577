"""test_memory.py: tests firn when memory runs out, at many limits. Usage: see case.py.

The driver's compiler and Embree's threads may then crash, with or without a message. firn can only
guarantee that an output file is the older one or the complete new one, and that the next run
removes a temporary file.
"""
import concurrent.futures
import os
import pathlib
import resource
import signal
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True  # the source tree stays clean
from case import NO_DEVICE, TRY_AGAIN, WRITE, Case, command, environment, main  # noqa: E402

CRASHES = (-signal.SIGSEGV, -signal.SIGABRT, -signal.SIGBUS, -signal.SIGILL, -signal.SIGTRAP)
OLDER = b'what was there before'
MIB = 1 << 20


def limit_to(kind, most):
    """The limit, or the one under which the test itself runs, if that is less."""
    hard = resource.getrlimit(kind)[1]
    most = most if hard == resource.RLIM_INFINITY else min(most, hard)
    resource.setrlimit(kind, (most, most))


class Memory(Case):
    def test_limits_of_a_batch_system(self):
        """A sound model is drawn, or the line says that it is the limit, not the file."""
        (self.folder / 'tent.obj').write_text('v 0 1 0\nv -1 -1 1\nv 1 -1 1\nv 0 -1 -1\n'
                                              'f 1 2 3\nf 1 3 4\nf 1 4 2\nf 2 4 3\n')
        for name, kind, most in (('-v', resource.RLIMIT_AS, 3000000 << 10),
                                 ('-t', resource.RLIMIT_CPU, 8),
                                 ('-n', resource.RLIMIT_NOFILE, 31)):
            done = subprocess.run(
                command('render', 'tent.obj', '--size', '64x48', '-o', 'a.exr', '-q'),
                cwd=self.folder, stdin=subprocess.DEVNULL, env=environment({}), timeout=240,
                capture_output=True, check=False,
                preexec_fn=lambda limit=(kind, most): limit_to(*limit))
            with self.subTest(name, words=done.stderr):
                self.assertIn(done.returncode, (0, TRY_AGAIN))
                self.assertEqual(len(done.stderr.splitlines()), done.returncode != 0)

    def test_files_beyond_a_limit(self):
        """`ulimit -f` is as a full disk. Mesa 25 dies, since it keeps device memory in a file."""
        for name in ('a.exr', 'a.png'):
            (self.folder / name).write_bytes(OLDER)
            done = subprocess.run(
                command('render', 'sphere', '--size', '256x256', '-o', name, '-q'),
                cwd=self.folder, stdin=subprocess.DEVNULL, timeout=240, capture_output=True,
                env=environment({'MESA_SHADER_CACHE_DISABLE': 'true'}), check=False,
                preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096)))
            self.assertIn(done.returncode, (WRITE, -signal.SIGBUS), done.stderr)
            self.assertEqual(len(done.stderr.splitlines()), done.returncode == WRITE, done.stderr)
            self.assertEqual((self.folder / name).read_bytes(), OLDER)
        self.assertEqual(self.files(), ['a.exr', 'a.png'])

    def run_within(self, arguments, size):
        """Its code, its words, and what it leaves: {name: bytes}."""
        def limit():
            limit_to(resource.RLIMIT_AS, size * MIB)
            limit_to(resource.RLIMIT_CORE, 0)
        with tempfile.TemporaryDirectory(prefix='firn ') as folder:
            (pathlib.Path(folder) / 'a.exr').write_bytes(OLDER)
            words = command(*arguments)
            env = environment({})
            done = subprocess.run(words, cwd=folder, stdin=subprocess.DEVNULL, env=env,
                                  capture_output=True, timeout=240, check=False,
                                  preexec_fn=limit)
            left = {path.name: path.read_bytes() for path in pathlib.Path(folder).iterdir()}
            if len(left) > 1 and done.returncode in CRASHES:
                subprocess.run(words, cwd=folder, env=env, timeout=240, check=True)
                left = {name: left.get(name) for name in os.listdir(folder)}
        return done.returncode, done.stderr.decode(), left

    def least(self):
        """Returns the limit, MiB, from which on the program's libraries are loaded. At some limits
        above the first that suffices, the allocator of TBB 2022 dies."""
        return 1 + next(size for size in reversed(range(32, 192))
                        if self.run_within(('--version',), size)[0] != 0)

    def squeeze(self, *arguments, sizes, may_crash):
        """How many ended with which code."""
        self.succeed(*arguments)
        whole = (self.folder / 'a.exr').read_bytes()
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            ends = list(pool.map(lambda size: self.run_within(arguments, size), sizes))
        codes = {}
        for size, (code, words, left) in zip(sizes, ends):
            codes[code] = codes.get(code, 0) + 1
            with self.subTest(f'{arguments} in {size} MiB: {code}: {words}'):
                self.assertEqual(list(left), ['a.exr'])
                if code in CRASHES and may_crash:
                    self.assertIn(left['a.exr'], (OLDER, whole))
                    continue
                self.assertEqual(left['a.exr'], OLDER if code else whole)
                self.assertIn(code, (0, NO_DEVICE, TRY_AGAIN))
                self.assertEqual(len(words.splitlines()), 1 if code else 0)
        print(f"{' '.join(arguments[:2])}: {len(sizes)} limits; exit codes "
              + ', '.join(f'{code}: {count}' for code, count in sorted(codes.items())),
              file=sys.stderr)
        return codes

    def test_render(self):
        codes = self.squeeze('render', 'sphere', '--size', '256x192', '--aov', 'all', '-q',
                             '-o', 'a.exr', sizes=range(200, 920, 72), may_crash=True)
        self.assertTrue(set(codes) - set(CRASHES), codes)  # where the driver dies is chance

    def test_reference(self):
        starts = self.least()
        self.squeeze('render', 'sphere', '-r', 'reference', '--size', '64x48', '-q', '-o', 'a.exr',
                     sizes=range(starts, starts + 320, 32), may_crash=True)

    def test_diff(self):
        """Nobody's memory but firn's."""
        self.succeed('render', 'sphere', '--size', '200x150', '-q', '-o', self.folder / 'b.exr')
        path = str(self.folder / 'b.exr')
        starts = self.least()
        codes = self.squeeze('diff', path, path, '-o', 'a.exr', sizes=range(starts, starts + 10),
                             may_crash=False)
        self.assertTrue(codes.get(TRY_AGAIN), codes)
        self.assertTrue(codes.get(0), codes)

    def test_a_picture_that_is_too_large(self):
        """Within the device's limits, but in no memory: found before it is drawn."""
        for size in ('16384x16384', '16384x12288'):
            code, words, left = self.run_within(
                ('render', 'sphere', '--size', size, '-q', '-o', 'a.exr'), 2048)
            with self.subTest(f'{size}: {words}'):
                self.assertEqual(code, TRY_AGAIN)
                self.assertEqual(len(words.splitlines()), 1)
                self.assertIn('--size', words)
                self.assertEqual(left, {'a.exr': OLDER})


if __name__ == '__main__':
    main()
