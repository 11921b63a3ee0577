#!/usr/bin/env python3
"""work.py: measures CPU time of firn for models with many parts, and its growth.

Usage: work.py FIRN [--check]

Prints a table of seconds of the program and its reader for 1 000, 10 000 and 100 000 parts of each
kind, the exponents between them, and how many of the last seconds the program itself used. With
--check, tests smaller numbers: exits with 1 if a file takes more than 4 s, is not answered with 0
or 65 and at most one error line, or if eight times the parts take more than twenty times as long.
"""
import json
import math
import os
import pathlib
import struct
import subprocess
import sys
import tempfile

POINTS = ((-1, -1, -1), (1, -1, -1), (0, 1, -1), (0, 0, 1))
CORNERS = (0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3)
GLASS = {'extensions': {'KHR_materials_transmission': {'transmissionFactor': 1}}}
OPAQUE = {'pbrMetallicRoughness': {'roughnessFactor': .5}}
BASE = b''.join(struct.pack('<3f', *p) for p in POINTS) + struct.pack('<12I', *CORNERS)


class Model:
    """A glTF file of tetrahedra and its buffer."""

    def __init__(self, material=None):
        self.data = b''
        self.json = {'asset': {'version': '2.0'}, 'scene': 0, 'bufferViews': [], 'accessors': [],
                     'materials': [material or GLASS],
                     'meshes': [{'primitives': [self.primitive(0)]}],
                     'extensionsUsed': ['KHR_materials_transmission', 'EXT_mesh_gpu_instancing']}
        self.add(BASE[:48], 5126, 'VEC3', 4, min=[-1] * 3, max=[1] * 3)
        self.add(BASE[48:], 5125, 'SCALAR', 12)
        self.place([{'mesh': 0}])

    @staticmethod
    def primitive(material):
        return {'attributes': {'POSITION': 0}, 'indices': 1, 'material': material}

    def add(self, data, component, kind, count, **more):
        """Adds an accessor; returns its index."""
        self.json['bufferViews'].append({'buffer': 0, 'byteOffset': len(self.data),
                                         'byteLength': len(data)})
        self.json['accessors'].append({'bufferView': len(self.json['bufferViews']) - 1,
                                       'componentType': component, 'type': kind, 'count': count,
                                       **more})
        self.data += data
        return len(self.json['accessors']) - 1

    def vectors(self, rows):
        return self.add(b''.join(struct.pack('<3f', *row) for row in rows), 5126, 'VEC3', len(rows))

    def place(self, nodes):
        self.json['nodes'] = nodes
        self.json['scenes'] = [{'nodes': list(range(len(nodes)))}]

    def instances(self, **attributes):
        self.json['nodes'][0]['extensions'] = {
            'EXT_mesh_gpu_instancing': {'attributes': attributes}}

    def write(self, path):
        path.with_suffix('.bin').write_bytes(self.data)
        self.json['buffers'] = [{'byteLength': len(self.data), 'uri': path.stem + '.bin'}]
        path.write_text(json.dumps(self.json))


