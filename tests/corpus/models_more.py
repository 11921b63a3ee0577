"""models_more.py: more kinds of malformed models, format by format."""
import json
import struct

from builders import (
    ACCEPTED, CORNERS, DRAWN, EITHER, POINTS, REFUSED, at, data_uri, glb, gltf, obj, ply, png, stl,
    stl_text, tent, textured)


def several(*changes):
    def change(document):
        for each in changes:
            each(document)
    return change


def put(key, *values):
    """Lists of the document, such as its skins."""
    return at(key, list(values))


PRIMITIVE = 'meshes', 0, 'primitives', 0
PERSPECTIVE = {'yfov': 0.8, 'znear': 0.1}


def sparse(count, indices_view=1, values_view=0, component=5123, **more):
    return at('accessors', 0, 'sparse', {
        'count': count, 'indices': {'bufferView': indices_view, 'componentType': component, **more},
        'values': {'bufferView': values_view}})


def accessors():
    """Of four positions, VEC3 of floats, and twelve indices."""
    yield 'unaligned.glb', glb(at('accessors', 0, 'byteOffset', 1)), EITHER
    yield 'scalar.glb', glb(at('accessors', 0, 'type', 'SCALAR')), EITHER
    yield 'matrix.glb', glb(at('accessors', 0, 'type', 'MAT4')), EITHER
    yield 'bytes.glb', glb(at('accessors', 0, 'componentType', 5121)), EITHER
    yield 'indices-float.glb', glb(at('accessors', 1, 'componentType', 5126)), EITHER
    yield 'indices-vector.glb', glb(at('accessors', 1, 'type', 'VEC3')), EITHER
    yield 'indices-own.glb', glb(at(*PRIMITIVE, 'indices', 0)), EITHER
    yield 'positions-own.glb', glb(at(*PRIMITIVE, 'attributes', 'POSITION', 1)), EITHER
    yield 'count-0.glb', glb(at('accessors', 0, 'count', 0)), EITHER
    yield 'stride-1.glb', glb(at('bufferViews', 0, 'byteStride', 1)), EITHER
    yield 'stride-252.glb', glb(at('bufferViews', 0, 'byteStride', 252)), EITHER
    yield 'view-buffer.glb', glb(at('bufferViews', 0, 'buffer', 9)), REFUSED
    yield 'view-negative.glb', glb(at('bufferViews', 0, 'byteOffset', -4)), EITHER
    yield 'view-nowhere.glb', glb(put('bufferViews')), REFUSED
    yield 'buffers-none.glb', glb(put('buffers')), EITHER
    yield 'normals-few.glb', glb(several(
        at(*PRIMITIVE, 'attributes', 'NORMAL', 2),
        lambda d: d['accessors'].append({**d['accessors'][0], 'count': 1}))), EITHER
    yield 'uv-few.glb', glb(several(
        at(*PRIMITIVE, 'attributes', 'TEXCOORD_0', 2),
        lambda d: d['accessors'].append({**d['accessors'][0], 'count': 1, 'type': 'VEC2'}))), EITHER
    yield 'colors-few.glb', glb(several(
        at(*PRIMITIVE, 'attributes', 'COLOR_0', 2),
        lambda d: d['accessors'].append({**d['accessors'][0], 'count': 2}))), EITHER
    yield 'sparse-index.glb', glb(sparse(4, component=5125)), EITHER
    yield 'sparse-more.glb', glb(sparse(5000)), EITHER
    yield 'sparse-view.glb', glb(sparse(1, indices_view=99)), REFUSED
    yield 'sparse-values.glb', glb(sparse(1, values_view=99)), REFUSED
    yield 'sparse-offset.glb', glb(sparse(2, byteOffset=1 << 40)), EITHER
    yield 'sparse.glb', glb(sparse(1)), EITHER


