"""builders.py: makes small files of each format, sound ones or with some words changed."""
import base64
import json
import random
import struct
import zlib
from typing import NamedTuple

# What the program makes of a file; what is drawn is accepted, and has a picture worth looking at.
DRAWN, ACCEPTED, REFUSED, EITHER = 'drawn', 'accepted', 'refused', 'either'

WEBP = base64.b64decode(  # 1 x 1 texels
    'UklGRiIAAABXRUJQVlA4IBYAAAAwAQCdASoBAAEADsD+JaQAA3AAAAAA')
AVIF = base64.b64decode(  # 4 x 4 texels
    'AAAAIGZ0eXBhdmlmAAAAAGF2aWZtaWYxbWlhZk1BMUEAAADybWV0YQAAAAAAAAAoaGRscgAAAAAAAAAAcGljdAAA'
    'AAAAAAAAAAAAAGxpYmF2aWYAAAAADnBpdG0AAAAAAAEAAAAeaWxvYwAAAABEAAABAAEAAAABAAABGgAAACAAAAAo'
    'aWluZgAAAAAAAQAAABppbmZlAgAAAAABAABhdjAxQ29sb3IAAAAAamlwcnAAAABLaXBjbwAAABRpc3BlAAAAAAAA'
    'AAQAAAAEAAAAEHBpeGkAAAAAAwgICAAAAAxhdjFDgSAAAAAAABNjb2xybmNseAABAA0ABoAAAAAXaXBtYQAAAAAA'
    'AAABAAEEAQKDBAAAAChtZGF0EgAKCDgEf5QENBpAMhIRQAAAQAAAV7LtHAxKkTFA5YQ=')
POINTS = ((0, 1, 0), (-1, -1, 1), (1, -1, 1), (0, -1, -1))
CORNERS = (0, 1, 2, 0, 2, 3, 0, 3, 1, 1, 3, 2)


class Entry(NamedTuple):
    kind: str     # a row of the table in docs/explanation/trust.md
    use: str      # what the file is given to
    name: str     # of the file to read
    content: bytes
    wanted: str   # DRAWN, ...
    others: tuple = ()  # (name, content) of files beside it


def tent(points=POINTS, corners=CORNERS, corner_format='H'):
    """A tetrahedron: its buffer, and the glTF that describes it."""
    positions = b''.join(struct.pack('<3f', *point) for point in points)
    indices = struct.pack(f'<{len(corners)}{corner_format}', *corners)
    data = positions + indices + bytes(-len(indices) % 4)
    component = {'B': 5121, 'H': 5123, 'I': 5125}[corner_format]
    return data, {
        'asset': {'version': '2.0'},
        'scene': 0,
        'scenes': [{'nodes': [0]}],
        'nodes': [{'mesh': 0}],
        'meshes': [{'primitives': [{'attributes': {'POSITION': 0}, 'indices': 1}]}],
        'buffers': [{'byteLength': len(data)}],
        'bufferViews': [
            {'buffer': 0, 'byteOffset': 0, 'byteLength': len(positions)},
            {'buffer': 0, 'byteOffset': len(positions), 'byteLength': len(indices)}],
        'accessors': [
            {'bufferView': 0, 'componentType': 5126, 'count': len(points), 'type': 'VEC3'},
            {'bufferView': 1, 'componentType': component, 'count': len(corners),
             'type': 'SCALAR'}],
    }


def glb_of(text, data, size=None, json_size=None, data_size=None):
    text += b' ' * (-len(text) % 4)
    whole = 28 + len(text) + len(data)
    return (struct.pack('<4sIIII', b'glTF', 2, size or whole, json_size or len(text), 0x4e4f534a) +
            text + struct.pack('<II', data_size or len(data), 0x004e4942) + data)


def glb(change=None, data=None, **sizes):
    """The tetrahedron with change(document) done to it."""
    buffer, document = tent()
    if change:
        change(document)
    return glb_of(json.dumps(document).encode(), buffer if data is None else data, **sizes)


def at(*path_and_value):
    """A change: document[a][b]... = value."""
    *path, last, value = path_and_value

    def change(document):
        for key in path:
            document = document[key]
        document[last] = value
    return change


