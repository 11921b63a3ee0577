"""gltf_file.py: small glTF files of boxes, for tests."""
import base64
import json
import math
import struct

CORNERS = [(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
# Two triangles a side, counter-clockwise seen from outside.
SIDES = (0, 1, 3, 0, 3, 2, 4, 6, 7, 4, 7, 5, 0, 4, 5, 0, 5, 1, 2, 3, 7, 2, 7, 6, 0, 2, 6, 0, 6, 4,
         1, 5, 7, 1, 7, 3)


def glass(ior=1.5, roughness=0, thickness=1, color=(1, 1, 1), **more):
    """A material of a solid."""
    extensions = {'KHR_materials_transmission': {'transmissionFactor': 1},
                  'KHR_materials_volume': {'thicknessFactor': thickness},
                  'KHR_materials_ior': {'ior': ior}}
    surface = {'roughnessFactor': roughness, 'baseColorFactor': [*color, 1]}
    return {'pbrMetallicRoughness': surface, 'extensions': extensions, **more}


def boxes(*parts):
    """The text of a file with a box, from -1 to 1, for each (material, place, scale); a scale is a
    number or three."""
    data = struct.pack('<24f', *sum(CORNERS, ())) + struct.pack('<36H', *SIDES)
    uri = 'data:application/octet-stream;base64,' + base64.b64encode(data).decode()
    return json.dumps({
        'asset': {'version': '2.0'}, 'scene': 0, 'scenes': [{'nodes': list(range(len(parts)))}],
        'nodes': [{'mesh': i, 'name': f'box {i}', 'translation': place,
                   'scale': scale if isinstance(scale, list) else [scale] * 3}
                  for i, (_, place, scale) in enumerate(parts)],
        'meshes': [{'primitives': [{'attributes': {'POSITION': 0}, 'indices': 1, 'material': i}]}
                   for i in range(len(parts))],
        'materials': [material for material, _, _ in parts],
        'extensionsUsed': sorted({name for material, _, _ in parts
                                  for name in material.get('extensions', {})}),
        'accessors': [
            {'bufferView': 0, 'componentType': 5126, 'count': 8, 'type': 'VEC3',
             'min': [-1, -1, -1], 'max': [1, 1, 1]},
            {'bufferView': 1, 'componentType': 5123, 'count': 36, 'type': 'SCALAR'}],
        'bufferViews': [{'buffer': 0, 'byteLength': 96},
                        {'buffer': 0, 'byteOffset': 96, 'byteLength': 72}],
        'buffers': [{'byteLength': len(data), 'uri': uri}]})


def flat_boxes(*parts):
    """A file of boxes() whose sides are flat: no corner is shared between sides."""
    scene = json.loads(boxes(*parts))
    corners = [CORNERS[i] for i in SIDES]
    normals = [n for side in ((-1, 0, 0), (1, 0, 0), (0, -1, 0), (0, 1, 0), (0, 0, -1), (0, 0, 1))
               for n in [side] * 6]
    data = struct.pack('<216f', *sum(corners + normals, ()))
    vectors = {'componentType': 5126, 'count': 36, 'type': 'VEC3'}
    scene['accessors'] = [{'bufferView': 0, 'min': [-1, -1, -1], 'max': [1, 1, 1], **vectors},
                          {'bufferView': 1, **vectors}]
    scene['bufferViews'] = [{'buffer': 0, 'byteOffset': at, 'byteLength': 432} for at in (0, 432)]
    scene['buffers'] = [{'byteLength': 864, 'uri': 'data:application/octet-stream;base64,' +
                         base64.b64encode(data).decode()}]
    for mesh in scene['meshes']:
        mesh['primitives'][0].update(attributes={'POSITION': 0, 'NORMAL': 1})
        del mesh['primitives'][0]['indices']
    return json.dumps(scene)


def ball(radius, first, rows=32):
    """Places, normals and corners of a ball; the corners count from `first`. Below 0: a cavity."""
    side = math.copysign(1, radius)
    turns = [(math.pi * i / rows, math.pi * k / rows) for i in range(rows + 1)
             for k in range(2 * rows + 1)]
    points = [(math.sin(a) * math.sin(b), math.cos(a), math.sin(a) * math.cos(b))
              for a, b in turns]
    cells = [first + i * (2 * rows + 1) + k for i in range(rows) for k in range(2 * rows)]
    below = 2 * rows + 1
    sides = [corner for at in cells for corner in (at, at + below, at + 1, at + 1, at + below,
                                                   at + below + 1)[::int(side)]]
    return ([side * radius * x for point in points for x in point],
            [side * x for point in points for x in point], sides)


def balls(cavity, *parts):
    """A file of boxes(), but of balls of radius 1, the first of which has a cavity."""
    scene = json.loads(boxes(*parts))
    outer = ball(1, 0)
    inner = ball(-cavity, len(outer[0]) // 3)
    places, normals, corners = (a + b for a, b in zip(outer, inner))
    data = b''.join((struct.pack(f'<{len(places)}f', *places),
                     struct.pack(f'<{len(normals)}f', *normals),
                     struct.pack(f'<{len(corners)}I', *corners)))
    count, at = len(places) // 3, 4 * len(places)
    vectors = {'componentType': 5126, 'count': count, 'type': 'VEC3'}
    indices = {'bufferView': 2, 'componentType': 5125, 'type': 'SCALAR'}
    scene['accessors'] = [
        {'bufferView': 0, 'min': [-1, -1, -1], 'max': [1, 1, 1], **vectors},
        {'bufferView': 1, **vectors}, {'count': len(corners), **indices},
        {'count': len(outer[2]), **indices}]
    scene['bufferViews'] = [{'buffer': 0, 'byteLength': at},
                            {'buffer': 0, 'byteOffset': at, 'byteLength': at},
                            {'buffer': 0, 'byteOffset': 2 * at, 'byteLength': 4 * len(corners)}]
    scene['buffers'] = [{'byteLength': len(data), 'uri': 'data:application/octet-stream;base64,'
                         + base64.b64encode(data).decode()}]
    for i, mesh in enumerate(scene['meshes']):
        mesh['primitives'][0].update(attributes={'POSITION': 0, 'NORMAL': 1},
                                     indices=3 if i else 2)
    return json.dumps(scene)


def with_nodes(text, *nodes, **more):
    """A file of boxes() with further nodes of the scene, and members of the top."""
    scene = json.loads(text)
    first = len(scene['nodes'])
    scene['nodes'] += nodes
    scene['scenes'][0]['nodes'] += range(first, first + len(nodes))
    return json.dumps({**scene, **more})


def slide(text, node, seconds, path, name='slide'):
    """A file of boxes() in which a node moves evenly along (from, to); a further animation if there
    is one."""
    scene = json.loads(text)
    data = struct.pack('<2f6f', 0, seconds, *path[0], *path[1])
    uri = 'data:application/octet-stream;base64,' + base64.b64encode(data).decode()
    buffer, view, accessor = (len(scene[key]) for key in ('buffers', 'bufferViews', 'accessors'))
    scene['buffers'].append({'byteLength': len(data), 'uri': uri})
    scene['bufferViews'] += [{'buffer': buffer, 'byteLength': 8},
                             {'buffer': buffer, 'byteOffset': 8, 'byteLength': 24}]
    scene['accessors'] += [{'bufferView': view, 'componentType': 5126, 'count': 2,
                            'type': 'SCALAR', 'min': [0], 'max': [seconds]},
                           {'bufferView': view + 1, 'componentType': 5126, 'count': 2,
                            'type': 'VEC3'}]
    scene.setdefault('animations', []).append({
        'name': name, 'samplers': [{'input': accessor, 'output': accessor + 1}],
        'channels': [{'sampler': 0, 'target': {'node': node, 'path': 'translation'}}]})
    return json.dumps(scene)