def references():
    """Indices of skins, animations, cameras, images: of nothing, or in circles."""
    skin = {'joints': [0], 'inverseBindMatrices': 0}
    for name, value, wanted in (
            ('joint', {'joints': [99]}, REFUSED), ('matrices', skin, EITHER),
            ('joints-none', {}, EITHER), ('skeleton', {'joints': [0], 'skeleton': 99}, EITHER)):
        yield f'skin-{name}.glb', glb(several(put('skins', value), at('nodes', 0, 'skin', 0))), \
            wanted
    yield 'skin-none.glb', glb(at('nodes', 0, 'skin', 7)), EITHER
    for name, sampler, channel, wanted in (
            ('sampler', 9, 0, EITHER), ('node', 0, 99, ACCEPTED), ('vector', 0, 0, EITHER)):
        yield f'animation-{name}.glb', glb(put('animations', {
            'samplers': [{'input': 0, 'output': 0}],
            'channels': [{'sampler': sampler, 'target': {'node': channel, 'path': 'translation'}}],
        })), wanted
    yield 'animation-input.glb', glb(put('animations', {
        'samplers': [{'input': 99, 'output': 0}],
        'channels': [{'sampler': 0, 'target': {'node': 0, 'path': 'weights'}}]})), ACCEPTED
    yield 'camera.glb', glb(at('nodes', 0, 'camera', 5)), REFUSED
    for name, camera in (('type', {'type': 'perspective'}), ('flat', {
            'type': 'perspective', 'perspective': {**PERSPECTIVE, 'yfov': 0}}), ('wide', {
                'type': 'perspective', 'perspective': {**PERSPECTIVE, 'yfov': 1e30}})):
        yield f'camera-{name}.glb', glb(several(put('cameras', camera),
                                                at('nodes', 0, 'camera', 0))), REFUSED
    yield 'light.glb', glb(several(
        put('extensionsUsed', 'KHR_lights_punctual'),
        at('nodes', 0, 'extensions', {'KHR_lights_punctual': {'light': 9}}))), REFUSED
    for name, change in (('texture', put('textures')), ('source', at('textures', 0, 'source', 9)),
                         ('sampler', at('textures', 0, 'sampler', 9)),
                         ('view', put('images', {'bufferView': 99, 'mimeType': 'image/png'})),
                         ('coordinates', at('materials', 0, 'pbrMetallicRoughness',
                                            'baseColorTexture', 'texCoord', 99))):
        yield f'{name}.gltf', gltf(data_uri, several(textured('a.png'), change)), \
            EITHER if name == 'coordinates' else ACCEPTED, (('a.png', png(4, 4)),)
    yield 'morph.glb', glb(at(*PRIMITIVE, 'targets', [{'POSITION': 99}])), REFUSED
    yield 'morph-weights.glb', glb(several(at(*PRIMITIVE, 'targets', [{'POSITION': 0}]),
                                           at('meshes', 0, 'weights', [1e30] * 99))), EITHER
    yield 'draco.glb', glb(several(*[at(key, ['KHR_draco_mesh_compression']) for key in (
        'extensionsUsed', 'extensionsRequired')])), EITHER
    yield 'mode.glb', glb(at(*PRIMITIVE, 'mode', 99)), REFUSED
    yield 'points.glb', glb(at(*PRIMITIVE, 'mode', 0)), REFUSED
    yield 'strip.glb', glb(at(*PRIMITIVE, 'mode', 5)), ACCEPTED
    box = {'firn': {'box': [[0, 0, 0], [0, 'x']]}}
    yield 'box.glb', glb(at('nodes', 0, 'extras', box)), REFUSED


def chunk(kind, data, size=None):
    return struct.pack('<I4s', len(data) if size is None else size, kind) + data


def glb_chunks(*chunks, magic=b'glTF', version=2):
    body = b''.join(chunks)
    return struct.pack('<4sII', magic, version, 12 + len(body)) + body


