"""test_shells.py: objects of several shells and primitives, winding, models far from the origin.
Usage: see case.py."""
import json
import struct
import sys

sys.dont_write_bytecode = True  # the source tree stays clean
from case import BARE, Case, main, unsanitized  # noqa: E402
from exr_file import Exr  # noqa: E402
from gltf_file import CORNERS, SIDES, boxes, glass  # noqa: E402

TRACE = ('--background', '0.2,0.4,0.6', '--size', '24x18', '--plain', '-r', 'trace')
ALL = range(12)


def box(*sides, scale=1, at=(0, 0, 0), nudge=0, turned=False, material=0):
    """A primitive: triangles of a box, with corners that are `nudge` float steps apart."""
    points = [[scale * x + a for x, a in zip(corner, at)] for corner in CORNERS]
    steps = struct.unpack('<24I', struct.pack('<24f', *sum(points, [])))
    values = struct.pack('<24I', *(step + nudge for step in steps))
    corners = [SIDES[3 * side + k] for side in sides for k in ((0, 2, 1) if turned else (0, 1, 2))]
    return values, corners, material


def model(*meshes, materials=(glass(),), nodes=None):
    """A file with a mesh and, unless given, a node for each list of primitives."""
    data, views, accessors, listed = b'', [], [], []

    def add(values, **accessor):
        nonlocal data
        views.append({'buffer': 0, 'byteOffset': len(data), 'byteLength': len(values)})
        accessors.append({'bufferView': len(views) - 1, **accessor})
        data += values
        return len(accessors) - 1
    for primitives in meshes:
        listed.append({'primitives': [{
            'attributes': {'POSITION': add(values, componentType=5126, count=len(values) // 12,
                                          type='VEC3')},
            'indices': add(struct.pack(f'<{len(corners)}I', *corners), componentType=5125,
                           count=len(corners), type='SCALAR'),
            'material': material} for values, corners, material in primitives]})
    scene = json.loads(boxes(*((material, [0, 0, 0], 1) for material in materials)))
    nodes = nodes or [{'mesh': i, 'name': f'node {i}'} for i in range(len(meshes))]
    inner = {child for node in nodes for child in node.get('children', ())}
    scene.update(nodes=nodes, meshes=listed, accessors=accessors, bufferViews=views,
                 scenes=[{'nodes': [i for i in range(len(nodes)) if i not in inner]}])
    scene['buffers'] = [{'byteLength': len(data), 'uri': 'a.bin'}]
    return json.dumps(scene), data


class Files(Case):
    def write(self, *meshes, **more):
        text, data = model(*meshes, **more)
        (self.folder / 'a.gltf').write_text(text)
        (self.folder / 'a.bin').write_bytes(data)

    def info(self):
        done = self.succeed('info', 'a.gltf', '--json')
        return json.loads(done.stdout), done.stderr.decode()

    def pixels(self, *words):
        done = self.succeed('render', 'a.gltf', *TRACE, '-o', 'a.exr', *words)
        self.warnings = done.stderr.decode()
        exr = Exr((self.folder / 'a.exr').read_bytes())
        return exr.read_planes('RGB'), exr

    def same(self, found, wanted, limit=0.0005):
        sums = [abs(a - b) for plane in 'RGB' for a, b in zip(found[plane], wanted[plane])]
        self.assertLess(sum(sums) / len(sums), limit)


class Objects(Files):
    def check(self, wanted, *meshes, notes=0, **more):
        with self.subTest(wanted=wanted):
            self.write(*meshes, **more)
            found, words = self.info()
            self.assertEqual([part['closed'] for part in found['objects']], wanted)
            self.assertEqual(len(words.splitlines()), notes, words)
            return words

    def test_parts_that_close_together_are_one_object(self):
        top, rest = box(0, 1, 2, 3), box(*ALL[4:], nudge=1)
        self.check([True], [top, rest])
        self.check([True], [top], [rest])  # of two nodes
        self.check([True], [box(*ALL), box(*ALL, scale=0.5, turned=True)])  # a cavity
        self.check([True, True], [box(*ALL), box(*ALL, at=(3, 0, 0))])
        self.check([False, False], [top, box(*ALL[4:], material=1)],
                   materials=(glass(), glass(ior=1.3)))
        self.check([False], [box(*ALL[:4], *ALL[8:])])  # a tube
        self.check([False, False], [box(0, 1, 2)], [box(*ALL[4:])])  # of two nodes, and open
        self.check([False], [box(0, 1, 2), box(*ALL[4:])])
        self.check([True], [top, box(*ALL[4:], turned=True)], notes=1)

    def test_a_note_tells_of_media_through_which_no_light_passes(self):
        self.write([box(*ALL)])
        for words, is_said in ((('--material', 'whisky', '--scale', '0.01'), False),
                               (('--material', 'whisky'), True),
                               (('--material', 'node 0=whisky'), True)):
            done = self.succeed('render', 'a.gltf', *BARE, '-o', 'a.png', *words)
            self.assertEqual(b'node 0 absorbs more than 99 %' in done.stderr, is_said, words)

    def test_open_objects_are_named_in_one_line(self):
        self.write([box(0, 1, 2)], [box(3, at=(5, 0, 0))])
        done = self.succeed('render', 'a.gltf', *BARE, '-o', 'a.png')
        lines = [line for line in done.stderr.decode().splitlines() if 'close the holes' in line]
        self.assertEqual(len(lines), 1)
        self.assertIn('object node 0 and 1 other are open', lines[0])
        self.write([box(0, 1, 2)], materials=(glass(thickness=0),))  # encloses nothing
        done = self.succeed('render', 'a.gltf', *BARE, '-o', 'a.png')
        self.assertNotIn(b'close the holes', done.stderr)

    @unsanitized
    def test_an_object_of_several_materials(self):
        """The medium is one, but the sides are tinted on their own."""
        sides = box(*ALL[:6]), box(*ALL[6:], material=1)
        self.write(list(sides), materials=(glass(), glass()))
        clear, _ = self.pixels()
        self.write(list(sides), materials=(glass(), glass(color=(0.2, 1, 1))))
        tinted, _ = self.pixels()
        self.same({**tinted, 'R': clear['R']}, clear)
        self.assertLess(sum(tinted['R']), 0.9 * sum(clear['R']))


