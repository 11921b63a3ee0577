"""test_profile.py: firn profile, as a user runs it. Usage: see case.py; FAKE_RENDERDOC names a
library that answers as RenderDoc's does."""
import csv
import json
import math
import os
import sys

sys.dont_write_bytecode = True  # the source tree stays clean
from case import CANT_CREATE, DATA, NO_DEVICE, NO_DRIVER, NO_INPUT, USAGE, Case, main  # noqa: E402

QUICK = ('--size', '64x48', '--runs', '4', '--warmup', '1', '--set', 'env_cube.dynamic=off')
CUBE = ('--set', 'env_cube.dynamic=on')
TIMED = ('--clock', 'timestamps')


class Profile(Case):
    def profile(self, *arguments, **how):
        return self.succeed('profile', 'sphere', *QUICK, *arguments, **how)

    def json(self, *arguments):
        return json.loads(self.profile('--json', '-', *arguments).stdout)


class OneFrame(Profile):
    def test_table(self):
        lines = self.profile(*CUBE).stdout.decode().splitlines()
        self.assertLessEqual(max(map(len, lines)), 100)
        for word in ('pass', 'refract_paper.color', 'env_cube.sky x6', 'record', 'submit',
                     'unattributed', 'frame', 'clock:', 'measuring:'):
            self.assertTrue(any(line.startswith(word) for line in lines), word)

    def test_each(self):
        text = self.profile('--each', *CUBE).stdout.decode()
        for face in range(6):
            self.assertEqual(text.count(f'\nenv_cube.sky [{face}] '), 2)  # times, then counts

    def check_sums(self, found):
        for run, frame in enumerate(found['frame']['ms']):
            rows = sum(row['ms'][run] for row in found['rows'])
            self.assertAlmostEqual(rows, frame, delta=1e-6 * frame)

    def test_json(self):
        for clock in ('timestamps', 'submits'):
            found = self.json('--clock', clock)
            self.assertEqual(found['clock'], clock)
            self.assertEqual((found['scene'], found['rung'], found['material']),
                             ('sphere', 'paper', 'ice'))
            self.assertEqual((found['width'], found['height'], found['run_count']), (64, 48, 4))
            self.assertIn('firn profile sphere', found['command'])
            self.assertEqual({one['name']: one['value'] for one in found['settings']}['air.count'],
                             '19')
            self.check_sums(found)

    def test_counts(self):
        rows = {row['name']: row for row in self.json()['rows']}
        self.assertEqual(rows['ice_normal.back']['triangles'], 960)
        self.assertEqual(rows['tonemap.screen']['covered'], 64 * 48)

    def test_settings_change_the_frame(self):
        names = {row['name'] for row in self.json('--set', 'cracks.count=0')['rows']}
        self.assertFalse(any(name.startswith('cracks') for name in names))

    def test_csv(self):
        self.profile('--csv', 'a.csv')
        with open(self.folder / 'a.csv', encoding='utf-8', newline='') as file:
            rows = list(csv.DictReader(file))
        self.assertEqual({row['run'] for row in rows}, set('0123'))
        self.assertIn('refract_paper.color', {row['row'] for row in rows})
        self.assertTrue(all(math.isfinite(float(row['ms'])) for row in rows))

    def test_trace(self):
        self.profile('--trace', 'a.json', *TIMED)
        events = json.loads((self.folder / 'a.json').read_text(encoding='utf-8'))['traceEvents']
        self.assertEqual({event['ph'] for event in events}, {'X', 'M', 'C'})
        names = [event['name'] for event in events if event['ph'] == 'X']
        self.assertEqual(names.count('refract_paper.color'), 8)  # drawn and recorded, 4 runs
        for event in events:
            self.assertIn('pid', event)
            if event['ph'] == 'X':
                self.assertTrue(math.isfinite(event['ts']) and event['dur'] >= 0)
                self.assertIn('tid', event)

    def test_page(self):
        self.profile('--html', 'a.html')
        page = (self.folder / 'a.html').read_text(encoding='utf-8')
        self.assertTrue(page.startswith('<!DOCTYPE html>') and page.endswith('</html>\n'))
        self.assertIn('"scene":"sphere"', page.replace(': ', ':'))

    def test_all_at_once(self):
        done = self.profile('--json', 'a.json', '--csv', 'a.csv', '--trace', 't.json', '--html',
                            'a.html')
        self.assertTrue(done.stdout.startswith(b'sphere, paper, ice, 64x48'))
        self.assertEqual(self.files(), ['a.csv', 'a.html', 'a.json', 't.json'])

    def test_time_step(self):
        found = self.json('--time-step', '0.5', '--set', 'motion.time=2')
        self.assertEqual((found['time'], found['time_step']), (2, 0.5))

    def test_validated(self):
        self.assertEqual(self.profile('--validate', *TIMED, '-q').stderr, b'')


class Baseline(Profile):
    def test_against_itself(self):
        self.profile('--json', 'a.json')
        done = self.firn('profile', 'sphere', *QUICK, '--baseline', 'a.json')
        text = done.stdout.decode()
        self.assertIn(done.returncode, (0, 1), done.stderr)
        self.assertIn('Mann-Whitney', text)
        slower = any(line.endswith(' slower') for line in text.splitlines())
        self.assertEqual(done.returncode, slower)

    def test_slower(self):
        """A hundred times as fast: exit code 1."""
        self.profile('--json', 'a.json', '--runs', '12')
        path = self.folder / 'a.json'
        found = json.loads(path.read_text(encoding='utf-8'))
        for part in (*found['rows'], found['frame'], found['plain'], found['wait']):
            for key in ('ms', 'begin_ms', 'record_ms'):
                part.update({key: [value / 100 for value in part[key]]} if key in part else {})
        path.write_text(json.dumps(found), encoding='utf-8')
        done = self.firn('profile', 'sphere', *QUICK, '--runs', '12', '--baseline', 'a.json')
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn('slower', done.stdout.decode())

    def test_other_conditions_are_named(self):
        self.profile('--json', 'a.json')
        done = self.firn('profile', 'sphere', *QUICK, '--baseline', 'a.json', '--set',
                         'air.count=3')
        self.assertIn('air.count', done.stdout.decode())

    def test_bad(self):
        (self.folder / 'a.json').write_text('{"format": 1, "type": "profile"}', encoding='utf-8')
        self.refuse(DATA, 'profile', 'sphere', '--baseline', 'a.json', names=('a.json',))
        self.refuse(NO_INPUT, 'profile', 'sphere', '--baseline', 'b.json', names=('b.json',))