def chunks():
    data, document = tent()
    text = json.dumps(document).encode()
    text += b' ' * (-len(text) % 4)
    json_chunk, binary = chunk(b'JSON', text), chunk(b'BIN\0', data)
    yield 'magic.glb', glb_chunks(json_chunk, binary, magic=b'GLTF'), REFUSED
    for version in (1, 3, 0xffffffff):
        yield f'version-{version}.glb', glb_chunks(json_chunk, binary, version=version), REFUSED
    yield 'order.glb', glb_chunks(binary, json_chunk), REFUSED
    yield 'json-kind.glb', glb_chunks(chunk(b'JASN', text), binary), REFUSED
    yield 'json-twice.glb', glb_chunks(json_chunk, json_chunk, binary), EITHER
    yield 'json-none.glb', glb_chunks(chunk(b'JSON', b''), binary), REFUSED
    yield 'json-zeros.glb', glb_chunks(chunk(b'JSON', bytes(4096)), binary), REFUSED
    yield 'other-first.glb', glb_chunks(chunk(b'NOTE', b'abcd'), json_chunk, binary), REFUSED
    yield 'other-last.glb', glb_chunks(json_chunk, binary, chunk(b'NOTE', b'abcd')), ACCEPTED
    yield 'binary-twice.glb', glb_chunks(json_chunk, binary, binary), EITHER
    yield 'binary-short.glb', glb_chunks(json_chunk, chunk(b'BIN\0', data[:8])), REFUSED
    yield 'uneven.glb', glb_chunks(chunk(b'JSON', text + b' '), binary), EITHER
    yield 'rest.glb', glb_chunks(json_chunk, binary) + b'\xff' * 1000, EITHER


def obj_lines():
    square = 'v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n'
    face = 'f 1 2 3 4\n'
    yield 'relative.obj', obj(faces='f -4 -3 -2\nf -1 -2 -3\n'), ACCEPTED
    yield 'continued.obj', (square + 'f 1 2 \\\n3 4\n').encode(), EITHER
    yield 'continued-end.obj', (square + face + 'f 1 2 \\').encode(), EITHER
    yield 'returns.obj', (square + face).replace('\n', '\r\n').encode(), ACCEPTED
    yield 'returns-only.obj', (square + face).replace('\n', '\r').encode(), EITHER
    yield 'no-end.obj', (square + face[:-1]).encode(), EITHER
    yield 'zeros.obj', (square + '\0\0\0\n' + face).encode(), EITHER
    yield 'digits.obj', (square.replace('1', '1.' + '0' * 100000) + face).encode(), EITHER
    yield 'words.obj', (square + 'f a b c\n' + face).encode(), EITHER
    yield 'numbers-few.obj', ('v 1 2\n' + square + face).encode(), EITHER
    yield 'numbers-many.obj', (square.replace(' 0\n', ' 0 1 1 1 1 1 1\n') + face).encode(), EITHER
    yield 'face-short.obj', (square + 'f 1\nf\nf 1/\nf /1\n' + face).encode(), EITHER
    yield 'slashes.obj', (square + 'f 1/1/1/1 2//// 3\n').encode(), EITHER
    yield 'library-none.obj', obj('mtllib none.mtl\nusemtl a\n'), EITHER
    yield 'library-line.obj', obj('mtllib\nusemtl\n'), EITHER
    yield 'library-own.obj', obj('mtllib library-own.obj\nusemtl a\n'), EITHER
    for name, text in (('headless', 'Kd 1 1 1\nmap_Kd a.png\nnewmtl a\n'),
                       ('empty', 'newmtl a\nKd\nNs\nd\nillum\nmap_Kd\n'),
                       ('words', 'newmtl a\nKd red\nillum x\nd -5\nNi -1\n'),
                       ('options', 'newmtl a\nmap_Kd -s 1 -o -mm a.png\nmap_Kd -clamp\n'),
                       ('texture', 'newmtl a\nmap_Kd none.png\n'),
                       ('long', 'newmtl ' + 'a' * 100000 + '\nKd 1 1 1\n'),
                       ('twice', 'newmtl a\nKd 1 0 0\n' * 1000)):
        yield (f'mtl-{name}.obj', obj('mtllib a.mtl\nusemtl a\n'), EITHER,
               (('a.mtl', text.encode()),))


def ply_text(header, body, form='ascii'):
    return f'ply\nformat {form} 1.0\n{header}end_header\n{body}'.encode()


