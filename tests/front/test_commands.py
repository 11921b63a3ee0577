"""test_commands.py: the program `firn` as a user runs it. Usage: see case.py."""
import itertools
import json
import pathlib
import re
import subprocess
import sys

sys.dont_write_bytecode = True  # the source tree stays clean
sys.path.append(str(pathlib.Path(__file__).parents[1] / 'support'))
from case import (  # noqa: E402
    BARE, CANT_CREATE, DATA, NO_DEVICE, NO_DRIVER, NO_INPUT, SMALL, USAGE, WRITE, Case, environment,
    main, unsanitized)
from exr_file import Exr  # noqa: E402
import plan_dumps  # noqa: E402

COMMANDS = ('render', 'view', 'profile', 'graph', 'diff', 'ladder', 'sheet', 'farm',
            'merge', 'info', 'selftest', 'list', 'help')


class CommandLine(Case):
    def test_help_names_every_command(self):
        text = self.succeed('--help').stdout
        for same in ('-h', 'help'):
            self.assertEqual(self.succeed(same).stdout, text)
        for command in COMMANDS:
            self.assertRegex(text.decode(), rf'(?m)^\s+(firn )?{command}\b')

    def test_version_is_one_line(self):
        version = self.succeed('--version').stdout
        self.assertRegex(version.decode(), r'\Afirn \d+\.\d+\.\d+\n\Z')
        text = self.succeed('--version', '--verbose').stdout
        self.assertTrue(text.startswith(version))
        for word in (b'compiler', b'libpng', b'assets', Case.program.encode()):
            self.assertIn(word, text)
        self.refuse(USAGE, '--version', '--verbse', names=['--verbse'])

    def test_no_command_and_no_scene(self):
        self.refuse(USAGE)
        self.refuse(USAGE, 'render', '-o', 'a.exr')
        self.refuse(USAGE, 'graph')

    def test_unknown_words_are_named(self):
        self.refuse(USAGE, 'rendr', names=['rendr', "'render'?"])
        self.refuse(USAGE, '--colour', names=['--colour'])
        self.refuse(USAGE, 'render', 'sphere', '--sise', '64x48',
                    names=['--sise', "'--size'?"])
        self.refuse(USAGE, 'graph', 'sphere', '--sise', names=['--sise'])
        self.refuse(USAGE, 'list', 'scnes', names=['scnes'])
        self.refuse(USAGE, 'render', 'sphere', '-o', 'a.exr', '--aov', 'N,depht', names=['depht'])
        self.refuse(USAGE, 'render', 'sphere', '-o', 'a.exr', '--refraction', 'papre',
                    names=['papre', "'paper'?"])
        self.refuse(USAGE, 'render', 'sphere', '-o', 'a.exr', '-r', 'slab', names=['use one-sided'])
        self.refuse(USAGE, 'graph', 'sphere', '-m', 'glas', names=['glas', "'glass'?"])
        self.assertNotIn(b'did you mean', self.firn('nosuch').stderr)

    def test_an_option_without_its_value(self):
        self.refuse(USAGE, 'render', 'sphere', '-o', names=['--output'])
        self.refuse(USAGE, 'render', 'sphere', '--size', names=['--size'])

    def test_an_output_of_unknown_kind(self):
        self.refuse(USAGE, 'render', 'sphere', *SMALL, '-o', 'a.gif', names=['a.gif'])

    def test_bad_sizes(self):
        for size in ('0x0', '12', '99999999x1', '2147483647x2', '16385x1',
                     '5x5x5', '-3x4', '4x', 'x4', '64x48 ', ''):
            self.refuse(USAGE, 'render', 'sphere', '-o', 'a.exr', '--size', size, names=[size])

    def test_places_without_a_view(self):
        for words in (('--eye', '1e12,0,0'), ('--target', '0,-1e30,0'), ('--orbit', '0,0,1e10'),
                      ('--orbit', '0,0,0'), ('--eye', '0,0,nan')):
            self.refuse(USAGE, 'render', 'sphere', '-o', 'a.exr', *words, names=words)
        for words in (('--eye', '0,3,1', '--target', '0,3,1'),
                      ('--orbit', '0,0,1e-9', '--target', '1e8,1e8,1e8')):
            self.refuse(USAGE, 'render', 'sphere', '-o', 'a.exr', *words, env=NO_DRIVER,
                        names=['--eye', '--orbit', '--target'])

    def test_bad_limits_of_reading(self):
        for option in ('--load-seconds', '--load-memory'):
            for value in ('0', '-1', '1e9', '', '2x'):
                self.refuse(USAGE, 'graph', 'sphere', option, value, names=[option, value])

    def test_an_output_is_no_other_file_in_use(self):
        """Whatever the paths are; found before any file is opened."""
        (self.folder / 'in.exr').write_bytes(b'not read')
        (self.folder / 'link.exr').symlink_to('in.exr')
        (self.folder / 'sub').mkdir()
        draw = ('render', 'sphere')
        for words, names in (
                ((*draw, '-o', 'a.exr', '-o', 'sub/../a.exr'), ['a.exr', '--output']),
                ((*draw, '-o', 'a.exr', '--json', './a.exr'), ['--output', '--json']),
                ((*draw, '--env', 'in.exr', '-o', 'link.exr'), ['link.exr', '--output', '--env']),
                (('merge', 'in.exr', 'b.exr', '-o', 'in.exr'), ["input 'in.exr'"]),
                (('merge', 'merged.exr', 'b.exr'), ["input 'merged.exr'"]),
                (('diff', 'b.exr', 'in.exr', '-o', 'sub/../in.exr'), ["input 'in.exr'"]),
                (('profile', 'sphere', '--csv', 'a', '--json', 'a'), ['--csv', '--json']),
                (('profile', 'sphere', '--baseline', 'in.exr', '--json', 'in.exr'),
                 ['--json', '--baseline']),
                (('ladder', '--truth', 'in.exr', '-o', 'in.exr'), ['--output', '--truth'])):
            self.refuse(USAGE, *words, names=names)
        self.assertEqual(self.files(), ['in.exr', 'link.exr', 'sub'])
        self.succeed('profile', 'sphere', *SMALL, '--runs', '1', '--csv', '/dev/null', '--trace',
                     '/dev/null', '--json', 'sphere', '-q')

    def test_names_cannot_command_a_terminal(self):
        for text in ('\x1b[2J', '\x9b2J', '\u202etxt.exe', '\u2066', '\u200f', '\u061c', '\x7f'):
            done = self.firn('render', f'sph{text}.glb')
            self.assertIn('sph?', done.stderr.decode())
            self.assertNotIn(text[0], done.stderr.decode())
        self.assertIn('sph\u00e4re.glb', self.firn('render', 'sph\u00e4re.glb').stderr.decode())

    def test_too_many(self):
        for *words, option, most in (('render', 'sphere', '-o', 16), ('diff', 'a', 'b', '-o', 16),
                                     ('ladder', 'sphere', '-o', 16),
                                     ('profile', 'sphere', '--sweep', 4),
                                     ('farm', 'slurm', 'sphere', '--sbatch', 16)):
            values = [f'--{i}.exr' for i in range(most + 1)]
            more = [word for value in values for word in (option, value)]
            self.refuse(USAGE, *words, *more, names=[values[-1], f'at most {most}'])

    def test_counts_and_places_that_cannot_be(self):
        for option, value in (('--samples', '0'), ('--samples', '65537'), ('--tile', '0'),
                              ('--tile', 'x')):
            self.refuse(USAGE, 'render', 'sphere', '-o', 'a.exr', option, value,
                        names=[option, value])
        self.refuse(USAGE, 'render', 'sphere', '-o', 'a.exr', '--eye', '0,0,5', '--orbit', '1,2,3',
                    env=NO_DRIVER, names=['--eye', '--orbit'])
        self.assertEqual(self.files(), [])

    def test_one_format_of_a_plan(self):
        for first, second in itertools.permutations(('--html', '--json'), 2):
            self.refuse(USAGE, 'graph', 'sphere', first, second, names=[first, second])
        self.refuse(USAGE, 'graph', 'sphere', '--json=plan', names=['--json'])
        self.refuse(USAGE, 'render', 'sphere', '-o', 'a.exr', '--json', names=['--json'])

    def test_help_fits(self):
        for command in ('graph', 'ladder', 'render', 'view'):
            text = self.succeed(command, '--help').stdout.decode()
            self.assertIn('--load-seconds', text)
            self.assertEqual([line for line in text.splitlines() if len(line) > 110], [])

    def test_bad_settings(self):
        for assignment, name in (
                ('sky.strenght=1', 'sky.strength'),  # the nearest is proposed
                ('refract_paper.back_weight=1.5', 'refract_paper.back_weight'),
                ('refract_paper.back_weight=-0.1', 'refract_paper.back_weight'),
                ('refract_paper.back_weight=nan', 'refract_paper.back_weight'),
                ('refract_paper.back_weight=ice', 'ice'),
                ('refract_paper.back_weight=0.5x', '0.5x'),
                ('refract_paper.back_weight', 'refract_paper.back_weight'),
                ('tonemap.curve=neutrl', 'neutrl')):
            self.refuse(USAGE, 'render', 'sphere', '-o', 'a.exr', '--set', assignment,
                        names=[name])
        self.assertEqual(self.files(), [])

    def test_ice_that_the_pool_is_too_small_for(self):
        for wrong in ('pool.ice=3', 'pool.ice=1.4'):  # too wide, too deep
            self.refuse(USAGE, 'render', 'pool', '--set', wrong, '-o', 'a.exr', names=[wrong])
        self.assertEqual(self.files(), [])

    def test_list(self):
        text = self.succeed('list', env=NO_DRIVER).stdout.decode()
        for name in ('valley', 'sphere', 'teapot', 'pool', 'paper', 'one-sided',
                     'refract_paper.back_weight'):
            self.assertRegex(text, rf'(?m)(^|\s){re.escape(name)}(\s|$)')

    def test_list_as_json(self):
        whole = json.loads(self.succeed('list', '--json', env=NO_DRIVER).stdout)
        self.assertEqual(whole.pop('devices'), [])
        text = self.succeed('list', env=NO_DRIVER).stdout.decode()
        for topic, entries in whole.items():
            if topic == 'sandbox':
                continue
            found = re.search(rf'(?ms)^{topic}:\n(.*?)(^\S|\Z)', text)[1].splitlines()
            self.assertEqual([entry['name'] for entry in entries],
                             [line.split()[0] for line in found])
            self.assertEqual([line for entry, line in zip(entries, found)
                              if entry['help'] not in line], [])
            self.assertEqual(json.loads(self.succeed('list', topic, '--json').stdout),
                             {topic: entries})
        rows = {row['name']: row for row in whole['settings']}
        self.assertEqual(rows['refract.ior'], {**rows['refract.ior'], 'type': 'number',
                                               'default': 1.3091, 'min': 1, 'max': 4})
        self.assertEqual(rows['landscape.flat']['default'], False)
        self.assertEqual(rows['tonemap.curve']['choices'],
                         ['neutral', 'clip', 'agx', 'aces', 'hable'])
        self.assertEqual(whole['materials'][0]['ior'], 1.3091)
        self.assertIsInstance(whole['sandbox']['landlock'], int)
        self.refuse(USAGE, 'list', 'scnes', '--json', names=['scnes'])
        self.refuse(USAGE, 'list', '--json', '--preset', names=['--json', '--preset'])

    def test_quality(self):
        """A level sets what nobody else has set; `high` is that of files, but samples or a preset
        alone mean `normal`."""
        def drawn(*words):
            line = (Case.program, 'render', 'sphere', *BARE, '-q', '-o', 'a.exr', *words)
            subprocess.run(line, env=environment({}), cwd=self.folder, check=True)
            return Exr((self.folder / 'a.exr').read_bytes()).text('firn/settings')

        (self.folder / 'a.set').write_text('refract.steps=7\n')
        self.assertEqual(drawn('--quality', 'normal'), drawn('--samples', '1'))
        self.assertEqual(drawn('--quality', 'high'), drawn())
        self.assertEqual(drawn('--preset', 'paper'),
                         drawn('--samples', '1', '--set', 'ice_caustics.light=none', '--set',
                               'ssr.steps=0', '--set', 'ao.strength=0', '--set',
                               'highlight.fresnel=off', '--set', 'tonemap.resolve=linear', '--set',
                               'refract_bounce.inclusions=cracks'))
        for words, wanted in (
                (('--quality', 'high'),
                 ('samples=4', 'refract.steps=12', 'ssr.steps=16')),
                (('--quality', 'draft'),
                 ('samples=1', 'refract_bounce.exits=1', 'trace.min_branch=0.1')),
                (('--quality', 'high', '--quality', 'draft'),
                 ('samples=1', 'refract.steps=8', 'texture.anisotropy=1')),
                (('--samples', '2', '--set', 'trace.min_branch=0.5', '--quality', 'high',
                  '--preset', 'a.set'), ('samples=2', 'trace.min_branch=0.5', 'refract.steps=7'))):
            found = drawn(*words).split()
            for value in wanted:
                self.assertIn(value, found, words)
        self.refuse(USAGE, 'render', 'sphere', '--quality', 'best', '-o', 'a.exr',
                    names=['--quality', 'draft', 'high', 'best'])

    def test_list_to_a_full_disk(self):
        with open('/dev/full', 'wb') as full:
            self.assertEqual(self.firn('list', stdout=full).returncode, WRITE)


