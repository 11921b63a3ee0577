"""test_ladder.py: tests `firn ladder`, which compares every rung with the reference.

Usage: test_ladder.py FIRN [--without] [TEST...]   --without: firn was built without Embree
"""
import json
import pathlib
import re
import sys

sys.dont_write_bytecode = True  # the source tree stays clean
from case import (  # noqa: E402
    CANT_CREATE, DATA, NO_DEVICE, NO_DRIVER, NO_INPUT, USAGE, Case, long, main, unsanitized)
from exr_file import Exr  # noqa: E402
from gltf_file import boxes, glass  # noqa: E402
from test_show import Png  # noqa: E402

WITHOUT = '--without' in sys.argv
if WITHOUT:
    sys.argv.remove('--without')

FAILED = 1
DATA_FOLDER = pathlib.Path(__file__).parents[1] / 'data' / 'truth'
WIDTH, HEIGHT = 96, 72
SIZE = ('--size', f'{WIDTH}x{HEIGHT}')
RUNGS = ('paper', 'per-vertex', 'one-sided', 'wyman', 'search', 'bounce', 'trace')
# What firn ladder sets by itself
ALIKE = ('--set', 'cracks.count=0', '--set', 'air.count=0', '--set', 'bubbles.count=0',
         '--set', 'light.count=0', '--set', 'bump.strength=0', '--set', 'frost.amount=0',
         '--set', 'refract.fresnel=exact',
         '--set', 'refract.lookup=distance', '--set', 'env_cube.dynamic=off')


class LadderCase(Case):
    def ladder(self, *arguments, code=0):
        """What it prints as JSON; rungs by their names."""
        done = self.firn('ladder', '--json', *arguments)
        self.assertEqual(done.returncode, code, done.stderr.decode())
        said = json.loads(done.stdout)
        said['rungs'] = {rung['name']: rung for rung in said['rungs']}
        return said

    def diff(self, *arguments):
        return json.loads(self.succeed('diff', *arguments, '--json', env=NO_DRIVER).stdout)

    def near(self, got, want, tolerance):
        self.assertLessEqual(abs(got - want), tolerance, f'{got}, not {want}')