def ply_headers():
    vertices = 'element vertex 4\nproperty float x\nproperty float y\nproperty float z\n'
    faces = 'element face 4\nproperty list uchar int vertex_indices\n'
    points = '0 1 0\n-1 -1 1\n1 -1 1\n0 -1 -1\n'
    corners = '3 0 1 2\n3 0 2 3\n3 0 3 1\n3 1 3 2\n'
    yield 'text.ply', ply_text(vertices + faces, points + corners), ACCEPTED
    big = b''.join(struct.pack('>3f', *point) for point in POINTS) + b''.join(
        struct.pack('>B3i', 3, *CORNERS[i:i + 3]) for i in range(0, 12, 3))
    yield 'big-endian.ply', ply_text(vertices + faces, '', 'binary_big_endian') + big, ACCEPTED
    yield 'doubles.ply', ply_text((vertices + faces).replace('float', 'double'),
                                  points + corners), ACCEPTED
    yield 'turned.ply', ply_text(faces + vertices, corners + points), EITHER
    yield 'axes-twice.ply', ply_text(vertices.replace('float y', 'float x') + faces,
                                     points + corners), EITHER
    yield 'axes-turned.ply', ply_text(
        'element vertex 4\n' + ''.join(f'property float {axis}\n' for axis in 'zxy') + faces,
        points + corners), ACCEPTED
    yield 'no-z.ply', ply_text(vertices.replace('property float z\n', '') + faces,
                               points + corners), EITHER
    yield 'unknown.ply', ply_text(vertices + 'property float confidence\n' + faces,
                                  points.replace('\n', ' 0.5\n') + corners), ACCEPTED
    yield 'list-float.ply', ply_text(vertices + faces.replace('int', 'float'),
                                     points + corners), EITHER
    yield 'list-char.ply', ply_text(vertices + faces.replace('uchar', 'char'),
                                    points + corners.replace('3 0', '-3 0')), EITHER
    yield 'list-of-vertices.ply', ply_text(vertices.replace('float x', 'list uchar float x') +
                                           faces, points + corners), EITHER
    yield 'vertices-twice.ply', ply_text(vertices + vertices + faces,
                                         points + points + corners), EITHER
    yield 'minus.ply', ply_text((vertices + faces).replace('vertex 4', 'vertex -4'),
                                points + corners), EITHER
    yield 'word.ply', ply_text((vertices + faces).replace('vertex 4', 'vertex four'),
                               points + corners), EITHER
    yield 'element.ply', ply_text('element\nproperty\nproperty list\n' + vertices + faces,
                                  points + corners), EITHER
    yield ('returns.ply', ply_text(vertices + faces, points + corners).replace(b'\n', b'\r\n'),
           EITHER)
    yield 'strips.ply', ply_text(
        vertices + 'element tristrips 1\nproperty list int int vertex_indices\n',
        points + '5 0 1 2 -1 99\n'), EITHER
    yield 'comment.ply', ply_text('comment ' + 'x' * (1 << 20) + '\n' + vertices + faces,
                                  points + corners), ACCEPTED
    yield 'elements.ply', ply_text(vertices + faces + 'element a 1\nproperty int a\n' * 5000,
                                   points + corners), EITHER