def gltf(uri, change=None):
    buffer, document = tent()
    document['buffers'][0]['uri'] = uri(buffer) if callable(uri) else uri
    if change:
        change(document)
    return json.dumps(document).encode()


def data_uri(buffer):
    return 'data:application/octet-stream;base64,' + base64.b64encode(buffer).decode()


def textured(uri):
    def change(document):
        document['images'] = [{'uri': uri}]
        document['textures'] = [{'source': 0}]
        document['materials'] = [{'pbrMetallicRoughness': {'baseColorTexture': {'index': 0}}}]
        primitive = document['meshes'][0]['primitives'][0]
        primitive['material'] = 0
        primitive['attributes']['TEXCOORD_0'] = 2
        document['accessors'].append(
            {'bufferView': 0, 'componentType': 5126, 'count': 4, 'type': 'VEC2'})
    return change


def obj(text='', points=POINTS, faces='f 1 2 3\nf 1 3 4\nf 1 4 2\nf 2 4 3\n'):
    return (text + ''.join('v {} {} {}\n'.format(*point) for point in points) + faces).encode()


def ply(points=POINTS, corners=CORNERS, vertex_count=None, face_count=None, per_face=3,
        count_type='uchar'):
    header = ('ply\nformat binary_little_endian 1.0\n'
              f'element vertex {len(points) if vertex_count is None else vertex_count}\n'
              'property float x\nproperty float y\nproperty float z\n'
              f'element face {len(corners) // 3 if face_count is None else face_count}\n'
              f'property list {count_type} int vertex_indices\nend_header\n')
    count = struct.pack('<I' if count_type == 'uint' else '<B', per_face)
    faces = b''.join(count + struct.pack('<3i', *corners[i:i + 3])
                     for i in range(0, len(corners), 3))
    return header.encode() + b''.join(struct.pack('<3f', *point) for point in points) + faces


def png_of(*chunks):
    """The chunks, each a (name, data) with a checksum."""
    return b'\x89PNG\r\n\x1a\n' + b''.join(
        struct.pack('>I', len(data)) + name + data + struct.pack('>I', zlib.crc32(name + data))
        for name, data in chunks)


def png_head(width, height, depth=8, color=2, interlaced=0):
    return b'IHDR', struct.pack('>IIBBBBB', width, height, depth, color, 0, 0, interlaced)


def png(width, height, rows=None):
    if rows is None:
        rows = (b'\0' + b'\x80\x40\x20' * width) * height
    return png_of(png_head(width, height), (b'IDAT', zlib.compress(rows, 9)), (b'IEND', b''))


def attribute(name, kind, value):
    return name.encode() + b'\0' + kind.encode() + b'\0' + struct.pack('<I', len(value)) + value


def exr_head(window=(0, 0, 7, 3), display=None, channels='BGR', kind=2, compression=0, sampling=1,
             tiles=None, order=0, more=b'', without=()):
    """The attributes of a part; `more`: other ones; without those of some names."""
    chlist = b''.join(name.encode() + b'\0' + struct.pack('<IIII', kind, 0, sampling, sampling)
                      for name in channels) + b'\0'
    attributes = {
        'channels': ('chlist', chlist),
        'compression': ('compression', bytes([compression])),
        'dataWindow': ('box2i', struct.pack('<4i', *window)),
        'displayWindow': ('box2i', struct.pack('<4i', *(display or window))),
        'lineOrder': ('lineOrder', bytes([order])),
        'pixelAspectRatio': ('float', struct.pack('<f', 1)),
        'screenWindowCenter': ('v2f', bytes(8)),
        'screenWindowWidth': ('float', struct.pack('<f', 1)),
    }
    if tiles:
        attributes['tiles'] = 'tiledesc', struct.pack('<IIB', *tiles)
    return b''.join(attribute(name, *value) for name, value in attributes.items()
                    if name not in without) + more + b'\0'


def stl(points=POINTS, corners=CORNERS, count=None, head=b'STL by firn', attribute=0):
    """The tetrahedron as a binary file; `count` is that of the header."""
    facets = [corners[i:i + 3] for i in range(0, len(corners), 3)]
    body = b''.join(struct.pack('<12fH', 0, 0, 0, *(x for i in facet for x in points[i]), attribute)
                    for facet in facets)
    return head.ljust(80, b' ') + struct.pack('<I', len(facets) if count is None else count) + body


