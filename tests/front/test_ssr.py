"""test_ssr.py: the mirror image of objects in what they stand on. Usage: see case.py."""
import math
import re
import sys

sys.dont_write_bytecode = True  # the source tree stays clean
from case import NO_DRIVER, SMALL_CUBE, Case, main, unsanitized  # noqa: E402
from exr_file import Exr  # noqa: E402
from gltf_file import boxes, glass  # noqa: E402

OFF = ('--set', 'ssr.steps=0')
WIDTH, HEIGHT = 96, 64
FLOOR = range(WIDTH * 44, WIDTH * HEIGHT)  # pixels of it before the box
BOX = ('box.gltf', '-r', 'bounce', '--size', f'{WIDTH}x{HEIGHT}', '--eye', '0,2,7', '--target',
       '0,0.5,0', '--samples', 1, *SMALL_CUBE, '--set', 'light.count=0', '-q')


class Mirror(Case):
    """A box of glass on a floor of metal, or on what is not."""

    def setUp(self):
        super().setUp()
        self.write(1)

    def write(self, color, roughness=0.2):
        floor = {'pbrMetallicRoughness': {'metallicFactor': 1, 'roughnessFactor': roughness}}
        box = glass(color=(color, color, color))
        (self.folder / 'box.gltf').write_text(boxes((floor, [0, -50, 0], 50),
                                                    (box, [0, 1.05, 0], 1)))

    def draw(self, *words):
        self.succeed('render', *BOX, *words, '-o', 'a.exr')
        return (self.folder / 'a.exr').read_bytes()

    def planes(self, *words):
        return Exr(self.draw(*words)).read_planes(['R', 'G', 'B'])

    def test_where_it_is_drawn(self):
        for is_drawn, words in ((True, BOX[:3]), (False, ('box.gltf', '-r', 'trace')),
                                (True, (*BOX[:3], '--quality', 'draft')), (False, ('valley',)),
                                (False, (*BOX[:3], '--set', 'ground.shading=vertices')),
                                (False, (*BOX[:3], '--preset', 'paper'))):
            done = self.succeed('graph', *words, env=NO_DRIVER)
            found = re.search(r'(?m)^pass \d+ ssr\.', done.stdout.decode())
            self.assertEqual(bool(found), is_drawn, words)

    def errors(self, *ways):
        """Sums of the floor's differences to the rung trace."""
        truth, *drawn = (
            [min(planes[name][i], 1) for name in 'RGB' for i in FLOOR] for planes in (
                self.planes('--env', 'valley', *words)
                for words in (('-r', 'trace', '--set', 'ground.light=traced', '--samples', 4),
                              *ways)))
        return [sum(abs(a - b) for a, b in zip(values, truth)) for values in drawn]

    @unsanitized
    def test_beside_rays(self):
        """The floor before dark glass, as the rung trace draws it: half of the error is gone."""
        self.write(0.02)
        without, found = self.errors(OFF, ())
        self.assertLess(found, 0.5 * without)

    @unsanitized
    def test_refracted(self):
        """Clear glass, from below: not what the eye sees in it, with and without a tint."""
        for color in (1, 0.8):
            self.write(color, 0)
            as_seen, refracted = self.errors(('--set', 'ssr.refract=off'), ())
            self.assertLess(refracted, 0.75 * as_seen, color)

    @unsanitized
    def test_tiles(self):
        """The lower tile, drawn alone, has the pixels of the whole: it knows what it mirrors."""
        words = ('--env', 'valley', '--eye', '0,4,7')
        whole = self.planes(*words)
        tile = Exr(self.draw(*words, '--tiles', '1x2', '--tile', '2'))
        top = tile.window('dataWindow')[1]
        for name, plane in tile.read_planes(['R', 'G', 'B']).items():
            self.assertEqual(plane, whole[name][WIDTH * top:])

    @unsanitized
    def test_even_light(self):
        """A mirror and clear things in even light are as bright as that."""
        planes = [self.planes('--background', '1,1,1', *more) for more in ((), OFF)]
        pairs = [pair for name in 'RGB' for pair in zip(planes[0][name], planes[1][name])]
        self.assertTrue(all(math.isfinite(a) and abs(a - b) < 0.01 and a < 1.01 for a, b in pairs))
        self.assertNotEqual(*planes)


if __name__ == '__main__':
    main()
