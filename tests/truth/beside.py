"""beside.py: firn's reference beside a path tracer that shares no code with it, paths.c.

Usage: beside.py FIRN SCENE.glb PANORAMA.exr [SAMPLES [WIDTHxHEIGHT [FILTER]]]
It needs a C compiler (CC, or cc). Both draw the file's camera, with no sun, clear ice and glass
that nothing dims, and surfaces that are not clear as if they sent the light of their colours
(KHR_materials_unlit).
FILTER: point, the default: one ray goes through each pixel's middle, which paths.c follows by
chance SAMPLES times, and the reference once, both ways at each surface; flat: the same, with the
triangles' own normals; or box: both draw means over pixels of as many rays. Printed: the mean
absolute error on the pixels that see a clear surface first, linear and clipped to 1; the noise of
the path tracer, which is half of the error between halves of its samples; and with box how far the
reference is from one of half the samples.

The scene for paths.c: eight int32 (width, height, samples, are all in the pixel's middle, are
normals flat, seed, objects, triangles), then doubles: right, up, back and place of the camera, the
tangent of half its field of view, the panorama. Of each object: int32 is it clear, priority;
doubles: index, absorption (3); a texture. Of each triangle: int32 object; for each corner place,
normal, colour, u, v. A picture: int32 width, height; doubles, three a texel.
"""
import json
import math
import os
import pathlib
import struct
import subprocess
import sys
import tempfile
import zlib

sys.dont_write_bytecode = True  # the source tree stays clean
HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / 'front'))
from exr_file import Exr  # noqa: E402

KINDS = {5123: 'H', 5125: 'I', 5126: 'f'}
WIDTHS = {'SCALAR': 1, 'VEC2': 2, 'VEC3': 3, 'VEC4': 4}
FILTERS = [], ['point'], ['flat'], ['box']
OFF = ('env.sun=none', 'air.media=0', 'light.count=0', 'ice_caustics.light=none')


class Glb:
    def __init__(self, data):
        size, = struct.unpack_from('<I', data, 12)
        self.json, self.bytes = json.loads(data[20:20 + size]), data[28 + size:]

    def view(self, index):
        view = self.json['bufferViews'][index]
        return self.bytes[view['byteOffset']:view['byteOffset'] + view['byteLength']]

    def rows(self, index):
        accessor = self.json['accessors'][index]
        kind = f'<{WIDTHS[accessor["type"]]}{KINDS[accessor["componentType"]]}'
        return [*struct.iter_unpack(kind, self.view(accessor['bufferView']))][:accessor['count']]

    def unlit(self):
        """The file, wholly clear or, what is not clear at all, sending light of its colours."""
        for material in self.json['materials']:
            more = material.setdefault('extensions', {})
            if 'KHR_materials_transmission' not in more:
                more['KHR_materials_unlit'] = {}
                material['pbrMetallicRoughness'].pop('metallicRoughnessTexture', None)
            else:
                more['KHR_materials_transmission'].pop('transmissionTexture', None)
        self.json['extensionsUsed'] = sorted({'KHR_materials_unlit',
                                              *self.json['extensionsUsed']})
        text = json.dumps(self.json).encode()
        text += b' ' * (-len(text) % 4)
        size = 28 + len(text) + len(self.bytes)
        return (struct.pack('<4sIIII', b'glTF', 2, size, len(text), 0x4e4f534a) + text +
                struct.pack('<II', len(self.bytes), 0x004e4942) + self.bytes)


def linear(byte):
    value = byte / 255
    return value / 12.92 if value <= 0.04045 else ((value + 0.055) / 1.055) ** 2.4


def read_png(data):
    """Of a palette, as assets/generate/files.py writes them: width, height, linear colours."""
    at, chunks = 8, {}
    while at < len(data):
        size, name = struct.unpack_from('>I4s', data, at)
        chunks[name] = data[at + 8:at + 8 + size]
        at += 12 + size
    width, height, depth, kind = struct.unpack_from('>IIBB', chunks[b'IHDR'])
    rows = zlib.decompress(chunks[b'IDAT'])
    if (depth, kind) != (8, 3) or any(rows[::width + 1]):
        sys.exit('beside.py: a picture that is not one of indices')
    colors = [tuple(map(linear, c)) for c in struct.iter_unpack('3B', chunks[b'PLTE'])]
    return width, height, [colors[rows[y * (width + 1) + 1 + x]]
                           for y in range(height) for x in range(width)]


def picture(width, height, texels):
    return struct.pack('<2i', width, height) + b''.join(struct.pack('<3d', *t) for t in texels)