class Winding(Files):
    @unsanitized
    def test_shells_inside_out_are_solid(self):
        self.write([box(*ALL), box(*ALL, at=(3, 0, 0))])
        wanted, _ = self.pixels()
        self.assertNotIn('inside out', self.warnings)
        self.write([box(*ALL), box(*ALL, at=(3, 0, 0), turned=True)])
        found, _ = self.pixels()
        self.assertEqual(self.warnings.count('inside out, and were flipped: 1\n'), 1)
        self.same(found, wanted)

    @unsanitized
    def test_cavities(self):
        self.write([box(*ALL), box(*ALL, scale=0.5, turned=True)])
        wanted, _ = self.pixels()
        self.assertNotIn('inside out', self.warnings)
        for outer, inner in (True, False), (True, True):
            self.write([box(*ALL, turned=outer), box(*ALL, scale=0.5, turned=inner)])
            self.same(self.pixels()[0], wanted)
            self.assertIn('inside out', self.warnings)

    @unsanitized
    def test_faces_with_both_windings(self):
        self.write([box(*ALL)])
        wanted, _ = self.pixels()
        values, corners, _ = box(*ALL)
        back = box(*ALL, turned=True)[1]
        for faces in corners + back, back + corners:
            self.write([(values, faces, 0)])
            self.same(self.pixels()[0], wanted)
            self.assertIn('opposite winding, and were left out: 12\n', self.warnings)

    @unsanitized
    def test_shells_that_touch(self):
        """Solids of one primitive that share faces, wholly, in part or nearly, are one body."""
        def joined(*parts):
            corners = [8 * i + k for i, part in enumerate(parts) for k in part[1]]
            return b''.join(part[0] for part in parts), corners, 0
        whole = [box(*ALL, at=(-1, 0, 0)), box(*ALL, at=(1, 0, 0))]
        near = [whole[0], box(*ALL, at=(1.0001, 0, 0))]
        step = [box(*ALL), box(*ALL, scale=0.5, at=(0.2, 1.5, 0.1))]
        values, corners, _ = joined(*whole)
        faces = [corners[i:i + 3] for i in range(0, len(corners), 3)]
        mixed = [k for i in range(24) for k in faces[i * 7 % 24]]
        for name in 'trace', 'reference':
            for parts, one, dropped in ((whole, joined(*whole), True), (step, joined(*step), False),
                                        (whole, (values, mixed, 0), True),
                                        (near, joined(*near), False)):
                with self.subTest(name, parts=parts, one=one):
                    words = '-r', name, '--set', 'trace.surroundings=rays'
                    self.write(*([part] for part in parts))
                    wanted, _ = self.pixels(*words)
                    self.write([one])
                    self.same(self.pixels(*words)[0], wanted)
                    self.assertEqual('were left out: 4\n' in self.warnings, dropped)

    def test_many_shells(self):
        """A tower, every other box of which is inside out, takes no quadratic time."""
        self.write([box(*ALL, at=(0, 3 * i, 0), turned=i % 2 > 0) for i in range(2000)])
        self.assertIn('inside out, and were flipped: 1000\n', self.info()[1])


class Far(Files):
    @unsanitized
    def test_far_from_the_origin(self):
        place = 10000000.25, -70000, 300
        eye = 3, 2, 4
        turn = {'rotation': [0, 0.6, 0, 0.8]}
        self.write([box(*ALL, scale=0.5, at=(0.5, 0, 0))], nodes=[{'mesh': 0, **turn}])
        wanted, exr = self.pixels('--eye', '3,2,4', '--target', '0,0,0')
        self.assertNotIn('firn/origin', exr.attributes)
        self.write([box(*ALL, scale=0.5, at=(0.5, 0, 0))], nodes=[
            {'mesh': 0, **turn}, {'children': [0], 'translation': [1e7 - 1000, 0, 1000]},
            {'children': [1], 'translation': [1000.25, -70000, -700]}])
        words = [','.join(repr(a + b) for a, b in zip(place, more)) for more in (eye, (0, 0, 0))]
        found, exr = self.pixels('--eye', words[0], '--target', words[1], '--aov', 'P')
        self.same(found, wanted)
        origin = [float(number) for number in exr.text('firn/origin').split(',')]
        seen = exr.read_planes(['P.X', 'P.Y', 'P.Z', 'A'])
        middle = 9 * 24 + 12
        for axis, name in enumerate(('P.X', 'P.Y', 'P.Z')):
            self.assertAlmostEqual(origin[axis] + seen[name][middle], place[axis], delta=2)
        self.assertIn(f'eye={words[0]}', exr.text('firn/settings'))
        scene = self.info()[0]
        self.assertEqual(scene['origin'], origin)
        for low, high, at in zip(scene['min'], scene['max'], place):
            self.assertTrue(at - 1.5 < low < high < at + 1.5)

    def test_vertices_that_collapse_are_noted(self):
        self.write([box(*ALL, at=(5e7, 0, 0))])
        self.assertIn('triangles have collapsed', self.info()[1])


if __name__ == '__main__':
    main()
