"""test_farm.py: sequences on many machines, `firn farm`.

Usage: test_farm.py FIRN [--no-slurm] [--no-parallel] [TEST...]   --no-...: is not installed
"""
import getpass
import json
import os
import pathlib
import random
import signal
import socket
import subprocess
import sys
import time
import unittest

sys.dont_write_bytecode = True  # the source tree stays clean
from case import (  # noqa: E402
    BARE, CANT_CREATE, NO_DRIVER, PLAIN, USAGE, WRITE, Case, environment, main,
    unsanitized)


def take_flag(name):
    given = name in sys.argv
    if given:
        sys.argv.remove(name)
    return given


NO_SLURM, NO_PARALLEL = take_flag('--no-slurm'), take_flag('--no-parallel')
FRAMES = 8
NAMES = [f'turn.{i:02}.exr' for i in range(1, FRAMES + 1)]
# A frame takes long enough to be killed in its middle
TURN = ('valley', '--size', '96x72', *PLAIN, '--samples', '8', '-q', '--frames', f'1-{FRAMES}',
        '-o', 'turn.##.exr')
SLURM_CONF = '''
ClusterName=firn
SlurmctldHost=localhost(127.0.0.1)
SlurmctldPort={ports[0]}
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/none
AuthInfo=cred_expire=5
CredType=cred/none
MpiDefault=none
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
CommunicationParameters=NoCtldInAddrAny,NoInAddrAny
SchedulerParameters=sched_interval=1,batch_sched_delay=0
SlurmdParameters=config_overrides
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool.%n
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/%n.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/%n.log
RequeueExit=75
ReturnToService=2
SlurmdTimeout=600
KillWait=2
NodeName=n[1-2] NodeHostname=localhost NodeAddr=127.0.0.1 Port=[{ports[1]}-{ports[2]}] CPUs=1
PartitionName=all Nodes=ALL Default=YES State=UP
'''


def free_ports(count):
    """Neighbours that nobody uses now."""
    for first in range(random.randrange(20000, 50000), 60000, count):
        sockets = [socket.socket() for _ in range(count)]
        try:
            for i, s in enumerate(sockets):
                s.bind(('127.0.0.1', first + i))
            return list(range(first, first + count))
        except OSError:
            pass
        finally:
            for s in sockets:
                s.close()
    raise OSError('no free ports')


def processes():
    """(number, number of the parent, environment) of those that may be read."""
    for entry in pathlib.Path('/proc').iterdir():
        try:
            if entry.name.isdigit():
                parent = int((entry / 'stat').read_text().rpartition(')')[2].split()[1])
                yield int(entry.name), parent, (entry / 'environ').read_bytes().split(b'\0')
        except (OSError, IndexError):  # it has ended
            pass


class Farm(Case):
    def check_frames(self, alone):
        """All there, as one machine draws them, and no temporaries."""
        for name in NAMES:
            same = (self.folder / name).read_bytes() == alone[name]
            self.assertTrue(same, f'{name}: other bytes')
        self.assertEqual([name for name in self.files() if name.endswith('.tmp')], [])

    def draw_alone(self):
        (self.folder / 'alone').mkdir()
        self.succeed('render', *TURN, cwd=self.folder / 'alone')
        return {name: (self.folder / 'alone' / name).read_bytes() for name in NAMES}

    def status(self, *arguments, code=0):
        done = self.firn('farm', 'status', *arguments)
        self.assertEqual(done.returncode, code, done.stderr.decode())
        return done.stdout.decode()


