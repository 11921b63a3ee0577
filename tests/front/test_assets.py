"""test_assets.py: models and panoramas that come with firn, and where it finds them.

Usage: test_assets.py FIRN [--without] [TEST...]
    --without: FIRN cannot trace
"""
import collections
import importlib
import json
import pathlib
import shutil
import struct
import sys
import unittest
import zlib

sys.dont_write_bytecode = True  # the source tree stays clean
from case import (  # noqa: E402
    DATA, NO_DRIVER, NO_INPUT, PLAIN, SMALL, Case, long, main)
from exr_file import Exr  # noqa: E402
from gltf_file import boxes, glass  # noqa: E402

ASSETS = pathlib.Path(__file__).parents[2] / 'assets'
sys.path.append(str(ASSETS / 'generate'))
SCENES = ('drink', 'amber', 'hollow', 'ice-cube', 'slate')
FILES = sorted(path.name for path in ASSETS.iterdir() if path.suffix in ('.glb', '.exr'))
TRACED = ['--refraction', 'reference']


class Generators(Case):
    @unittest.skipIf('ng' in zlib.ZLIB_RUNTIME_VERSION, 'zlib-ng packs other bytes')
    @long
    def test_they_make_the_files(self):
        importlib.import_module('make').main(self.folder)
        made = self.files()
        self.assertEqual([*made, 'alps.exr'], [*FILES[1:], FILES[0]])
        for name in made:
            with self.subTest(name):
                self.assertTrue((self.folder / name).read_bytes() == (ASSETS / name).read_bytes(),
                                'python3 assets/generate/make.py assets makes other bytes')

    def test_a_line_of_where_each_is_from(self):
        text = (ASSETS / 'README.md').read_text(encoding='utf-8')
        for name in FILES:
            self.assertRegex(text, rf'(?m)^\| `{name}` \| .* \| (made by `generate/\w+\.py`|'
                                   r'rendered) for this project; MIT')


class Shells(Case):
    """Of refractive things: closed, so that there is an inside."""

    def meshes(self, name):
        """Material, points and corners of each mesh."""
        data = (ASSETS / f'{name}.glb').read_bytes()
        length, = struct.unpack_from('<I', data, 12)
        model, first = json.loads(data[20:20 + length]), 28 + length

        def values(index, code, width):
            accessor = model['accessors'][index]
            at = first + model['bufferViews'][accessor['bufferView']]['byteOffset']
            return struct.unpack_from(f'<{accessor["count"] * width}{code}', data, at)

        for mesh in model['meshes']:
            primitive = mesh['primitives'][0]
            points = values(primitive['attributes']['POSITION'], 'f', 3)
            yield (model['materials'][primitive['material']], points,
                   values(primitive['indices'], 'H', 1))

    def test_closed_with_a_priority(self):
        for name in SCENES:
            for material, points, corners in self.meshes(name):
                if 'KHR_materials_transmission' not in material.get('extensions', ()):
                    continue
                medium = material['extensions']['KHR_materials_volume']
                with self.subTest(scene=name, material=material['name']):
                    self.assertGreater(medium['thicknessFactor'], 0)
                    self.assertEqual({'water': 1, 'ice': 2, 'glass': 3, 'air': 4}[material['name']],
                                     material['extras']['priority'])
                    sides = collections.Counter()
                    for a, b, c in zip(*[iter(corners)] * 3):
                        sides.update(((a, b), (b, c), (c, a)))
                    self.assertEqual(set(sides.values()), {1})
                    self.assertEqual([side for side in sides if side[::-1] not in sides], [])
                    # In metres: a thing that a hand can hold.
                    self.assertTrue(0.01 < max(points) - min(points) < 0.2)


class Names(Case):
    def test_every_scene_loads(self):
        for name in SCENES:
            self.succeed('graph', name, env=NO_DRIVER)

    def test_listed(self):
        scenes = self.succeed('list', 'scenes').stdout.decode()
        for name in SCENES:
            self.assertRegex(scenes, rf'(?m)^  {name} +\w')
        environments = self.succeed('list', 'environments').stdout.decode()
        for name in ('studio', 'window', 'alps', 'valley'):
            self.assertRegex(environments, rf'(?m)^  {name} +\w')

    def test_a_picture(self):
        small = ('render', 'hollow', '--size', '32x24', *PLAIN, *TRACED)
        pictures = set()
        for k, more in enumerate(([], ['--env', 'studio'])):
            self.succeed(*small, *more, '-o', f'{k}.png')
            pictures.add((self.folder / f'{k}.png').read_bytes())
        self.assertEqual(len(pictures), 2)

    def test_names_that_are_close(self):
        self.refuse(NO_INPUT, 'graph', 'drnk', names=["did you mean 'drink'?"])
        self.refuse(NO_INPUT, 'graph', 'sphere', '--env', 'studoi',
                    names=["did you mean 'studio'?"])
        self.refuse(NO_INPUT, 'graph', 'studio', names=["'studio' is neither a built-in scene"])

    def test_a_path_is_a_file(self):
        (self.folder / 'drink').write_bytes(b'no model')
        self.refuse(DATA, 'graph', './drink', names=['./drink'])
        self.succeed('graph', 'drink', env=NO_DRIVER)


