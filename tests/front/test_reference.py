"""test_reference.py: firn render --refraction reference, as a user runs it. Usage: see case.py.

With --without after FIRN: of a build that cannot trace.
"""
import re
import signal
import subprocess
import sys
import time

sys.dont_write_bytecode = True  # the source tree stays clean
from case import (  # noqa: E402
    DATA, NO_DEVICE, NO_DRIVER, SMALL, USAGE, Case, environment, main, unsanitized)
from exr_file import Exr  # noqa: E402

TRACED = ('--refraction', 'reference')
LAYERS = ('Z', 'N.X', 'N.Y', 'N.Z', 'P.X', 'P.Y', 'P.Z',
          'albedo.R', 'albedo.G', 'albedo.B', 'object.Z', 'motion.X', 'motion.Y',
          'exit.X', 'exit.Y', 'exit.Z',
          'refraction.R', 'refraction.G', 'refraction.B',
          'reflection.R', 'reflection.G', 'reflection.B', 'fresnel.Z', 'path.Z', 'bounces.Z',
          'tir.Z', 'object.last.Z', 'inclusions.Z', 'remaining.R', 'remaining.G', 'remaining.B',
          'error.Z')
SMOOTH = [word for name in ('cracks.count', 'air.count', 'bubbles.count', 'bump.strength',
                            'light.count') for word in ('--set', f'{name}=0')]


class Both(Case):
    """Whether it can trace or not."""

    def test_it_is_listed(self):
        text = self.succeed('list', 'rungs', env=NO_DRIVER).stdout.decode()
        self.assertRegex(text, r'(?m)^ +reference .*\bCPU\b')
        layers = self.succeed('list', 'layers', env=NO_DRIVER).stdout.decode()
        self.assertRegex(layers, r'(?m)^ +remaining .*\(only with --refraction reference\)$')
        self.assertEqual(layers.count('only with'), 3)

    def test_layers_that_are_not_made(self):
        for option in ('--aov', '--show'):
            for name in ('cracks', 'air', 'bubbles', 'back.N', 'thickness', 'intervals'):
                self.refuse(USAGE, 'render', 'sphere', *TRACED, option, name, '-o', 'a.exr',
                            '-o', 'a.png', names=[option, name, 'reference'])
            self.refuse(USAGE, 'render', 'sphere', option, 'remaining', '-o', 'a.exr',
                        '-o', 'a.png', names=[option, 'remaining', 'bounce'])
        self.refuse(USAGE, 'render', 'sphere', *TRACED, '--aov', 'all,cracks', names=['cracks'])
        self.assertEqual(self.files(), [])

    def test_other_commands_do_not_trace(self):
        for command in ('graph', 'view', 'profile'):
            self.refuse(USAGE, command, 'sphere', *TRACED, names=['reference', 'render'],
                        env=NO_DRIVER)
        self.refuse(USAGE, 'profile', 'sphere', '--sweep', 'refraction=paper,reference',
                    names=['reference', 'render'], env=NO_DRIVER)

    def test_bad_settings(self):
        for assignment in ('reference.cutoff=2', 'reference.bounces=0', 'reference.bounces=257',
                           'reference.normals=smooth', 'absorb.red=-1', 'refract.dispersion=-1'):
            name, value = assignment.split('=')
            self.refuse(USAGE, 'render', 'sphere', *TRACED, '--set', assignment,
                        names=[name, value])

    def test_limits_of_other_rungs(self):
        self.refuse(USAGE, 'render', 'sphere', '--keep-sums', env=NO_DRIVER,
                    names=['--keep-sums', 'reference'])
        for outputs in (('a.png',), ('-',)):
            self.refuse(USAGE, 'render', 'sphere', *TRACED, '--keep-sums', '-o', *outputs,
                        names=['--keep-sums', '.exr'])
        self.refuse(USAGE, 'render', 'sphere', *TRACED, '--keep-sums', '-o', 'a.exr', '-o',
                    'a.sums.exr', names=['a.sums.exr', '--output'])
        self.assertEqual(self.files(), [])
        for option, values in (('--noise', ('0', '1', '-1', 'nan', 'low', '.1,.2')),
                               ('--time', ('0', '-1', 'inf', 'nan', '1m', ''))):
            for value in values:
                self.refuse(USAGE, 'render', 'sphere', *TRACED, option, value,
                            names=[option, f"'{value}'"])
            self.refuse(USAGE, 'render', 'sphere', option, '0.1', env=NO_DRIVER,
                        names=[option, 'reference', '--samples'])