class Words(Farm):
    def test_what_is_wrong(self):
        for words, names in (
                ((), ['slurm', 'parallel', 'status']), (('pbs', 'sphere'), ['pbs']),
                (('slurm',), ['SCENE']), (('slurm', 'sphere'), ['--frames']),
                (('slurm', 'sphere', '--frames', '1-2', '-o', 'a.exr'), ['a.exr']),
                (('slurm', 'sphere', '--frames', '1', '-o', '-'), ['--output']),
                (('slurm', 'sphere', '--frames', '1', '--tasks', '0'), ['--tasks']),
                (('slurm', 'sphere', '--frames', '1', '--sbatch', 'x'), ['--sbatch']),
                (('parallel', 'sphere', '--frames', '1', '--hosts', ''), ['--hosts']),
                (('status', '--frames', '1-2', '-o', 'b.##.exr'), ['SCENE']),
                (('parallel', 'sphere', '--frames', '1-2', '-o', '{}.##.exr'), ['{}.##.exr'])):
            self.refuse(USAGE, 'farm', *words, names=names)
        self.refuse(CANT_CREATE, 'farm', 'slurm', 'sphere', '--frames', '1-2', '-o', 'gone/##.exr',
                    names=['gone/01.exr'])
        with open('/dev/full', 'wb') as full:
            for what in ('slurm', 'status'):
                done = self.firn('farm', what, 'sphere', '--frames', '1', stdout=full)
                self.assertEqual(done.returncode, WRITE)

    def script(self, what, *arguments):
        done = self.succeed('farm', what, *arguments, env=NO_DRIVER)
        text = done.stdout.decode()
        path = self.folder / 'script.sh'
        path.write_text(text)
        subprocess.run(['sh', '-n', path], check=True)
        return text

    def test_words_of_render_are_passed_on(self):
        for what in ('slurm', 'parallel'):
            text = self.script(what, '--tasks=3', '--hosts', 'a,b', '--sbatch', '--time=9', '-n4',
                               'sphere', '--set', 'cracks.count=2', '--frames', '1-9', '-o',
                               "it's.##.exr")
            self.assertIn('render --resume --chunk ', text)
            self.assertIn('-n4 sphere --set cracks.count=2 --frames 1-9 -o', text)
            self.assertNotRegex(text, '--(tasks|hosts)')
            self.assertEqual('#SBATCH --time=9' in text, what == 'slurm')
            self.assertEqual('--sshlogin a,b ' in text, what == 'parallel')

    def test_numbers_of_tasks(self):
        for frames, more, count in (('1-8', (), 8), ('1-250', (), 100), ('1-8', ('--tasks', 3), 3),
                                    ('1-8', ('--tasks', 99), 8), ('1', (), 1)):
            words = ('sphere', '--frames', frames, '-o', 'a.#.exr', *more)
            self.assertIn(f'--array=1-{count}\n', self.script('slurm', *words))
            self.assertIn(f'$(seq {count})', self.script('parallel', *words))

    def test_cores_of_a_job_are_those_of_its_step(self):
        text = self.script('slurm', 'sphere', '--frames', '1')
        job = text.split("<<'END'\n")[1].split('END\n')[0]
        (self.folder / 'srun').write_text('#!/bin/sh\necho "$SRUN_CPUS_PER_TASK"\n')
        (self.folder / 'srun').chmod(0o755)
        for cores in ('', '8'):
            env = {'PATH': f'{self.folder}:/usr/bin:/bin', 'SLURM_CPUS_PER_TASK': cores}
            done = subprocess.run(['sh', '-c', job], env=env, capture_output=True, check=True)
            self.assertEqual(done.stdout.decode().strip(), cores)

    def test_names_of_jobs(self):
        for output, name in (('turn.##.exr', 'turn'), ('an ice cube.#.png', 'an'),
                             ('##.exr', 'firn'), ('-x.#.exr', 'firn')):
            text = self.script('slurm', 'sphere', '--frames', '1-2', f'--output={output}')
            self.assertIn(f'#SBATCH --job-name={name}\n', text)

    def test_names_that_are_no_words(self):
        """A shell takes none for a comment or the end of its text."""
        text = self.script('slurm', 'sphere', '--frames', '1-2', '-o', '#.exr')
        self.assertIn(" -o '#.exr'\n", text)
        for what in ('slurm', 'parallel'):
            for words in (('m\nEND\n)\ntouch pwned\nexit\n.gltf', '-o', '#.exr'),
                          ('sphere', '-o', 'a\x7f#.exr')):
                self.refuse(USAGE, 'farm', what, *words, '--frames', '1-2', names=['control'])
        self.refuse(USAGE, 'farm', 'slurm', 'sphere', '-o', '#.exr', '--frames', '1-2', '--sbatch',
                    '-n1\ntouch pwned', names=['--sbatch'])

    def test_a_script_that_fails(self):
        done = self.firn('farm', 'slurm', 'sphere', '--frames', '1-2', '--submit',
                         env={'PATH': '/nonexistent'})
        self.assertEqual(done.returncode, 1)
        self.assertIn(b'--submit', done.stderr.splitlines()[-1])