class Numbers(LadderCase):
    @unsanitized
    def test_they_are_those_of_diff(self):
        """The same pictures by themselves, compared by another command."""
        said = self.ladder('valley', *SIZE, '--validate', '--rungs', 'paper,bounce', '--runs', 0)
        for rung in ('reference', 'paper', 'bounce'):
            self.succeed('render', 'valley', *SIZE, *ALIKE, '--refraction', rung, '--aov',
                         'exit,path,bounces,tir', '-o', f'{rung}.exr')
        self.assertEqual(list(said['rungs']), ['paper', 'bounce'])
        truth = Exr((self.folder / 'reference.exr').read_bytes())
        planes = truth.read_planes(['path.Z', 'tir.Z'])
        inside = [path > 0 for path in planes['path.Z']]
        straight = [a and tir == 0 for a, tir in zip(inside, planes['tir.Z'])]
        self.assertEqual((said['object_pixels'], said['straight_pixels']),
                         (sum(inside), sum(straight)))
        for name, rung in said['rungs'].items():
            whole = self.diff('reference.exr', f'{name}.exr', '--exposure', 0)
            object_ = self.diff('reference.exr', f'{name}.exr', '--mask', 'reference.exr',
                                '--mask-channel', 'path.Z')
            self.near(rung['flip'], whole['flip']['mean'], 1e-4)
            self.near(rung['mae'], object_['mae'], 1e-4)  # files are of half floats
            self.near(rung['mae_unclipped'], object_['mae_unclipped'], 1e-3)
            self.assertGreater(rung['mae_unclipped'], rung['mae'])
            self.near(rung['rmse'], object_['rmse'], 1e-3)
            self.near(rung['tir'], object_['tir']['mismatch'], 1e-9)
            self.check_causes(said, rung, name, truth)
            self.assertIsNone(rung['cost'])
            self.assertEqual(rung['not_finite'], 0)
        self.assertLess(said['rungs']['bounce']['angle'], 1.5)
        self.assertGreater(said['rungs']['paper']['angle'], 10)
        self.assertLess(said['rungs']['bounce']['flip'], said['rungs']['paper']['flip'] / 3)

    def check_causes(self, said, rung, name, truth):
        """By the same layers: never, once and more often reflected."""
        names = [*'RGB', 'path.Z', 'bounces.Z']
        ours = truth.read_planes(names)
        test = Exr((self.folder / f'{name}.exr').read_bytes()).read_planes([*'RGB'])
        for cause, least, most in (('refracted', 0, 0), ('reflected', 1, 1), ('trapped', 2, 99)):
            inside = [i for i, (path, bounces) in enumerate(zip(ours['path.Z'], ours['bounces.Z']))
                      if path > 0 and least <= bounces <= most]
            self.assertEqual(said[f'{cause}_pixels'], len(inside))
            errors = [abs(min(max(ours[c][i], 0), 1) - min(max(test[c][i], 0), 1))
                      for c in 'RGB' for i in inside]
            if errors:
                self.near(rung[f'mae_{cause}'], sum(errors) / len(errors), 1e-4)
            else:
                self.assertIsNone(rung[f'mae_{cause}'])

    @long
    def test_with_all_that_ice_has(self):
        """Errors by what the reference's paths meet are those of pictures made one by one."""
        said = self.ladder('valley', *SIZE, '--whole', '--rungs', 'bounce', '--runs', 0,
                           '--set', 'bubbles.count=60')
        same = ('--set', 'light.count=0', '--set', 'refract.fresnel=exact', '--set',
                'refract.lookup=distance', '--set', 'env_cube.dynamic=off', '--set',
                'cracks.refract=gap', '--set', 'bubbles.count=60')
        for rung in ('reference', 'bounce'):
            self.succeed('render', 'valley', *SIZE, *same, '--refraction', rung, '--aov',
                         'path,inclusions' if rung == 'reference' else 'path', '-o', f'{rung}.exr')
        ours, test = (Exr((self.folder / f'{name}.exr').read_bytes())
                      for name in ('reference', 'bounce'))
        ours = ours.read_planes([*'RGB', 'path.Z', 'inclusions.Z'])
        test = test.read_planes([*'RGB'])
        for name, bit in (('clear', 0), ('bubbles', 1), ('cracks', 2), ('air', 4)):
            inside = [i for i, (path, met) in enumerate(zip(ours['path.Z'], ours['inclusions.Z']))
                      if path > 0 and (int(met) & bit if bit else met == 0)]
            self.assertEqual(said[f'{name}_pixels'], len(inside))
            errors = [abs(min(max(ours[c][i], 0), 1) - min(max(test[c][i], 0), 1))
                      for c in 'RGB' for i in inside]
            self.assertGreater(len(errors), 20)
            self.near(said['rungs']['bounce'][f'mae_{name}'], sum(errors) / len(errors), 1e-4)
        plain = self.ladder('valley', *SIZE, '--rungs', 'bounce', '--runs', 0)
        self.assertNotIn('clear_pixels', plain)
        for furnace in (('--furnace', '--whole'), ('--whole', '--furnace')):
            self.refuse(USAGE, 'ladder', 'valley', *furnace, names=['--whole', '--furnace'])

    def test_costs(self):
        said = self.ladder('sphere', *SIZE, '--rungs', 'one-sided,paper', '--runs', 2)
        self.assertEqual(said['rungs']['paper']['cost'], 1)
        self.assertGreater(said['rungs']['one-sided']['ms'], 0)
        self.assertGreater(said['reference_ms'], 0)

    def test_beside_another_programs_picture(self):
        self.succeed('render', 'sphere', *SIZE, *ALIKE, '--refraction', 'reference', '--aov',
                     'path', '-o', 'truth.exr')
        words = ('sphere', *SIZE, '--rungs', 'paper', '--runs', 0, '--truth', 'truth.exr')
        said = self.ladder(*words)
        self.near(said['reference_truth'], 0, 1e-3)
        self.near(said['rungs']['paper']['truth'], said['rungs']['paper']['mae'], 1e-3)
        masked = self.ladder(*words, '--mask', 'truth.exr', '--mask-channel', 'G')
        self.assertLess(masked['rungs']['paper']['truth'], said['rungs']['paper']['truth'] / 2)
        self.assertIn('truth', self.succeed('ladder', *words).stdout.decode())

    @long
    def test_the_independent_truth(self):
        """A path tracer's picture of an irregular cube in a finite landscape."""
        said = self.ladder(DATA_FOLDER / 'cube.obj', '--surroundings',
                           DATA_FOLDER / 'landscape.obj', '--size', '1024x768', '--eye',
                           '1.0526182,0.926304,4.2104725', '--target', '0,0,0', '--background',
                           '0.75,0.8,0.88', '--rungs', 'paper,bounce', '--runs', 0, '--truth',
                           DATA_FOLDER / 'truth.exr', '--mask', DATA_FOLDER / 'mask.exr')
        self.assertLessEqual(said['reference_truth'], 0.01)
        self.assertLessEqual(said['rungs']['bounce']['truth'], 0.05)
        self.assertTrue(0.13 <= said['rungs']['paper']['truth'] <= 0.17)


