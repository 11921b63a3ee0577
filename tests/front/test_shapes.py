"""test_shapes.py: forms of a glTF file's geometry, each with a pixel computed by hand. Usage: see
case.py."""
import json
import math
import struct
import sys

sys.dont_write_bytecode = True  # the source tree stays clean
import test_features as features  # noqa: E402
from case import main  # noqa: E402
from test_features import COLUMNS, HAS_REFERENCE, ROWS, SIDE, extended, pbr  # noqa: E402


class Shapes(features.Cards):
    """One card in many forms of geometry: its vertex colours grow from corner to corner, so the
    pixel in its middle says where it is."""
    CORNERS = [(-0.45, -0.45, 0), (0.45, -0.45, 0), (0.45, 0.45, 0), (-0.45, 0.45, 0)]
    COLORS = [(0, 0, 0.25), (1, 0, 0.25), (1, 1, 0.25), (0, 1, 0.25)]
    IDENTITY = (1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1)

    def setUp(self):
        super().setUp()
        self.paint = self.scene.add('materials', extended(pbr(), materials_unlit={}))
        self.channels, self.samplers = [], []

    def place(self):
        """The middle of the next card."""
        place = len(self.names)
        return [place % COLUMNS - (COLUMNS - 1) / 2, (ROWS - 1) / 2 - place // COLUMNS, 5]

    def mesh(self, positions=None, colors=None, indices=(0, 1, 2, 0, 2, 3), targets=(), weights=(),
             **attributes):
        scene = self.scene
        primitive = {'material': self.paint, 'attributes': {
            'POSITION': scene.accessor(self.CORNERS) if positions is None else positions,
            'COLOR_0': scene.accessor(self.COLORS) if colors is None else colors, **attributes}}
        if indices:
            primitive['indices'] = scene.accessor([(i,) for i in indices], 'H', 5123)
        if targets:
            primitive['targets'] = [{'POSITION': target} for target in targets]
        mesh = {'primitives': [primitive]}
        return scene.add('meshes', {**mesh, 'weights': list(weights)} if weights else mesh)

    def form(self, name, mesh=None, **node):
        """A node with the card; returns its number."""
        node = {'mesh': self.mesh() if mesh is None else mesh, 'translation': self.place(), **node}
        node = {key: value for key, value in node.items() if value is not None}
        self.names.append(name)
        self.scene.nodes.append(self.scene.add('nodes', node))
        return self.scene.nodes[-1]

    def move(self, node, path, keys, interpolation='LINEAR'):
        """Keys at 0 and 2 seconds."""
        output = [tuple(key) if isinstance(key, (tuple, list)) else (key,) for key in keys]
        self.samplers.append({'input': self.scene.accessor([(0,), (2,)], min=[0], max=[2]),
                              'output': self.scene.accessor(output),
                              'interpolation': interpolation})
        self.channels.append({'sampler': len(self.samplers) - 1,
                              'target': {'node': node, 'path': path}})

    def padded(self, unit, kind, component, **more):
        """Corners as whole numbers, with a fourth one that is not theirs."""
        gltf = self.scene.gltf
        index = self.scene.accessor([(*(round(c / 0.45 * unit) for c in p), 9)
                                     for p in self.CORNERS], kind, component, **more)
        gltf['accessors'][index]['type'] = 'VEC3'
        view = gltf['bufferViews'][gltf['accessors'][index]['bufferView']]
        view['byteStride'] = struct.calcsize(f'4{kind}')
        return index

    def fill(self):
        scene, accessor = self.scene, self.scene.accessor
        self.form('floats')
        self.form('without indices', self.mesh(
            accessor([self.CORNERS[i] for i in (0, 1, 2, 0, 2, 3)]),
            accessor([self.COLORS[i] for i in (0, 1, 2, 0, 2, 3)]), ()))
        for is_normalized, scale in (True, 0.45), (False, 0.45 / 127):
            self.form(f'bytes, normalized: {is_normalized}', self.mesh(
                self.padded(127, 'b', 5120, normalized=is_normalized),
                accessor([tuple(round(255 * c) for c in (*color, 1)) for color in self.COLORS],
                         'B', 5121, normalized=True)), scale=[scale] * 3)
        self.form('shorts', self.mesh(
            self.padded(32767, 'h', 5122, normalized=True),
            accessor([tuple(round(65535 * c) for c in (*color, 1)) for color in self.COLORS], 'H',
                     5123, normalized=True)), scale=[0.45] * 3)
        x, y, z = self.place()
        half = math.sqrt(0.5)
        self.form('instances', rotation=[0, 0, half, half], translation=[x, y, z - 1], extensions={
            'EXT_mesh_gpu_instancing': {'attributes': {
                'TRANSLATION': accessor([(0, 0, 1), (0, -1, 1)]),
                'ROTATION': accessor([(0, 0, -half, half)] * 2),
                'SCALE': accessor([(1, 1, 1), (1, 1, 1)])}}})
        self.names.append('instances, the second')
        for name, base, places in (('sparse, of nothing', None, (0, 1, 2, 3)),
                                   ('sparse, of others', [(9, 9, 9), *self.CORNERS[1:3], (
                                       9, 9, 9)], (0, 3))):
            at = scene.gltf['accessors'].pop(accessor([(i,) for i in places], 'B', 5121))
            with_ = scene.gltf['accessors'].pop(accessor([self.CORNERS[i] for i in places]))
            sparse = accessor(base or self.CORNERS)
            if not base:
                del scene.gltf['accessors'][sparse]['bufferView']
            scene.gltf['accessors'][sparse]['sparse'] = {
                'count': len(places), 'values': {'bufferView': with_['bufferView']},
                'indices': {'bufferView': at['bufferView'], 'componentType': 5121}}
            self.form(name, self.mesh(sparse))
        self.form('matrix', translation=None,
                  matrix=[0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, *self.place(), 1],
                  mesh=self.mesh(accessor([(p[1], -p[0], 0) for p in self.CORNERS])))
        self.form('mirrored', self.mesh(accessor([(-p[0], *p[1:]) for p in self.CORNERS])),
                  scale=[-1, 1, 1])
        child = scene.add('nodes', {'mesh': self.mesh(), 'translation': [0, -3, 0],
                                    'rotation': [0, 0, -half, half], 'scale': [0.5] * 3})
        x, y, z = self.place()
        self.form('nested', scale=[2] * 3, rotation=[0, 0, half, half], children=[child],
                  translation=[x - 6, y, z])
        del scene.gltf['nodes'][scene.nodes[-1]]['mesh']
        self.fill_posed()

    def fill_posed(self):
        scene, accessor = self.scene, self.scene.accessor

        def low(by):
            return accessor([(p[0] - by, *p[1:]) for p in self.CORNERS])

        def apart(by):
            return accessor([(by, 0, 0)] * 4)
        self.form('morphed by the mesh', self.mesh(low(2), targets=(apart(4), apart(9)),
                                                   weights=(0.5, 0)))
        self.form('morphed by the node', self.mesh(low(2), targets=(apart(4), apart(2)),
                                                   weights=(9, 9)), weights=[0.25, 0.5])
        for has_inverse in False, True:
            x, y, z = self.place()
            joints = []
            for dx in (-1, 1):
                joints.append(scene.add('nodes', {'translation': [x + dx, y, z]}))
                scene.nodes.append(joints[-1])
            skin = {'joints': joints}
            if has_inverse:
                skin['inverseBindMatrices'] = accessor([
                    (*self.IDENTITY[:12], -dx, 0, 0, 1) for dx in (-1, 1)])
            scene.gltf.setdefault('skins', []).append(skin)
            mesh = self.mesh(JOINTS_0=accessor([(1, 0, 0, 0)] * 4, 'B', 5121),
                             WEIGHTS_0=accessor([(0.5, 0.5, 0, 0)] * 4))
            self.form(f'skin, inverses: {has_inverse}', mesh, skin=len(scene.gltf['skins']) - 1,
                      translation=[99, 0, 0])
        # One second is half way from each first key to the second.
        x, y, z = self.place()
        self.move(self.form('moved'), 'translation', ([x - 1, y + 2, z], [x + 1, y - 2, z]))
        x, y, z = self.place()
        self.move(self.form('moved in a step'), 'translation', ([x, y, z], [x, y, 99]), 'STEP')
        x, y, z = self.place()
        self.move(self.form('moved along a spline'), 'translation', (
            [0] * 3, [x - 1, y, z], [4, 0, 0], [0] * 3, [x - 1, y, z], [0] * 3), 'CUBICSPLINE')
        half = math.sqrt(0.5)
        self.move(self.form('turned', rotation=[1, 0, 0, 0], mesh=self.mesh(accessor(
            [((p[0] + p[1]) * half, (p[1] - p[0]) * half, 0) for p in self.CORNERS]))),
            'rotation', ([0, 0, 0, 1], [0, 0, half, half]))
        self.move(self.form('scaled'), 'scale', ([0.5] * 3, [1.5] * 3))
        self.move(self.form('morphed in time', self.mesh(low(1), targets=(apart(2), apart(5)))),
                  'weights', (0, 0.5, 1, -0.5))
        x, y, z = self.place()
        joint = scene.add('nodes', {'translation': [x - 5, y, z]})
        scene.nodes.append(joint)
        scene.gltf['skins'].append({'joints': [joint]})
        self.form('skin in time', self.mesh(
            JOINTS_0=accessor([(0, 0, 0, 0)] * 4, 'H', 5123),
            WEIGHTS_0=accessor([(255, 0, 0, 0)] * 4, 'B', 5121, normalized=True)),
            skin=len(scene.gltf['skins']) - 1)
        self.move(joint, 'translation', ([x - 1, y, z], [x + 1, y, z]))

    def test_one_card_in_many_forms(self):
        self.fill()
        scene = json.loads(self.scene.text())
        scene['animations'] = [{'channels': self.channels, 'samplers': self.samplers}]
        scene['skins'] = self.scene.gltf['skins']
        scene['extensionsUsed'] += ['KHR_mesh_quantization', 'EXT_mesh_gpu_instancing']
        scene['extensionsRequired'] = ['KHR_mesh_quantization', 'EXT_mesh_gpu_instancing']
        (self.folder / 'a.gltf').write_text(json.dumps(scene))
        del scene['buffers'][0]['uri']
        text = json.dumps(scene).encode()
        text += b' ' * (-len(text) % 4)
        data = self.scene.data + b'\0' * (-len(self.scene.data) % 4)
        (self.folder / 'b.glb').write_bytes(
            struct.pack('<4s4sI', b'glTF', b'\2\0\0\0', 28 + len(text) + len(data)) +
            struct.pack('<I4s', len(text), b'JSON') + text +
            struct.pack('<I4s', len(data), b'BIN\0') + data)
        even = {c: [1] * 512 for c in 'RGB'}
        wanted = 0.5 + 0.5 / SIDE / 0.9, 0.5 - 0.5 / SIDE / 0.9, 0.25
        pictures = []
        for name, words in ('a.gltf', ()), ('b.glb', ()), ('a.gltf', ('-r', 'reference')):
            if words and not HAS_REFERENCE:
                continue
            pictures.append(self.draw_scene(name, even, '--set', 'motion.time=1', '--samples', '1',
                                            *words))
            for card, color in zip(self.names, pictures[-1]):
                self.check(color, wanted, f'{card} {words}', 8e-3)
        self.assertEqual(*pictures[:2])


if __name__ == '__main__':
    if not HAS_REFERENCE:
        sys.argv.remove('--without')
    main()