def stl_text(points=POINTS, corners=CORNERS):
    lines = ['solid tent']
    for i in range(0, len(corners), 3):
        lines += ['facet normal 0 0 0', ' outer loop']
        lines += ['  vertex {} {} {}'.format(*points[corner]) for corner in corners[i:i + 3]]
        lines += [' endloop', 'endfacet']
    return '\n'.join([*lines, 'endsolid tent', '']).encode()


def exr(chunk_size=None, offset=None, flags=0, size=(8, 4), value=0.5, texels=None, channels='BGR',
        **head):
    """Lines of floats, not compressed; size[1] of size[0], whatever the header says. `texels`: line
    by line, of each its channels."""
    width, height = size
    head = struct.pack('<II', 20000630, 2 | flags) + exr_head(
        head.pop('window', (0, 0, width - 1, height - 1)), channels=channels, **head)
    count = width * len(channels)
    values = [value] * (count * height) if texels is None else texels
    line_size = 4 * count
    first = len(head) + 8 * height
    offsets = b''.join(
        struct.pack('<Q', first + y * (8 + line_size) if offset is None else offset)
        for y in range(height))
    lines = b''.join(struct.pack('<iI', y, chunk_size or line_size) +
                     struct.pack(f'<{count}f', *values[y * count:(y + 1) * count])
                     for y in range(height))
    return head + offsets + lines


def exr_tiles(level=0, flags=0x200, **head):
    """Four tiles of 4 x 2 texels."""
    head = struct.pack('<II', 20000630, 2 | flags) + exr_head(tiles=(4, 2, level), **head)
    tile = struct.pack('<8f', *([0.5] * 8)) * 3
    first = len(head) + 8 * 4
    offsets = b''.join(struct.pack('<Q', first + i * (20 + len(tile))) for i in range(4))
    return head + offsets + b''.join(
        struct.pack('<4iI', i % 2, i // 2, 0, 0, len(tile)) + tile for i in range(4))


def exr_parts(*parts, flags=0x1000):
    """Parts of lines of 8 floats, 4 of them; each is channels and its type."""
    head = struct.pack('<II', 20000630, 2 | flags) + b''.join(
        exr_head(channels=channels, more=attribute('name', 'string', f'part{i}'.encode()) +
                 attribute('type', 'string', kind.encode()) +
                 attribute('chunkCount', 'int', struct.pack('<i', 4)))
        for i, (channels, kind) in enumerate(parts)) + b'\0'
    at_byte, offsets, lines = len(head) + 32 * len(parts), b'', b''
    for part, (channels, _) in enumerate(parts):
        for y in range(4):
            data = struct.pack('<8f', *([0.5] * 8)) * len(channels)
            offsets += struct.pack('<Q', at_byte + len(lines))
            lines += struct.pack('<iiI', part, y, len(data)) + data
    return head + offsets + lines


def hdr(lines, width=16, height=8, form='32-bit_rle_rgbe', resolution='-Y {} +X {}'):
    return (f'#?RADIANCE\nFORMAT={form}\n\n' + resolution.format(height, width) + '\n').encode() \
        + lines


def hdr_line(width, channel):
    """Run-length data, each of four channels being `channel`."""
    return b'\x02\x02' + struct.pack('>H', width) + channel * 4


def flipped(content, seed, count=2):
    """With some bits turned over, not those of the first bytes that name the format."""
    flips = random.Random(seed)
    result = bytearray(content)
    for _ in range(count):
        result[flips.randrange(16, len(result))] ^= 1 << flips.randrange(8)
    return bytes(result)


def nodes(count, children_of, mesh_at=None):
    """A glTF of so many nodes; the last one shows the mesh."""
    def change(document):
        document['nodes'] = [
            {'children': children_of(i)} if children_of(i) else {} for i in range(count)]
        document['nodes'][count - 1 if mesh_at is None else mesh_at]['mesh'] = 0
    return glb(change)


