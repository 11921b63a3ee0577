"""models.py: kinds of malformed models: entries are name, content, what becomes of it, files beside
it. Some kinds have panoramas, too."""
import base64
import json
import struct

from builders import (
    ACCEPTED, AVIF, CORNERS, DRAWN, EITHER, POINTS, REFUSED, WEBP, at, data_uri, exr, flipped, glb,
    glb_of, gltf, hdr, hdr_line, nodes, obj, ply, png, tent, textured)

NAN, INFINITY = float('nan'), float('inf')


def truncated():
    whole, mesh, panorama = glb(), ply(), exr()
    for size in (4, 12, 20, len(whole) // 2, len(whole) - 8):
        yield f'{size}.glb', whole[:size], REFUSED
    yield 'header.ply', mesh[:mesh.index(b'end_header')], REFUSED
    yield 'vertices.ply', mesh[:-60], REFUSED
    yield 'faces.ply', mesh[:-20], EITHER  # what is missing may be left out
    yield 'line.obj', obj()[:-5], EITHER
    yield 'json.gltf', gltf(data_uri)[:-40], REFUSED
    for size in (3, 60, len(panorama) // 2, len(panorama) - 1):
        yield f'{size}.exr', panorama[:size], REFUSED
    yield 'texels.hdr', hdr(hdr_line(16, b'\x90\x80')), REFUSED


def bit_flips():
    sources = {'glb': glb(), 'gltf': gltf(data_uri), 'ply': ply(), 'obj': obj(), 'exr': exr(),
               'hdr': hdr(hdr_line(16, b'\x90\x80') * 8)}
    for suffix, content in sources.items():
        for seed in range(6):
            yield f'{seed}.{suffix}', flipped(content, seed), EITHER


def lengths():
    buffer, _ = tent()
    yield 'file-long.glb', glb(size=1 << 30), EITHER
    yield 'file-short.glb', glb(size=64), REFUSED
    yield 'json-long.glb', glb(json_size=0x7fffffff), REFUSED
    yield 'json-all.glb', glb(json_size=0xffffffff), REFUSED
    yield 'binary-long.glb', glb(data_size=0xfffffff0), REFUSED
    yield 'buffer-long.glb', glb(at('buffers', 0, 'byteLength', 1 << 40)), REFUSED
    yield 'buffer-negative.glb', glb(at('buffers', 0, 'byteLength', -1)), EITHER
    yield 'buffer-none.glb', glb(data=b''), REFUSED
    yield 'view-beyond.glb', glb(at('bufferViews', 0, 'byteOffset', len(buffer) - 4)), REFUSED
    yield 'view-wraps.glb', glb(at('bufferViews', 0, 'byteOffset', (1 << 64) - 8)), EITHER
    yield 'accessor-beyond.glb', glb(at('accessors', 0, 'count', 5)), REFUSED
    yield 'accessor-wraps.glb', glb(at('accessors', 0, 'byteOffset', (1 << 64) - 12)), EITHER
    yield 'stride-wraps.glb', glb(at('bufferViews', 0, 'byteStride', 1 << 62)), EITHER
    yield 'vertices.ply', ply(vertex_count=1000), REFUSED
    yield 'faces.ply', ply(face_count=1000), EITHER
    yield 'corners.ply', ply(per_face=255), REFUSED
    yield 'corners-many.ply', ply(per_face=0xffffffff, count_type='uint'), REFUSED
    yield 'chunk.exr', exr(chunk_size=1 << 30), REFUSED
    yield 'chunk-negative.exr', exr(chunk_size=0xffffffff), REFUSED
    yield 'offset.exr', exr(offset=1 << 60), REFUSED
    yield 'offset-own.exr', exr(offset=0), REFUSED


def indices():
    for size, index in (('B', 255), ('H', 65535), ('I', 0xffffffff), ('H', 4)):
        data, document = tent(corners=(*CORNERS[:11], index), corner_format=size)
        yield (f'{size}{index}.glb', glb_of(json.dumps(document).encode(), data), REFUSED)
    yield 'large.obj', obj(faces='f 1 2 9999999999999\n'), REFUSED
    yield 'next.obj', obj(faces='f 1 2 5\n'), REFUSED
    yield 'back.obj', obj(faces='f -1 -2 -9\n'), REFUSED
    yield 'zero.obj', obj(faces='f 0 0 0\n'), REFUSED
    yield 'uv.obj', obj(faces='f 1/7 2/7 3/7\n'), EITHER
    yield 'next.ply', ply(corners=(*CORNERS[:11], 4)), REFUSED
    yield 'negative.ply', ply(corners=(*CORNERS[:11], -1)), REFUSED
    yield 'mesh.glb', glb(at('nodes', 0, 'mesh', 7)), REFUSED
    yield 'node.glb', glb(at('scenes', 0, 'nodes', [9])), REFUSED
    yield 'node-negative.glb', glb(at('scenes', 0, 'nodes', [-1])), REFUSED
    yield 'scene.glb', glb(at('scene', 5)), EITHER
    yield 'view.glb', glb(at('accessors', 0, 'bufferView', 1 << 31)), REFUSED
    yield 'accessor.glb', glb(at('meshes', 0, 'primitives', 0, 'indices', 77)), REFUSED
    yield 'material.glb', glb(at('meshes', 0, 'primitives', 0, 'material', 3)), REFUSED


def numbers():
    for name, value in (('nan', NAN), ('infinity', INFINITY), ('large', 3e38)):
        data, document = tent(points=((value, 0, 0), *POINTS[1:]))
        yield f'{name}.glb', glb_of(json.dumps(document).encode(), data), REFUSED
    yield 'nan.obj', obj(points=((NAN, 0, 0), *POINTS[1:])), REFUSED
    yield 'nan.ply', ply(points=((NAN, 0, 0), *POINTS[1:])), REFUSED
    yield 'exponent.obj', obj(points=(('1e999', 0, 0), *POINTS[1:])), REFUSED
    yield ('color.obj', obj('mtllib a.mtl\nusemtl a\n'), REFUSED,
           (('a.mtl', b'newmtl a\nKd nan inf 1e300\n'),))
    yield 'scale.glb', glb(at('nodes', 0, 'scale', [1e38, 1e38, 1e38])), REFUSED
    yield 'matrix.glb', glb(at('nodes', 0, 'matrix', [1e30] * 16)), REFUSED
    yield 'matrix-short.glb', glb(at('nodes', 0, 'matrix', [1, 2, 3])), EITHER
    yield 'rotation.glb', glb(at('nodes', 0, 'rotation', [0, 0, 0, 0])), EITHER
    for ior in (0.5, 1e30, -1):
        def glass(document, ior=ior):
            document['extensionsUsed'] = ['KHR_materials_ior', 'KHR_materials_transmission']
            document['materials'] = [{
                'extensions': {'KHR_materials_ior': {'ior': ior},
                               'KHR_materials_transmission': {'transmissionFactor': 1}}}]
            document['meshes'][0]['primitives'][0]['material'] = 0
        yield f'ior{ior:g}.glb', glb(glass), REFUSED


def trees():
    yield 'deep.glb', nodes(100000, lambda i: [i + 1] if i < 99999 else []), DRAWN
    yield 'cycle.glb', nodes(3, lambda i: [(i + 1) % 3]), REFUSED
    yield 'own-child.glb', nodes(1, lambda i: [0]), REFUSED
    yield 'doubling.glb', nodes(41, lambda i: [i + 1] * 2 if i < 40 else []), REFUSED
    yield 'missing-child.glb', nodes(2, lambda i: [99]), REFUSED
    yield 'wide.glb', nodes(20001, lambda i: list(range(1, 20001)) if i == 0 else []), DRAWN
    yield 'arrays.gltf', b'{"asset":' + b'[' * 100000 + b']' * 100000 + b'}', REFUSED
    yield 'objects.gltf', b'{"a":' * 100000 + b'1' + b'}' * 100000, REFUSED


def counts():
    def zeros(document):
        document['accessors'][0].update(count=0xfffffff0)
        del document['accessors'][0]['bufferView']

    def sparse(document):
        document['accessors'][0]['sparse'] = {
            'count': 0x7fffffff,
            'indices': {'bufferView': 1, 'componentType': 5123},
            'values': {'bufferView': 0}}
    yield 'zeros.glb', glb(zeros), REFUSED
    yield 'sparse.glb', glb(sparse), EITHER
    yield 'accessor.glb', glb(at('accessors', 0, 'count', 1 << 62)), REFUSED
    yield 'indices.glb', glb(at('accessors', 1, 'count', 0xffffffff)), REFUSED
    yield 'negative.glb', glb(at('accessors', 0, 'count', -4)), REFUSED
    yield 'vertices.ply', ply(vertex_count=4000000000), REFUSED
    yield 'faces.ply', ply(face_count=4000000000), REFUSED
    yield 'polygon.obj', obj(faces='f' + ' 1 2 3' * 100000 + '\n'), EITHER
    yield 'words.obj', obj('# ' + 'x' * (1 << 20) + '\n'), DRAWN
    yield 'memory.gltf', b'{"buffers":[' + b'{"byteLength":4294967295},' * 1000 + b'{}]}', REFUSED


def uris():
    buffer, _ = tent()
    secret = (('../secret.bin', buffer),)
    for name, uri in (('up', '../secret.bin'), ('up-hidden', 'a/../../secret.bin'),
                      ('up-percent', '%2e%2e/secret.bin'), ('up-windows', '..\\secret.bin'),
                      ('root', '/etc/passwd'), ('file', 'file:///etc/passwd'),
                      ('file-short', 'file:secret.bin'), ('https', 'https://example.org/a.bin'),
                      ('device', '/dev/zero')):
        yield f'{name}.gltf', gltf(uri), REFUSED, secret
        yield f'{name}-texture.gltf', gltf(data_uri, textured(uri)), ACCEPTED, secret
    yield 'own.gltf', gltf('own.gltf'), REFUSED
    yield 'folder.gltf', gltf('.'), REFUSED
    yield 'missing.gltf', gltf('no-such.bin'), REFUSED
    yield 'empty-name.gltf', gltf(''), REFUSED
    yield 'beside.gltf', gltf('beside.bin'), DRAWN, (('beside.bin', buffer),)
    yield 'data.gltf', gltf(data_uri), DRAWN
    yield 'library.obj', obj('mtllib ../a.mtl\n'), REFUSED


def base64_text():
    head = 'data:application/octet-stream;base64,'
    good = base64.b64encode(tent()[0]).decode()
    yield 'letters.gltf', gltf(head + '!' * len(good)), EITHER
    yield 'short.gltf', gltf(head + good[:20]), REFUSED
    yield 'odd.gltf', gltf(head + good[:-3]), REFUSED
    yield 'none.gltf', gltf(head), REFUSED
    yield 'only-padding.gltf', gltf(head + '=' * 80), REFUSED
    yield 'no-comma.gltf', gltf('data:application/octet-stream;base64' + good), REFUSED
    yield 'plain.gltf', gltf('data:,abc'), REFUSED
    yield 'high.gltf', gltf(head + '\u00ff' * len(good)), REFUSED


def empty():
    for suffix in ('glb', 'gltf', 'obj', 'ply', 'exr', 'hdr'):
        yield f'nothing.{suffix}', b'', REFUSED
    yield 'braces.gltf', b'{}', REFUSED
    yield 'comment.obj', b'# nothing\n', REFUSED
    yield 'points.obj', obj(faces=''), REFUSED
    yield 'no-faces.ply', ply(corners=()), REFUSED
    yield 'no-meshes.glb', glb(at('meshes', [])), REFUSED
    yield 'no-nodes.glb', glb(at('scenes', 0, 'nodes', [])), REFUSED
    yield 'no-attributes.glb', glb(at('meshes', 0, 'primitives', 0, 'attributes', {})), REFUSED
    yield 'zeros.glb', bytes(4096), REFUSED
    yield 'zeros.exr', bytes(4096), REFUSED
    yield 'zeros.ply', bytes(4096), REFUSED


def shapes():
    yield 'one-point.obj', obj(points=((1, 1, 1),) * 4), DRAWN
    yield 'line.obj', obj(points=((0, 0, 0), (1, 0, 0), (2, 0, 0), (3, 0, 0))), DRAWN
    yield 'same-corner.obj', obj(faces='f 1 1 1\nf 2 2 3\n'), DRAWN
    yield 'flat.obj', obj(faces='f 1 2 3\n'), DRAWN
    yield 'tiny.obj', obj(points=tuple(tuple(x * 1e-30 for x in p) for p in POINTS)), DRAWN
    yield 'vast.obj', obj(points=tuple(tuple(x * 9e5 for x in p) for p in POINTS)), DRAWN
    yield 'far.obj', obj(points=tuple((9e5 + x, y, z) for x, y, z in POINTS)), DRAWN
    yield 'scale-0.glb', glb(at('nodes', 0, 'scale', [0, 0, 0])), DRAWN
    yield 'no-normals.glb', glb(), DRAWN
    yield 'normals-0.obj', obj('vn 0 0 0\n', faces='f 1//1 2//1 3//1\n'), DRAWN
    yield 'normals-odd.obj', obj('vn 1e-30 0 0\n', faces='f 1//1 2//1 3//1\n'), DRAWN
    yield 'fan.obj', obj(points=(*POINTS, (3, 0, 0)),
                         faces='f 1 2 3\nf 1 2 4\nf 1 2 5\nf 2 1 3\n'), DRAWN
    yield 'inside-out.obj', obj(faces='f 3 2 1\nf 4 3 1\nf 2 4 1\nf 3 4 2\n'), DRAWN
    yield 'twice.obj', obj(faces='f 1 2 3\n' * 50), DRAWN
    yield 'pentagon-bent.obj', obj(points=(*POINTS, (0, 5, 3)), faces='f 1 2 3 4 5\n'), DRAWN


def names():
    yield 'escape.glb', glb(at('meshes', 0, 'name', '\x1b[31m\n\r\x07')), DRAWN
    yield 'long.glb', glb(at('nodes', 0, 'name', 'n' * 100000)), EITHER
    yield 'number.glb', glb(at('nodes', 0, 'name', 5)), EITHER
    yield 'list.glb', glb(at('meshes', {'a': 1})), REFUSED
    yield 'text.glb', glb(at('accessors', 0, 'count', 'four')), REFUSED
    yield 'kind.glb', glb(at('accessors', 0, 'type', 'VEC9')), EITHER
    yield 'component.glb', glb(at('accessors', 0, 'componentType', 1)), REFUSED
    yield 'version.glb', glb(at('asset', 'version', '9.9')), REFUSED
    yield 'bytes.gltf', gltf(data_uri).replace(b'2.0', b'2.0\xff\xfe'), EITHER
    yield 'property.ply', ply().replace(b'float x', b'float\xffx'), EITHER
    yield 'type.ply', ply().replace(b'uchar int', b'uchar string'), REFUSED
    yield 'format.ply', ply().replace(b'little', b'middle'), EITHER


def textures():
    good = png(4, 4)
    loop = b'GIF89a' + struct.pack('<HHBBB', 4, 4, 0, 0, 0) + b'\x21\xff\xff' * 100
    for name, content, wanted in (
            ('good', good, DRAWN), ('empty', b'', ACCEPTED), ('cut', good[:40], ACCEPTED),
            ('vast', png(60000, 60000, b'\0'), ACCEPTED),
            ('zero', png(0, 4, b''), ACCEPTED),
            ('rows', png(4, 4, b'\0' * 8), ACCEPTED),
            ('filter', png(4, 4, b'\xff' * 52), ACCEPTED),
            ('flipped', flipped(good, 3, 8), EITHER), ('gif', loop, ACCEPTED),
            ('jpeg', b'\xff\xd8\xff\xc4' + b'\xff' * 300, ACCEPTED),
            # drawn with libavif, else accepted without the texture
            ('avif', AVIF, EITHER), ('avif-cut', AVIF[:-8], EITHER),
            ('avif-vast', AVIF.replace(b'ispe\0\0\0\0\0\0', b'ispe\0\0\0\0\xff\xff'), EITHER),
            ('webp', WEBP, DRAWN), ('webp-cut', WEBP[:-8], ACCEPTED),
            ('webp-vast', WEBP[:26] + b'\xff' * 4 + WEBP[30:], ACCEPTED),
            ('tga', bytes([0, 0, 10]) + bytes(9) + b'\xff\xff\xff\xff\x20\0' + b'\xff', EITHER)):
        yield f'{name}.gltf', gltf(data_uri, textured(f'{name}.pic')), wanted, \
            ((f'{name}.pic', content),)
