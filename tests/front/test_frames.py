"""test_frames.py: sequences, `firn render --frames`. Usage: see case.py."""
import json
import os
import pty
import re
import signal
import struct
import socket
import subprocess
import sys
import time

sys.dont_write_bytecode = True  # the source tree stays clean
from case import (  # noqa: E402
    BARE, CANT_CREATE, FLAT, NO_DEVICE, NO_DRIVER, USAGE, WRITE, Case, command, environment,
    main, unsanitized)
from exr_file import Exr  # noqa: E402

MOVING = ('--set', 'motion.count=3')
LONG = '1-9999'


class Frames(Case):
    def draw(self, frames, *arguments, **how):
        """What is said about it, line by line."""
        done = self.succeed('render', 'sphere', *BARE, '--frames', frames, *arguments, **how)
        self.assertEqual(done.stdout, b'')
        return done.stderr.decode().splitlines()

    def render(self, output, *arguments):
        return super().render(output, *FLAT, *arguments)

    def read(self, name):
        return (self.folder / name).read_bytes()

    def refuse_frames(self, code, frames, *arguments, **how):
        self.refuse(code, 'render', 'sphere', *BARE, '--frames', frames, *arguments, **how)


class Sequence(Frames):
    @unsanitized
    def test_frames_are_single_pictures_of_their_time(self):
        more = (*MOVING, '--aov', 'all', '--samples', '2')
        self.draw('0-2', '-o', 'a.####.exr', '-o', 'a.####.png', *more)
        for kind in ('exr', 'png'):
            frames = [self.read(f'a.{i:04}.{kind}') for i in range(3)]
            self.assertEqual(len(set(frames)), 3)
            for frame, when in zip(frames, ('0', '0.04', '0.08')):
                single = self.render(f'b.{kind}', *more, '--set', f'motion.time={when}')
                if kind == 'exr':
                    self.assertEqual(Exr(frame).attributes.pop('framesPerSecond'),
                                     ('rational', struct.pack('<2i', 25, 1)))
                    self.assertTrue(Exr(frame).pixels == Exr(single).pixels, f'at {when} s')
                    self.assertEqual(Exr(frame).text('firn/settings'),
                                     Exr(single).text('firn/settings'))
                else:
                    self.assertTrue(frame == single, f'at {when} s: other bytes')
        pixels = {Exr(self.read(f'a.{i:04}.exr')).pixels for i in range(3)}
        self.assertEqual(len(pixels), 3)  # not only the header's words

    def test_rates_are_rational(self):
        for fps, rate in (('24', (24, 1)), ('23.976', (24000, 1001)), ('12.5', (12500, 1000))):
            self.draw('1', '-o', '#.exr', '--set', f'motion.fps={fps}')
            self.assertEqual(Exr(self.read('1.exr')).attributes['framesPerSecond'],
                             ('rational', struct.pack('<2i', *rate)))

    def test_time_goes_on_from_motion_time(self):
        self.draw('-1,10', '-o', '#.exr', '--set', 'motion.time=2', '--set', 'motion.fps=10')
        for name, when in (('-1.exr', '1.9'), ('10.exr', '3')):
            self.assertIn(f' motion.time={when} ', Exr(self.read(name)).text('firn/settings'))

    def test_names_in_the_order_of_the_list(self):
        lines = self.draw('3,-2,1-5x2,3', '-o', 'an ice cube.###.exr', '-o', '%02d.png')
        names = [f'an ice cube.{first}.exr {second}.png'.split('.exr ')
                 for first, second in (('003', '03'), ('-002', '-2'), ('001', '01'), ('005', '05'))]
        self.assertEqual([line.split(': ')[0] for line in lines],
                         [name for first, second in names for name in (f'{first}.exr', second)])
        self.assertEqual(self.files(), sorted(line.split(': ')[0] for line in lines))

    def test_chunks_make_the_whole(self):
        self.draw('4-0', '-o', 'all.#.exr')
        for k in range(1, 4):
            self.draw('4-0', '-o', 'part.#.exr', '--chunk', f'{k}/3')
        for frame in range(5):
            self.assertEqual(self.read(f'part.{frame}.exr'), self.read(f'all.{frame}.exr'))
        done = self.succeed('render', 'sphere', *BARE, '--frames', '1,2', '--chunk', '1/3', '-o',
                            'none.#.exr', env=NO_DRIVER)
        self.assertIn('contains no frames', done.stderr.decode())
        for chunk in ('0/3', '4/3', '1', '1/', '/2', '1/2/3', 'x'):
            self.refuse_frames(USAGE, '1-4', '--chunk', chunk, '-o', '#.exr', names=['--chunk'])
        self.refuse_frames(USAGE, '1-4', '--chunk', '1/4', '-o', 'same.exr', names=['same.exr'])
        self.refuse(USAGE, 'render', 'sphere', *BARE, '--chunk', '1/2', names=['--frames'])

    def test_default_name(self):
        self.draw('7,8')
        self.assertEqual(self.files(), ['firn.0007.exr', 'firn.0008.exr'])

    def test_one_frame_needs_no_pattern(self):
        self.draw('25', '-o', 'a.exr')
        self.assertIn(' motion.time=1 ', Exr(self.read('a.exr')).text('firn/settings'))
        done = self.succeed('render', 'sphere', *BARE, '--frames', '25', '-o', '-')
        self.assertEqual(done.stdout, self.read('a.exr'))

    def test_names_without_frames(self):
        for name in ('take#3.exr', '50%.exr'):
            self.render(name)
        for name in ('a.##.exr', 'a.%04d.exr'):
            self.refuse(USAGE, 'render', 'sphere', *BARE, '-o', name, names=[name, '--frames'])
        self.assertEqual(self.files(), ['50%.exr', 'take#3.exr'])

    def test_a_cube_that_stays_is_that_of_frame_0(self):
        static = (*MOVING, '--set', 'env_cube.dynamic=off', '--set', 'motion.objects=400')
        self.draw('0-2', '-o', 'a.#.exr', *static)
        self.draw('2', '-o', 'b.#.exr', *static)
        self.assertTrue(self.read('a.2.exr') == self.read('b.2.exr'))
        self.draw('2', '-o', 'c.#.exr', *MOVING, '--set', 'motion.objects=400')
        self.assertFalse(Exr(self.read('a.2.exr')).pixels == Exr(self.read('c.2.exr')).pixels)


