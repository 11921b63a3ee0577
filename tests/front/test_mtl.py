"""test_mtl.py: what each statement of an MTL file does to a pixel. Usage: see case.py.

Cards of an OBJ file, and beside them those of a glTF file that say the same.
"""
import base64
import json
import pathlib
import sys

sys.dont_write_bytecode = True  # the source tree stays clean
import test_features as features  # noqa: E402
from case import DATA, main, unsanitized  # noqa: E402
from test_features import UV, encode, extended, moved, pbr  # noqa: E402

NO_LIGHT = {'specularFactor': 0}


class Mtl(features.Cards):
    def setUp(self):
        super().setUp()
        self.obj, self.mtl = ['mtllib some cards.mtl'], []

    def picture(self, name, texels, width=1):
        """A picture of RGBA texels for the statement `name`; returns its file's name."""
        data = features.png(width, len(texels) // width, texels)
        (self.folder / name).write_bytes(base64.b64decode(data.partition(',')[2]))
        return name

    def twin(self, statements, material, uv=UV):
        """A card in both files; `uv` is glTF's, with v = 0 at the top."""
        place = self.card('; '.join(statements), material, uv=uv)
        x, y = place % features.COLUMNS - (features.COLUMNS - 1) / 2, (
            features.ROWS - 1) / 2 - place // features.COLUMNS
        self.mtl += [f'newmtl card {place}', *statements]
        self.obj += [f'usemtl card {place}', 'vn 0 0 1']
        for (u, v), (dx, dy) in zip(uv, ((-1, -1), (1, -1), (1, 1), (-1, 1))):
            self.obj += [f'v {x + 0.45 * dx} {y + 0.45 * dy} 5', f'vt {u} {1 - v}']
        self.obj.append('f -4/-4/-1 -3/-3/-1 -2/-2/-1 -1/-1/-1')

    def compare(self, samples='1', delta=8e-3):
        (self.folder / 'cards.obj').write_text('\n'.join(self.obj))
        (self.folder / 'some cards.mtl').write_text('\n'.join(self.mtl))
        words = '--samples', samples
        wanted = self.draw(features.UNEVEN, *words)
        found = self.draw_file('cards.obj', features.UNEVEN, *words)
        for place, name in enumerate(self.names):
            self.check(found[place], wanted[place], name, delta)

    @unsanitized
    def test_values(self):
        matt = extended(pbr((0.2, 0.6, 0.9, 1)), materials_specular=NO_LIGHT)
        self.twin(('Kd .2 .6 .9', 'illum 1'), matt)
        self.twin(('Kd .2 .6 .9', 'Ks 0 0 0', 'illum 2'), matt)
        self.twin(('Kd .5', 'Ns 123'), pbr((0.5, 0.5, 0.5, 1), 0, (2 / 125) ** 0.25))
        self.twin(('Kd 0 0 0', 'Ks 5 2.5 10', 'Ns 30'), extended(
            pbr((0, 0, 0, 1), 0, (2 / 32) ** 0.25), materials_specular={
                'specularColorFactor': [10, 5, 20]}))
        self.twin(('Kd .9 .5 .1', 'Pm .8', 'Pr .4', 'Ns 999'), pbr((0.9, 0.5, 0.1, 1), 0.8, 0.4))
        self.twin(('Kd 0 0 0', 'illum 0', 'Ke .5 2 0'), extended(
            pbr((0, 0, 0, 1), emissiveFactor=[0.25, 1, 0]), materials_specular=NO_LIGHT,
            materials_emissive_strength={'emissiveStrength': 2}))
        self.compare()

    @unsanitized
    def test_pictures(self):
        texture, color = self.scene.texture, (0.2, 0.6, 0.9)
        stored = tuple(round(255 * encode(x)) for x in color) + (255,)
        name = self.picture('one color.png', [stored])
        self.twin((f'map_Kd {name}',), pbr(baseColorTexture=texture(stored)))
        self.twin(('Kd 0 0 0', 'Ns 100', f'map_Ks {name}', 'Ks 5'), extended(
            pbr((0, 0, 0, 1), 0, (2 / 102) ** 0.25), materials_specular={
                'specularColorFactor': [10] * 3, 'specularColorTexture': texture(stored)}))
        self.twin(('Kd 0 0 0', 'Ke 1 .5 1', 'illum 1', f'map_Ke {name}'), extended(
            pbr((0, 0, 0, 1), emissiveFactor=[1, 0.5, 1], emissiveTexture=texture(stored)),
            materials_specular=NO_LIGHT))
        slope = (166, 100, 250, 255)
        bent = self.picture('bent.png', [slope])
        for statement in f'norm {bent}', f'map_bump -bm 1 {bent}', f'bump {bent}':
            self.twin(('Pm 1', 'Pr .3', statement), pbr(
                (1, 1, 1, 1), 1, 0.3, normalTexture=texture(slope)))
        self.twin(('Pm 1', 'Pr .3', f'map_Bump -bm .5 {bent}'), pbr(
            (1, 1, 1, 1), 1, 0.3, normalTexture={**texture(slope), 'scale': 0.5}))
        # heights that rise by 1/255 a texel to the right, and by 2/255 upwards
        ramp = self.picture('ramp.png', [(2 * (63 - y) + x,) * 3 + (255,) for y in range(64)
                                         for x in range(64)], 64)
        flat = 1 / 255
        length = (1 + flat ** 2 + (2 * flat) ** 2) ** 0.5
        self.twin(('Pm 1', 'Pr .3', f'bump -bm 20 {ramp}'), pbr(
            (1, 1, 1, 1), 1, 0.3, normalTexture={**texture(tuple(
                round(127.5 + 127.5 * c / length) for c in (-flat, -2 * flat, 1)) + (255,)),
                'scale': 20}))
        self.compare()

    @unsanitized
    def test_alpha(self):
        white, clear = (255, 255, 255, 255), (255, 255, 255, 102)
        grey = self.picture('grey.png', [(102, 102, 102, 255)])
        alpha = self.picture('alpha.png', [(7, 9, 8, 102)])
        color = self.picture('green.png', [(0, 255, 0, 255)])
        blended = extended(pbr((0.5, 0.25, 0, 1), baseColorTexture=self.scene.texture(clear),
                               alphaMode='BLEND'), materials_specular=NO_LIGHT)
        self.twin(('Kd .5 .25 0', 'illum 1', f'map_d {grey}'), blended)
        self.twin(('Kd .5 .25 0', 'illum 1', f'map_d {alpha}'), blended)
        self.twin(('illum 1', f'map_Kd {color}', f'map_d {grey}'), extended(
            pbr(baseColorTexture=self.scene.texture((0, 255, 0, 102)), alphaMode='BLEND'),
            materials_specular=NO_LIGHT))
        self.twin(('illum 1', 'd .4', f'map_d {self.picture("white.png", [white])}'), extended(
            pbr((1, 1, 1, 0.4), alphaMode='BLEND'), materials_specular=NO_LIGHT))
        self.compare('64', 0.03)

    def test_options(self):
        red, green, blue, grey = (255, 0, 0, 255), (0, 255, 0, 255), (0, 0, 255, 255), (99,) * 4
        four = self.picture('four.png', [red, green, blue, grey], 2)
        repeated = self.scene.texture(red, green, blue, grey, width=2)
        clamped = self.scene.texture(red, green, blue, grey, width=2, wrapS=33071, wrapT=33071)

        def at(u, v):
            return tuple((u + x * 0.02 - 0.01, v + y * 0.02 - 0.01) for x, y in UV)

        def matt(texture, **more):
            return extended(pbr(baseColorTexture=texture, **more), materials_specular=NO_LIGHT)
        self.twin(('illum 1', f'map_Kd {four}'), matt(repeated), uv=at(1.25, 0.75))
        self.twin(('illum 1', f'map_Kd -clamp on {four}'), matt(clamped), uv=at(1.25, 0.75))
        # glTF turns v: 1 - ((1 - v) s + o)
        self.twin(('illum 1', f'map_Kd -o .5 0 0 {four}'), matt(moved(repeated, offset=[0.5, 0])),
                  uv=at(0.25, 0.25))
        self.twin(('illum 1', f'map_Kd -o 0 .5 {four}'), matt(moved(repeated, offset=[0, -0.5])),
                  uv=at(0.25, 0.25))
        self.twin(('illum 1', f'map_Kd -s 3 1 1 -o 0 .1 {four}'), matt(
            moved(repeated, scale=[3, 1], offset=[0, -0.1])), uv=at(0.25, 0.25))
        self.twin(('illum 1', f'map_Kd -s 1 2 {four}'), matt(
            moved(repeated, scale=[1, 2], offset=[0, -1])), uv=at(0.75, 0.4))
        self.twin(('illum 1', 'Kd 0 0 0', 'Ke 1 1 1', f'map_Kd -s 2 3 -o 5 .5 {four}',
                   f'map_Ke -s 1 .5 -o .5 .125 {four}'), extended(
            pbr((0, 0, 0, 1), emissiveFactor=[1, 1, 1], emissiveTexture=moved(
                repeated, scale=[1, 0.5], offset=[0.5, 0.375])), materials_specular=NO_LIGHT),
            uv=at(0.25, 0.25))
        self.compare()

    def test_what_is_not_drawn(self):
        self.twin(('disp -mm 0 1 a.png', 'decal b.png', 'refl -type sphere c.png', 'Ks spectral x',
                   'illum 1', 'Kd 1 1 1', 'aniso .5', 'disp c.png',
                   f'map_Kd -cc on {self.picture("a.png", [(255,) * 4])}'), pbr())
        self.twin(('illum 7', 'map_Kd a.png', 'map_Ke a.png', 'norm a.png',
                   'map_Pm a.png'), pbr())
        self.twin(('d .5', 'map_Kd a.png', 'map_Ks a.png'), pbr())
        self.twin(('Tr 1', 'illum 2'), pbr())
        more = ['l 1 2', 'p 1', 'curv 0 1 1 2', 'surf 0 1 0 1 1 2 3', 'curv2 1 2']
        (self.folder / 'cards.obj').write_text('\n'.join(self.obj + more))
        (self.folder / 'some cards.mtl').write_text('\n'.join(self.mtl))
        done = self.succeed('info', 'cards.obj', '--json')
        self.assertEqual([found['kind'] for found in json.loads(done.stdout)['materials']],
                         ['opaque', 'thin wall', 'thin wall', 'opaque'])
        self.assertEqual(json.loads(done.stdout)['not_drawn'][-4:], [
            'map_Ks of transmissive materials', 'Tr 1 (taken as opaque, as MeshLab writes it)',
            'points and lines', 'free-form curves and surfaces'])
        self.assertEqual(done.stderr, b'firn: warning: cards.obj: not drawn of its materials: '
                         b'disp, decal, refl, spectral, aniso, -cc, map_Pm, map_Kd of fully '
                         b'transmissive materials, map_Ke of transmissive materials, map_Ks of '
                         b'transmissive materials, '
                         b'Tr 1 (taken as opaque, as MeshLab writes it)\n'
                         b'firn: warning: cards.obj: not drawn: points and lines, '
                         b'free-form curves and surfaces\n')
        (self.folder / 'a.ply').write_text(
            'ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n'
            'property float z\nelement face 1\nproperty list uchar int vertex_indices\n'
            'property uchar red\nproperty list uchar float texcoord\nelement edge 1\n'
            'property int vertex1\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 9 2 0 0\n0\n')
        self.assertEqual(self.succeed('info', 'a.ply').stderr.decode(),
                         'firn: warning: a.ply: not drawn: colours of faces, texture coordinates '
                         'of faces, points and lines\n')
        for line, words in (('Kd red', 'expected one or three colour components, got \'red\''),
                            ('Ns nan', 'expected a finite number'),
                            ('map_Kd -s a.png', 'expected texture options'),
                            ('map_Kd', 'expected the name of a texture file')):
            (self.folder / 'some cards.mtl').write_text('newmtl a\n' + line + '\n')
            self.refuse(DATA, 'info', 'cards.obj', names=('line 2', words))


if __name__ == '__main__':
    if not features.HAS_REFERENCE:
        sys.argv.remove('--without')
    main()
