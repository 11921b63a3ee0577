"""test_profile.py: firn profile, as a user runs it. Usage: see case.py; FAKE_RENDERDOC names a
library that answers as RenderDoc's does."""
import csv
import json
import math
import os
import sys
import unittest

sys.dont_write_bytecode = True  # the source tree stays clean
from case import (  # noqa: E402
    CANT_CREATE, DATA, NO_DEVICE, NO_DRIVER, NO_INPUT, SMALL, USAGE, Case, main, unsanitized)
from gltf_file import boxes, glass  # noqa: E402

# On a busy machine the test of timestamps is repeated, unless they are not used.
SUBMITS = ('--clock', 'submits')
QUICK = (*SMALL, '--runs', '4', '--warmup', '1', '--set', 'env_cube.dynamic=off', *SUBMITS)
CUBE = ('--set', 'env_cube.dynamic=on')


class Profile(Case):
    def profile(self, *arguments, **how):
        return self.succeed('profile', 'sphere', *QUICK, *arguments, **how)

    def json(self, *arguments):
        return json.loads(self.profile('--json', '-', *arguments).stdout)

    def read_json(self, name):
        return json.loads((self.folder / name).read_text(encoding='utf-8'))


class OneFrame(Profile):
    def test_all_reports_of_one_frame(self):
        done = self.profile(*CUBE, '-r', 'paper', '--json', 'a.json', '--csv', 'a.csv', '--trace',
                            't.json')
        self.assertEqual(self.files(), ['a.csv', 'a.json', 't.json'])
        self.assertTrue(done.stdout.startswith(b'sphere, paper, ice, 64x48\n'))
        self.check_table(done.stdout.decode().splitlines())
        self.check_json(self.read_json('a.json'))
        self.check_csv()
        self.check_trace(self.read_json('t.json')['traceEvents'])

    def check_table(self, lines):
        self.assertLessEqual(max(map(len, lines)), 100)
        for word in ('pass', 'refract_paper.color', 'env_cube.sky x6', 'record', 'submit',
                     'unattributed', 'frame', 'clock:', 'measurement overhead:'):
            self.assertTrue(any(line.startswith(word) for line in lines), word)

    def check_json(self, found):
        self.assertEqual((found['scene'], found['rung'], found['material']),
                         ('sphere', 'paper', 'ice'))
        self.assertEqual((found['width'], found['height'], found['run_count']), (64, 48, 4))
        self.assertIn('firn profile sphere', found['command'])
        self.assertEqual({one['name']: one['value'] for one in found['settings']}['bubbles.count'],
                         '0')
        self.assertFalse(any(row['name'].startswith('cracks') for row in found['rows']))
        rows = {row['name']: row for row in found['rows']}
        self.assertEqual(rows['ice_normal.back']['triangles'], 960)
        self.assertEqual(rows['tonemap.screen']['covered'], 64 * 48)
        self.check_sums(found)

    def check_sums(self, found):
        for run, frame in enumerate(found['frame']['ms']):
            rows = sum(row['ms'][run] for row in found['rows'])
            self.assertAlmostEqual(rows, frame, delta=1e-6 * frame)

    def check_csv(self):
        with open(self.folder / 'a.csv', encoding='utf-8', newline='') as file:
            rows = list(csv.DictReader(file))
        self.assertEqual({row['run'] for row in rows}, set('0123'))
        self.assertIn('refract_paper.color', {row['row'] for row in rows})
        self.assertTrue(all(math.isfinite(float(row['ms'])) for row in rows))

    def check_trace(self, events):
        self.assertEqual({event['ph'] for event in events}, {'X', 'M', 'C'})
        names = [event['name'] for event in events if event['ph'] == 'X']
        self.assertEqual(names.count('refract_paper.color'), 8)  # drawn and recorded, 4 runs
        for event in events:
            self.assertIn('pid', event)
            if event['ph'] == 'X':
                self.assertTrue(math.isfinite(event['ts']) and event['dur'] >= 0)
                self.assertIn('tid', event)

    def test_the_slowest_pass_first(self):
        lines = self.profile('-r', 'paper', '--sort').stdout.decode().splitlines()
        first = next(i for i, line in enumerate(lines) if line.startswith('pass ')) + 1
        rows = lines[first:lines.index('', first)]
        medians = [float(row[32:].split()[0]) for row in rows]
        self.assertEqual(rows[-1][:6], 'frame ')
        self.assertGreater(len(medians), 5)
        self.assertEqual(medians[:-1], sorted(medians[:-1], reverse=True))

    def test_objects_are_added_up(self):
        (self.folder / 'two.gltf').write_text(boxes((glass(1.5), [-1.5, 0, 0], 1),
                                                    (glass(2), [1.5, 0, 0], 1)))
        text = self.succeed('profile', 'two.gltf', *QUICK, '-r', 'bounce').stdout.decode()
        self.assertIn('\nrefract_bounce.color x2 ', text)
        self.assertNotIn('color.1', text)

    @unsanitized
    def test_the_clock_that_is_asked_for(self):
        for clock in ('timestamps', 'submits'):
            found = self.json('--clock', clock, '--time-step', '0.5', '--set', 'motion.time=2',
                              '--set', 'cracks.count=2')
            self.assertEqual(found['clock'], clock)
            self.check_sums(found)
            self.assertEqual((found['time'], found['time_step']), (2, 0.5))
            self.assertTrue(any(row['name'].startswith('cracks') for row in found['rows']))

    def test_validated(self):
        self.assertEqual(self.profile('--validate', '-q').stderr, b'')