class Pictures(LadderCase):
    def test_files(self):
        names = ('sheet.png', 'all.exr')
        outputs = [word for name in names for word in ('-o', name)]
        done = self.succeed('ladder', 'sphere', *SIZE, '--runs', 1, *outputs)
        text = done.stdout.decode()
        self.assertEqual([line.split()[0] for line in text.splitlines()[6:14]],
                         [*RUNGS, 'reference'])
        self.assertTrue(all(len(line) <= 100 for line in text.splitlines()), text)
        self.succeed('render', 'sphere', *SIZE, *ALIKE, '--refraction', 'bounce', '-o', 'one.exr',
                     '-o', 'one.png')
        self.check_sheet()
        self.check_layers()

    def check_sheet(self):
        """Two columns of cells; that of bounce is what render draws."""
        sheet = Png((self.folder / 'sheet.png').read_bytes())
        one = Png((self.folder / 'one.png').read_bytes())
        cell, row = 330 + 16, HEIGHT + 16 + 8
        left, top = 8, 8 + 3 * row + 16
        self.assertEqual((sheet.width, sheet.height), (2 * cell, 4 * row + 8))
        for y in range(0, HEIGHT, 7):
            for x in range(0, WIDTH, 7):
                self.assertEqual(sheet[left + x, top + y], one[x, y])
        letters = sum(sheet[x, top - 14 + y] == (235, 235, 235) for x in range(left, left + 40)
                      for y in range(10))
        self.assertGreater(letters, 40)
        self.assertLess(sum(sheet[left + WIDTH + 8, top]), 60)  # hardly an error in the corner

    def check_layers(self):
        layers = Exr((self.folder / 'all.exr').read_bytes())
        self.assertEqual(set(layers.channels), {
            'R', 'G', 'B', *(f'{rung}.{end}' for rung in RUNGS
                             for end in ('R', 'G', 'B', 'flip.Z'))})
        mine = layers.read_planes(['bounce.G'])['bounce.G']
        rendered = Exr((self.folder / 'one.exr').read_bytes()).read_planes(['G'])['G']
        self.assertLess(max(abs(a - b) for a, b in zip(mine, rendered)), 2e-3)

    def test_without_costs(self):
        self.succeed('ladder', 'sphere', *SIZE, '--rungs', 'paper', '--runs', 0, '-o', 'a.png')