class Words(Frames):
    def test_bad_ranges(self):
        for frames, names in (
                ('1:5', ['A-BxN', "':'"]), ('', ['A-B']), ('1-', ['A-B']), ('1,,2', ['A-B']),
                ('1-5x0', ['step']), ('1-5x-2', ['step']), ('1-9999999', ['100000']),
                ('99999999999999999999', ['9999999']), ('9999999', ['motion.time']),
                ('-2500001', ['-2500001', 'motion.fps'])):
            self.refuse_frames(USAGE, frames, '-o', '#.exr', names=['--frames', *names])
        self.assertEqual(self.files(), [])

    def test_bad_names(self):
        for name in ('a.exr', '-', '##/a.exr', 'a%s.exr', 'a%4d.exr', '#.#.exr', '##%d.exr'):
            self.refuse_frames(USAGE, '1-2', '-o', '#.png', '-o', name, names=['--output', name])
        self.refuse_frames(USAGE, '1', '-o', '50%.png', names=['--output', '50%.png'])
        self.assertEqual(self.files(), [])

    def test_folders_are_looked_at_before_rendering(self):
        for driver in ({}, NO_DRIVER):
            self.refuse_frames(CANT_CREATE, '1-3', '-o', '#.exr', '-o', 'gone/#.png', env=driver,
                               names=['gone/1.png'])
        (self.folder / '2.exr').mkdir()
        self.refuse_frames(CANT_CREATE, '1-3', '-o', '#.exr', env=NO_DRIVER, names=['2.exr'])
        self.assertEqual(self.files(), ['2.exr'])

    def test_help(self):
        text = self.succeed('render', '--help').stdout.decode()
        self.assertRegex(text, r'(?m)^Sequence:\n +--frames .*\n +--chunk .*\n +--resume ')

    def test_quiet(self):
        for _ in range(2):
            self.assertEqual(self.draw('1-2', '-q', '--resume', '-o', '#.exr'), [])

    def stderr_of(self, *arguments):
        """As a terminal gets it."""
        ours, its = pty.openpty()
        with subprocess.Popen(command('render', 'sphere', *BARE, *arguments),
                              env=environment({}), cwd=self.folder, stderr=its) as process:
            os.close(its)
            text = b''
            try:
                while piece := os.read(ours, 4096):
                    text += piece
            except OSError:  # closed
                pass
        os.close(ours)
        self.assertEqual(process.returncode, 0, text)
        return text.decode()

    def test_a_terminal_gets_a_bar(self):
        many = ('--frames', '1-3', '--samples', '2', '-o', '#.exr')
        text = self.stderr_of(*many)
        bars = re.findall(r'\r\[#* *\] frame (\d)/3, (\d)/2 samples', text)
        self.assertEqual(bars, [(str(f), str(s)) for f in (1, 2, 3) for s in (0, 1, 2)])
        self.assertIn('\r[' + 30 * '#' + '] frame 3/3, 2/2 samples', text)
        self.assertEqual(self.stderr_of(*many, '-q'), '')
        self.assertNotIn('[', self.stderr_of('-o', 'a.exr'))