class Input(Case):
    def render_file(self, name, content):
        (self.folder / name).write_bytes(content)
        self.refuse(DATA, 'render', name, *SMALL, '-o', 'a.exr', names=[name])
        self.assertEqual(self.files(), [name])

    def test_missing(self):
        self.refuse(NO_INPUT, 'render', 'gone.obj', '-o', 'a.exr',
                    names=['gone.obj', 'neither a built-in scene nor a file'])
        self.refuse(NO_INPUT, 'graph', 'ice-cub', names=['ice-cub', "'ice-cube'?"])
        self.refuse(NO_INPUT, 'render', 'sphere', '-o', 'a.exr', '--env', 'gone.hdr',
                    names=['gone.hdr'])

    def test_broken_glb(self):
        self.render_file('broken.glb', b'glTF\x02\0\0\0' + bytes(range(256)) * 4)

    def test_empty_file(self):
        self.render_file('empty.obj', b'')

    def test_nan_in_obj(self):
        self.render_file('nan.obj', b'v 0 0 0\nv 1 0 nan\nv 0 1 0\nf 1 2 3\n')

    def test_index_out_of_range(self):
        self.render_file('index.obj', b'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 7\n')

    def test_a_model_is_rendered(self):
        (self.folder / 'tent.obj').write_text(
            'v 0 1 0\nv -1 -1 1\nv 1 -1 1\nv 0 -1 -1\nf 1 2 3\nf 1 3 4\nf 1 4 2\nf 2 4 3\n')
        self.succeed('render', 'tent.obj', *SMALL, '-o', 'a.exr', '--aov', 'N')
        self.assertEqual(Exr((self.folder / 'a.exr').read_bytes()).size, (64, 48))