class Furnace(LadderCase):
    def check(self, scene):
        said = self.ladder(scene, *SIZE, '--runs', 0)
        not_finite = [rung['not_finite'] for rung in said['rungs'].values()]
        self.assertEqual(not_finite, [0] * len(RUNGS))
        text = self.succeed('ladder', scene, *SIZE, '--furnace').stdout.decode()
        rows = {line.split()[0]: line.split()[1:] for line in text.splitlines()[1:9]}
        self.assertEqual(set(rows), {'reference', *RUNGS})
        for name, (least, mean, greatest, _, remaining, off, result) in rows.items():
            self.assertEqual(result, 'passes', name)
            self.near(float(mean), 1, 2e-3)
            if name not in ('trace', 'reference'):  # whose pixels have noise
                self.near(float(greatest), 1, 1e-3)
                self.assertGreaterEqual(float(least) + float(remaining), 1 - 1e-3, name)
                self.assertEqual(off, '0')

    @long
    def test_what_takes_no_light_shows_1(self):
        self.check('valley')

    @long
    def test_a_sphere_shows_1(self):
        self.check('sphere')

    def test_what_takes_light_does_not(self):
        done = self.firn('ladder', 'sphere', *SIZE, '--furnace', '--rungs', 'bounce', '--set',
                         'absorb.red=1')
        self.assertEqual(done.returncode, FAILED)
        self.assertRegex(done.stdout.decode(), r'(?m)^bounce .* [1-9]\d* fails$')

    def test_opaque_surfaces_take_light(self):
        opaque = {'pbrMetallicRoughness': {'baseColorFactor': [0.2, 0.2, 0.2, 1]}}
        (self.folder / 'a.gltf').write_text(boxes((glass(), [0, 0, 0], 1),
                                                  (opaque, [0, -3, 0], 2)))
        done = self.firn('ladder', 'a.gltf', *SIZE, '--furnace', '--rungs', 'bounce')
        self.assertEqual(done.returncode, FAILED)
        self.assertRegex(done.stderr.decode(),
                         'warning: a.gltf: pixels .* opaque surfaces .* absorb light')


class Refused(LadderCase):
    def test_words(self):
        small = ('sphere', *SIZE)
        self.refuse(USAGE, 'ladder', *small, '--rungs', 'paper,glass',
                    names=['--rungs', 'glass'])
        self.refuse(USAGE, 'ladder', *small, '--rungs', '', names=['--rungs'])
        self.refuse(USAGE, 'ladder', *small, '--runs', '-1', names=['--runs'])
        self.refuse(USAGE, 'ladder', *small, '-o', 'a.gif', names=['a.gif', '.exr'])
        self.refuse(USAGE, 'ladder', *small, '--mask', 'a.png', names=['--truth'])
        self.refuse(USAGE, 'ladder', *small, '--refraction', 'paper', names=['--refraction'])
        self.refuse(USAGE, 'ladder', 'pool', names=['pool'])
        for word, value in (('--env', 'a.hdr'), ('--background', '1,1,1'), ('--truth', 'a.exr'),
                            ('--surroundings', 'a.obj'), ('--output', 'a.png')):
            self.refuse(USAGE, 'ladder', *small, '--furnace', word, value, names=[word])
        self.assertEqual(self.files(), [])

    def test_files(self):
        small = ('sphere', *SIZE, '--rungs', 'paper', '--runs', 0)
        self.refuse(NO_INPUT, 'ladder', 'gone.obj', names=['gone.obj'])
        self.refuse(CANT_CREATE, 'ladder', *small, '-o', 'gone/a.png', names=['gone'])
        self.refuse(NO_INPUT, 'ladder', *small, '--truth', 'gone.exr', names=['gone.exr'])
        self.succeed('render', 'sphere', '--size', '8x8', '-o', 'small.exr')
        self.refuse(DATA, 'ladder', *small, '--truth', 'small.exr', names=['8 x 8', '8x8'])

    def test_no_device(self):
        self.refuse(NO_DEVICE, 'ladder', 'sphere', *SIZE, env=NO_DRIVER)

    def test_what_the_reference_leaves_out(self):
        done = self.succeed('ladder', 'sphere', *SIZE, '--rungs', 'paper', '--runs', 0, '--set',
                            'light.count=1', '--set', 'highlight.strength=1')
        self.assertIn('highlights', done.stderr.decode())


class Without(Case):
    def test_it_says_so(self):
        self.refuse(NO_DEVICE, 'ladder', 'sphere', names=['Embree'])


if WITHOUT:
    del Numbers, Pictures, Furnace, Refused
else:
    del Without

if __name__ == '__main__':
    main()
