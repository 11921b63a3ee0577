"""test_clear.py: what textures do to light that passes a transmissive material. Usage: see case.py.

Thin panes and solid blocks side by side, in two files: one says by factors, normals or places what
the other one says by textures. Both are drawn by each rung with the same samples, so their pixels
are equal; in even light some are known.
"""
import base64
import math
import pathlib
import sys

sys.dont_write_bytecode = True  # the source tree stays clean
sys.path.append(str(pathlib.Path(__file__).parents[1] / 'support'))
import test_features as features  # noqa: E402
from case import Case, long, main, unsanitized  # noqa: E402
from exr_file import Exr, write_exr  # noqa: E402
from test_features import UV, encode, extended, moved, pbr  # noqa: E402

COLUMNS, ROWS, SIDE, DISTANCE = features.COLUMNS, 3, 8, 100
EVEN = {c: [1] * 512 for c in 'RGB'}
COLOR = (0.2, 0.6, 0.9)
STORED = tuple(round(255 * encode(x)) for x in COLOR) + (255,)
WHITE = (255, 255, 255, 255)
F = 0.04  # of index 1.5, from the front
PANE = 2 * F / (1 + F)
THROUGH = {'materials_transmission': {'transmissionFactor': 1}}
# Sides of a block: its normal, and the directions of u and against v.
SIDES = (((0, 0, 1), (1, 0, 0), (0, 1, 0)), ((0, 0, -1), (-1, 0, 0), (0, 1, 0)),
         ((1, 0, 0), (0, 0, -1), (0, 1, 0)), ((-1, 0, 0), (0, 0, 1), (0, 1, 0)),
         ((0, 1, 0), (1, 0, 0), (0, 0, -1)), ((0, -1, 0), (1, 0, 0), (0, 0, 1)))


class Glasses(features.Scene):
    """A scene of transmissive things."""
    def pane(self, place, material, normal=(0, 0, 1), attributes=None, **more):
        self.cards = place + 2 * COLUMNS  # the middle of the rows that features.py has
        self.card(extended(material, **{**THROUGH, **more}), normal=normal, more=attributes)

    def block(self, place, material, normal=(0, 0, 1), **more):
        x, y = place % COLUMNS - (COLUMNS - 1) / 2, (ROWS - 1) / 2 - place // COLUMNS
        points, normals, uvs, order = [], [], [], []
        for n, u, v in SIDES:
            order += [(len(points) + i,) for i in (0, 1, 2, 0, 2, 3)]
            for (s, t), a, b in zip(UV, (-1, 1, 1, -1), (-1, -1, 1, 1)):
                points.append(tuple(0.45 * (n[k] + a * u[k] + b * v[k]) for k in range(3)))
                normals.append([sum(w * d[k] for w, d in zip(normal, (u, v, n)))
                                for k in range(3)])
                uvs.append((s, t))
        material = extended(material, **{
            **THROUGH, 'materials_volume': {'thicknessFactor': 1}, **more})
        primitive = {
            'attributes': {'POSITION': self.accessor(points, min=[-0.45] * 3, max=[0.45] * 3),
                           'NORMAL': self.accessor(normals), 'TEXCOORD_0': self.accessor(uvs)},
            'material': self.add('materials', material),
            'indices': self.accessor(order, 'H', 5123)}
        mesh = self.add('meshes', {'primitives': [primitive]})
        self.nodes.append(self.add('nodes', {'mesh': mesh, 'translation': [x, y, 5]}))


