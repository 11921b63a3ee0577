"""test_output.py: tests output files when the disk fails or the process is killed during a write.

Usage: see case.py. FAIL_CALL in the environment is the library of tests/support/fail_system_call.c.
"""
import fcntl
import os
import signal
import sys

sys.dont_write_bytecode = True  # the source tree stays clean
from case import CANT_CREATE, WRITE, Case, main  # noqa: E402

NAMES = ('a.exr', 'a.png')
OLDER = b'what was there before'
MOST = 60  # calls: there are fewer


class Output(Case):
    def setUp(self):
        super().setUp()
        self.render('one.exr')

    def draw(self, **env):
        """Needs no device: many runs in little time."""
        words = [word for name in NAMES for word in ('-o', name)]
        return self.firn('diff', 'one.exr', 'one.exr', *words, env=env)

    def draw_and_fail(self, at, how):
        """What the run says, and whether it came to this call."""
        for name in NAMES:
            (self.folder / name).write_bytes(OLDER)
        asan = os.environ.get('ASAN_OPTIONS', '') + ':verify_asan_link_order=0'
        done = self.draw(LD_PRELOAD=os.environ['FAIL_CALL'], FAIL_AT=str(at), FAIL_HOW=how,
                         ASAN_OPTIONS=asan)
        return done, b'fail_call: ' in done.stderr

    def check(self, how, codes):
        """At every call: each file is the older one or the new one, and nothing else is left once
        firn has run again."""
        self.assertEqual(self.draw().returncode, 0)
        newer = {name: (self.folder / name).read_bytes() for name in NAMES}
        damaged = 0
        for at in range(1, MOST):
            done, met = self.draw_and_fail(at, how)
            if not met:
                self.assertEqual(done.returncode, 0, done.stderr.decode())
                break
            with self.subTest(f'{how} at call {at}: {done.stderr.decode()}'):
                self.assertIn(done.returncode, codes)
                for name in NAMES:
                    data = (self.folder / name).read_bytes()
                    damaged += data not in (OLDER, newer[name])
                self.assertEqual(damaged, 0)
                if how != 'kill':
                    self.assertEqual(len(done.stderr.decode().splitlines()), 2)  # and the library's
                    self.assertEqual(self.files(), sorted([*NAMES, 'one.exr']))
                self.assertEqual(self.draw().returncode, 0)
                self.assertEqual(self.files(), sorted([*NAMES, 'one.exr']))
                for name in NAMES:
                    self.assertEqual((self.folder / name).read_bytes(), newer[name])
        self.assertGreater(at, 10)
        self.assertLess(at, MOST - 1)
        print(f'{how}: {at - 1} points, {damaged} damaged', file=sys.stderr)

    def test_full(self):
        self.check('full', (WRITE, CANT_CREATE))

    def test_broken(self):
        self.check('broken', (WRITE, CANT_CREATE))

    def test_short(self):
        self.check('short', (WRITE, CANT_CREATE))

    def test_killed(self):
        self.check('kill', (-signal.SIGKILL,))

    def test_others_temporaries_stay(self):
        """Of a process that lives, and of another file; those that nobody has locked go."""
        stay = ['.a.exr.living.tmp', '.b.exr.k3Xz0q.tmp', '.a.exr.k3Xz0.tmp']
        gone = '.a.exr.k3Xz0q.tmp'
        for name in (*stay, gone):
            (self.folder / name).touch()
        with open(self.folder / stay[0], 'rb') as living:
            fcntl.flock(living, fcntl.LOCK_EX)
            self.assertEqual(self.draw().returncode, 0)
        self.assertEqual(self.files(), sorted([*NAMES, *stay, 'one.exr']))


if __name__ == '__main__':
    main()