def stl_facets():
    nan = ((float('nan'), 0, 0), *POINTS[1:])
    text = stl_text()
    yield 'binary.stl', stl(), DRAWN
    yield 'solid.stl', stl(head=b'solid of bytes'), DRAWN
    yield 'colors.stl', stl(attribute=0x7fff), ACCEPTED
    yield 'rest.stl', stl() + b'rest', ACCEPTED
    yield 'cut.stl', stl()[:-7], REFUSED
    yield 'header.stl', stl()[:83], REFUSED
    yield 'count.stl', stl(count=5), REFUSED
    yield 'count-vast.stl', stl(count=0xffffffff), REFUSED
    yield 'none.stl', stl(corners=()), REFUSED
    yield 'nan.stl', stl(nan), REFUSED
    yield 'far.stl', stl(((1e30, 0, 0), *POINTS[1:])), REFUSED
    yield 'one-point.stl', stl(POINTS[:1] * 4), ACCEPTED
    yield 'text.stl', text, DRAWN
    yield 'text-twice.stl', text * 2, ACCEPTED
    yield 'text-upper.stl', text.upper().replace(b'\n', b'\r\n'), ACCEPTED
    yield 'text-nan.stl', stl_text(nan), REFUSED
    yield 'text-normal.stl', text.replace(b'normal 0 0 0', b'normal nan nan inf'), ACCEPTED
    yield 'text-cut.stl', text[:-60], REFUSED
    yield 'text-end.stl', text.replace(b'endsolid tent', b''), REFUSED
    yield 'text-empty.stl', b'solid a\nendsolid a\n', REFUSED
    yield 'text-corner.stl', text.replace(b' endloop', b'  vertex 0 0 0\n endloop', 1), REFUSED
    yield 'text-word.stl', text.replace(b' outer loop', b' outer loop\n  point 1', 1), REFUSED
    yield 'text-zeros.stl', text[:200] + bytes(400) + text[200:], REFUSED


def colors():
    """What is accepted is drawn with numbers."""
    def factor(*values):
        return glb(several(put('materials', {'pbrMetallicRoughness': {'baseColorFactor': values}}),
                           at(*PRIMITIVE, 'material', 0)))
    yield 'large.glb', factor(3e38, 3e38, 3e38, 3e38), DRAWN
    yield 'beyond.glb', factor(1e300, 1, 1, 1), EITHER
    yield 'tiny.glb', factor(1e-45, 1e-45, 1e-45, 1), DRAWN
    yield 'negative.glb', factor(-1, -3e38, -1e-45, 1), DRAWN
    yield 'word.glb', factor('NaN', 'Infinity', '-1', 1), EITHER
    yield 'null.glb', factor(None, None, None, None), EITHER
    yield 'few.glb', factor(1), EITHER
    for name, color in (('large', '3e38 3e38 3e38'), ('negative', '-1 -3e38 0'),
                        ('tiny', '1e-45 1e-45 1e-45'), ('word', 'NaN inf 0')):
        yield f'mtl-{name}.obj', obj('mtllib a.mtl\nusemtl a\n'), \
            EITHER if name == 'word' else DRAWN, (('a.mtl', f'newmtl a\nKd {color}\n'.encode()),)
        lines = ''.join(f'v {x} {y} {z} {color}\n' for x, y, z in POINTS)
        yield f'vertex-{name}.obj', obj(lines, points=()), EITHER if name == 'word' else DRAWN


def other_formats():
    """The bytes of one format in a file of another's name."""
    mesh, text = ply(), obj()
    blend = b'BLENDER-v300REND' + bytes(100)
    solid = b'solid of nothing' + bytes(64) + struct.pack('<I', 1) + bytes(50)
    triangle = b'facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n' \
        b'endloop\nendfacet\n'
    lines = b'solid a\n' + triangle + b'endsolid a\n'
    collada = b'<?xml version="1.0"?><COLLADA version="1.4.1"></COLLADA>'
    for name, content in (('blend', blend), ('stl', solid), ('stl-text', lines), ('obj', text),
                          ('json', gltf(data_uri)), ('zip', b'PK\3\4' + bytes(60))):
        yield f'{name}.glb', content, REFUSED
    for name, content in (('ply', mesh), ('stl-text', lines), ('collada', collada),
                          ('blend', blend), ('glb', glb())):
        yield f'{name}.obj', content, REFUSED
    for name, content in (('obj', text), ('stl', solid), ('blend', blend)):
        yield f'{name}.ply', content, REFUSED
    for name, content in (('glb', glb()), ('collada', collada), ('obj', text)):
        yield f'{name}.gltf', content, REFUSED
    for name, content in (('blend', blend), ('ply', mesh), ('obj', text), ('glb', glb())):
        yield f'{name}.stl', content, REFUSED