class Resume(Frames):
    """--resume draws what is not there yet, and nothing else."""
    both = ('--resume', '-o', '#.exr', '-o', '#.png')

    def setUp(self):
        super().setUp()
        self.draw('1-2', *self.both)
        self.whole = {name: self.read(name) for name in self.files()}
        self.assertEqual(list(self.whole), ['1.exr', '1.png', '2.exr', '2.png'])

    def check_redrawn(self, wanted, *arguments, frames='1-2'):
        """These files and no others are written. Returns why files could not be kept."""
        before = {name: (self.folder / name).stat().st_ino for name in self.files()}
        lines = self.draw(frames, *self.both, *arguments)
        reasons = [line for line in lines if line.startswith('firn: ')]
        said = {name: words for name, words in (line.split(': ') for line in lines
                                                if line not in reasons)}
        self.assertEqual(sorted(said), self.files())
        for name, words in said.items():
            written = before.get(name) != (self.folder / name).stat().st_ino
            self.assertEqual(written, name in wanted, name)
            self.assertEqual(words == 'up to date', name not in wanted, name)
        return reasons

    def check_whole(self):
        for name, data in self.whole.items():
            self.assertTrue(self.read(name) == data, f'{name}: other bytes')

    def test_nothing_to_do_needs_no_device(self):
        lines = self.draw('1-2', *self.both, env=NO_DRIVER)
        self.assertEqual(lines, [f'{name}: up to date' for name in self.whole])
        self.check_whole()
        self.refuse_frames(NO_DEVICE, '1-3', '-q', *self.both, env=NO_DRIVER)

    def test_missing(self):
        (self.folder / '1.png').unlink()
        self.check_redrawn(['1.png'])
        self.check_redrawn(['3.exr', '3.png'], frames='1-3')
        self.check_whole()

    def test_damaged(self):
        for name, data in self.whole.items():
            for bad in (data[:-1], data[:len(data) // 2], b'', b'firn/settings'):
                with self.subTest(name=name, size=len(bad)):
                    (self.folder / name).write_bytes(bad)
                    reasons = self.check_redrawn([name])
                    self.assertEqual(len(reasons), 1)
                    self.assertTrue(reasons[0].startswith(f'firn: {name}: '), reasons)
        self.check_whole()

    @unsanitized
    def test_other_options(self):
        for other in (('--set', 'tonemap.exposure=1'), ('--set', 'motion.time=1'),
                      ('--size', '48x64'), ('--samples', '2'), ('--refraction', 'one-sided'),
                      ('--fov', '40'), ('--background', '0,0,1'), ()):
            with self.subTest(other=other):
                self.check_redrawn(list(self.whole), *other)
                self.check_redrawn([], *other)
        self.check_whole()

    def test_other_layers(self):
        for layers in (('--aov', 'Z'), ('--aov', 'Z,N'), ('--aov', 'N'), ()):
            with self.subTest(layers=layers):
                self.check_redrawn(['1.exr', '2.exr'], *layers)
                self.check_redrawn([], *layers)
        self.check_whole()

    def test_a_file_of_another_frame(self):
        for kind in ('exr', 'png'):
            (self.folder / f'2.{kind}').write_bytes(self.whole[f'1.{kind}'])
        self.check_redrawn(['2.exr', '2.png'])
        self.check_whole()

    def test_without_it_all_are_drawn(self):
        before = [(self.folder / name).stat().st_ino for name in self.whole]
        self.draw('1-2', '-o', '#.exr', '-o', '#.png')
        for name, node in zip(self.whole, before):
            self.assertNotEqual((self.folder / name).stat().st_ino, node, name)

    def test_after_a_full_disk(self):
        """A file that cannot be written ends the sequence."""
        (self.folder / '4.exr').symlink_to('/dev/full')
        done = self.firn('render', 'sphere', *BARE, '--frames', '3-5', '-q', *self.both)
        self.assertEqual(done.returncode, WRITE, done.stderr)
        self.assertRegex(done.stderr, rb'\Afirn: 4\.exr: [^\n]*\n\Z')
        self.assertEqual(self.files(), sorted([*self.whole, '3.exr', '3.png', '4.exr']))
        (self.folder / '4.exr').unlink()
        self.check_redrawn(['4.exr', '4.png', '5.exr', '5.png'], frames='1-5')

    def test_a_single_picture(self):
        self.render('a b.exr')
        done = self.succeed('render', 'sphere', *BARE, '-o', 'a b.exr', '--resume', env=NO_DRIVER)
        self.assertEqual(done.stderr, b'a b.exr: up to date\n')


class Report(Frames):
    """--json says what became of each frame."""

    def report(self, name='report.json'):
        return json.loads(self.read(name))

    def test_drawn_then_current(self):
        words = ('--resume', '--json', 'report.json', '-o', '#.exr', '-o', '#.png')
        self.draw('2,1', *words)
        first = self.report()
        self.assertEqual((first['code'], first['scene']), (0, 'sphere'))
        self.assertEqual([(f['frame'], f['state'], f['files']) for f in first['frames']],
                         [(2, 'drawn', ['2.exr', '2.png']), (1, 'drawn', ['1.exr', '1.png'])])
        for frame in first['frames']:
            self.assertGreater(frame['seconds'], 0)
            self.assertRegex(frame['hash'], r'\A[0-9a-f]{16}\Z')
        self.draw('1-3', *words)
        again = {f['frame']: f for f in self.report()['frames']}
        self.assertEqual([again[i]['state'] for i in (1, 2, 3)], ['current', 'current', 'drawn'])
        self.assertEqual([again[f['frame']]['hash'] for f in first['frames']],
                         [f['hash'] for f in first['frames']])
        self.assertEqual(len({f['hash'] for f in again.values()}), 3)  # of different times
        self.draw('1', *words, '--fov', '40')
        self.assertNotEqual(self.report()['frames'][0]['hash'], again[1]['hash'])

    def test_to_stdout(self):
        done = self.succeed('render', 'sphere', *BARE, '-q', '-o', 'a.exr', '--json', '-')
        self.assertEqual(json.loads(done.stdout)['frames'][0]['files'], ['a.exr'])
        self.refuse(USAGE, 'render', 'sphere', *BARE, '-o', '-', '--json', '-', names=['stdout'])
        self.refuse(CANT_CREATE, 'render', 'sphere', *BARE, '--json', 'gone/a', env=NO_DRIVER,
                    names=['gone/a'])

    def test_a_name_that_is_no_text(self):
        name = b'\xff.exr'.decode(errors='surrogateescape')
        done = self.firn('render', 'sphere', *BARE, '-o', name, '--json', 'report.json')
        self.assertEqual(done.returncode, 0)
        self.assertEqual(self.report()['frames'][0]['files'], ['?.exr'])

    def test_a_frame_that_cannot_be_stored(self):
        """The first failed frame ends the sequence, because the next ones would fail, too."""
        words = ('render', 'sphere', *BARE, '-q', '--frames', '1-3', '--json', 'report.json')
        with socket.socket(socket.AF_UNIX) as server:
            os.chdir(self.folder)
            self.addCleanup(os.chdir, '/')
            server.bind('2.exr')  # looks as if it could be written to
            self.refuse(CANT_CREATE, *words, '-o', '#.exr', names=['2.exr'])
        self.assertEqual([f['state'] for f in self.report()['frames']],
                         ['drawn', 'failed', 'left'])
        self.assertEqual(self.report()['code'], CANT_CREATE)

    def test_an_end_before_the_end(self):
        (self.folder / '2.exr').symlink_to('/dev/full')
        done = self.firn('render', 'sphere', *BARE, '--frames', '1-3', '-o', '#.exr', '--json',
                         'report.json')
        self.assertEqual(done.returncode, WRITE)
        self.assertEqual([f['state'] for f in self.report()['frames']],
                         ['drawn', 'failed', 'left'])


class Together(Frames):
    """Processes that know nothing of each other write the same files."""

    def test_the_same_frames(self):
        self.draw('1-6', '-o', 'alone.#.exr')
        for more in ((), ('--resume',)):
            words = command('render', 'sphere', *BARE, '--frames', '1-6', '-o', '#.exr')
            racers = [subprocess.Popen([*words, *more], env=environment({}), cwd=self.folder,
                                       stderr=subprocess.PIPE) for _ in range(3)]
            for racer in racers:
                said = racer.communicate(timeout=120)[1]
                self.assertEqual(racer.returncode, 0, said)
        for i in range(1, 7):
            self.assertTrue(self.read(f'{i}.exr') == self.read(f'alone.{i}.exr'), i)
        self.assertEqual(len(self.files()), 12)  # and no temporaries


class Stop(Frames):
    """A signal ends the program, and leaves only whole files."""

    def start(self, *arguments, handlers=(), stderr=subprocess.PIPE):
        def prepare():
            for number in (signal.SIGHUP, signal.SIGINT, signal.SIGTERM, signal.SIGUSR1):
                signal.signal(number, dict(handlers).get(number, signal.SIG_DFL))
        process = subprocess.Popen(
            command('render', 'sphere', *arguments), env=environment({}), cwd=self.folder,
            stdin=subprocess.DEVNULL, stderr=stderr, preexec_fn=prepare)
        if process.stderr:
            self.addCleanup(process.stderr.close)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        return process

    def wait_for(self, process, names):
        while not all((self.folder / name).exists() for name in names):
            self.assertIsNone(process.poll(), 'it ended too early')
            time.sleep(0.001)

    def check_whole_files(self, count):
        names = self.files()
        self.assertGreaterEqual(len(names), count)
        for name in names:
            self.assertRegex(name, r'\A\d+\.exr\Z')  # and nothing temporary
            data = self.read(name)
            self.assertEqual(Exr(data).end, len(data), name)

    def test_in_a_sequence(self):
        for number, code in ((signal.SIGTERM, 143), (signal.SIGINT, 130), (signal.SIGHUP, 129)):
            process = self.start(*BARE, '--frames', LONG, '-q', '-o', f'{code}#.exr')
            self.wait_for(process, [f'{code}3.exr'])
            process.send_signal(number)
            self.assertEqual(process.wait(60), code, process.stderr.read())
            self.assertEqual(process.stderr.read(), b'')
        self.check_whole_files(9)

    def test_to_be_started_again(self):
        """SIGUSR1 of a batch system: with 75, and a report of what is left."""
        process = self.start(*BARE, '--frames', LONG, '-q', '-o', '#.exr', '--json', 'report.txt')
        self.wait_for(process, ['3.exr'])
        process.send_signal(signal.SIGUSR1)
        self.assertEqual(process.wait(60), 75, process.stderr.read())
        report = json.loads((self.folder / 'report.txt').read_text())
        self.assertEqual(report['code'], 75)
        states = [f['state'] for f in report['frames']]
        self.assertEqual(sorted(states), states)  # drawn, then left
        self.assertEqual(len(states), 9999)
        (self.folder / 'report.txt').unlink()
        count = len(self.files())
        self.assertIn(count - states.count('drawn'), (0, 1))  # one is written, not yet counted
        self.check_whole_files(3)

    def test_within_a_file(self):
        """The file is finished first."""
        process = self.start('--size', '256x256', '--aov', 'all', '--frames', LONG, '-o', '#.exr')
        while not any(name.endswith('.tmp') for name in os.listdir(self.folder)):
            self.assertIsNone(process.poll())
        process.send_signal(signal.SIGTERM)
        self.assertEqual(process.wait(60), 143)
        self.check_whole_files(1)

    def test_within_a_frame(self):
        ours, its = pty.openpty()
        self.addCleanup(os.close, ours)
        process = self.start('--size', '256x256', '--samples', '65536', '-o', 'a.exr', stderr=its)
        os.close(its)
        while b'1/65536' not in os.read(ours, 4096):
            self.assertIsNone(process.poll())
        process.send_signal(signal.SIGTERM)
        self.assertEqual(process.wait(60), 143)
        self.assertEqual(self.files(), [])

    def test_to_a_pipe_that_nobody_reads(self):
        os.mkfifo(self.folder / 'pipe.exr')
        process = self.start(*BARE, '--resume', '-o', 'first.exr', '-o', 'pipe.exr')
        self.wait_for(process, ['first.exr'])
        process.send_signal(signal.SIGTERM)
        self.assertEqual(process.wait(60), 143)

    def test_an_ignored_signal_stays_ignored(self):
        process = self.start(*BARE, '--frames', '1-4', '-q', '-o', '#.exr',
                             handlers={signal.SIGINT: signal.SIG_IGN})
        self.wait_for(process, ['1.exr'])
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(60), 0)
        self.check_whole_files(4)

    def test_resume_goes_on(self):
        process = self.start(*BARE, '--frames', LONG, '-q', '-o', '#.exr')
        self.wait_for(process, ['2.exr'])
        process.send_signal(signal.SIGTERM)
        self.assertEqual(process.wait(60), 143)
        count = len(self.files())
        lines = self.draw(f'1-{count + 1}', '-o', '#.exr', '--resume')
        self.assertEqual([line.endswith(': up to date') for line in lines],
                         count * [True] + [False])


if __name__ == '__main__':
    main()