class Sweep(Profile):
    def test_settings(self):
        text = self.profile('--sweep', 'cracks.count=1,4').stdout.decode()
        self.assertIn('cracks.count', text)
        self.assertIn('exponent', text)
        self.assertLessEqual(max(map(len, text.splitlines())), 100)

    def test_options_and_products(self):
        done = self.profile('--sweep', 'size=32x32,64x64', '--sweep', 'refraction=paper,one-sided',
                            '--json', 's.json', '--html', 's.html')
        self.assertIn(b'one-sided', done.stdout)
        found = json.loads((self.folder / 's.json').read_text(encoding='utf-8'))
        self.assertEqual(found['type'], 'sweep')
        self.assertEqual([point['values'] for point in found['points']],
                         [['32x32', 'paper'], ['32x32', 'one-sided'], ['64x64', 'paper'],
                          ['64x64', 'one-sided']])
        self.assertEqual(found['points'][2]['numbers'][0], 4096)
        names = [{row['name'] for row in point['profile']['rows']} for point in found['points']]
        self.assertIn('refract_one_sided.color', names[1])
        self.assertNotIn('refract_one_sided.color', names[0])

    def test_refused(self):
        for sweep, name in (('cracks.count', 'cracks.count'), ('cracks.cont=1,2', 'cracks.cont'),
                            ('cracks.count=1,many', 'many'), ('size=3', 'size')):
            self.refuse(USAGE, 'profile', 'sphere', '--sweep', sweep, names=(name,))
        self.refuse(USAGE, 'profile', 'sphere', '--sweep', 'air.count=1', '--csv', 'a.csv',
                    names=('--csv',))


class Paper(Profile):
    def test_table(self):
        done = self.succeed('profile', 'paper', '--size', '32x24', '--runs', '1', '--warmup', '0',
                            '--json', 'p.json')
        text = done.stdout.decode()
        for words in ('about -26 %', 'about -10 %', '148 to 67', 'teapot with cracks and air'):
            self.assertIn(words, text)
        self.assertLessEqual(max(map(len, text.splitlines())), 100)
        found = json.loads((self.folder / 'p.json').read_text(encoding='utf-8'))
        self.assertEqual(len(found['points']), 11)
        triangles = [max(row['triangles'] for row in point['profile']['rows']
                         if row['name'].startswith('refract_')) for point in found['points'][:6]]
        self.assertEqual(triangles, [960, 960, 4800, 4800, 14400, 14400])

    def test_a_fifth_and_all_of_the_screen(self):
        done = self.succeed('profile', 'paper', '--size', '256x192', '--runs', '1', '--warmup', '0')
        lines = done.stdout.decode().splitlines()
        shares = [float(line.split()[-2]) for line in lines[1:12]]
        self.assertTrue(all(19 < share < 21 for share in shares[:10]), shares)
        self.assertAlmostEqual(shares[10], 100, delta=0.1)

    def test_refused(self):
        self.refuse(USAGE, 'profile', 'paper', '--sweep', 'air.count=1', names=('--sweep',))
        self.refuse(USAGE, 'profile', 'paper', '--trace', 'a.json', names=('--trace',))


class Refused(Profile):
    def test_words(self):
        for words, name in ((('--runs', '0'), '--runs'), (('--warmup', '-1'), '--warmup'),
                            (('--clock', 'sundial'), 'sundial'), (('--time-step', 'x'), 'x'),
                            (('--json', '-', '--csv', '-'), 'stdout'),
                            (('--samples', '2'), '--samples')):
            self.refuse(USAGE, 'profile', 'sphere', *words, names=(name,))
        self.refuse(USAGE, 'profile', names=('SCENE',))

    def test_files(self):
        self.refuse(CANT_CREATE, 'profile', 'sphere', '--json', 'no/a.json', names=('no/a.json',))
        self.refuse(NO_INPUT, 'profile', 'no.glb', names=('no.glb',))

    def test_no_device(self):
        self.refuse(NO_DEVICE, 'profile', 'sphere', env=NO_DRIVER)

    def test_nothing_is_left_behind(self):
        self.firn('profile', 'sphere', *QUICK, '--json', 'a.json', env=NO_DRIVER)
        self.assertEqual(self.files(), [])


class Capture(Profile):
    def test_without_renderdoc(self):
        self.refuse(USAGE, 'profile', 'sphere', '--capture', names=('RenderDoc',))

    def test_brackets_one_frame(self):
        env = {'LD_PRELOAD': os.environ['FAKE_RENDERDOC'],
               'ASAN_OPTIONS': os.environ.get('ASAN_OPTIONS', '') + ':verify_asan_link_order=0'}
        words = self.profile('--capture', env=env).stderr.decode().splitlines()
        self.assertEqual([word for word in words if 'capture' in word],
                         ['capture begins', 'capture ends',
                          'RenderDoc has captured a frame: /captures/frame 1.rdc'])


main()