def medium(glb, material):
    """What paths.c knows of an object."""
    more = material.get('extensions', {})
    base = material['pbrMetallicRoughness']
    if 'KHR_materials_transmission' in more:
        volume = more['KHR_materials_volume']
        absorbed = [-math.log(c) / volume['attenuationDistance']
                    for c in volume['attenuationColor']]
        return (struct.pack('<2i4d', 1, material.get('extras', {}).get('priority', -1),
                            more['KHR_materials_ior']['ior'], *absorbed) +
                picture(1, 1, [(1, 1, 1)]))
    texels = 1, 1, [(1, 1, 1)]
    if 'baseColorTexture' in base:
        texture = glb.json['textures'][base['baseColorTexture']['index']]
        texels = read_png(glb.view(glb.json['images'][texture['source']]['bufferView']))
    return struct.pack('<2i4d', 0, 0, 1, 0, 0, 0) + picture(*texels)


def triangles(glb, primitive, number):
    where = primitive['attributes']
    places, normals = glb.rows(where['POSITION']), glb.rows(where['NORMAL'])
    count = len(places)
    colors = glb.rows(where['COLOR_0']) if 'COLOR_0' in where else [(1, 1, 1)] * count
    uvs = glb.rows(where['TEXCOORD_0']) if 'TEXCOORD_0' in where else [(0, 0)] * count
    corners = [struct.pack('<11d', *p, *n, *c[:3], *t)
               for p, n, c, t in zip(places, normals, colors, uvs)]
    indices = [i for i, in glb.rows(primitive['indices'])]
    head = struct.pack('<i', number)
    return [head + b''.join(corners[i] for i in indices[k:k + 3])
            for k in range(0, len(indices), 3)]


def scene(glb, panorama, size, samples, kind):
    media, faces, view = [], [], None
    for node in glb.json['nodes']:
        if 'camera' in node:
            m = node['matrix']
            lens = glb.json['cameras'][node['camera']]['perspective']
            view = struct.pack('<13d', *m[0:3], *m[4:7], *m[8:11], *m[12:15],
                               math.tan(lens['yfov'] / 2))
            continue
        primitive, = glb.json['meshes'][node['mesh']]['primitives']
        faces += triangles(glb, primitive, len(media))
        media.append(medium(glb, glb.json['materials'][primitive['material']]))
    planes = panorama.read_planes('RGB')
    around = picture(*panorama.size, zip(*(planes[c] for c in 'RGB')))
    return (struct.pack('<8i', *size, samples, kind != 'box', kind == 'flat', 1, len(media),
                        len(faces)) + view + around + b''.join(media) + b''.join(faces))


def error(a, b, mask):
    """Of two lists of (R, G, B)."""
    return sum(abs(min(x, 1) - min(y, 1)) for p, q, m in zip(a, b, mask) if m
               for x, y in zip(p, q)) / (3 * sum(mask))


def draw_reference(words, samples, folder):
    """By firn: (R, G, B) of each pixel."""
    path = folder / 'reference.exr'
    subprocess.run([*words, '-r', 'reference', '--plain', '-q', '--samples', str(samples),
                    *(w for s in OFF for w in ('--set', s)), '-o', path], check=True)
    planes = Exr(path.read_bytes()).read_planes('RGB')
    return [*zip(*(planes[c] for c in 'RGB'))]


def main(firn, file, panorama, samples='16', size='320x240', kind='point'):
    size, samples = tuple(map(int, size.split('x'))), int(samples)
    glb = Glb(pathlib.Path(file).read_bytes())
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        data = scene(glb, Exr(pathlib.Path(panorama).read_bytes()), size, samples, kind)
        (folder / 'scene').write_bytes(data)
        (folder / 'unlit.glb').write_bytes(glb.unlit())
        subprocess.run([os.environ.get('CC', 'cc').split()[-1], '-std=c17', '-O3', '-march=native',
                        '-fopenmp', HERE / 'paths.c', '-lm', '-o', folder / 'paths'], check=True)
        subprocess.run([folder / 'paths', folder / 'scene', folder / 'out'], check=True)
        rows = [*struct.iter_unpack('<7f', (folder / 'out').read_bytes())]
        words = (firn, 'render', folder / 'unlit.glb', '--env', panorama, '--size', '%dx%d' % size,
                 '--pixel-filter', 'box' if kind == 'box' else 'point', '--set',
                 'reference.normals=' + ('flat' if kind == 'flat' else 'interpolated'))
        found = draw_reference(words, samples if kind == 'box' else 1, folder)
        half = draw_reference(words, max(samples // 2, 1), folder) if kind == 'box' else None
    mask = [row[6] for row in rows]
    even, odd = [row[:3] for row in rows], [row[3:6] for row in rows]
    truth = [tuple((a + b) / 2 for a, b in zip(p, q)) for p, q in zip(even, odd)]
    text = (f'{pathlib.Path(file).stem}: {error(found, truth, mask):.4f} on {sum(mask):.0f} '
            f'pixels; noise of the paths {error(even, odd, mask) / 2:.4f}')
    print(text + (f', of the reference {error(found, half, mask):.4f}' if half else ''))


if __name__ == '__main__':
    if len(sys.argv) not in range(4, 8) or sys.argv[6:] not in FILTERS:
        sys.exit(__doc__)
    main(*sys.argv[1:])