class Status(Farm):
    words = ('sphere', *BARE, '--frames', '1-6', '-o', 'a.#.exr', '-o', 'a.#.png')

    def test_nothing_is_there(self):
        self.assertEqual(self.status(*self.words, code=1), 'missing      6  1-6\n')
        self.assertEqual(self.status('sphere', '-o', 'a.#.exr', '--frames', '9-1x2', code=1),
                         'missing      5  9-1x2\n')

    def test_all_states(self):
        self.succeed('render', *self.words)
        self.assertEqual(self.status(*self.words), 'done         6  1-6\n')
        (self.folder / 'a.2.png').unlink()
        (self.folder / 'a.3.exr').write_bytes((self.folder / 'a.3.exr').read_bytes()[:-9])
        (self.folder / 'a.4.exr').write_bytes((self.folder / 'a.5.exr').read_bytes())
        (self.folder / 'a.6.png').write_bytes(b'no PNG')
        done = self.firn('farm', 'status', *self.words)
        self.assertEqual(sorted(line.split(':')[1] for line in done.stderr.decode().splitlines()),
                         [' a.3.exr', ' a.6.png'])  # each damaged file in one line
        lines = done.stdout.decode().splitlines()
        self.assertEqual([line.split()[:3] for line in lines],
                         [['done', '2', '1,5'], ['stale', '1', '4'], ['damaged', '2', '3,6'],
                          ['missing', '1', '2']])
        found = json.loads(self.status(*self.words, '--json', code=1))
        self.assertEqual([f['state'] for f in found['frames']],
                         ['done', 'missing', 'damaged', 'stale', 'done', 'damaged'])
        self.assertEqual([found[k] for k in ('done', 'stale', 'damaged', 'missing')], [2, 1, 2, 1])
        left = ','.join(line.split()[2] for line in lines[1:])
        self.succeed('render', *self.words, '--frames', left, '--resume')
        self.status(*self.words)
        self.assertIn('stale        6  1-6', self.status(*self.words, '--fov', '40', code=1))


@unittest.skipIf(NO_PARALLEL, 'no GNU parallel')
class Parallel(Farm):
    """Two hosts, of which one does not answer: what stands for ssh runs commands here."""

    def setUp(self):
        super().setUp()
        (self.folder / 'home').mkdir()
        self.ssh = self.folder / 'ssh.sh'
        self.ssh.write_text('#!/bin/sh\necho "$1" >>hosts.txt\n[ "$1" = alive ] || exit 255\n'
                            'shift\n[ "$1" != -- ] || shift\nSHELL=/bin/sh exec sh -c "$*"\n')
        self.ssh.chmod(0o755)
        self.link = self.folder.with_name(self.folder.name.replace(' ', '-'))  # ssh is a command
        self.link.symlink_to(self.folder)
        self.addCleanup(self.link.unlink)
        self.env = environment({'PARALLEL_SSH': str(self.link / 'ssh.sh'),
                                'HOME': str(self.folder / 'home')})

    def submit(self, *arguments):
        return self.firn('farm', 'parallel', *arguments, '--submit', '--hosts', 'dead,alive',
                         env=self.env)

    @unsanitized
    def test_a_dead_host(self):
        alone = self.draw_alone()
        done = self.submit(*TURN)
        self.assertEqual(done.returncode, 0, done.stderr.decode())
        self.assertEqual(done.stdout.decode().splitlines()[-1], 'done         8  1-8')
        self.check_frames(alone)
        hosts = (self.folder / 'hosts.txt').read_text().split()
        self.assertEqual((hosts.count('alive'), set(hosts)), (8, {'alive', 'dead'}))
        lines = (self.folder / 'turn.logs/joblog').read_text().splitlines()
        self.assertEqual([line.split('\t')[6] for line in lines[1:]], 8 * ['0'])
        self.assertEqual(self.submit(*TURN).returncode, 0)  # nothing is left to do
        self.assertEqual((self.folder / 'hosts.txt').read_text().split(), hosts)

    @unsanitized
    def test_what_has_failed_comes_again(self):
        (self.folder / 'turn.03.exr').mkdir()
        self.refuse(CANT_CREATE, 'farm', 'parallel', *TURN, names=['turn.03.exr'])
        (self.folder / 'turn.03.exr').rmdir()
        (self.folder / 'turn.03.exr').symlink_to('/dev/full')
        self.assertEqual(self.submit(*TURN, *BARE, '--samples', '1').returncode, 1)
        (self.folder / 'turn.03.exr').unlink()
        done = self.submit(*TURN, *BARE, '--samples', '1')
        self.assertEqual(done.returncode, 0, done.stderr.decode())


