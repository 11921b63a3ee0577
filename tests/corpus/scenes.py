"""scenes.py: random scenes of numbers that are extreme, but accepted."""
import json
import random
import struct

from builders import exr, glb_of

FLOAT_MAX = 3.4028234663852886e38
COLORS = (0, 1e-45, 1e-38, 0.5, 1, 1, 1, 1e3, 65504, 65536, 1e30, FLOAT_MAX, -1, -1e30)
TEXELS = (0, 1e-45, 6e-8, 0.5, 1, 100, 65504, 65519, 65536, 1e30, FLOAT_MAX, -1, float('nan'),
          float('inf'))
RUNGS = ('paper', 'bounce', 'one-sided', 'wyman', 'search')
TRIANGLES = 24
EXTENSIONS = ['KHR_materials_transmission', 'KHR_materials_ior', 'KHR_materials_unlit']


def coordinates(chance, scale):
    return [chance.choice((1,) * 8 + (1e-6, 0)) * scale * chance.uniform(-1, 1) for _ in range(3)]


def normal(chance):
    length = chance.choice((1, 1, 1, 0, 1e-30, 1e30))
    return [length * chance.uniform(-1, 1) for _ in range(3)]


def material(chance, transmission):
    found = {'pbrMetallicRoughness': {
        'baseColorFactor': [chance.choice(COLORS) for _ in range(3)] + [1]}, 'extensions': {}}
    if chance.random() < transmission:
        found['extensions']['KHR_materials_transmission'] = {'transmissionFactor': 1}
        found['extensions']['KHR_materials_ior'] = {'ior': chance.choice((1, 1.0001, 1.31, 2.4, 4))}
    if chance.random() < 0.4:
        found['extensions']['KHR_materials_unlit'] = {}
    return found


def mesh(chance, index, scale):
    """The bytes of vertices and indices, and what describes them."""
    count = 3 * TRIANGLES
    vertices = b''.join(struct.pack('<10f', *coordinates(chance, scale), *normal(chance),
                                    *(chance.choice(COLORS) for _ in range(4)))
                        for _ in range(count))
    indices = struct.pack(f'<{count}H', *(chance.randrange(count) for _ in range(count)))
    view, first = 2 * index, 4 * index
    accessors = [{'bufferView': view, 'byteOffset': offset, 'componentType': 5126, 'count': count,
                  'type': kind} for offset, kind in ((0, 'VEC3'), (12, 'VEC3'), (24, 'VEC4'))]
    accessors.append({'bufferView': view + 1, 'componentType': 5123, 'count': count,
                      'type': 'SCALAR'})
    primitive = {'attributes': {'POSITION': first, 'NORMAL': first + 1}, 'indices': first + 3,
                 'material': index}
    if chance.random() < 0.7:
        primitive['attributes']['COLOR_0'] = first + 2
    return vertices, indices, accessors, primitive


def model(chance, scale):
    """A .glb of two meshes: mostly an object, and what is around it."""
    data, views, accessors, primitives = b'', [], [], []
    for index in range(2):
        vertices, indices, more, primitive = mesh(chance, index, (1 + 2 * index) * scale)
        views += [{'buffer': 0, 'byteOffset': len(data), 'byteLength': len(vertices),
                   'byteStride': 40},
                  {'buffer': 0, 'byteOffset': len(data) + len(vertices),
                   'byteLength': len(indices)}]
        data += vertices + indices
        accessors += more
        primitives.append(primitive)
    return glb_of(json.dumps({
        'asset': {'version': '2.0'}, 'extensionsUsed': EXTENSIONS,
        'scene': 0, 'scenes': [{'nodes': [0, 1]}],
        'nodes': [{'mesh': 0}, {'mesh': 1, 'scale': [chance.choice((1, 1, 1, -1, 1e-3))] * 3}],
        'meshes': [{'primitives': [primitive]} for primitive in primitives],
        'materials': [material(chance, 0.9), material(chance, 0)], 'accessors': accessors,
        'bufferViews': views, 'buffers': [{'byteLength': len(data)}]}).encode(), data)


def vector(values):
    return ','.join(f'{value:.9g}' for value in values)


def scene(seed):
    """Words for firn render, and the files that they name: {name: bytes}."""
    chance = random.Random(seed)
    scale = chance.choice((1e-3, 1, 1, 1, 50, 1e4, 3e5))
    words = ['a.glb', '-r', chance.choice(RUNGS)]
    files = {'a.glb': model(chance, scale)}
    if chance.random() < 0.7:
        values = [chance.choice(TEXELS) for _ in range(32 * 3)]
        files['env.exr'] = exr(texels=values)
        words += ['--env', 'env.exr']
    if chance.random() < 0.6:
        words += ['--eye', vector(coordinates(chance, scale)), '--target',
                  vector(coordinates(chance, scale)), '--fov',
                  chance.choice(('1', '45', '120', '170'))]
    if chance.random() < 0.3:
        words += ['--samples', '3']
    return words, files
