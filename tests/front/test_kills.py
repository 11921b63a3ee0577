"""test_kills.py: tests output files of processes that are killed while others write the same ones.

Usage: see case.py. FIRN_KILLS in the environment is the number of kills (10); 100 take a minute.
"""
import os
import random
import shutil
import signal
import subprocess
import sys
import time

sys.dont_write_bytecode = True  # the source tree stays clean
from case import FLAT, PLAIN, Case, command, environment, long, main  # noqa: E402

KILLS = int(os.environ.get('FIRN_KILLS', '10'))
FRAMES = 24
RUNS = 18  # in two namespaces
TINY = ('--size', '16x12', *PLAIN, *FLAT, '-q')
SEQUENCE = ('render', 'sphere', *TINY, '--frames', f'1-{FRAMES}', '-o', '#.exr', '-o', '#.png')


class Kills(Case):
    def setUp(self):
        super().setUp()
        self.succeed(*SEQUENCE)
        self.whole = {name: (self.folder / name).read_bytes() for name in self.files()}
        self.assertEqual(len(self.whole), 2 * FRAMES)

    def start(self):
        process = subprocess.Popen(
            command(*SEQUENCE), env=environment({}), cwd=self.folder,
            stdin=subprocess.DEVNULL, stderr=subprocess.PIPE)
        self.addCleanup(process.stderr.close)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        return process

    def node(self):
        return (self.folder / '1.exr').stat().st_ino

    def wait_for_a_frame(self, process):
        """Until the process, or the other one, has written the first frame anew."""
        before = self.node()
        while process.poll() is None and self.node() == before:
            time.sleep(0.001)

    def check_whole(self):
        """Each frame is there, complete. Returns the number of temporaries, which come and go."""
        for name, data in self.whole.items():
            self.assertTrue((self.folder / name).read_bytes() == data, name)
        others = [name for name in self.files() if name not in self.whole]
        for name in others:
            self.assertRegex(name, r'\A\.\d+\.(exr|png)\.\w{6}\.tmp\Z')
        return len(others)

    @long
    def test_at_random(self):
        """Two processes at once write the same frames; one or the other is killed, and replaced."""
        chance = random.Random(1)
        processes = [self.start(), self.start()]
        temporaries, killed = 0, 0
        while killed < KILLS:
            one = chance.randrange(2)
            self.wait_for_a_frame(processes[one])
            time.sleep(chance.uniform(0, 0.2))
            processes[one].kill()
            code = processes[one].wait()
            self.assertIn(code, (0, -signal.SIGKILL), processes[one].stderr.read())
            killed += code != 0
            processes[one] = self.start()
            temporaries = max(temporaries, self.check_whole())
        for process in processes:
            process.kill()
            process.wait()
        self.check_whole()
        self.succeed(*SEQUENCE)
        self.assertEqual(self.check_whole(), 0)
        print(f'{killed} kills, up to {temporaries} temporaries at once', file=sys.stderr)


class Namespaces(Case):
    def test_two_of_processes(self):
        """In containers on one host, processes have the same numbers and the same host's name."""
        for enter in (('unshare', '-p', '-f', '--mount-proc'),
                      ('unshare', '-U', '-r', '-p', '-f', '--mount-proc')):
            if shutil.which(enter[0]) and subprocess.run(
                    [*enter, 'true'], stderr=subprocess.DEVNULL, check=False).returncode == 0:
                break
        else:
            self.skipTest('namespaces of processes are not available')
        self.succeed('render', 'sphere', *TINY, '-o', 'one.exr')
        words = (Case.program, 'diff', 'one.exr', 'one.exr', '-o', 'a.exr')  # soon done
        self.succeed(*words[1:])
        whole = (self.folder / 'a.exr').read_bytes()
        loop = ('echo $$; i=0; '
                f'while [ $i -lt {RUNS // 2} ]; do "$@" >/dev/null || exit; i=$((i + 1)); done')
        both = [subprocess.Popen([*enter, 'sh', '-c', loop, 'sh', *words], env=environment({}),
                                 cwd=self.folder, stdin=subprocess.DEVNULL,
                                 stdout=subprocess.PIPE, stderr=subprocess.PIPE)
                for _ in range(2)]
        for process in both:
            said, words = process.communicate(timeout=1200)
            self.assertEqual((process.returncode, said, words), (0, b'1\n', b''))
        self.assertEqual(self.files(), ['a.exr', 'one.exr'])
        self.assertTrue((self.folder / 'a.exr').read_bytes() == whole)


if __name__ == '__main__':
    main()
