"""test_scenes.py: scenes of model files: their objects, and what these are dressed with. Usage: see
case.py."""
import json
import math
import re
import sys

sys.dont_write_bytecode = True  # the source tree stays clean
import test_features as features  # noqa: E402
from case import (CRACKED, DATA, NO_DRIVER, NO_INPUT, PLAIN, SMALL_CUBE, USAGE, Case,  # noqa: E402
                  long, main, unsanitized)
from exr_file import Exr, write_exr  # noqa: E402
from gltf_file import boxes, glass, with_nodes  # noqa: E402

# Extensions of Khronos' registry (July 2026) that are not drawn, by what of a file may have them.
UNKNOWN = {
    '': 'AGI_stk_metadata GODOT_single_root KHR_animation_pointer KHR_interactivity KHR_xmp '
        'KHR_xmp_json_ld MPEG_animation_timing MPEG_media',
    'accessors': 'MPEG_accessor_timed',
    'buffers': 'MPEG_buffer_circular',
    'materials': 'ADOBE_materials_clearcoat_specular ADOBE_materials_clearcoat_tint '
                 'ADOBE_materials_thin_transparency KHR_materials_anisotropy '
                 'KHR_materials_diffuse_transmission '
                 'KHR_materials_iridescence KHR_materials_pbrSpecularGlossiness '
                 'KHR_materials_sheen KHR_techniques_webgl MSFT_packing_normalRoughnessMetallic '
                 'MSFT_packing_occlusionRoughnessMetallic NV_materials_mdl',
    'nodes': 'AGI_articulations EXT_lights_ies KHR_node_hoverability KHR_node_selectability '
             'KHR_node_visibility MPEG_audio_spatial MPEG_mesh_linking MSFT_lod',
    'primitives': 'CESIUM_primitive_outline EXT_mesh_manifold EXT_mesh_primitive_edge_visibility '
                  'EXT_mesh_primitive_restart FB_geometry_metadata GRIFFEL_bim_data '
                  'KHR_gaussian_splatting KHR_materials_variants',
    'scenes': 'EXT_lights_image_based MPEG_scene_dynamic MPEG_viewport_recommended',
    'textures': 'EXT_texture_astc KHR_texture_basisu MPEG_texture_video '
                'MSFT_texture_dds',
}
# What only ice has by default.
DRESSING = ('cracks', 'air', 'bubbles')
SMALL = ('--size', '32x24', '-q')
# With few photons, which take most of the time of a small image with a floor.
TRACED = ('-r', 'reference', '--set', 'reference.photons=1000')