class Device(Case):
    def test_none(self):
        self.refuse(NO_DEVICE, 'render', 'sphere', *SMALL, '-o', 'a.exr', env=NO_DRIVER)
        self.assertEqual(self.files(), [])

    def test_a_plan_needs_none(self):
        plan = {rung: self.succeed('graph', 'valley', '--refraction', rung,
                                   env=NO_DRIVER).stdout.decode()
                for rung in ('paper', 'one-sided')}
        self.assertIn('refract_paper.color', plan['paper'])
        self.assertIn('refract_one_sided.color', plan['one-sided'])
        self.assertIn('ice_normal.back', plan['paper'])
        # it may be named among what was culled, but is not run
        alive = [line for line in plan['one-sided'].splitlines() if 'cull' not in line]
        self.assertNotIn('ice_normal.back', '\n'.join(alive))

    def graph(self, *arguments):
        """The same bytes twice."""
        first, second = (self.succeed('graph', 'valley', *arguments, env=NO_DRIVER).stdout
                         for _ in range(2))
        self.assertTrue(first == second, f'{arguments}: other bytes')
        return first.decode()

    def test_a_plan_as_json(self):
        plan = json.loads(self.graph('--json'))
        self.assertEqual(plan['faults'], [])
        self.assertEqual(list(plan_dumps.text_lines(plan)), self.graph().splitlines())

    def test_a_plan_as_a_page(self):
        """The page has the JSON; rg_dump_forms.py tests how it is drawn."""
        for rung in ('paper', 'one-sided'):
            arguments = ('--refraction', rung, '--aov', 'all')
            html = self.graph('--html', *arguments)
            self.assertEqual(plan_dumps.embedded(html), self.graph('--json', *arguments))
            self.assertIn('refract_', html)

    def test_a_plan_to_a_full_disk(self):
        for form in ('--html', '--json'):
            with open('/dev/full', 'wb') as full:
                done = self.firn('graph', 'sphere', form, env=NO_DRIVER, stdout=full)
            self.assertEqual(done.returncode, WRITE, done.stderr.decode())

    def test_links_no_window_system(self):
        libraries = subprocess.run(['ldd', Case.program], capture_output=True, text=True,
                                   check=True)
        self.assertNotRegex(libraries.stdout, r'(?i)libX11|libxcb|wayland|glfw')
        self.assertIn('libc.so', libraries.stdout)


