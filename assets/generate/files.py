"""files.py: writes glTF, PNG and OpenEXR files with the standard library alone."""
import json
import math
import struct
import zlib

TRANSMISSION, IOR = 'KHR_materials_transmission', 'KHR_materials_ior'
VOLUME, UNLIT = 'KHR_materials_volume', 'KHR_materials_unlit'
FLOAT, USHORT, UINT = 5126, 5123, 5125


def glass(name, ior, priority, thickness, tint=(1, 1, 1), distance=1, cloud=0):
    """glTF material of a clear dielectric: KHR_materials_transmission, _ior and _volume. `tint` is
    the attenuationColor at `distance`; lengths in metres. `cloud` is the optical depth of a cloudy
    core, the mean number of scattering events on a path across the core."""
    return {
        'name': name,
        'extras': {'priority': priority, **({'cloud': cloud} if cloud else {})},
        'pbrMetallicRoughness': {'roughnessFactor': 0, 'metallicFactor': 0},
        'extensions': {
            TRANSMISSION: {'transmissionFactor': 1},
            IOR: {'ior': ior},
            VOLUME: {'thicknessFactor': thickness, 'attenuationColor': list(tint),
                     'attenuationDistance': distance},
        },
    }


def unlit(name, texture=None):
    """KHR_materials_unlit material: emitted radiance is the texture times the vertex colours."""
    surface = {'roughnessFactor': 1, 'metallicFactor': 0}
    if texture is not None:
        surface['baseColorTexture'] = {'index': texture}
    return {'name': name, 'pbrMetallicRoughness': surface, 'extensions': {UNLIT: {}}}


def lit(name, roughness, **textures):
    """Lit dielectric material; `textures` are members of pbrMetallicRoughness."""
    return {'name': name, 'pbrMetallicRoughness': {'metallicFactor': 0,
                                                   'roughnessFactor': roughness, **textures}}


def look_at(eye, target):
    """Column-major matrix of a camera node: right, up, back, position."""
    back = [a - b for a, b in zip(eye, target)]
    length = math.hypot(*back)
    back = [a / length for a in back]
    level = math.hypot(back[0], back[2])
    right = [back[2] / level, 0, -back[0] / level]
    up = [back[1] * right[2], back[2] * right[0] - back[0] * right[2], -back[1] * right[0]]
    matrix = [*right, 0, *up, 0, *back, 0, *eye, 1]
    return [round(value, 7) + 0.0 for value in matrix]


class Model:
    """Builder of a glTF scene."""

    def __init__(self):
        self.bytes = bytearray()
        self.materials, self.used = [], set()
        self.json = {'asset': {'version': '2.0', 'generator': 'firn assets/generate'},
                     'scene': 0, 'nodes': [], 'meshes': [], 'bufferViews': [], 'accessors': []}

    def view(self, data, **more):
        self.bytes += bytes(-len(self.bytes) % 4)
        self.json['bufferViews'].append(
            {'buffer': 0, 'byteOffset': len(self.bytes), 'byteLength': len(data), **more})
        self.bytes += data
        return len(self.json['bufferViews']) - 1

    def floats(self, rows, digits, bounds=False):
        """Adds a float vector accessor, rounded so that files are reproducible on any machine."""
        rows = [tuple(round(value, digits) + 0.0 for value in row) for row in rows]
        width = len(rows[0])
        data = struct.pack(f'<{len(rows) * width}f', *(value for row in rows for value in row))
        accessor = {'bufferView': self.view(data, target=34962), 'componentType': FLOAT,
                    'count': len(rows), 'type': f'VEC{width}'}
        if bounds:
            columns = [struct.unpack(f'<{len(rows)}f', struct.pack(f'<{len(rows)}f', *column))
                       for column in zip(*rows)]
            accessor.update(min=[min(c) for c in columns], max=[max(c) for c in columns])
        self.json['accessors'].append(accessor)
        return len(self.json['accessors']) - 1

    def indices(self, faces, count):
        code, kind = ('H', USHORT) if count < 65536 else ('I', UINT)
        data = struct.pack(f'<{len(faces) * 3}{code}', *(i for face in faces for i in face))
        self.json['accessors'].append(
            {'bufferView': self.view(data, target=34963), 'componentType': kind,
             'count': len(faces) * 3, 'type': 'SCALAR'})
        return len(self.json['accessors']) - 1

    def texture(self, png):
        images, textures = (self.json.setdefault(key, []) for key in ('images', 'textures'))
        images.append({'bufferView': self.view(png), 'mimeType': 'image/png'})
        textures.append({'source': len(images) - 1})
        return len(textures) - 1

    def add(self, name, mesh, material):
        """Adds a node with a new mesh."""
        if material not in self.materials:
            self.materials.append(material)
            self.used.update(material.get('extensions', ()))
        attributes = {'POSITION': self.floats(mesh.points, 7, bounds=True),
                      'NORMAL': self.floats(mesh.normals, 4)}
        if mesh.uvs:
            attributes['TEXCOORD_0'] = self.floats(mesh.uvs, 5)
        if mesh.colors:
            attributes['COLOR_0'] = self.floats(mesh.colors, 4)
        indices = self.indices(mesh.faces, len(mesh.points))
        primitive = {'attributes': attributes, 'indices': indices,
                     'material': self.materials.index(material)}
        self.json['meshes'].append({'name': name, 'primitives': [primitive]})
        self.json['nodes'].append({'name': name, 'mesh': len(self.json['meshes']) - 1})

    def camera(self, eye, target, fov_deg):
        """Adds a camera node; `fov_deg` is the vertical field of view."""
        self.json['cameras'] = [{'type': 'perspective', 'perspective': {
            'yfov': round(math.radians(fov_deg), 6), 'aspectRatio': 1.25, 'znear': 0.01}}]
        self.json['nodes'].append({'name': 'camera', 'camera': 0, 'matrix': look_at(eye, target)})

    def file(self):
        """Returns the content of the .glb file."""
        self.bytes += bytes(-len(self.bytes) % 4)
        document = {**self.json, 'materials': self.materials, 'extensionsUsed': sorted(self.used),
                    'scenes': [{'nodes': list(range(len(self.json['nodes'])))}],
                    'buffers': [{'byteLength': len(self.bytes)}]}
        text = json.dumps(document, separators=(',', ':')).encode()
        text += b' ' * (-len(text) % 4)
        chunks = struct.pack('<II', len(text), 0x4e4f534a) + text
        chunks += struct.pack('<II', len(self.bytes), 0x004e4942) + bytes(self.bytes)
        return struct.pack('<4sII', b'glTF', 2, 12 + len(chunks)) + chunks


