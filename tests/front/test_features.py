"""test_features.py: what each feature of a glTF material does to a pixel. Usage: see case.py.

Cards side by side before the camera, each with a material of its own. In an even environment the
colour of a card is known; in an uneven one, it is that of another card that says the same in
another way.
"""
import base64
import json
import math
import pathlib
import struct
import sys
import zlib

sys.dont_write_bytecode = True  # the source tree stays clean
sys.path.append(str(pathlib.Path(__file__).parents[1] / 'support'))
from case import Case, long, main, unsanitized  # noqa: E402
from exr_file import Exr, write_exr  # noqa: E402

COLUMNS, ROWS, SIDE, DISTANCE = 8, 7, 8, 400  # SIDE: pixels of a card and the gap around it
HAS_REFERENCE = '--without' not in sys.argv
VERTICES = '--set', 'ground.shading=vertices'
REFERENCE = '-r', 'reference', '--set', 'motion.count=0'
NORMAL, UV = (0, 0, 1), ((0, 1), (1, 1), (1, 0), (0, 0))
# Cards whose bytes, steps of alpha or table of sums are coarse.
ROUND = {'lit', 'normals of the second set', 'scale of normals', 'normal texture', 'blend',
         'blend by the factor', 'scaled', *(
    f'metallic {m}, roughness {r}' for m in (0, 1) for r in (0.25, 0.5, 1))}