class Baseline(Profile):
    def compare(self, *arguments):
        done = self.firn('profile', 'sphere', *QUICK, '--runs', '12', '--baseline',
                         'a.json', *arguments)
        self.assertIn(done.returncode, (0, 1), done.stderr)
        return done.returncode, done.stdout.decode()

    @unsanitized
    def test_against_itself_and_faster(self):
        self.profile('--json', 'a.json', '--runs', '12')
        code, text = self.compare('--set', 'bubbles.count=3')
        self.assertIn('Mann-Whitney', text)
        self.assertIn('bubbles.count', text)  # other conditions are named
        slower = any(line.endswith(' slower') for line in text.splitlines())
        self.assertEqual(code, slower)
        found = self.read_json('a.json')  # a hundred times as fast
        for part in (*found['rows'], found['frame'], found['plain'], found['wait']):
            for key in ('ms', 'begin_ms', 'record_ms'):
                part.update({key: [value / 100 for value in part[key]]} if key in part else {})
        (self.folder / 'a.json').write_text(json.dumps(found), encoding='utf-8')
        code, text = self.compare()
        self.assertEqual(code, 1)
        self.assertIn('slower', text)

    def test_too_few_runs(self):
        self.profile('--json', 'a.json')
        done = self.firn('profile', 'sphere', *QUICK, '--baseline', 'a.json')
        self.assertEqual(done.returncode, USAGE)
        self.assertIn(b'with at least --runs', done.stderr)

    def test_bad(self):
        (self.folder / 'a.json').write_text('{"format": 2, "type": "profile"}', encoding='utf-8')
        self.refuse(DATA, 'profile', 'sphere', '--baseline', 'a.json', names=('a.json',))
        self.refuse(NO_INPUT, 'profile', 'sphere', '--baseline', 'b.json', names=('b.json',))