class Scenes(Case):
    def setUp(self):
        super().setUp()
        for name, parts in (('one', [(glass(), [0, 0, 0], 1)]),
                            ('two', [(glass(), [-1.5, 0, 0], 1), (glass(2), [1.5, 0, 0], 1)])):
            (self.folder / f'{name}.gltf').write_text(boxes(*parts))

    def passes(self, *words):
        """The names of the passes, and what is said."""
        done = self.succeed('graph', *words, env=NO_DRIVER)
        return re.findall(r'(?m)^pass \d+ (\S+)', done.stdout.decode()), done.stderr.decode()

    def techniques(self, *words):
        return {name.split('.')[0] for name in self.passes(*words)[0]}

    def check_dressed(self, is_textured, *words):
        with self.subTest(words):
            # otherwise bounce intersects bubbles itself, without a pass
            found = self.techniques(*words, '--set', 'refract_bounce.inclusions=cracks')
            for name in DRESSING:
                self.assertEqual(name in found, is_textured, name)

    @unsanitized
    def test_thin_ice(self):
        """A pane of ice has no bumps, unless a preset is given."""
        (self.folder / 'pane.gltf').write_text(boxes((glass(), [0, 4, 0], [1, 1, .02])))

        def draw(*words):
            self.succeed('render', 'pane.gltf', '-m', 'ice', '--size', '48x32', '--samples', 1,
                         '-r', 'one-sided', '--ground', 'none', '-q', *SMALL_CUBE, *words,
                         '-o', 'a.png')
            return (self.folder / 'a.png').read_bytes()
        level = '--set', 'bump.strength=0'
        self.assertEqual(draw(), draw(*level))
        self.assertNotEqual(draw('--preset', 'paper'), draw('--preset', 'paper', *level))

    @unsanitized
    def test_what_is_in_ice_for_rays_alone_is_said(self):
        words = ('render', 'valley', '-r', 'search', *SMALL, '--set', 'air.model=medium', '--set',
                 'bubbles.count=0', '-o', 'a.exr')
        said = self.succeed(*words).stderr.decode()
        self.assertEqual(said.count('air.model=medium: drawn as planes'), 1, said)
        said = self.succeed(*words, '--set', 'air.count=0').stderr.decode()
        self.assertNotIn('air.model', said)

    def test_only_ice_has_cracks(self):
        self.check_dressed(True, 'sphere')
        self.check_dressed(False, 'sphere', '--material', 'glass')
        self.check_dressed(False, 'sphere', '--plain')
        self.check_dressed(False, 'one.gltf')
        self.check_dressed(True, 'one.gltf', '--material', 'ice', '--ground', 'none')
        self.check_dressed(False, 'two.gltf')

    def test_what_is_asked_for_is_there(self):
        for words in (('one.gltf', '--set', 'cracks.count=3'),
                      ('sphere', '--plain', '--set', 'cracks.count=3'),
                      ('sphere', '--set', 'cracks.count=3', '--plain', '--material', 'glass')):
            found = self.techniques(*words)
            self.assertIn('cracks', found)
            self.assertNotIn('bubbles', found)
            self.assertEqual(self.passes(*words)[1], '')

    def test_cracks_are_of_one_object(self):
        words = ('two.gltf', '--set', 'cracks.count=3', '--set', 'frost.amount=1')
        self.assertFalse({'cracks', 'frost'} & self.techniques(*words))
        said = self.passes(*words)[1]
        self.assertRegex(said, r'\Afirn: warning: .*cracks.* 2 .*\nfirn: warning: .*frost.*\n'
                               r'firn: note: .*\n\Z')

    @unsanitized
    def test_own_cracks(self):
        """A crack of a file, far from its origin, is as large as a built-in one."""
        (self.folder / 'crack.obj').write_text('v 90 0 0\nv 99 0 0\nv 90 9 0\nv 99 9 1\n'
                                               'f 1 2 3\nf 2 4 3\n')
        shares = []
        for more in ((), ('--cracks', 'crack.obj')):
            self.succeed('render', 'valley', *CRACKED, '--size', '64x48', '--set',
                         'cracks.debug=on', '--aov', 'cracks', '-o', 'a.exr', '-q', *more)
            exr = Exr((self.folder / 'a.exr').read_bytes())
            shares.append(sum(exr.read_planes(['cracks.A'])['cracks.A']))
        self.assertNotEqual(*shares)
        self.assertTrue(0.5 < shares[1] / shares[0] < 2, shares)
        self.assertIn('crack.obj', exr.text('firn/settings'))
        (self.folder / 'flat.obj').write_text('v 0 0 0\n')
        self.refuse(DATA, 'render', 'valley', '--cracks', 'flat.obj', '-o', 'a.exr',
                    names=('flat.obj',))
        done = self.succeed('render', 'pool', *PLAIN, '--size', '8x6', '--cracks', 'crack.obj',
                            '-o', 'a.exr')
        self.assertIn(b'--cracks: no effect', done.stderr)
        for rung in ('trace', 'reference'):
            done = self.succeed('render', 'valley', '-r', rung, '--plain', '--size', '8x6',
                                '--set', 'inclusions.scale=0.5', '-o', 'a.exr')
            self.assertIn(b'inclusions.scale: no effect', done.stderr)

    @long
    def test_own_pictures(self):
        """Flat heights, and a mask that is white, are no bumps; waves are some. Air is where its
        picture is white."""
        def write(name, *rows):
            texels = [value for row in rows for value in row]
            (self.folder / name).write_bytes(
                write_exr((len(rows[0]), len(rows)), {'Y': texels}))

        def draw(*words):
            self.succeed('render', 'valley', '-r', 'paper', *SMALL_CUBE, '--size', '48x36', '-q',
                         '--set', 'cracks.count=0', '--set', 'bubbles.count=0', '--set',
                         'air.haze=0', '--set', 'air.count=1', '--aov', 'air', '-o', 'a.exr',
                         *words)
            exr = Exr((self.folder / 'a.exr').read_bytes())
            return exr.read_planes(['G'])['G'], sum(exr.read_planes(['air.A'])['air.A'])

        write('flat.exr', (7, 7), (7, 7))
        write('waves.exr', (0, 90, 0, 90))
        write('white.exr', (1,))
        write('middle.exr', (0, 0, 0), (0, 1, 0), (0, 0, 0))
        even, none = draw('--bump', 'flat.exr', '--set', 'air.strength=0')
        self.assertEqual(none, 0)
        for words in (('--set', 'bump.strength=0'),
                      ('--bump', 'waves.exr', '--bump-mask', 'white.exr')):
            self.assertEqual(draw('--set', 'air.strength=0', *words)[0], even)
        self.assertNotEqual(draw('--set', 'air.strength=0', '--bump', 'waves.exr')[0], even)
        covers = [draw('--air', name)[1] for name in ('middle.exr', 'white.exr')]
        self.assertTrue(0 < covers[0] < 0.7 * covers[1], covers)
        for rung, is_said in (('bounce', False), ('per-vertex', True)):
            said = self.succeed('render', 'valley', *PLAIN, '-r', rung, '--size', '8x6', '--bump',
                                'waves.exr', '--set', 'bump.strength=1', '-o', 'a.exr').stderr
            self.assertEqual((b'--bump: no effect' in said, b'bump.strength: no effect' in said),
                             (is_said, is_said))
        for name in ('a.obj', 'none.png'):
            self.refuse(NO_INPUT if name[0] == 'n' else DATA, 'render', 'valley', '--bump', name,
                        '-o', 'b.exr', names=(name,))

    def test_each_object_has_rows(self):
        passes, _ = self.passes('two.gltf', '-r', 'bounce')
        self.assertEqual([name for name in passes if name.startswith('refract')],
                         ['refract_bounce.color', 'refract_bounce.color.1'])

    @unsanitized
    def test_objects_share_passes_where_none_sees_another(self):
        """The third box is drawn with the second one, unless it hides some of that."""
        for place, passes in (([6, 0, 0], 2), ([0.5, 0, 2], 3)):
            (self.folder / 'a.gltf').write_text(boxes(
                (glass(), [-4, 0, -2], 1), (glass(), [0, 0, 0], 1), (glass(), place, 1)))
            done = self.succeed('profile', 'a.gltf', '-r', 'bounce', '--eye', '0,0,20', '--target',
                                '0,0,0', '--size', '160x96', '-n', '1', '--warmup', '0', '-q',
                                '--json', '-')
            drawn = [row for row in json.loads(done.stdout)['rows']
                     if row['name'].startswith('refract') and row['covered']]
            self.assertEqual(len(drawn), passes, drawn)

    @unsanitized
    def test_what_a_rung_leaves_out_is_said(self):
        parts = [(glass(), [0, 0, 0], 1), (glass(roughness=0.3), [3, 0, 0], 1),
                 (glass(thickness=0, color=[1, 0, 0]), [6, 0, 0], 1), (glass(1.3), [0, 0, 0], 0.5)]
        (self.folder / 'four.gltf').write_text(boxes(*parts))
        words = ('render', 'four.gltf', *SMALL, '-o', 'a.exr')
        said = self.succeed(*words, '-r', 'bounce').stderr.decode()
        self.assertRegex(said, r'\Afirn: warning: four.gltf: .*4 objects \(of which 1 rough, '
                               r'1 thin-walled, 1 inside others\) are .*trace.*\n\Z')
        self.assertEqual(self.succeed(*words, '-r', 'trace').stderr, b'')
        self.assertEqual(self.succeed(*words, '-r', 'reference', env=NO_DRIVER).stderr, b'')
        words = ('render', 'two.gltf', *SMALL, '-o', 'a.exr', '-r', 'bounce')
        self.assertEqual(self.succeed(*words).stderr, b'')

    @long
    def test_a_second_set_is_said(self):
        """Of textures that rungs of faces draw; the scene's own rung has all sets."""
        self.succeed('render', 'sphere', *SMALL, *PLAIN, '-o', 'a.png')
        for name, second, is_said in (('first', 0, False), ('second', 1, True)):
            part = glass(pbrMetallicRoughness={'roughnessFactor': 0,
                                               'baseColorTexture': {'index': 0}})
            part['extensions']['KHR_materials_transmission']['transmissionTexture'] = {
                'index': 0, 'texCoord': second}
            scene = json.loads(boxes((part, [0, 0, 0], 1)))
            scene['meshes'][0]['primitives'][0]['attributes'].update(TEXCOORD_0=2, TEXCOORD_1=2)
            scene['accessors'].append({**scene['accessors'][0], 'count': 8, 'type': 'VEC2'})
            scene.update(textures=[{'source': 0}], images=[{'uri': 'a.png'}])
            (self.folder / f'{name}.gltf').write_text(json.dumps(scene))
            words = ('render', f'{name}.gltf', *SMALL, '-o', 'a.exr', '-r')
            what = b'1 with a second set of texture coordinates'
            said = self.succeed(*words, 'bounce').stderr
            self.assertEqual(b'of which ' + what + b') are approximated' in said, is_said)
            self.assertEqual(said.count(b'\n'), is_said)
            self.assertEqual(self.succeed(*words, 'trace').stderr, b'')
            chosen, _, note = self.chosen(f'{name}.gltf')
            self.assertEqual(chosen, 'refract_trace' if is_said else 'refract_bounce')
            self.assertEqual(what.decode() in note, is_said)

    def chosen(self, name, *words):
        """The rung of a scene, and the note that says why."""
        passes, said = self.passes(name, *words)
        rungs = {found.split('.')[0] for found in passes if found.startswith('refract_')}
        self.assertEqual(len(rungs), 1)
        info = self.succeed('info', name, '--json', env=NO_DRIVER)
        return rungs.pop(), json.loads(info.stdout)['refraction'], said

    @unsanitized
    def test_the_scene_chooses_the_rung(self):
        opaque = {'name': 'core'}
        (self.folder / 'core.gltf').write_text(boxes((glass(), [0, 0, 0], 1),
                                                     (opaque, [0, 0, 0], 0.5)))
        (self.folder / 'beside.gltf').write_text(boxes((glass(), [0, 0, 0], 1),
                                                       (opaque, [1.6, 0, 0], 0.5)))
        (self.folder / 'rough.gltf').write_text(boxes((glass(roughness=0.3), [0, 0, 0], 1)))
        (self.folder / 'open.obj').write_text('v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n')
        for name in ('one.gltf', 'beside.gltf', 'sphere', 'valley'):
            self.assertEqual(self.chosen(name), ('refract_bounce', 'bounce', ''), name)
        for name, why in (('two.gltf', 'it has 2 refractive objects'),
                          ('core.gltf', 'something is inside its object'),
                          ('open.obj', 'its object is not closed'),
                          ('rough.gltf', 'bounce would only approximate its object: 1 rough')):
            pixel, said, note = self.chosen(name)
            self.assertEqual((pixel, said), ('refract_trace', 'trace'), name)
            self.assertIn(f'firn: note: {name}: drawn with --refraction trace, because {why}\n',
                          note)
        inside = ('sphere', '--eye', '0,0,0.01', '--target', '0,0,0', '--plain')
        passes, note = self.passes(*inside)
        self.assertIn('refract_trace.color', passes)
        self.assertIn('because the camera is inside its object\n', note)
        for rung, is_said in (('bounce', True), ('paper', True), ('trace', False)):
            said = self.passes(*inside, '-r', rung)[1]
            self.assertEqual('the camera is inside an object' in said, is_said)
        for rung in ('bounce', 'trace'):
            passes, said = self.passes('two.gltf', '-r', rung)
            self.assertIn(f'refract_{rung}.color', passes)
            self.assertEqual(said, '')

    def test_status_knows_the_chosen_rung(self):
        words = ('two.gltf', *SMALL, '--frames', '0', '-o', 'a.#.exr')
        self.succeed('render', *words)
        self.succeed('farm', 'status', *words, env=NO_DRIVER)
        self.assertEqual(self.firn('farm', 'status', *words, '-r', 'bounce').returncode, 1)

    def test_info(self):
        parts = [(glass(1.3, name='ice'), [0, 0, 0], 0.5), (glass(1.5, name='cup'), [0, 0, 0], 1),
                 (glass(2, name='gem', extras={'priority': -1}), [9, 0, 0], 1)]
        (self.folder / 'three.gltf').write_text(boxes(*parts))
        said = json.loads(self.succeed('info', 'three.gltf', '--json', env=NO_DRIVER).stdout)
        names = [said['materials'][found['material']]['name'] for found in said['objects']]
        self.assertEqual(names, ['cup', 'ice', 'gem'])  # what lies inside wins; what is stated, too
        self.assertEqual([found['closed'] for found in said['objects']], [True] * 3)
        self.assertEqual([found['triangles'] for found in said['objects']], [12] * 3)
        self.assertEqual([found['inside_rank'] for found in said['objects']], [0, 1, 0])
        indices = [round(found['ior'], 4) for found in said['materials'] if 'ior' in found]
        self.assertEqual(indices, [1.3, 1.5, 2])
        self.assertEqual(len(said['materials']), 3)
        self.assertEqual(said['materials'][2]['priority'], -1)
        self.assertEqual(said['surrounding_triangles'], 0)
        text = self.succeed('info', 'three.gltf', env=NO_DRIVER).stdout.decode()
        self.assertRegex(text, r'(?m)^  box 0 +12  closed +ice, inside box 1$')
        self.assertRegex(text, r'(?m)^  gem +solid +2 .*priority -1$')
        self.refuse(USAGE, 'info', names=['SCENE'])

    def test_a_mesh_without_materials_is_ice(self):
        (self.folder / 'a.obj').write_text('v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n'
                                           'f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n')
        note = b'firn: note: a.obj: has no materials, so it is drawn as ice'
        for words, is_said in (((), True), (('--material', 'ice'), False), (('-q',), False)):
            done = self.succeed('graph', 'a.obj', '-r', 'paper', *words, env=NO_DRIVER)
            self.assertEqual(done.stderr.startswith(note), is_said, words)
            self.assertEqual(done.stderr.count(b'\n'), is_said)
        for name in ('sphere', 'one.gltf'):
            self.assertNotIn(b'note', self.succeed('graph', name, env=NO_DRIVER).stderr)
        self.assertNotIn(b'note', self.succeed('info', 'a.obj', env=NO_DRIVER).stderr)

    def test_a_mesh_that_lies_on_its_side(self):
        """A pyramid that stands on -Z, is flat, or stands on -Y."""
        base = ((0, 0), (2, 0), (2, 2), (0, 2))
        faces = 'f 1 4 3 2\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n'
        for name, tip in (('z.obj', 3), ('low.obj', 0.5), ('y.obj', 3)):
            points = [(*p, 0) for p in base] + [(1, 1, tip)]
            if name == 'y.obj':
                points = [(x, z, -y) for x, y, z in points]
            (self.folder / name).write_text(
                ''.join(f'v {x} {y} {z}\n' for x, y, z in points) + faces)
        for words, is_said in ((('z.obj',), True), (('z.obj', '--scale', '0.1'), True),
                               (('z.obj', '--up', 'z'), False), (('z.obj', '--up', 'y'), False),
                               (('z.obj', '-q'), False), (('low.obj',), False),
                               (('y.obj',), False)):
            done = self.succeed('graph', *words, '-r', 'paper', '-m', 'glass', env=NO_DRIVER)
            self.assertEqual(b'use --up z' in done.stderr, is_said, words)

    def test_a_mesh_with_materials_is_drawn_with_them(self):
        wood = {'name': 'wood', 'pbrMetallicRoughness': {'baseColorFactor': [0.5, 0.2, 0.1, 1]}}
        (self.folder / 'wood.gltf').write_text(boxes((wood, [0, 0, 0], 1)))
        said = json.loads(self.succeed('info', 'wood.gltf', '--json', env=NO_DRIVER).stdout)
        self.assertEqual((said['objects'], said['surrounding_triangles']), ([], 12))
        self.assertEqual(said['surroundings'], [{'name': 'box 0', 'triangles': 12,
                                                 'materials': [0]}])
        text = self.succeed('info', 'wood.gltf', env=NO_DRIVER).stdout.decode()
        self.assertRegex(text, r'(?s)\nmaterials:.*\n  box 0 +12  wood\n.*\nBVH for ray tracing')
        for words, is_ice in (((), False), (('--material', 'ice'), True)):
            done = self.succeed('render', 'wood.gltf', *words, '--plain', '-r', 'reference',
                                '--size', '9x9', '--background', '1,1,1', '-o', 'a.exr',
                                env=NO_DRIVER)
            self.assertNotIn(b'note', done.stderr)
            planes = Exr((self.folder / 'a.exr').read_bytes()).read_planes('RGB')
            middle = [planes[name][40] for name in 'RGB']
            self.assertEqual(middle[0] > 1.5 * middle[2], not is_ice, middle)

    def test_clear_things_that_are_blended(self):
        """A note has the option that draws them as such."""
        def said(name, node='thing', mode='BLEND', *words):
            material = {'name': name, 'alphaMode': mode,
                        'pbrMetallicRoughness': {'baseColorFactor': [1, 1, 1, 0.3]}}
            scene = json.loads(boxes((material, [0, 0, 0], 1), (glass(1.5), [3, 0, 0], 1)))
            scene['nodes'][0]['name'] = node
            (self.folder / 'pane.gltf').write_text(json.dumps(scene))
            return self.succeed('graph', 'pane.gltf', *words, env=NO_DRIVER).stderr.decode()
        for name, node, option in (
                ('glass', 'thing', 'glass=glass'), ('a_GLASS.001', 'x', 'a_GLASS.001=glass'),
                ('Big Diamond', 'x', "'Big Diamond=diamond'"),
                ('WineGlass', 'x', 'WineGlass=glass'),
                ('crystal2', 'x', 'crystal2=glass'), ('blue', 'Water', 'Water=water'),
                ('Ice', 'Water', 'Ice=ice')):
            self.assertEqual(said(name, node), (
                'firn: note: pane.gltf: alpha-blended surfaces do not refract; to draw them as '
                f'clear objects, use --material {option}\n'))
        self.assertIn('glass=glass', said('glass', 'x', 'BLEND', '--material', 'box 1=water'))
        for words in (('eyeglasses', 'dice'), ('price', 'underwater'), ('paint', 'wall'),
                      ('glass', 'x', 'OPAQUE'), ('glass', 'x', 'BLEND', '-q'),
                      ('glass', 'x', 'BLEND', '-r', 'bounce', '--material', 'glass=glass')):
            self.assertEqual(said(*words), '', words)
        self.assertIn('refract_trace', str(self.passes('pane.gltf', '-m', 'glass=glass')))

    def test_files_of_other_formats(self):
        """What they lack, and what is not read, is said."""
        (self.folder / 'a.obj').write_text('mtllib gone.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\n'
                                           'f 1 2 3\n')
        self.assertEqual(self.succeed('graph', 'a.obj', '-q', env=NO_DRIVER).stderr,
                         b'firn: warning: a.obj: refers to gone.mtl: file not found; its '
                         b'materials are left out\n')
        head = ('ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n'
                'property float z\n')
        points = 'end_header\n0 0 0\n1 0 0\n0 1 0\n'
        (self.folder / 'points.ply').write_text(head + points)
        (self.folder / 'strips.ply').write_text(
            f'{head}element tristrips 1\nproperty list int int vertex_indices\n{points}3 0 1 2\n')
        self.refuse(DATA, 'graph', 'points.ply', names=['faces'], env=NO_DRIVER)
        self.succeed('graph', 'strips.ply', '-q', env=NO_DRIVER)

    def test_transforms_of_nodes(self):
        """--transform draws what a file with these transforms draws; unknown nodes are named."""
        wood = {'name': 'wood', 'pbrMetallicRoughness': {'baseColorFactor': [0.5, 0.2, 0.1, 1]}}

        def draw(parts, *words):
            (self.folder / 'a.gltf').write_text(boxes(*parts))
            self.succeed('render', 'a.gltf', *words, *SMALL, '-r', 'reference', '--ground', 'none',
                         '--eye', '0,0,9', '--target', '0,0,0', '--aov', 'Z', '-o', 'a.exr',
                         env=NO_DRIVER)
            return (self.folder / 'a.exr').read_bytes()

        def planes(image):
            return [round(x, 3) for x in Exr(image).read_planes(['Z'])['Z']]
        for left, right in ((wood, wood), (glass(1.5), wood), (glass(1.5), glass(1.5))):
            parts = [(left, [-1.5, 0, 0], 1), (right, [1.5, 0, 0], [0.5, 0.8, 0.3])]
            moved = [parts[0], (right, [2, 0.5, 0], [0.6, 1.6, 1])]
            made = draw(parts, '--hide', 'box 1')
            self.assertEqual(planes(made), planes(draw(parts[:1])))
            made = draw(parts, '--transform', 'box 1=0.5,0.5,0,0,90,0,2')
            self.assertEqual(planes(made), planes(draw(moved)))
            self.assertIn(b' transform=box 1=0.5,0.5,0,0,90,0,2 ', made)
        for code, words, name in (
                (USAGE, ('--transform', 'box 1=1,2'), 'box 1=1,2'),
                (USAGE, ('--transform', '=1,2,3'), 'name of a node'),
                (DATA, ('--hide', 'box 0', '--hide', 'box 1'), 'leaves no triangle')):
            self.refuse(code, 'render', 'a.gltf', *words, '-o', 'a.png', names=[name],
                        env=NO_DRIVER)

    def test_materials_of_nodes(self):
        wood = {'name': 'wood', 'pbrMetallicRoughness': {'baseColorFactor': [0.5, 0.2, 0.1, 1]}}
        parts = [(wood, [-1.5, 0, 0], 1), (wood, [1.5, 0, 0], 1)]
        (self.folder / 'wood.gltf').write_text(boxes(*parts))
        fifth = (glass(1.7), [1.5, 0, 0], 1)
        (self.folder / 'same.gltf').write_text(boxes((wood, [-1.5, 0, 0], 1), fifth))

        def draw(*words):
            self.succeed('render', *words, *SMALL, *TRACED, '--aov', 'fresnel', '-o', 'a.exr',
                         env=NO_DRIVER)
            return Exr((self.folder / 'a.exr').read_bytes()).read_planes(['fresnel.Z'])
        made = draw('wood.gltf', '--material', 'box 1=glass,ior=1.7')
        self.assertEqual(made, draw('same.gltf'))
        self.assertEqual(draw('two.gltf', '--material', 'box 0=water,ior=1.5', '-m',
                              'box 1=glass,ior=2'), draw('two.gltf'))
        both = self.passes('wood.gltf', '--material', 'wood=glass', '-r', 'bounce')[0]
        self.assertIn('refract_bounce.color.1', both)
        each = draw('two.gltf', '-m', 'box 0=diamond', '-m', 'box 1=diamond')
        self.assertEqual(draw('two.gltf', '--material', 'diamond'), each)
        self.assertIn(b' material=diamond ', (self.folder / 'a.exr').read_bytes())
        for code, words, names in (
                (DATA, ('wood.gltf', '-m', 'bix 1=glass'), ("'bix 1'", 'did you mean \'box 1\'?')),
                (DATA, ('a.obj', '-m', 'box=glass'), ('a.obj', 'glTF')),
                (USAGE, ('sphere', '-m', 'box=glass'), ('sphere',)),
                (USAGE, ('wood.gltf', '-m', 'wood=glas'), ('glas',)),
                (USAGE, ('wood.gltf', '-m', '=glass'), ('=glass',)),
                (USAGE, ('wood.gltf', '-m', 'wood=glass,iro=2'), ("'iro'", 'ior')),
                (USAGE, ('wood.gltf', '-m', 'wood=glass,ior'), ('ior', '1 to 4')),
                (USAGE, ('wood.gltf', '-m', 'wood=glass,ior=5'), ("'5'", '1 to 4')),
                (USAGE, ('wood.gltf', '-m', 'wood=glass,'), ("unknown key ''",))):
            (self.folder / 'a.obj').write_text('v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n')
            self.refuse(code, 'graph', *words, names=names, env=NO_DRIVER)

    def write_cameras(self):
        lens = {'type': 'perspective', 'perspective': {'yfov': 0.8, 'znear': 0.1}}
        flat = {'type': 'orthographic',
                'orthographic': {'xmag': 1, 'ymag': 2, 'znear': 0, 'zfar': 9}}
        (self.folder / 'seen.gltf').write_text(with_nodes(
            boxes((glass(), [0, 0, 0], 1)),
            {'name': 'Front', 'camera': 0, 'translation': [0, 0, 6]},
            {'name': 'Near', 'camera': 0, 'translation': [0.5, 0, 4]},
            {'name': 'Plan', 'camera': 1, 'translation': [0, 0, 6]}, cameras=[lens, flat]))

    def test_cameras(self):
        self.write_cameras()
        cameras = json.loads(self.succeed('info', 'seen.gltf', '--json',
                                          env=NO_DRIVER).stdout)['cameras']
        self.assertEqual([(found['name'], found['kind']) for found in cameras],
                         [('Front', 'perspective'), ('Near', 'perspective'),
                          ('Plan', 'orthographic')])
        self.assertEqual(cameras[2]['height'], 4)
        self.assertAlmostEqual(cameras[0]['fov'], 45.836624, 4)
        text = self.succeed('info', 'seen.gltf', env=NO_DRIVER).stdout.decode()
        self.assertRegex(text, r'(?m)^  2 +Plan +orthographic +4 metres high, from 0,0,6$')
        pictures = {}
        for words in ((), ('--camera', 'Front'), ('--camera', '0'), ('--camera', 'Near'),
                      ('--camera', '1'), ('--eye', '0,0,6', '--fov', cameras[0]['fov'])):
            self.succeed('render', 'seen.gltf', *SMALL, *words, *TRACED, '-o', 'a.exr',
                         env=NO_DRIVER)
            exr = Exr((self.folder / 'a.exr').read_bytes())
            pictures[' '.join(map(str, words))] = exr.read_planes(['G'])['G']
        self.assertEqual(pictures[''], pictures['--camera Front'])
        self.assertEqual(pictures[''], pictures['--camera 0'])
        self.assertEqual(pictures['--camera Near'], pictures['--camera 1'])
        self.assertNotEqual(pictures[''], pictures['--camera Near'])
        for size, fov in (('48x24', 45.8366), ('24x24', 45.8366), ('12x24', 80.4348)):
            self.succeed('render', 'seen.gltf', '--size', size, *TRACED, '--json', 'a.json',
                         '-o', 'a.exr', env=NO_DRIVER)
            camera = json.loads((self.folder / 'a.json').read_text())['camera']
            self.assertAlmostEqual(camera['fov'], fov, 3)

    def test_cameras_that_are_not_there(self):
        self.write_cameras()
        for words, names in ((('seen.gltf', '--camera', 'Fromt'), ("'Front'?", "1 'Near'")),
                             (('seen.gltf', '--camera', '3'), ("2 'Plan'",)),
                             (('seen.gltf', '--camera', ''), ("0 'Front'",)),
                             (('one.gltf', '--camera', '0'), ('one.gltf has no cameras',)),
                             (('sphere', '--camera', '0'), ('sphere has no cameras',)),
                             (('seen.gltf', '--camera', 'Near', '--orbit', '1,1,9'),
                              ('--orbit',))):
            done = self.firn('render', *words, '-q', '-o', 'a.exr', env=NO_DRIVER)
            said = done.stderr.decode().splitlines()
            self.assertEqual(done.returncode, USAGE, said)
            for name in names:
                self.assertIn(name, said[-1])
        self.refuse(USAGE, 'render', 'seen.gltf', '--camera', 'Plan', '--fov', '30', '-o', 'a.exr',
                    names=('Plan', 'orthographic'), env=NO_DRIVER)

    def orthographic(self, *words):
        """A picture of it, as lines of pixels."""
        self.succeed('render', 'flat.gltf', '--size', '64x48', *PLAIN, *words, '-o', 'a.exr')
        planes = Exr((self.folder / 'a.exr').read_bytes()).read_planes(['R', 'G', 'B'])
        pixels = list(zip(planes['R'], planes['G'], planes['B']))
        return [pixels[i:i + 64] for i in range(0, len(pixels), 64)]

    @long
    def test_orthographic(self):
        """4 m are 48 pixels, so boxes of 1 m are 12, near and far; a rung is like the truth."""
        flat = {'type': 'orthographic',
                'orthographic': {'xmag': 1, 'ymag': 2, 'znear': 0, 'zfar': 9}}
        red = {'pbrMetallicRoughness': {'baseColorFactor': [1, 0.1, 0.1, 1]},
               'extensions': {'KHR_materials_unlit': {}}}
        aside = [math.sin(math.radians(-15)), 0, 0, math.cos(math.radians(15))]
        (self.folder / 'flat.gltf').write_text(with_nodes(
            boxes((glass(1.3), [0, 0, 0], 0.5), (red, [1.5, 0, -2], 0.5),
                  (red, [-1.5, 1, 3], 0.5)),
            {'name': 'front', 'camera': 0, 'translation': [0, 0, 9]},
            {'name': 'above', 'camera': 0, 'translation': [0, 3, 5.196], 'rotation': aside},
            cameras=[flat]))
        lines = self.orthographic('-r', 'bounce')
        is_red = [[x for x, (r, g, _) in enumerate(line)
                   if r > 0.6 and g < 0.2 and x not in range(26, 38)] for line in lines]
        self.assertEqual(is_red[6:18], [list(range(8, 20))] * 12)
        self.assertEqual(is_red[18:30], [list(range(44, 56))] * 12)
        self.assertFalse(sum(is_red[:6] + is_red[30:], []))
        for camera in ('front', 'above'):
            truth = self.orthographic('-r', 'reference', '--camera', camera)
            for rung in ('bounce', 'wyman'):
                found = self.orthographic('-r', rung, '--camera', camera)
                mean = sum(abs(a - b) for x, y in zip(truth, found)
                           for p, q in zip(x, y) for a, b in zip(p, q)) / (64 * 48 * 3)
                self.assertLess(mean, 0.01, (camera, rung))
        parts = self.orthographic('-r', 'bounce', '--camera', 'above', '--tiles', '2x2')
        self.assertEqual(parts, self.orthographic('-r', 'bounce', '--camera', 'above'))

    def test_lights(self):
        lights = [{'type': 'directional', 'intensity': 10.5},
                  {'type': 'spot', 'intensity': 40, 'color': [1, 0.5, 0.25], 'range': 9}]
        nodes = [{'name': f'lamp {i}', 'translation': [0, 0, 5],
                  'extensions': {'KHR_lights_punctual': {'light': i}}} for i in range(2)]
        (self.folder / 'lit.gltf').write_text(with_nodes(
            boxes((glass(), [0, 0, 0], 1)), *nodes,
            extensions={'KHR_lights_punctual': {'lights': lights}}))
        done = self.succeed('info', 'lit.gltf', '--json', env=NO_DRIVER)
        self.assertTrue(done.stderr.startswith(
            b'firn: warning: lit.gltf: its lights have no effect'), done.stderr)
        sun, spot = json.loads(done.stdout)['lights']
        self.assertEqual((sun['name'], sun['kind'], sun['intensity'], sun['unit']),
                         ('lamp 0', 'directional', 10.5, 'lux'))
        self.assertEqual((spot['kind'], spot['unit'], spot['color'], spot['range']),
                         ('spot', 'candela', [1, 0.5, 0.25], 9))
        self.assertEqual((spot['position'], spot['direction']), ([0, 0, 5], [0, 0, -1]))
        text = self.succeed('info', 'lit.gltf', env=NO_DRIVER).stdout.decode()
        self.assertRegex(text, r'(?m)^  lamp 1 +spot +40 candela, .*, at 0,0,5, within 9 m, cone '
                               r'of 0 to 45 degrees$')
        for lux, words, is_said in ((2049, (), True), (2049, ('-q',), False), (40, (), False),
                                    (2049, ('--set', 'tonemap.exposure=-9'), False)):
            (self.folder / 'lit.gltf').write_text(with_nodes(
                boxes(({}, [0, 0, 0], 1)), nodes[0], extensions={'KHR_lights_punctual': {
                    'lights': [{'type': 'directional', 'intensity': lux}]}}))
            said = self.succeed('graph', 'lit.gltf', *words, env=NO_DRIVER).stderr
            self.assertEqual(b'a factor of 652; use --set tonemap.exposure=-9' in said,
                             is_said, said)

    def test_what_is_not_drawn_is_listed(self):
        scene = json.loads(boxes((glass(emissiveFactor=[1, 1, 1]), [0, 0, 0], 1)))
        scene['extensionsUsed'] += ['EXT_of_nobody', 'KHR_texture_transform']
        (self.folder / 'a.gltf').write_text(json.dumps(scene))
        done = self.succeed('info', 'a.gltf', '--json', env=NO_DRIVER)
        said = json.loads(done.stdout)
        found = {row['name']: row['support'] for row in said['extensions']}
        self.assertEqual(found, {
            'EXT_of_nobody': 'ignored', 'KHR_materials_ior': 'drawn',
            'KHR_materials_transmission': 'drawn', 'KHR_materials_volume': 'approximated',
            'KHR_texture_transform': 'drawn'})
        warned = done.stderr.decode().split('not drawn: ')
        self.assertEqual(', '.join(said['not_drawn']), ''.join(warned[1:]).strip())
        self.assertIn('EXT_of_nobody is not supported and is ignored', warned[0])
        text = self.succeed('info', 'a.gltf', env=NO_DRIVER).stdout.decode()
        self.assertRegex(text, r'(?m)^  ignored +EXT_of_nobody$')
        self.assertRegex(text, r'(?m)^  drawn +KHR_materials_ior, KHR_materials_transmission, '
                               r'KHR_texture_transform$')

    def test_each_extension_is_named_once(self):
        """Whether the file declares it, or an object has it, or both; and refused if required."""
        scene = json.loads(boxes((glass(), [0, 0, 0], 1), (glass(), [3, 0, 0], 1)))
        known = sorted(scene['extensionsUsed'])
        scene['extras'] = {'extensions': {'EXT_of_the_author': {}}}
        scene['textures'] = [{}]
        names = sum((found.split() for found in UNKNOWN.values()), [])
        wanted = sorted(f'firn: warning: a.gltf: the extension {name} is not supported and '
                        f'is ignored' for name in names)

        def check(scene):
            (self.folder / 'a.gltf').write_text(json.dumps(scene))
            done = self.succeed('info', 'a.gltf', '--json', env=NO_DRIVER)
            self.assertEqual(sorted(done.stderr.decode().splitlines()), wanted)
            found = {row['name']: row['support'] for row in json.loads(done.stdout)['extensions']}
            self.assertEqual(sorted(found), sorted(names + known))
            self.assertEqual({found[name] for name in names}, {'ignored'})
        used = json.loads(json.dumps(scene))
        used['extensionsUsed'] = names + scene['extensionsUsed'] + names
        check(used)
        for kind, found in UNKNOWN.items():
            things = scene['meshes'][0]['primitives'] if kind == 'primitives' else scene.get(
                kind, [scene])
            for thing in things:
                thing.setdefault('extensions', {}).update({name: {} for name in found.split()})
        check(scene)
        for name in names[::6]:
            (self.folder / 'a.gltf').write_text(json.dumps({**used, 'extensionsRequired': [name]}))
            if re.search('_(texture|image|animation|materials)_', name):
                self.succeed('info', 'a.gltf', env=NO_DRIVER)
                continue
            self.refuse(DATA, 'info', 'a.gltf', env=NO_DRIVER,
                        names=[f'requires the extension {name}, which is not supported'])

    def test_no_untrue_warning(self):
        """What a transmissive material has, but would change nothing, is not said."""
        part = glass(alphaMode='BLEND', emissiveTexture={'index': 0})
        part['extensions']['KHR_materials_specular'] = {'specularFactor': 1}
        part['extensions']['KHR_materials_volume'].update(thicknessFactor=0, thicknessTexture={
            'index': 0})
        scene = json.loads(boxes((part, [0, 0, 0], 1)))
        self.succeed('render', 'sphere', *SMALL, *PLAIN, '-o', 'a.png')
        scene.update(textures=[{'source': 0}], images=[{'uri': 'a.png'}])

        def said():
            (self.folder / 'a.gltf').write_text(json.dumps(scene))
            return self.succeed('info', 'a.gltf', env=NO_DRIVER).stderr.decode()
        self.assertEqual(said(), '')
        material = scene['materials'][0]
        material['pbrMetallicRoughness']['baseColorFactor'][3] = 0.5
        material.update(emissiveFactor=[1, 0, 0], occlusionTexture={'index': 0})
        material['extensions']['KHR_materials_specular']['specularFactor'] = 0.5
        material['extensions']['KHR_materials_volume']['thicknessFactor'] = 1
        material['extensions']['KHR_materials_clearcoat'] = {'clearcoatFactor': 1,
                                                             'clearcoatNormalTexture': {'index': 0}}
        scene['samplers'] = [{'magFilter': 9728}]
        scene['textures'][0]['sampler'] = 0
        scene['scenes'].append({})
        attributes = scene['meshes'][0]['primitives'][0]
        attributes['attributes']['COLOR_1'] = 0
        attributes['targets'] = [{'COLOR_0': 0}]
        self.assertEqual(said(), 'firn: warning: a.gltf: not drawn: ' + ', '.join(
            [f'{name} of transmissive materials'
             for name in ('alpha', 'emission', 'occlusion', 'clear coat', 'specular')] +
            ['thickness textures', 'normal textures of clear coats',
             'nearest filtering (magFilter NEAREST)',
             'vertex colours beyond COLOR_0', 'colours and texture coordinates of morph targets',
             'scenes other than the one shown']) + '\n')

    def test_large_textures_are_smaller(self):
        scene = json.loads(boxes(({'pbrMetallicRoughness': {'baseColorTexture': {'index': 0}}},
                                  [0, 0, 0], 1)))
        scene['meshes'][0]['primitives'][0]['attributes']['TEXCOORD_0'] = 2
        scene['accessors'].append({**scene['accessors'][0], 'type': 'VEC2'})
        scene.update(textures=[{'source': 0}],
                     images=[{'uri': features.png(2049, 1, [(9, 9, 9, 255)] * 2049)}])
        (self.folder / 'a.gltf').write_text(json.dumps(scene))
        self.assertEqual(self.succeed('info', 'a.gltf', env=NO_DRIVER).stderr,
                         b'firn: warning: a.gltf: the largest of 1 textures has 2049 texels a '
                         b'side and is downsampled to 2048\n')

    def test_metallic_is_not_of_what_light_passes(self):
        """Said only of a material that states it."""
        for metallic, is_said in ((0.5, True), (0, False), (None, False)):
            part = glass()
            if metallic is not None:
                part['pbrMetallicRoughness']['metallicFactor'] = metallic
            (self.folder / 'a.gltf').write_text(boxes((part, [0, 0, 0], 1)))
            done = self.succeed('info', 'a.gltf', '--json', env=NO_DRIVER)
            found = ['metallic factor of transmissive materials'] * is_said
            self.assertEqual(json.loads(done.stdout)['not_drawn'], found)
            self.assertEqual(done.stderr.decode(), ''.join(
                f'firn: warning: a.gltf: not drawn: {name}\n' for name in found))

    def test_names_cannot_command_a_terminal(self):
        (self.folder / 'a.gltf').write_text(boxes((glass(name='\x1b[2Jice'), [0, 0, 0], 1)))
        self.assertIn(b' ?[2Jice', self.succeed('info', 'a.gltf', env=NO_DRIVER).stdout)

    def test_indices_are_the_materials(self):
        """And --set overrides all of them."""
        pictures = []
        for more in ((), ('--set', 'refract.ior=1.5'), ('--set', 'refract.ior=2')):
            self.succeed('render', 'two.gltf', *SMALL, *more, *TRACED, '-o', 'a.exr',
                         '--orbit', '28,9,9', '--aov', 'fresnel', env=NO_DRIVER)
            pictures.append(Exr((self.folder / 'a.exr').read_bytes()))
        own, low, high = (picture.read_planes(['fresnel.Z'])['fresnel.Z'] for picture in pictures)
        width = pictures[0].size[0]
        halves = [sum(a != b for i, (a, b) in enumerate(zip(own, other))
                      if (i % width < width // 2) == is_left)
                  for other, is_left in ((low, True), (high, False), (low, False), (high, True))]
        self.assertEqual(halves[:2], [0, 0])
        self.assertGreater(min(halves[2:]), 20)


if __name__ == '__main__':
    main()