class Clear(Case):
    def setUp(self):
        super().setUp()
        self.factors, self.textures, self.names, self.known = Glasses(), Glasses(), [], {}
        self.kinds = 'pane', 'block'

    def twin(self, name, kind, by_factor, by_texture, is_=None):
        """Adds a thing to both files; `kind` is 'pane' or 'block'."""
        if kind not in self.kinds:
            return
        place = len(self.names)
        self.names.append(name)
        for scene, words in ((self.factors, by_factor), (self.textures, by_texture)):
            getattr(scene, kind)(place, words[0], **(words[1] if len(words) > 1 else {}))
        if is_:
            self.known[place] = is_

    def draw(self, scene, sky, *words, name='things.gltf'):
        """What is said, and the colour in the middle of each thing."""
        (self.folder / name).write_text(scene if isinstance(scene, str) else scene.text())
        (self.folder / 'sky.exr').write_bytes(write_exr((32, 16), sky))
        done = self.succeed('render', name, '--plain', '--env', 'sky.exr', '--eye',
                            f'0,0,{DISTANCE + 5}', '--target', '0,0,5', '--fov',
                            str(2 * math.degrees(math.atan(ROWS / 2 / DISTANCE))), '--size',
                            f'{COLUMNS * SIDE}x{ROWS * SIDE}', '-q', '-o', 'a.exr', *words)
        planes = Exr((self.folder / 'a.exr').read_bytes()).read_planes('RGB')
        rows = [(p // COLUMNS * SIDE + SIDE // 2) * COLUMNS * SIDE for p in range(len(self.names))]
        return done.stderr, [tuple(planes[c][row + p % COLUMNS * SIDE + SIDE // 2] for c in 'RGB')
                             for p, row in enumerate(rows)]

    def check(self, found, wanted, place):
        name = self.names[place]
        is_exact = 'index' in name or 'dispersion' in name  # bytes are coarse, squared more so
        delta = 0.02 if 'normal' in name else 2e-3 if is_exact else 0.01
        for a, b in zip(found, wanted):
            self.assertAlmostEqual(a, b, delta=delta,
                                   msg=f'{name}: {found} {wanted}')

    def fill(self):
        texture = self.textures.texture
        base = pbr((*COLOR, 1), roughness=0)
        pane = [PANE + (1 - PANE) * c for c in COLOR]
        for kind, is_, through in ('pane', pane, pane), (
                'block', [F + (1 - F) * c * c for c in COLOR],
                [F + (1 - F) * c * (0.6 + 0.4 * c) for c in COLOR]):
            self.twin(f'{kind}, base colour', kind, (base,),
                      (pbr(roughness=0, baseColorTexture=texture(STORED)),), is_)
            self.twin(f'{kind}, transmission', kind,
                      (base, {'materials_transmission': {'transmissionFactor': 0.4}}),
                      (base, {'materials_transmission': {
                          'transmissionFactor': 0.8,
                          'transmissionTexture': texture((128, 0, 9, 9))}}), through)
            self.twin(f'{kind}, roughness', kind, (pbr(roughness=0.4),), (pbr(
                roughness=0.8, metallicRoughnessTexture=texture((9, 128, 0, 9))),))
        tilt = (0.28, -0.2, math.sqrt(1 - 0.28 ** 2 - 0.2 ** 2))
        slope = tuple(round(127.5 + 127.5 * x) for x in tilt) + (255,)
        index = {'materials_ior': {'ior': 4}}  # so that more is reflected
        self.twin('pane, normal', 'pane', (pbr(roughness=0), {'normal': tilt, **index}), (
            pbr(roughness=0, normalTexture=texture(slope)), index))
        self.twin('block, normal', 'block', (pbr(roughness=0), {'normal': tilt}), (
            pbr(roughness=0, normalTexture=texture(slope)),))
        tangents = {'TANGENT': [(-1, 0, 0, 1)] * 4, 'TEXCOORD_1': [(0.125, 0.5)] * 4}
        self.twin('pane, normal along tangents', 'pane', (
            pbr(roughness=0), {'normal': tilt, **index}), (
                pbr(roughness=0, normalTexture=texture(
                    (255 - slope[0], 255 - slope[1], slope[2], 255))), {
                        'attributes': tangents, **index}))
        first = {**texture((0, 128, 0, 9), WHITE, WHITE, WHITE, width=4), 'texCoord': 1}
        self.twin('pane, second set', 'pane', (pbr(roughness=0.4),), (
            pbr(roughness=0.8, baseColorTexture=texture(WHITE), metallicRoughnessTexture=first),
            {'attributes': tangents}))
        self.fill_volumes()
        # Between the last two texels.
        four = texture(WHITE, WHITE, STORED, STORED, width=4)
        self.twin('pane, place', 'pane', (base,), (pbr(roughness=0, baseColorTexture=moved(
            four, offset=[0.15, 0])),))


    def fill_volumes(self):
        """Twins say the same by other numbers. In even light what is reflected inside leaves, too,
        with the colour of the face, or is attenuated again."""
        grey, dark = pbr((0.1, 0.1, 0.1, 1), roughness=0), 0.1 ** 2
        self.twin('block, no index is 1.5', 'block', (grey, {'materials_ior': {'ior': 1.5}}),
                  (grey,), [F + (1 - F) * dark] * 3)
        self.twin('block, index', 'block', (grey, {'materials_ior': {'ior': 2}}),
                  (grey, {'materials_ior': {'ior': 2.0}}), [1 / 9 + 8 / 9 * dark] * 3)
        once = [((n - 1) / (n + 1)) ** 2 for n in (1.375, 1.5, 1.625)]
        self.twin('block, dispersion', 'block', (grey, {'materials_dispersion': {
            'dispersion': 10}}), (grey, {'materials_dispersion': {'dispersion': 10}}),
            [f + (1 - f) * dark for f in once])

        def volume(exponent):
            return {'materials_volume': {
                'thicknessFactor': 1, 'attenuationDistance': 0.9 * exponent,
                'attenuationColor': [c ** exponent for c in COLOR]}}
        self.twin('block, attenuation', 'block', (pbr(roughness=0), volume(1)),
                  (pbr(roughness=0), volume(2)), [F + (1 - F) ** 2 * c / (1 - F * c)
                                                 for c in COLOR])


class Rungs(Clear):
    @unsanitized
    def test_reference(self):
        if not features.HAS_REFERENCE:
            self.skipTest('built without Embree')
        self.fill()
        self.compare('-r', 'reference', '--samples', '4')

    @long
    def test_trace(self):
        self.fill()
        self.compare('-r', 'trace', '--set', 'trace.min_branch=0', '--samples', '4')

    @unsanitized
    def test_maps(self):
        """The rungs that know faces draw smooth solids; what is reflected inside is not matt, and
        its share is that of the middle index."""
        self.kinds = 'block',
        self.fill()
        index = self.names.index
        self.known[index('block, dispersion')] = self.known[index('block, no index is 1.5')]
        self.known[1] = [F + (1 - F) * c * (0.6 + 0.4 * 0.4 * c) for c in COLOR]
        exact = '--samples', '1', '--set', 'refract.fresnel=exact'
        self.compare('-r', 'bounce', *exact)
        _, found = self.draw(self.textures, EVEN, '-r', 'paper', *exact)
        self.check(found[0], self.known[0], 0)

    def compare(self, *words):
        _, even = self.draw(self.textures, EVEN, *words)
        for place, color in self.known.items():
            self.check(even[place], color, place)
        _, found = self.draw(self.textures, features.UNEVEN, *words)
        _, wanted = self.draw(self.factors, features.UNEVEN, *words)
        for place in range(len(self.names)):
            self.check(found[place], wanted[place], place)

    @unsanitized
    def test_pictures_of_mtl(self):
        if not features.HAS_REFERENCE:
            self.skipTest('built without Embree')
        slope = (166, 100, 250, 255)
        for name, texels in ('bent.png', slope), ('base.png', STORED):
            data = features.png(1, 1, [texels]).partition(',')[2]
            (self.folder / name).write_bytes(base64.b64decode(data))
        texture, names = self.textures.texture, []
        for statements, material, more in (
                (('illum 4', 'Ns 100'), pbr(roughness=(2 / 102) ** 0.25), {}),
                (('illum 4', 'Tf .2 .6 .9', 'norm bent.png', 'map_Kd base.png'), pbr(
                    (*COLOR, 1), roughness=0, normalTexture=texture(slope)), {}),
                (('d .6', 'map_Kd base.png'), pbr(roughness=0), {
                    'transmissionFactor': 0.4})):
            names.append('\n'.join(statements))
            self.twin(names[-1], 'pane', (pbr(),), (material, {
                'materials_transmission': more} if more else {}))
        obj = ['mtllib a.mtl', 'vn 0 0 1']
        for place in range(3):
            x = place - (COLUMNS - 1) / 2
            obj += [f'o pane {place}', f'usemtl pane {place}']
            for (u, v), (dx, dy) in zip(UV, ((-1, -1), (1, -1), (1, 1), (-1, 1))):
                obj += [f'v {x + 0.45 * dx} {1 + 0.45 * dy} 5', f'vt {u} {1 - v}']
            obj.append('f -4/-4/-1 -3/-3/-1 -2/-2/-1 -1/-1/-1')
        (self.folder / 'a.mtl').write_text(''.join(
            f'newmtl pane {i}\n{words}\n' for i, words in enumerate(names)))
        words = '-r', 'reference', '--samples', '4'
        _, wanted = self.draw(self.textures, features.UNEVEN, *words)
        _, found = self.draw('\n'.join(obj), features.UNEVEN, *words, name='a.obj')
        for place in range(2):
            self.check(found[place], wanted[place], place)
        _, found = self.draw('\n'.join(obj), EVEN, *words, name='a.obj')
        self.check(found[2], [PANE + (1 - PANE) * (0.4 + 0.6 * c) for c in COLOR], 2)


if __name__ == '__main__':
    main()