class Folders(Case):
    def test_the_stated_one_is_first(self):
        stated = {'FIRN_ASSETS': self.folder}
        (self.folder / 'drink.glb').write_bytes(b'glTF\x02\0\0\0' + bytes(range(256)))
        self.refuse(DATA, 'graph', 'drink', env=stated, names=[f'{self.folder}/drink.glb'])
        self.succeed('graph', 'hollow', env=stated)  # what is not in it is looked for elsewhere

    def test_beside_an_installed_program(self):
        """Wherever its prefix is moved to."""
        program = self.folder / 'bin' / 'firn'
        program.parent.mkdir()
        shutil.copy(Case.program, program)
        built, Case.program = Case.program, str(program)
        try:
            self.refuse(NO_INPUT, 'graph', 'hollow', names=["'hollow'", 'FIRN_ASSETS'])
            (self.folder / 'a.gltf').write_text(boxes((glass(), [0, 0, 0], 1)))
            done = self.succeed('graph', 'a.gltf')
            self.assertEqual(len(done.stderr.splitlines()), 1)
            self.assertIn(b'studio.exr: not found, so the surroundings are', done.stderr)
            (self.folder / 'share').mkdir()
            (self.folder / 'share' / 'firn').symlink_to(ASSETS)
            self.succeed('graph', 'hollow', '--env', 'studio')
        finally:
            Case.program = built


class Studio(Case):
    def draw(self, scene, *words):
        self.succeed('render', scene, *SMALL, *words, '-r', 'one-sided', '-o', 'a.exr')
        exr = Exr((self.folder / 'a.exr').read_bytes())
        return exr.read_planes(['R', 'G', 'B']), exr.text('firn/settings')

    def test_it_surrounds_a_file(self):
        (self.folder / 'a.gltf').write_text(boxes((glass(), [0, 0, 0], 1)))
        pixels, words = self.draw('a.gltf')
        self.assertIn(' env=studio ', words)
        self.assertEqual(pixels, self.draw('a.gltf', '--env', 'studio')[0])
        sky, words = self.draw('a.gltf', '--env', 'sky')
        self.assertIn(' env=sky ', words)
        self.assertNotEqual(pixels, sky)
        self.assertEqual(sky, self.draw('a.gltf', '--env', 'valley')[0])
        self.assertNotEqual(pixels, self.draw('a.gltf', '--env-rotate', '90')[0])
        for words in ('sphere',), ('a.gltf', '--background', '1,1,1'):
            self.assertNotIn(' env=', self.draw(*words)[1])

    def test_the_sun_brings_shadows(self):
        """Where it shines on what a file has around its objects, unless options say otherwise."""
        def light_of(*words):
            self.succeed('render', 'a.gltf', '--size', '16x16', '--samples', '1', '-r', 'one-sided',
                         *words, '-o', 'a.exr')
            words = Exr((self.folder / 'a.exr').read_bytes()).text('firn/settings')
            return words.partition(' ice_caustics.light=')[2].split()[0]
        floor = {'pbrMetallicRoughness': {'metallicFactor': 0}}
        (self.folder / 'a.gltf').write_text(boxes((glass(), [0, 0, 0], 1),
                                                  (floor, [0, -3, 0], 2)))
        self.assertEqual(light_of('--env', 'sky'), 'sun')
        self.assertEqual(light_of('--env', 'alps'), 'sun')
        for words in ((), ('--env', 'alps', '--set', 'env.sun=none'), ('--env', 'sky', '--plain'),
                      ('--env', 'sky', '--set', 'ice_caustics.light=none')):
            self.assertEqual(light_of(*words), 'none', words)
        (self.folder / 'a.gltf').write_text(boxes((glass(), [0, 0, 0], 1)))
        self.assertEqual(light_of('--env', 'alps'), 'none')

    @long
    def test_an_asset_in_its_own(self):
        """With its own settings, unless options say otherwise."""
        pixels, words = self.draw('slate')
        self.assertIn(' env=alps ', words)
        self.assertIn(' ice_caustics.light=sun ', words)
        other, words = self.draw('slate', '--env', 'sky', '--set', 'ice_caustics.light=none')
        self.assertIn(' env=sky ', words)
        self.assertIn(' ice_caustics.light=none ', words)
        self.assertNotEqual(pixels, other)


if __name__ == '__main__':
    if '--without' in sys.argv:
        sys.argv.remove('--without')
        TRACED = []
    main()