@unittest.skipIf(NO_SLURM, 'no Slurm')
class Slurm(Farm):
    """Two nodes on this machine, of which one is lost."""

    def setUp(self):
        super().setUp()
        self.where = self.folder / 'slurm'
        for name in ('state', 'spool.n1', 'spool.n2'):
            (self.where / name).mkdir(parents=True)
        self.conf = self.where / 'slurm.conf'
        link = self.folder.with_name(self.folder.name.replace(' ', '-'))  # Slurm knows no spaces
        link.symlink_to(self.folder)
        self.addCleanup(link.unlink)
        self.conf = link / 'slurm/slurm.conf'
        if not pathlib.Path('/sys/fs/cgroup').is_dir():  # a root in which it is not mounted
            self.conf.with_name('cgroup.conf').write_text('CgroupPlugin=disabled\n')
        self.env = environment({'SLURM_CONF': str(self.conf), 'FIRN_FARM_TEST': str(self.folder)})
        self.addCleanup(self.stop)
        for _ in range(5):
            if self.start_daemons(link / 'slurm'):
                return
            self.stop()  # somebody else has taken a port
        self.fail(self.log())

    def start_daemons(self, folder):
        """Whether all of them run on."""
        self.conf.write_text(SLURM_CONF.format(ports=free_ports(3), user=getpass.getuser(),
                                               folder=folder))
        self.daemons = {'ctld': self.start('slurmctld', '-D')}
        for node in ('n1', 'n2'):
            self.daemons[node] = self.start('slurmd', '-D', '-N', node)
        return self.wait_for(lambda: 'ended' if any(
            daemon.poll() is not None for daemon in self.daemons.values()) else self.ask(
                'sinfo', '-h', '-t', 'idle', '-o', '%D') == '2\n') != 'ended'

    def stop(self):
        self.kill([number for number, _, env in processes()
                   if f'SLURM_CONF={self.conf}'.encode() in env])
        for daemon in self.daemons.values():
            daemon.wait()

    def start(self, *words):
        path = f'{self.env["PATH"]}:/usr/sbin:/sbin'
        with open(self.where / f'{words[-1]}.out', 'wb') as out:
            return subprocess.Popen(words, env={**self.env, 'PATH': path}, cwd=self.where,
                                    stdin=subprocess.DEVNULL, stdout=out, stderr=out)

    def ask(self, *words):
        return subprocess.run(words, env=self.env, cwd=self.folder, capture_output=True, text=True,
                              check=False, timeout=60).stdout

    def wait_for(self, condition):
        end = time.monotonic() + 240  # long after it has gone wrong
        while not (found := condition()):
            self.assertLess(time.monotonic(), end, self.log())
            time.sleep(0.05)
        return found

    def log(self):
        return ''.join(path.read_text()[-1000:] for path in self.where.glob('*.log'))

    def find_firn(self, node):
        """Processes of a job that draws on that node; None: it does not draw yet."""
        mine = [number for number, _, env in processes()
                if f'SLURMD_NODENAME={node}'.encode() in env and
                f'FIRN_FARM_TEST={self.folder}'.encode() in env]
        return mine if any(self.program_of(n) == os.path.realpath(Case.program)
                           for n in mine) else None

    def kill(self, numbers):
        """The daemons of their steps first, which would tell of the others' end."""
        parents = {number: parent for number, parent, _ in processes()}
        daemons = set()
        for number in numbers:
            while (number := parents.get(number)) is not None:
                if (self.program_of(number) or '').rpartition('/')[2].startswith('slurmstepd'):
                    daemons.add(number)
        for number in (*sorted(daemons), *numbers):
            try:
                os.kill(number, signal.SIGKILL)
            except ProcessLookupError:
                pass

    def program_of(self, number):
        try:
            return os.readlink(f'/proc/{number}/exe')
        except OSError:
            return None

    def test_a_node_is_lost(self):
        alone = self.draw_alone()
        done = self.firn('farm', 'slurm', *TURN, '--submit', env=self.env)
        self.assertEqual(done.returncode, 0, done.stderr.decode())
        self.assertRegex(done.stdout.decode(), r'\Ajob \d+: 8 tasks, logs in turn.logs\n\Z')
        mine = self.wait_for(lambda: self.find_firn('n1'))
        self.daemons['n1'].kill()
        self.kill(mine)
        log = self.folder / 'turn.logs/status.log'

        def is_over():
            # Mark the node down instead of waiting for Slurm's timeout, and repeat this: a late
            # message of the node can mark it as up again.
            self.ask('scontrol', 'update', 'NodeName=n1', 'State=DOWN', 'Reason=lost')
            return log.exists() and self.ask('squeue', '-h') == ''
        self.wait_for(is_over)
        self.assertEqual(log.read_text(), 'done         8  1-8\n',
                         self.log())
        self.check_frames(alone)


if __name__ == '__main__':
    main()
