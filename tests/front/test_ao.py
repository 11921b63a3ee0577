"""test_ao.py: what objects hide of the light on what they stand on. Usage: see case.py."""
import re
import sys

sys.dont_write_bytecode = True  # the source tree stays clean
from case import NO_DRIVER, SMALL_CUBE, Case, main, unsanitized  # noqa: E402
from exr_file import Exr  # noqa: E402
from gltf_file import boxes, glass  # noqa: E402

OFF = ('--set', 'ao.strength=0')
WIDTH, HEIGHT = 96, 64
FOOT = range(WIDTH * 48 + 44, WIDTH * 48 + 52)  # pixels of the floor close before the box
FLOOR = range(WIDTH * 48, WIDTH * HEIGHT)
NEAR = [WIDTH * y + x for y in range(50, 54) for x in range(36, 60)]
BOX = ('box.gltf', '-r', 'bounce', '--size', f'{WIDTH}x{HEIGHT}', '--eye', '0,4,6', '--target',
       '0,0.9,0', '--samples', 1, *SMALL_CUBE, '--set', 'light.count=0', '-q')


class Contact(Case):
    """A box of glass on a matt white floor, clear or black."""

    def write(self, color):
        floor = {'pbrMetallicRoughness': {'metallicFactor': 0, 'roughnessFactor': 1}}
        (self.folder / 'box.gltf').write_text(boxes(
            (floor, [0, -50, 0], 50), (glass(color=(color, color, color)), [0, 1.001, 0], 1)))

    def planes(self, *words):
        self.succeed('render', *BOX, *words, '-o', 'a.exr')
        return Exr((self.folder / 'a.exr').read_bytes()).read_planes(['R', 'G', 'B'])

    def test_where_it_is_drawn(self):
        self.write(1)
        for is_drawn, words in ((True, BOX[:3]), (False, ('box.gltf', '-r', 'trace')),
                                (False, (*BOX[:3], *OFF)), (False, ('valley',)),
                                (False, (*BOX[:3], '--preset', 'paper'))):
            done = self.succeed('graph', *words, env=NO_DRIVER)
            found = re.search(r'(?m)^pass \d+ ao\.', done.stdout.decode())
            self.assertEqual(bool(found), is_drawn, words)

    @unsanitized
    def test_even_light(self):
        """In even light a white floor stays white below clear glass, and is dark beside black."""
        self.write(1)
        clear = self.planes('--background', '1,1,1')
        for name in 'RGB':
            self.assertLess(max(abs(clear[name][i] - 1) for i in FLOOR), 0.02)
        at_vertices = self.planes('--background', '1,1,1', '--set', 'ground.shading=vertices')
        self.assertLess(max(abs(at_vertices['G'][i] - 1) for i in FLOOR), 0.02)
        self.write(1e-4)
        black = self.planes('--background', '1,1,1')
        self.assertLess(max(black['G'][i] for i in FOOT), 0.8)
        self.assertGreater(black['G'][-1], 0.95)

    @unsanitized
    def test_beside_rays(self):
        """The floor before a black box, as the rung trace draws it: half of the error is gone."""
        self.write(1e-4)
        truth, without, found = (
            [planes['G'][i] for i in FLOOR] for planes in (
                self.planes('--background', '1,1,1', *words)
                for words in (('-r', 'trace', '--set', 'ground.light=traced', '--samples', 16),
                              OFF, ())))
        errors = [sum(abs(a - b) for a, b in zip(plane, truth)) for plane in (without, found)]
        self.assertLess(errors[1], 0.5 * errors[0], errors)


    @unsanitized
    def test_opaque(self):
        """The floor before a dark box, as trace draws it; one in the air changes nothing."""
        matt = {'pbrMetallicRoughness': {'baseColorFactor': [0.2, 0.2, 0.2, 1],
                                         'metallicFactor': 0, 'roughnessFactor': 1}}

        def drawn(height, *ways):
            (self.folder / 'box.gltf').write_text(boxes(
                (matt, [0, -50, 0], 50), (glass(), [0, 0.501, -1], 0.5),
                (matt, [0, height, 0.8], 0.5)))
            return [[planes['G'][i] for i in NEAR] for planes in (
                self.planes('--background', '1,1,1', *words) for words in ways)]

        truth, without, found = drawn(
            0.5, ('-r', 'trace', '--set', 'ground.light=traced', '--samples', 16), OFF, ())
        errors = [sum(abs(a - b) for a, b in zip(plane, truth)) for plane in (without, found)]
        self.assertLess(errors[1], 0.5 * errors[0], errors)
        without, found = drawn(2, OFF, ())
        self.assertLess(max(abs(a - b) for a, b in zip(without, found)), 0.01)


if __name__ == '__main__':
    main()