class Sweep(Profile):
    def test_settings(self):
        text = self.profile('--sweep', 'cracks.count=0,4', '--csv', 's.csv').stdout.decode()
        lines = {line.split()[0]: line.split()[1:] for line in text.splitlines()}
        self.assertEqual(lines['cracks.count'], ['0', '4'])
        self.assertEqual(lines['cracks.color'][0], '-')
        with open(self.folder / 's.csv', encoding='utf-8', newline='') as file:
            rows = list(csv.DictReader(file))
        found = {(row['cracks.count'], row['row']): float(row['median_ms']) for row in rows}
        self.assertEqual(f"{found['4', 'cracks.color']:.3f}", lines['cracks.color'][1])
        self.assertEqual([f"{found[count, 'frame']:.3f}" for count in '04'], lines['frame'])

    def test_options_and_products(self):
        done = self.profile('--sweep', 'size=32x32,64x64', '--sweep', 'refraction=paper,one-sided',
                            '--json', 's.json')
        self.assertIn(b'one-sided', done.stdout)
        found = self.read_json('s.json')
        self.assertEqual(found['type'], 'sweep')
        self.assertEqual([point['values'] for point in found['points']],
                         [['32x32', 'paper'], ['32x32', 'one-sided'], ['64x64', 'paper'],
                          ['64x64', 'one-sided']])
        self.assertEqual(found['points'][2]['profile']['height'], 64)
        names = [{row['name'] for row in point['profile']['rows']} for point in found['points']]
        self.assertIn('refract_one_sided.color', names[1])
        self.assertNotIn('refract_one_sided.color', names[0])

    def test_refused(self):
        for sweep, name in (('cracks.count', 'cracks.count'), ('cracks.cont=1,2', 'cracks.cont'),
                            ('cracks.count=1,many', 'many'), ('size=3', 'size')):
            self.refuse(USAGE, 'profile', 'sphere', '--sweep', sweep, names=(name,))
        for words in (('--trace', 'a.json'), ('--sort',)):
            self.refuse(USAGE, 'profile', 'sphere', '--sweep', 'air.count=1', *words,
                        names=words[:1])


class Startup(Profile):
    def test_table_and_json(self):
        done = self.succeed('profile', 'sphere', *SMALL, '--startup', '--json', 's.json')
        found = self.read_json('s.json')
        self.assertEqual((found['type'], found['scene'], found['rung'], found['width']),
                         ('startup', 'sphere', 'paper', 64))
        phases = {phase['name']: phase for phase in found['phases']}
        rows = [line.split()[0] for line in done.stdout.decode().splitlines()[3:]]
        self.assertEqual(rows, [*phases, 'start'])
        for name in ('scene', 'device', 'pipelines', 'first_sample', 'next_sample'):
            self.assertGreater(phases[name]['cpu'], 0, name)
            self.assertGreater(phases[name]['wall'], 0, name)
        self.assertIsNone(phases['photons']['cpu'])

    def test_reader_and_bvh(self):
        (self.folder / 'box.gltf').write_text(boxes((glass(), [0, 0, 0], 1)))
        done = self.succeed('profile', 'box.gltf', *SMALL, '--startup', '-r', 'trace', '--json',
                            '-', '--no-cache')
        phases = {phase['name']: phase for phase in json.loads(done.stdout)['phases']}
        self.assertGreater(phases['reader']['cpu'], 0)
        self.assertGreater(phases['bvh']['wall'], 0)

    def test_refused(self):
        self.refuse(USAGE, 'profile', 'sphere', '--startup', '--csv', 'a.csv', names=('--startup',))


class Refused(Profile):
    def test_words(self):
        for words, name in ((('--runs', '0'), '--runs'), (('--warmup', '-1'), '--warmup'),
                            (('--clock', 'sundial'), 'sundial'), (('--time-step', 'x'), 'x'),
                            (('--json', '-', '--csv', '-'), 'stdout'),
                            (('--samples', '2'), '--samples'),
                            (('--threshold', '3'), '--baseline')):
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

    @unittest.skipIf('FAKE_RENDERDOC' not in os.environ, 'built without RenderDoc')
    def test_brackets_one_frame(self):
        env = {'LD_PRELOAD': os.environ['FAKE_RENDERDOC'],
               'ASAN_OPTIONS': os.environ.get('ASAN_OPTIONS', '') + ':verify_asan_link_order=0'}
        words = self.profile('--capture', env=env).stderr.decode().splitlines()
        self.assertEqual([word for word in words if 'capture' in word],
                         ['capture begins', 'capture ends',
                          'RenderDoc has captured a frame: /captures/frame 1.rdc'])


if __name__ == "__main__":
    main()