def grid(count):
    side = math.ceil(count ** (1 / 3))
    return [(4 * (i % side), 4 * (i // side % side), 4 * (i // side ** 2)) for i in range(count)]


def one_place(count):
    model = Model()
    model.json['accessors'].append({'componentType': 5126, 'type': 'VEC3', 'count': count})
    model.instances(TRANSLATION=2)
    return model


def nested(count):
    model = Model()
    model.instances(SCALE=model.vectors([[1 + .01 * i] * 3 for i in range(count)]))
    return model


def pairs(count):
    """Objects that each have one other inside."""
    model = Model()
    where = grid(count // 2)
    model.instances(TRANSLATION=model.vectors(where + where),
                    SCALE=model.vectors([[1] * 3] * len(where) + [[.2] * 3] * len(where)))
    return model


def nodes(count, material=None):
    model = Model(material)
    model.place([{'mesh': 0, 'translation': at} for at in grid(count)])
    return model


def named(count, material=None):
    """Objects of two names, of which one is moved and the other hidden."""
    model = nodes(count, material)
    for i, node in enumerate(model.json['nodes']):
        node['name'] = ('moved', 'hidden')[i % 2]
    return model


def opaque_named(count):
    return named(count, OPAQUE)


def opaque_nodes(count):
    return nodes(count, OPAQUE)


def materials(count):
    model = Model()
    model.json['materials'] = [OPAQUE] * count
    model.json['meshes'] = [{'primitives': [model.primitive(i)]} for i in range(count)]
    model.place([{'mesh': i, 'translation': at} for i, at in enumerate(grid(count))])
    return model


def primitives(count):
    model = Model(OPAQUE)
    model.json['meshes'] = [{'primitives': [model.primitive(0)] * count}]
    return model


def overlapping(count):
    """One primitive of triangles as large as itself."""
    model = Model()
    turns = [i * 2.4 for i in range(count)]
    points = [(math.cos(turn), math.sin(turn), i / count) for i, turn in enumerate(turns)]
    corners = [k for i in range(count) for k in (i, (i + 377) % count, (i + 610) % count)]
    row = {'attributes': {'POSITION': model.vectors(points)}, 'material': 0,
           'indices': model.add(struct.pack(f'<{3 * count}I', *corners), 5125, 'SCALAR', 3 * count)}
    model.json['meshes'] = [{'primitives': [row]}]
    return model


def animated(count, channels):
    model = Model(OPAQUE)
    model.place([{'mesh': 0, 'translation': at} for at in grid(count if channels else 1)])
    times = model.add(struct.pack('<2f', 0, 1), 5126, 'SCALAR', 2, min=[0], max=[1])
    sampler = {'input': times, 'output': model.vectors([(0, 0, 0), (1, 1, 1)])}
    rows = [{'sampler': 0, 'target': {'node': i if channels else 0, 'path': 'translation'}}
            for i in range(count)]
    model.json['animations'] = [{'samplers': [sampler], 'channels': part}
                                for part in ([rows] if channels else [[row] for row in rows])]
    return model


def animations(count):
    return animated(count, False)


def channels(count):
    return animated(count, True)


def shells(count):
    """One primitive of separate shells."""
    model = Model()
    points = b''.join(struct.pack('<3f', *(a + b for a, b in zip(at, p)))
                      for at in grid(count) for p in POINTS)
    corners = b''.join(struct.pack('<12I', *(4 * i + c for c in CORNERS)) for i in range(count))
    far = 4. * math.ceil(count ** (1 / 3))
    attributes = {'POSITION': model.add(points, 5126, 'VEC3', 4 * count, min=[-1] * 3,
                                        max=[far] * 3)}
    row = {'attributes': attributes, 'material': 0,
           'indices': model.add(corners, 5125, 'SCALAR', 12 * count)}
    model.json['meshes'] = [{'primitives': [row]}]
    return model


KINDS = (one_place, nested, pairs, nodes, opaque_nodes, named, opaque_named, materials, primitives,
         overlapping, animations, channels, shells)
COMMAND = 'info', '--no-cache'
COMMANDS = dict.fromkeys((named, opaque_named), (
    'graph', '-r', 'trace', '--transform', 'moved=1,0,0', '--hide', 'hidden'))


def seconds(firn, kind, count):
    """Returns CPU time of the program and its reader, that of the program, and the exit code."""
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / 'model.gltf'
        kind(count).write(path)
        done = subprocess.Popen([firn, *COMMANDS.get(kind, COMMAND), path],
                                stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
        lines = done.stderr.read().decode().splitlines()
        os.waitid(os.P_PID, done.pid, os.WEXITED | os.WNOWAIT)
        # of the ended process: user and system time, and those of its children
        stat = pathlib.Path(f'/proc/{done.pid}/stat').read_text().rsplit(')', 1)[1].split()
        code = done.wait()
    errors = [line for line in lines if not line.startswith(('firn: note:', 'firn: warning:'))]
    assert code in (0, 65) and len(errors) == (code == 65), (kind, lines)
    times = [int(ticks) / os.sysconf('SC_CLK_TCK') for ticks in stat[11:15]]
    return sum(times), sum(times[:2]), code


def is_slow(few, many):
    return many > 4 or many > 20 * few + .2


def check(firn):
    is_good = True
    for kind in KINDS:
        few, many = (seconds(firn, kind, count)[0] for count in (2000, 16000))
        if is_slow(few, many):  # perhaps by chance
            few, many = (min(time, seconds(firn, kind, count)[0])
                         for time, count in ((few, 2000), (many, 16000)))
        if is_slow(few, many):
            print(f'{kind.__name__}: {few:.2f} s for 2000, {many:.2f} s for 16000')
            is_good = False
    return 0 if is_good else 1


def table(firn):
    print('| parts | 1 000 | 10 000 | 100 000 | exponents | program |\n|---|---|---|---|---|---|')
    for kind in KINDS:
        rows = [seconds(firn, kind, count) for count in (1000, 10000, 100000)]
        times = [f'{used:.2f}' + ('' if code == 0 else ' (refused)') for used, _, code in rows]
        powers = [f'{math.log10(b[0] / a[0]):.1f}' if b[2] == 0 else '' for a, b in
                  zip(rows, rows[1:])]
        print('|', ' | '.join([kind.__name__.replace('_', ' '), *times, ' '.join(powers),
                               f'{rows[-1][1]:.2f}']), '|', flush=True)
    return 0


if __name__ == '__main__':
    sys.exit((check if '--check' in sys.argv else table)(sys.argv[1]))