def png_chunk(name, data):
    return struct.pack('>I', len(data)) + name + data + struct.pack('>I', zlib.crc32(name + data))


def png(rows, palette):
    """PNG with a palette of up to 256 colours; `rows` have palette indices, from the top."""
    header = struct.pack('>IIBBBBB', len(rows[0]), len(rows), 8, 3, 0, 0, 0)
    colors = bytes(round(255 * min(max(value, 0), 1)) for color in palette for value in color)
    return (b'\x89PNG\r\n\x1a\n' + png_chunk(b'IHDR', header) + png_chunk(b'PLTE', colors) +
            png_chunk(b'IDAT', zlib.compress(b''.join(b'\0' + bytes(row) for row in rows), 9)) +
            png_chunk(b'IEND', b''))


def png_colors(rows):
    """8-bit RGB PNG with the Sub filter; `rows` are bytes R G B, from the top."""
    header = struct.pack('>IIBBBBB', len(rows[0]) // 3, len(rows), 8, 2, 0, 0, 0)
    steps = (b'\1' + bytes((v - (row[i - 3] if i > 2 else 0)) & 255 for i, v in enumerate(row))
             for row in rows)
    return (b'\x89PNG\r\n\x1a\n' + png_chunk(b'IHDR', header) +
            png_chunk(b'IDAT', zlib.compress(b''.join(steps), 9)) + png_chunk(b'IEND', b''))


def exr(rows, sun=None):
    """ZIP-compressed OpenEXR image of half floats. `rows`, from the top, are lists of R, G and B
    lists. `sun`: azimuth and elevation (see src/scene/environment/environment.h), radiance of a
    white surface that faces the sun."""
    width, height = len(rows[0][0]), len(rows)

    def attribute(name, kind, data):
        return name + b'\0' + kind + b'\0' + struct.pack('<I', len(data)) + data

    channel = struct.pack('<iIii', 1, 0, 1, 1)
    window = struct.pack('<4i', 0, 0, width - 1, height - 1)
    header = struct.pack('<II', 20000630, 2)
    header += attribute(b'channels', b'chlist', b''.join(c + b'\0' + channel
                                                         for c in (b'B', b'G', b'R')) + b'\0')
    header += attribute(b'compression', b'compression', b'\3')
    header += attribute(b'dataWindow', b'box2i', window)
    header += attribute(b'displayWindow', b'box2i', window)
    header += attribute(b'lineOrder', b'lineOrder', b'\0')
    header += attribute(b'pixelAspectRatio', b'float', struct.pack('<f', 1))
    header += attribute(b'screenWindowCenter', b'v2f', struct.pack('<2f', 0, 0))
    header += attribute(b'screenWindowWidth', b'float', struct.pack('<f', 1))
    if sun:
        header += attribute(b'firn/sun', b'string', ' '.join(f'{v:g}' for v in sun).encode())
    header += b'\0'

    blocks = []
    for first in range(0, height, 16):
        data = b''.join(struct.pack(f'<{width}e', *row[c]) for row in rows[first:first + 16]
                        for c in (2, 1, 0))
        halves = data[::2] + data[1::2]
        steps = bytes([halves[0]]) + bytes((b - a + 128) & 255
                                           for a, b in zip(halves, halves[1:]))
        packed = zlib.compress(steps, 9)
        if len(packed) >= len(data):
            packed = data
        blocks.append(struct.pack('<iI', first, len(packed)) + packed)
    offset, table = len(header) + 8 * len(blocks), b''
    for block in blocks:
        table += struct.pack('<Q', offset)
        offset += len(block)
    return header + table + b''.join(blocks)