class Output(Case):
    def test_a_missing_folder_is_found_before_rendering(self):
        for driver in ({}, NO_DRIVER):  # without a driver too: before a device is looked for
            self.refuse(CANT_CREATE, 'render', 'sphere', *SMALL, '-o', 'gone/a.exr', env=driver,
                        names=['gone/a.exr'])

    def test_one_bad_output_of_two_leaves_none(self):
        self.refuse(CANT_CREATE, 'render', 'sphere', *SMALL, '-o', 'a.exr', '-o', 'gone/a.png',
                    names=['gone/a.png'])
        self.assertEqual(self.files(), [])

    def test_stdout_holds_the_picture_and_nothing_else(self):
        data = self.succeed('render', 'sphere', *SMALL, '-o', '-').stdout
        self.assertEqual(data, self.render('a.exr'))
        self.assertEqual(len(data), Exr(data).end)

    def test_stdout_is_a_full_disk(self):
        with open('/dev/full', 'wb') as full:
            done = self.firn('render', 'sphere', *SMALL, '-o', '-', stdout=full)
        self.assertEqual(done.returncode, WRITE, done.stderr.decode())

    def test_exr_and_png_at_once(self):
        self.render('a.exr', '-o', 'a.png')
        self.assertEqual(self.files(), ['a.exr', 'a.png'])
        png = (self.folder / 'a.png').read_bytes()
        self.assertEqual(png[:16], b'\x89PNG\r\n\x1a\n\0\0\0\rIHDR')
        self.assertEqual(png[16:24], b'\0\0\0\x40\0\0\0\x30')
        self.assertEqual(png[-8:-4], b'IEND')
        self.assertEqual(Exr((self.folder / 'a.exr').read_bytes()).size, (64, 48))

    def test_an_older_file_is_replaced(self):
        (self.folder / 'a.exr').write_bytes(b'older')
        Exr(self.render('a.exr'))
        self.assertEqual(self.files(), ['a.exr'])

    def test_runs_with_no_home_in_a_folder_it_cannot_write_to(self):
        self.succeed('render', 'sphere', *SMALL, '-o', self.folder / 'a.exr', cwd='/proc')
        self.assertEqual(self.files(), ['a.exr'])

    def test_quiet(self):
        done = self.succeed('render', 'sphere', *SMALL, '-q', '-o', 'a.exr')
        self.assertEqual((done.stdout, done.stderr), (b'', b''))

    def test_no_escape_codes_outside_a_terminal(self):
        done = self.succeed('render', 'sphere', *SMALL, '-o', 'a.exr')
        self.assertEqual(done.stdout, b'')
        self.assertNotIn(b'\x1b', done.stderr)
        self.assertNotIn(b'\r', done.stderr)