class Without(Case):
    def test_it_says_so(self):
        self.refuse(NO_DEVICE, 'render', 'sphere', *SMALL, *TRACED, '-o', 'a.exr',
                    names=['reference', 'Embree'])
        self.assertEqual(self.files(), [])


class With(Case):
    def trace(self, output, *arguments):
        self.succeed('render', 'sphere', *SMALL, *TRACED, '-q', '-o', output, *arguments,
                     env=NO_DRIVER)
        return (self.folder / output).read_bytes()

    def test_no_device_is_needed(self):
        picture = Exr(self.trace('a.exr', '-o', 'a.png', '--samples', '2', '--aov', 'all'))
        self.assertEqual(picture.size, (64, 48))
        expected = {**dict.fromkeys('RGBA', 'half'), **dict.fromkeys(LAYERS, 'float'),
                    'depths.0': 'float', 'object.Z': 'uint', 'object.last.Z': 'uint'}
        self.assertEqual({name: picture.channels.get(name) for name in expected}, expected)
        self.assertRegex(picture.text('firn/device'), r'\AEmbree \d+\.\d+\.\d+\Z')
        self.assertRegex(picture.text('firn/settings'), r'refraction=reference .*samples=2\b')
        self.assertEqual((self.folder / 'a.png').read_bytes()[:8], b'\x89PNG\r\n\x1a\n')

    def test_the_same_bytes(self):
        self.assertTrue(self.trace('a.exr', '--aov', 'all') == self.trace('b.exr', '--aov', 'all'))
        other = self.trace('c.exr', '--aov', 'all', '--set', 'absorb.green=0.5')
        self.assertFalse(Exr(self.trace('a.exr')).pixels == Exr(other).pixels)

    def test_a_limit_of_noise(self):
        words = self.succeed('render', 'sphere', *SMALL, *TRACED, '--noise', '0.01', '-o', 'a.exr',
                             '-o', 'a.png', '--aov', 'error', env=NO_DRIVER).stderr.decode()
        count, noise = re.search(r'a\.exr: 64x48, (\d+) samples, noise (\S+)\n', words).groups()
        picture = Exr((self.folder / 'a.exr').read_bytes())
        self.assertEqual(picture.text('firn/samples'), count)
        self.assertAlmostEqual(float(picture.text('firn/noise')), float(noise), 4)
        self.assertLessEqual(float(noise), 0.01)
        self.trace('b.exr', '--samples', count, '--aov', 'error', '-o', 'b.png')
        for kind in ('exr', 'png'):
            self.assertTrue((self.folder / f'a.{kind}').read_bytes() ==
                            (self.folder / f'b.{kind}').read_bytes(), kind)

        def again(*limits):
            return self.succeed('render', 'sphere', *SMALL, *TRACED, '--resume', '-o', 'a.exr',
                                '--aov', 'error', *limits, env=NO_DRIVER).stderr.decode()
        self.assertIn('up to date', again('--noise', '0.01'))
        self.assertIn('up to date', again('--noise', '0.02', '--samples', count))
        self.assertIn('up to date', again('--samples', count))
        self.assertNotIn('up to date', again('--noise', str(float(noise) / 2)))
        self.assertNotIn('up to date', again('--samples', '3'))
        self.assertIn('1 sample\n', again('--time', '0.001', '--samples', '1'))

    def same(self, one, other):
        self.assertTrue((self.folder / one).read_bytes() == (self.folder / other).read_bytes(),
                        f'{one} {other}')

    def test_more_samples_later(self):
        kept = ('--keep-sums', '--aov', 'error,remaining,exit')
        self.trace('a.exr', *kept, '--samples', '3')
        self.trace('a.exr', *kept, '--samples', '21', '--resume', '-o', 'a.png')
        self.trace('b.exr', *kept, '--samples', '21', '-o', 'b.png')
        self.trace('c.exr', *kept[1:], '--samples', '21')
        for name in ('a.exr', 'a.sums.exr', 'a.png'):
            self.same(name, name.replace('a', 'b', 1))
        self.same('a.exr', 'c.exr')
        (self.folder / 'a.exr').unlink()  # what is summed is not traced again
        self.trace('a.exr', *kept, '--samples', '21', '--resume')
        self.same('a.exr', 'b.exr')
        self.trace('a.exr', *kept, '--noise', '0.3', '--samples', '30', '--resume')
        self.same('a.exr', 'b.exr')

    def test_each_frame_has_sums(self):
        self.succeed('render', 'sphere', *SMALL, *TRACED, '--keep-sums', '-o', 'a.##.exr',
                     '--frames', '1-2', env=NO_DRIVER)
        self.assertEqual(self.files(), ['a.01.exr', 'a.01.sums.exr', 'a.02.exr', 'a.02.sums.exr'])

    def test_a_picture_that_was_interrupted(self):
        long = ('render', 'sphere', *SMALL, *TRACED, '--keep-sums', '-o', 'a.exr', '--aov', 'all')
        for signal_ in (signal.SIGKILL, signal.SIGTERM):
            with self.subTest(signal=signal_), subprocess.Popen(
                    [self.program, *long, '-n', '65536'], cwd=self.folder,
                    env=environment(NO_DRIVER), stderr=subprocess.DEVNULL) as running:
                late = time.monotonic() + 200
                while not (self.folder / 'a.sums.exr').exists() and time.monotonic() < late:
                    time.sleep(0.01)
                running.send_signal(signal_)
            self.assertFalse((self.folder / 'a.exr').exists())
            sums = Exr((self.folder / 'a.sums.exr').read_bytes())
            count = str(int(sums.text('firn/samples')) + 3)
            self.succeed(*long, '-n', count, '--resume', env=NO_DRIVER)
            self.trace('b.exr', '-n', count, '--aov', 'all')
            self.same('a.exr', 'b.exr')
            for name in ('a.exr', 'a.sums.exr'):
                (self.folder / name).unlink()

    def test_sums_of_another_picture(self):
        self.trace('a.exr', '--keep-sums', '--samples', '2')
        again = ('render', 'sphere', *SMALL, *TRACED, '--keep-sums', '--resume', '-q',
                 '-o', 'a.exr')
        kept = (self.folder / 'a.sums.exr').read_bytes()
        for words, names in (
                (('-n', '3', '--set', 'absorb.red=2'), ['an image with', 'absorb.red=2']),
                (('-n', '3', '--eye', '1,2,3'), ['an image with', 'eye=1,2,3']),
                (('-n', '3', '--size', '65x48'), ['an image with', 'size=65x48']),
                (('-n', '3', '--aov', 'refraction'), ['refraction.R', '--aov']),
                (('-n', '1'), ['2 samples', '--samples'])):
            self.refuse(DATA, *again, *words, names=['a.sums.exr', '--resume', *names],
                        env=NO_DRIVER)
        picture = (self.folder / 'a.exr').read_bytes()
        for bad, names in ((picture, ['brightness']), (kept[:5000], []), (b'', []),
                           (kept.replace(b'firn/samples', b'firn/simples'), ['--keep-sums'])):
            (self.folder / 'a.sums.exr').write_bytes(bad)
            self.refuse(DATA, *again, '-n', '3', names=['a.sums.exr', *names], env=NO_DRIVER)
        self.assertTrue(picture == (self.folder / 'a.exr').read_bytes())

    def test_light_that_was_not_followed(self):
        def words(*arguments):
            return self.succeed('render', 'sphere', *SMALL, *SMOOTH, *TRACED, *arguments,
                                '--set', 'reference.bounces=1', '--set',
                                'reference.russian_roulette=off', env=NO_DRIVER).stderr.decode()
        said = words('--frames', '1-2', '-o', 'a.##.exr')
        self.assertRegex(said, r'(?m)^firn: warning: .* 1 of .* in \d{3} pixels .*remaining.*'
                               r'reference\.bounces')
        self.assertEqual(said.count('warning'), 1, said)
        self.assertEqual(words('-q'), '')

    def test_one_layer_as_png(self):
        self.trace('path.png', '--show', 'path')
        self.assertEqual(self.files(), ['path.png'])

    def test_a_sequence_resumes(self):
        frames = ('render', 'sphere', *SMALL, *TRACED, '--frames', '1-3', '-o', 'a.##.exr')
        self.succeed(*frames, env=NO_DRIVER)
        first = (self.folder / 'a.02.exr').read_bytes()
        (self.folder / 'a.02.exr').unlink()
        said = self.succeed(*frames, '--resume', env=NO_DRIVER).stderr.decode()
        self.assertEqual(said.count('up to date'), 2)
        self.assertTrue(first == (self.folder / 'a.02.exr').read_bytes())

    @unsanitized
    def test_an_eye_in_the_pool(self):
        """What the rasteriser draws from below: Snell's window, the mirror around it, the tiles,
        and light on floor and walls."""
        words = ('render', 'pool', '--size', '48x36', '--pixel-filter', 'point', '--samples', 1,
                 '-q', '--fov', 100, '--set', 'reference.photons=200000', '-o', 'a.exr')
        room, floe = ('0.3,-0.7,0.4', '0,0,-0.6'), ('1.2,-0.5,0.9', '0,-0.3,0')
        for (eye, target), ice, light, limit in ((room, 0, 'none', 0.02), (floe, 1, 'none', 0.04),
                                                 (room, 0, 'area', 0.036)):
            more = ('--eye', eye, '--target', target, '--set', f'pool.ice={ice}',
                    '--set', f'caustics.method={light}')
            planes = []
            for rung in ((), TRACED):
                self.succeed(*words, *more, *rung)
                planes.append(Exr((self.folder / 'a.exr').read_bytes()).read_planes('RGB'))
            pairs = [(a, b) for name in 'RGB' for a, b in zip(planes[0][name], planes[1][name])]
            error = sum(abs(min(a, 1) - min(b, 1)) for a, b in pairs) / len(pairs)
            self.assertLess(error, limit)

    def test_a_pool(self):
        words = ('render', 'pool', '--size', '32x24', *TRACED, '--set', 'reference.photons=5000')
        for ice in ('0', '1'):
            self.succeed(*words, '--set', f'pool.ice={ice}', '-o', f'{ice}.exr', env=NO_DRIVER)
        pictures = [Exr((self.folder / f'{ice}.exr').read_bytes()).pixels for ice in '01']
        self.assertNotEqual(*pictures)

    def test_what_is_left_out_is_said_once(self):
        def words(*arguments):
            return self.succeed('render', 'sphere', '--size', '64x48', *TRACED, '--frames', '1-2',
                                '-o', 'a.##.exr', *arguments, env=NO_DRIVER).stderr.decode()
        said = words()
        self.assertEqual(said.count('draws the scene without'), 1, said)
        self.assertIn('highlights', said)
        for name in ('frost', 'bubbles', 'bumps', 'cracks', 'air'):
            self.assertNotIn(name, said)
        self.assertEqual(words('-q'), '')
        self.assertNotIn('draws the scene without', words(*SMOOTH))


if __name__ == '__main__':
    if '--without' in sys.argv:
        sys.argv.remove('--without')
        del With
    else:
        del Without
    main()