UNEVEN = {c: [1 + math.sin(2 * math.pi * ((i % 32) / 32 + k / 3)) * (i // 32) / 32
              for i in range(512)] for k, c in enumerate('RGB')}
TILT = (0.6, 0.28, 0.7493997597)


def png(width, height, texels):
    """A data URI of RGBA texels."""
    def chunk(name, data):
        body = name + data
        return struct.pack('>I', len(data)) + body + struct.pack('>I', zlib.crc32(body))
    lines = b''.join(b'\0' + bytes(sum(texels[y * width:(y + 1) * width], ()))
                     for y in range(height))
    head = struct.pack('>IIBBBBB', width, height, 8, 6, 0, 0, 0)
    data = (b'\x89PNG\r\n\x1a\n' + chunk(b'IHDR', head)
            + chunk(b'IDAT', zlib.compress(lines)) + chunk(b'IEND', b''))
    return 'data:image/png;base64,' + base64.b64encode(data).decode()


def encode(x):
    return 12.92 * x if x <= 0.0031308 else 1.055 * x ** (1 / 2.4) - 0.055


class Scene:
    """A glTF file while it is written."""
    def __init__(self):
        self.data, self.nodes, self.cards, self.lights = b'', [], 0, []
        self.gltf = {name: [] for name in ('nodes', 'meshes', 'materials', 'accessors',
                                           'bufferViews', 'images', 'textures', 'samplers')}

    def add(self, kind, value):
        self.gltf[kind].append(value)
        return len(self.gltf[kind]) - 1

    def texture(self, *texels, width=1, **sampler):
        image = self.add('images', {'uri': png(width, len(texels) // width, texels)})
        texture = {'source': image}
        if sampler:
            texture['sampler'] = self.add('samplers', sampler)
        return {'index': self.add('textures', texture)}

    def accessor(self, values, kind='f', component=5126, **more):
        flat = [x for value in values for x in value]
        count = len(values[0])
        self.data += b'\0' * (-len(self.data) % 4)
        view = self.add('bufferViews', {'buffer': 0, 'byteOffset': len(self.data),
                                        'byteLength': struct.calcsize(f'{len(flat)}{kind}')})
        self.data += struct.pack(f'<{len(flat)}{kind}', *flat)
        types = {1: 'SCALAR', 2: 'VEC2', 3: 'VEC3', 4: 'VEC4', 16: 'MAT4'}
        return self.add('accessors', {'bufferView': view, 'componentType': component,
                                      'count': len(values), 'type': types[count], **more})

    def card(self, material, uv=UV, normal=NORMAL, colors=None, mode=None, more=None, **node):
        place = self.cards
        self.cards += 1
        x, y = place % COLUMNS - (COLUMNS - 1) / 2, (ROWS - 1) / 2 - place // COLUMNS
        corners = [(-0.45, -0.45, 0), (0.45, -0.45, 0), (0.45, 0.45, 0), (-0.45, 0.45, 0)]
        order = {None: (0, 1, 2, 0, 2, 3), 5: (0, 1, 3, 2), 6: (0, 1, 2, 3)}[mode]
        attributes = {'POSITION': self.accessor(corners, min=[-0.45, -0.45, 0],
                                                max=[0.45, 0.45, 0]),
                      'NORMAL': self.accessor([normal] * 4), 'TEXCOORD_0': self.accessor(uv)}
        if colors:
            attributes['COLOR_0'] = self.accessor([colors] * 4)
        for name, values in (more or {}).items():
            attributes[name] = self.accessor(values)
        primitive = {'attributes': attributes, 'material': self.add('materials', material),
                     'indices': self.accessor([(i,) for i in order], 'H', 5123)}
        if mode:
            primitive['mode'] = mode
        mesh = self.add('meshes', {'primitives': [primitive]})
        self.nodes.append(self.add('nodes', {'mesh': mesh, 'translation': [x, y, 5], **node}))
        return place

    def light(self, place, **light):
        self.lights.append(light)
        node = {'translation': place, 'extensions': {
            'KHR_lights_punctual': {'light': len(self.lights) - 1}}}
        self.nodes.append(self.add('nodes', node))

    def text(self):
        uri = 'data:application/octet-stream;base64,' + base64.b64encode(self.data).decode()
        used = {name for material in self.gltf['materials']
                for name in material.get('extensions', {})}
        return json.dumps({
            'asset': {'version': '2.0'}, 'scene': 0, 'scenes': [{'nodes': self.nodes}],
            'extensionsUsed': sorted(used | {'KHR_texture_transform', 'KHR_lights_punctual'}),
            'extensions': {'KHR_lights_punctual': {'lights': self.lights}},
            'buffers': [{'byteLength': len(self.data), 'uri': uri}],
            **{name: values for name, values in self.gltf.items() if values}})


def pbr(color=(1, 1, 1, 1), metallic=0.0, roughness=1.0, **more):
    surface = {'baseColorFactor': list(color), 'metallicFactor': metallic,
               'roughnessFactor': roughness}
    for key in ('baseColorTexture', 'metallicRoughnessTexture'):
        if key in more:
            surface[key] = more.pop(key)
    return {'pbrMetallicRoughness': surface, **more}


def extended(material, **extensions):
    return {**material, 'extensions': {f'KHR_{name}': value for name, value in extensions.items()}}


def moved(texture, **transform):
    return {**texture, 'extensions': {'KHR_texture_transform': transform}}


class Cards(Case):
    """Fills self.scene; self.same: pairs of cards; self.known: a card and its colour in light 1."""
    def setUp(self):
        super().setUp()
        self.scene, self.names, self.same, self.known = Scene(), [], [], []

    def card(self, name, material, like=None, is_=None, **how):
        place = self.scene.card(material, **how)
        self.names.append(name)
        if like is not None:
            self.same.append((place, like))
        if is_ is not None:
            self.known.append((place, is_))
        return place

    def draw(self, sky, *words):
        """The colour in the middle of each card."""
        (self.folder / 'cards.gltf').write_text(self.scene.text())
        return self.draw_file('cards.gltf', sky, *words)

    def draw_file(self, name, sky, *words):
        return self.draw_scene('sphere', sky, '--surroundings', name, *words)

    def draw_scene(self, scene, sky, *words):
        (self.folder / 'sky.exr').write_bytes(write_exr((32, 16), sky))
        done = self.succeed('render', scene, '--plain',
                            '--env', 'sky.exr', '--eye', f'0,0,{DISTANCE + 5}', '--target', '0,0,5',
                            '--fov', str(2 * math.degrees(math.atan(ROWS / 2 / DISTANCE))),
                            '--size', f'{COLUMNS * SIDE}x{ROWS * SIDE}', '-q', '-o', 'a.exr',
                            '--set', 'texture.anisotropy=1', *words)
        self.assertEqual(done.stderr, b'')
        planes = Exr((self.folder / 'a.exr').read_bytes()).read_planes('RGB')
        rows = [(p // COLUMNS * SIDE + SIDE // 2) * COLUMNS * SIDE for p in range(len(self.names))]
        return [tuple(planes[c][row + p % COLUMNS * SIDE + SIDE // 2] for c in 'RGB')
                for p, row in enumerate(rows)]

    def check(self, found, wanted, name, delta):
        for a, b in zip(found, wanted):
            self.assertAlmostEqual(a, b, delta=delta, msg=f'{name}: {found} {wanted}')

    def check_all(self, samples='1'):
        even = {c: [1] * 512 for c in 'RGB'}
        for words in [(), VERTICES] + [REFERENCE] * HAS_REFERENCE:
            words += '--samples', samples
            with self.subTest(words=words):
                found = self.draw(even, *words)
                for place, color in self.known:
                    if words[:2] == VERTICES and self.names[place] == 'lit':
                        continue  # by a lamp so near that its light is uneven on a card
                    self.check(found[place], color, self.names[place], 8e-3)
                if words[:2] == VERTICES:  # in uneven light it is coarser
                    continue
                found = self.draw(UNEVEN, *words)
                for place, like in self.same:
                    self.check(found[place], found[like], self.names[place], 8e-3)


def split(roughness, cosine):
    """What of an even light a surface reflects: factors of f0 and f90, by sums over the
    distribution of Trowbridge and Reitz."""
    alpha, count, a, b = roughness ** 2, 64, 0.0, 0.0
    v = (math.sqrt(1 - cosine ** 2), 0, cosine)

    def shadowing(c):
        return 2 * c / (c + math.sqrt(alpha ** 2 + (1 - alpha ** 2) * c * c))
    for i in range(count):
        u = (i + 0.5) / count
        z = math.sqrt((1 - u) / (1 + (alpha ** 2 - 1) * u))
        for k in range(count):
            phi = 2 * math.pi * (k + 0.5) / count
            h = (math.sqrt(1 - z * z) * math.cos(phi), math.sqrt(1 - z * z) * math.sin(phi), z)
            vh = sum(x * y for x, y in zip(v, h))
            lz = 2 * vh * z - cosine
            if lz <= 0 or vh <= 0:
                continue
            weight = shadowing(lz) * shadowing(cosine) * vh / (z * cosine) / count ** 2
            fresnel = (1 - vh) ** 5
            a += (1 - fresnel) * weight
            b += fresnel * weight
    return a, b


class Surfaces(Cards):
    def test_occlusion_of_traced_light(self):
        """Rays find what hides light, so textures of occlusion do not count."""
        occluded = pbr(occlusionTexture=self.scene.texture((51, 0, 0, 255)))
        place = self.card('occluded', occluded, is_=(1, 1, 1))
        even = {c: [1] * 512 for c in 'RGB'}
        for rung in ['trace'] + ['reference'] * HAS_REFERENCE:
            with self.subTest(rung=rung):
                found = self.draw(even, '-r', rung, '--set', 'ground.light=traced', '--samples', 4)
                self.check(found[place], (1, 1, 1), rung, 0.02)

    @long
    def test_in_even_light(self):
        """White keeps all light; a colour is kept as the formulas say."""
        self.card('white', pbr(), is_=(1, 1, 1))
        self.card('white metal', pbr(metallic=1, roughness=0.5), is_=(1, 1, 1))
        self.card('unlit', extended(pbr((0.5, 0.25, 0.75, 1)), materials_unlit={}),
                  is_=(0.5, 0.25, 0.75))
        self.card('emission', pbr((0, 0, 0, 1), emissiveFactor=[0.25, 0.5, 1], extensions={
            'KHR_materials_specular': {'specularFactor': 0}}), is_=(0.25, 0.5, 1))
        self.card('emissive strength', extended(
            pbr((0, 0, 0, 1), emissiveFactor=[0.25, 0.5, 1]), materials_specular={
                'specularFactor': 0}, materials_emissive_strength={'emissiveStrength': 3}),
            is_=(0.75, 1.5, 3))
        self.card('no specular: matt', extended(pbr((0.5, 0.25, 0.75, 1)), materials_specular={
            'specularFactor': 0}), is_=(0.5, 0.25, 0.75))
        occluded = self.scene.texture((128, 0, 0, 255))
        self.card('occlusion', pbr(occlusionTexture={**occluded, 'strength': 0.5}),
                  is_=(1 - 0.5 * 127 / 255,) * 3)
        for metallic in (0, 1):
            for roughness in (0.25, 0.5, 1):
                color = 1, 0.5, 0.25
                f0 = [color[c] if metallic else 0.04 for c in range(3)]
                place = len(self.names)
                x, y = place % COLUMNS - (COLUMNS - 1) / 2, (ROWS - 1) / 2 - place // COLUMNS
                a, b = split(roughness, DISTANCE / math.hypot(DISTANCE, x, y))
                wanted = []
                for c in range(3):
                    once, missing = f0[c] * a + b, 1 - a - b
                    mean = f0[c] + (1 - f0[c]) / 21
                    more = once * mean * missing / (1 - mean * missing)
                    wanted.append((once + more, 0 if metallic else color[c]))
                most = max(kept for kept, _ in wanted)
                self.card(f'metallic {metallic}, roughness {roughness}',
                          pbr((*color, 1), metallic, roughness))
                self.known.append((place, [kept + (1 - most) * base for kept, base in wanted]))
        self.check_all()

    def check(self, found, wanted, name, delta):
        if name in ROUND or name.startswith('tangents'):
            delta = 0.03
        super().check(found, wanted, name, delta)

    @unsanitized
    def test_textures_and_factors(self):
        texture, color = self.scene.texture, (0.2, 0.6, 0.9)
        stored = tuple(round(255 * encode(x)) for x in color) + (255,)
        base = self.card('base', pbr((*color, 1)))
        self.card('base texture', pbr(baseColorTexture=texture(stored)), base)
        self.card('vertex colours', pbr(), base, colors=color)
        self.card('strip', pbr((*color, 1)), base, mode=5)
        self.card('fan', pbr((*color, 1)), base, mode=6)
        metal = self.card('metal', pbr((*color, 1), 0.8, 0.4))
        numbers = texture((7, 204, 255, 9))
        self.card('metallic-roughness texture', pbr(
            (*color, 1), 0.8, 0.5, metallicRoughnessTexture=numbers), metal)
        glow = self.card('emission', pbr(emissiveFactor=color))
        self.card('emission texture', pbr(emissiveFactor=[1, 1, 1], emissiveTexture=texture(
            stored)), glow)
        dull = self.card('specular', extended(pbr((0, 0, 0, 1), 0, 0.3), materials_specular={
            'specularFactor': 0.4, 'specularColorFactor': list(color)}))
        self.card('specular texture', extended(pbr((0, 0, 0, 1), 0, 0.3), materials_specular={
            'specularFactor': 0.8, 'specularColorFactor': list(color),
            'specularTexture': texture((1, 2, 3, 128))}), dull)
        self.card('specular colour texture', extended(
            pbr((0, 0, 0, 1), 0, 0.3), materials_specular={
                'specularFactor': 0.4, 'specularColorTexture': texture(stored)}), dull)
        f0 = 0.04 * 2.25  # of index 1.857
        index = self.card('specular colour', extended(pbr((0, 0, 0, 1)), materials_specular={
            'specularColorFactor': [2.25] * 3}))
        root = math.sqrt(f0)
        self.card('index', extended(pbr((0, 0, 0, 1)), materials_ior={
            'ior': (1 + root) / (1 - root)}), index)
        quarter = {'materials_specular': {'specularColorFactor': [0.25] * 3}}
        legacy = self.card('index 3', extended(pbr((0, 0, 0, 1)), materials_ior={'ior': 3}))
        self.card('index 0', extended(pbr((0, 0, 0, 1)), materials_ior={'ior': 0}, **quarter),
                  legacy)
        half = self.card('occluded', pbr(occlusionTexture={**texture((102, 9, 9, 9)),
                                                           'strength': 0.5}))
        self.card('occlusion texture', pbr(occlusionTexture=texture((178, 9, 9, 9))), half)
        tilted = self.card('normals', pbr((*color, 1), 1, 0.3), normal=TILT)
        slope = tuple(round(127.5 + 127.5 * x) for x in TILT) + (255,)
        flat = (*(round(127.5 + 127.5 * x / 2) for x in TILT[:2]), slope[2], 255)
        bent = pbr((*color, 1), 1, 0.3, normalTexture=texture(slope))
        self.card('normal texture', bent, tilted)
        self.card('scale of normals', pbr((*color, 1), 1, 0.3, normalTexture={
            **texture(flat), 'scale': 2}), tilted)
        turned = (slope[1], 255 - slope[0], slope[2], 255)
        self.card('normal texture, uv turned', pbr(
            (*color, 1), 1, 0.3, normalTexture=texture(turned)), tilted,
            uv=((0, 0), (0, 1), (1, 1), (1, 0)))
        mirrored = (255 - slope[0], slope[1], slope[2], 255)
        self.card('normal texture, uv mirrored', pbr(
            (*color, 1), 1, 0.3, normalTexture=texture(mirrored)), tilted,
            uv=((1, 1), (0, 1), (0, 0), (1, 0)))
        self.card('seen from behind', pbr((*color, 1), 1, 0.3, doubleSided=True), tilted,
                  normal=tuple(-x for x in TILT))
        self.check_all()

    @unsanitized
    def test_films(self):
        """Below a film the matt base alone is bent."""
        color = (0.2, 0.6, 0.9)
        slope = tuple(round(127.5 + 127.5 * x) for x in TILT) + (255,)
        film = {'normalTexture': self.scene.texture(slope), 'extras': {'film': True}}
        black = self.card('even mirror', pbr((0, 0, 0, 1), 0, 0.3))
        self.card('normal texture, film', {**pbr((0, 0, 0, 1), 0, 0.3), **film}, black)
        matt = extended(pbr((*color, 1)), materials_specular={'specularFactor': 0})
        self.card('normal texture, below a film', {**matt, **film},
                  self.card('matt normals', matt, normal=TILT))
        self.check_all()

    def test_clear_coats(self):
        """A coat reflects its share of the light, and the rest is that of the base."""
        color, numbers = (0.5, 0.25, 1), self.scene.texture((128, 128, 0, 255))

        def coated(strength, roughness=0, base=color, more=(), **textures):
            return extended(pbr((*base, 1), **dict(more)), materials_specular={'specularFactor': 0},
                            materials_clearcoat={'clearcoatFactor': strength,
                                                 'clearcoatRoughnessFactor': roughness, **textures})
        a, b = split(1, 1)
        for name, strength, roughness, share in (('whole', 1, 0, 0.04), ('half', 0.5, 0, 0.02),
                                                 ('rough', 1, 1, 0.04 * a + b)):
            self.card(name, coated(strength, roughness),
                      is_=[share + (1 - share) * c for c in color])
        self.card('emission below', coated(1, base=(0, 0, 0), more={'emissiveFactor': color}),
                  is_=[0.04 + 0.96 * c for c in color])
        self.card('coat texture', coated(1, clearcoatTexture=numbers), 1)
        blurred = self.card('half rough', coated(1, 0.5))
        self.card('roughness texture', coated(1, 1, clearcoatRoughnessTexture=numbers), blurred)
        slope = tuple(round(127.5 + 127.5 * x) for x in TILT) + (255,)
        even = self.card('mirror', coated(1, base=(0, 0, 0)))
        self.card('unbent coat', coated(1, base=(0, 0, 0), more={
            'normalTexture': self.scene.texture(slope)}), even)
        self.check_all()
        traced = '--set', 'ground.light=traced', '--samples', 4
        for words in [('-r', 'trace'), ('-r', 'trace', *traced)] + [
                (*REFERENCE, *traced)] * HAS_REFERENCE:
            found = self.draw({c: [1] * 512 for c in 'RGB'}, *words)
            for place, wanted in self.known:
                self.check(found[place], wanted, f'{words} {self.names[place]}', 0.02)

    @unsanitized
    def test_places_in_textures(self):
        red, green, blue, grey = (255, 0, 0, 255), (0, 255, 0, 255), (0, 0, 255, 255), (99,) * 4
        four = self.scene.texture(red, green, blue, grey, width=2)
        edge = self.scene.texture(red, green, blue, grey, width=2, wrapS=33071, wrapT=33071)
        mirror = self.scene.texture(red, green, blue, grey, width=2, wrapS=33648, wrapT=33648)

        def at(u, v):
            return tuple((u + x * 0.02 - 0.01, v + y * 0.02 - 0.01) for x, y in UV)

        def unlit(texture):
            return extended(pbr(baseColorTexture=texture), materials_unlit={})
        self.card('red', unlit(four), uv=at(0.25, 0.25), is_=(1, 0, 0))
        self.card('green', unlit(four), uv=at(0.75, 0.25), is_=(0, 1, 0))
        self.card('blue', unlit(four), uv=at(0.25, 0.75), is_=(0, 0, 1))
        self.card('between', unlit(four), uv=at(0.5, 0.25), is_=(0.5, 0.5, 0))
        self.card('repeated', unlit(four), uv=at(1.25, -1.75), is_=(1, 0, 0))
        self.card('clamped', unlit(edge), uv=at(1.25, -1.75), is_=(0, 1, 0))
        self.card('clamped at the edge', unlit(edge), uv=at(0, 0), is_=(1, 0, 0))
        self.card('mirrored', unlit(mirror), uv=at(1.25, -0.25), is_=(0, 1, 0))
        self.card('moved', unlit(moved(four, offset=[0.5, 0])), uv=at(0.25, 0.25), is_=(0, 1, 0))
        self.card('scaled', unlit(moved(four, scale=[3, 1])), uv=at(0.25, 0.25), is_=(0, 1, 0))
        self.card('turned', unlit(moved(four, rotation=math.pi / 2)), uv=at(0.25, 0.25),
                  is_=(0, 0, 1))
        glow = extended(pbr((0, 0, 0, 1), baseColorTexture=moved(four, offset=[5, 0.5]),
                            emissiveFactor=[1, 1, 1], emissiveTexture=moved(four, offset=[0.5, 0])),
                        materials_specular={'specularFactor': 0})
        self.card('two transforms', glow, uv=at(0.25, 0.25), is_=(0, 1, 0))
        self.check_all()

    @long
    def test_two_sets(self):
        """Textures of two sets of coordinates, and tangents, which go before the coordinates."""
        texture = self.scene.texture
        red, green, blue, grey = (255, 0, 0, 255), (0, 255, 0, 255), (0, 0, 255, 255), (99,) * 4
        four = texture(red, green, blue, grey, width=2)
        mirror = texture(red, green, blue, grey, width=2, wrapS=33648, wrapT=33648)
        corner = ((0.74, 0.26), (0.76, 0.26), (0.76, 0.24), (0.74, 0.24))  # green
        other = {'TEXCOORD_1': corner}
        second = {'texCoord': 1}

        def glow(base, emission):
            return extended(pbr((0, 0, 0, 1), baseColorTexture=base, emissiveFactor=[1, 1, 1],
                                emissiveTexture=emission), materials_specular={'specularFactor': 0})
        self.card('of the second set', glow(four, {**four, **second}), is_=(0, 1, 0), more=other)
        self.card('by the transform', glow(four, moved(four, texCoord=1)), is_=(0, 1, 0),
                  more=other)
        self.card('transformed', glow(moved(four, scale=[3, 4]), {
            **moved(four, offset=[0.5, 0.5]), **second}), is_=(0, 0, 1), more=other)
        self.card('mirrored', glow(four, {**moved(mirror, offset=[0.5, 0]), **second}),
                  is_=(0, 1, 0), more=other)
        self.card('base of the second set', glow({**four, **second}, four), is_=(1, 0, 0),
                  more=other, uv=((0.24, 0.26), (0.26, 0.26), (0.26, 0.24), (0.24, 0.24)))
        self.card('beside one that has no area', glow(moved(four, scale=[0, 0]), four),
                  is_=(0, 1, 0), uv=corner)
        metal = self.card('metal', pbr((0.2, 0.6, 0.9, 1), 0.8, 0.4))
        numbers = texture((0,) * 4, (7, 102, 204, 9), (0,) * 4, (0,) * 4, width=2)
        self.card('metallic-roughness of the second set', pbr(
            (0.2, 0.6, 0.9, 1), 1, 1, baseColorTexture=texture((255,) * 4),
            metallicRoughnessTexture={**numbers, **second}), metal, more=other)
        tilted = self.card('normals', pbr((1, 1, 1, 1), 1, 0.3), normal=TILT)
        x, y, z = (round(127.5 + 127.5 * c) for c in TILT)

        def bent(*texel, **info):
            return pbr((1, 1, 1, 1), 1, 0.3, baseColorTexture=texture((255,) * 4),
                       normalTexture={**texture((*texel, 255)), **info})
        turned = (0, 0), (0, 1), (1, 1), (1, 0)
        self.card('normals of the second set', bent(y, 255 - x, z, **second), tilted,
                  more={'TEXCOORD_1': turned})
        along_x, along_y = [(1, 0, 0, 1)] * 4, [(0, 1, 0, 1)] * 4
        self.card('tangents', bent(x, y, z), tilted, uv=turned, more={'TANGENT': along_x})
        self.card('tangents, turned', bent(y, 255 - x, z), tilted, more={'TANGENT': along_y})
        self.card('tangents, no area in the texture', bent(x, y, z), tilted, uv=((0, 0),) * 4,
                  more={'TANGENT': along_x})
        self.card('tangents, a node mirrored', bent(255 - x, y, z), tilted, scale=[-1, 1, 1],
                  more={'TANGENT': along_x})
        self.card('tangents, a node turned', bent(x, y, z), tilted,
                  rotation=[0, 0, math.sqrt(0.5), math.sqrt(0.5)],
                  more={'TANGENT': [(0, -1, 0, 1)] * 4})
        self.check_all()

    @unsanitized
    def test_handedness_of_vertex_tangents(self):
        """The bitangent's sign is that of the tangent's w, on both sides of the surface."""
        tilted = self.card('normals', pbr((1, 1, 1, 1), 1, 0.3), normal=TILT)
        x, y, z = (round(127.5 + 127.5 * c) for c in TILT)
        for name, texel, normal, w in (
                ('tangents', (x, y, z), NORMAL, 1),
                ('tangents, mirrored', (x, 255 - y, z), NORMAL, -1),
                ('tangents, seen from behind', (x, y, z), (0, 0, -1), -1)):
            self.card(name, pbr((1, 1, 1, 1), 1, 0.3, normalTexture=self.scene.texture(
                (*texel, 255))), tilted, normal=normal, more={'TANGENT': [(2, 0, 0, w)] * 4})
        self.check_all()

    def test_a_third_set(self):
        texture = self.scene.texture((255,) * 4)
        self.card('three', pbr(baseColorTexture=texture, emissiveTexture={**texture, 'texCoord': 1},
                               occlusionTexture={**texture, 'texCoord': 2}),
                  more={'TEXCOORD_1': UV, 'TEXCOORD_2': UV})
        (self.folder / 'a.gltf').write_text(self.scene.text())
        self.assertEqual(self.succeed('info', 'a.gltf').stderr,
                         b'firn: warning: a.gltf: not drawn: textures with a third texture '
                         b'coordinate set\n')

    @unsanitized
    def test_lights(self):
        matt = extended(pbr((0.5, 0.25, 1, 1)), materials_specular={'specularFactor': 0})
        lamp = (0.5, 0, 7)
        self.scene.light([9, 9, 9], type='directional', intensity=2, color=[1, 0.5, 0])
        self.scene.light(lamp, type='point', intensity=5, range=8)
        self.scene.light((-1.5, 1, 8), type='spot', intensity=9, spot={
            'innerConeAngle': 0.2, 'outerConeAngle': 0.6})
        for place in range(COLUMNS * ROWS):
            x, y = place % COLUMNS - (COLUMNS - 1) / 2, (ROWS - 1) / 2 - place // COLUMNS
            light = [2, 1, 0]
            distance = math.dist((x, y, 5), lamp)
            point = 5 / distance ** 2 * (1 - (distance / 8) ** 4) * 2 / distance
            distance = math.dist((x, y, 5), (-1.5, 1, 8))
            cone = (3 / distance - math.cos(0.6)) / (math.cos(0.2) - math.cos(0.6))
            spot = 9 / distance ** 2 * min(max(cone, 0), 1) ** 2 * 3 / distance
            self.card('lit', matt, is_=[
                color * (1 + (lux + point + spot) / math.pi)
                for color, lux in zip((0.5, 0.25, 1), light)])
        self.check_all()

    def test_alpha(self):
        texture = self.scene.texture((255, 255, 255, 102))
        sky = (1, 1, 1)

        def unlit(**more):
            return extended(pbr((0.5, 0.25, 0, 1), **more), materials_unlit={})
        opaque = (0.5, 0.25, 0)
        self.card('opaque', unlit(baseColorTexture=texture), is_=opaque)
        self.card('mask, above', unlit(baseColorTexture=texture, alphaMode='MASK',
                                       alphaCutoff=0.39), is_=opaque)
        self.card('mask, below', unlit(baseColorTexture=texture, alphaMode='MASK',
                                       alphaCutoff=0.41), is_=sky)
        self.card('mask by the factor', extended(pbr((1, 1, 1, 0.4), alphaMode='MASK',
                                                     alphaCutoff=0.5), materials_unlit={}), is_=sky)
        self.card('blend', unlit(baseColorTexture=texture, alphaMode='BLEND'),
                  is_=tuple(0.4 * c + 0.6 for c in opaque))
        self.card('blend by the factor', extended(pbr((0.5, 0.25, 0, 0.75), alphaMode='BLEND'),
                                                  materials_unlit={}),
                  is_=tuple(0.75 * c + 0.25 for c in opaque))
        self.check_all('64')


if __name__ == '__main__':
    if not HAS_REFERENCE:
        sys.argv.remove('--without')
    main()