class Layers(Case):
    def test_all(self):
        picture = Exr(self.render('a.exr', '--refraction', 'paper', '--aov', 'all'))
        layers = json.loads(self.succeed('list', 'layers', '--json').stdout)['layers']
        want = {**dict.fromkeys('RGBA', 'half'),
                **{channel: 'uint' if layer['integer'] else 'float' for layer in layers
                   if not layer['reference_only'] and not layer['traced_only']
                   for channel in layer['channels']}}
        self.assertEqual(picture.channels, want)
        self.assertEqual(list(picture.channels), sorted(want))

    def test_none_and_some(self):
        self.assertEqual(set(Exr(self.render('a.exr')).channels), set('RGBA'))
        self.assertEqual(set(Exr(self.render('b.exr', '--aov', 'Z,back.N')).channels),
                         {*'RGBA', 'Z', 'back.N.X', 'back.N.Y', 'back.N.Z'})

    @unsanitized
    def test_automatic_settings_are_the_rungs_own(self):
        values = {'bounce': ('exact', 'distance'), 'paper': ('paper', 'infinite')}
        for rung, other in (('bounce', 'paper'), ('paper', 'bounce')):
            same, fresnel, lookup = (
                self.render('b.exr', '-r', rung, '--set', f'refract.fresnel={values[of[0]][0]}',
                            '--set', f'refract.lookup={values[of[1]][1]}')
                for of in ((rung, rung), (other, rung), (rung, other)))
            first = self.render('a.exr', '-r', rung, '--set', 'refract.fresnel=auto')
            self.assertTrue(first == same, rung)
            self.assertNotEqual(Exr(first).pixels, Exr(fresnel).pixels)
            self.assertNotEqual(Exr(first).pixels, Exr(lookup).pixels)
        self.assertIn('refract.lookup=auto', self.succeed('list', 'settings',
                                                          '--preset').stdout.decode())

    def test_metadata_tells_how_it_was_made(self):
        picture = Exr(self.render('a.exr', '--set', 'refract_paper.back_weight=0.25'))
        version = self.succeed('--version').stdout.decode().split()[1]
        self.assertIn(version, picture.text('firn/version'))
        self.assertRegex(picture.text('firn/settings'), r'refract_paper\.back_weight=0\.25\b')
        matrix = picture.matrix('worldToCamera')
        self.assertEqual(matrix[3::4], (0, 0, 0, 1))  # affine, row vectors
        for axis in (matrix[0:3], matrix[4:7], matrix[8:11]):  # a rotation
            self.assertAlmostEqual(sum(x * x for x in axis), 1, places=5)
        self.assertIn('chromaticities', picture.attributes)


class Same(Case):
    """The same command gives the same bytes; another one does not."""

    ALL = ('-r', 'paper', '--aov', 'all', '--set', 'cracks.count=2', '--set', 'bubbles.count=40')

    def setUp(self):
        super().setUp()
        self.first = self.render('first.exr', *self.ALL)

    def check(self, *arguments, env=()):
        again = self.render('again.exr', *self.ALL, *arguments, env=env)
        self.assertTrue(self.first == again, f'{arguments} {env}: other bytes')

    def test_again(self):
        self.check()

    @unsanitized
    def test_whatever_the_threads(self):
        self.check(env={'LP_NUM_THREADS': '1'})
        self.check(env={'LP_NUM_THREADS': '2'})

    def test_a_setting_changes_the_picture(self):
        other = self.render('other.exr', *self.ALL, '--set', 'refract_paper.back_weight=0.5')
        self.assertFalse(Exr(self.first).pixels == Exr(other).pixels)


if __name__ == '__main__':
    main()
