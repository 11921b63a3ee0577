"""test_exposure.py: automatic exposure of model files. Usage: see case.py."""
import json
import sys

sys.dont_write_bytecode = True  # the source tree stays clean
from case import PAPER, SMALL_CUBE, USAGE, Case, main  # noqa: E402
from exr_file import Exr  # noqa: E402
from png_file import Png  # noqa: E402

CUBE = ''.join(f'v {x} {y} {z}\n' for x in (0, 1) for y in (0, 1) for z in (0, 1)) + (
    'f 1 2 4 3\nf 5 7 8 6\nf 1 5 6 2\nf 3 4 8 7\nf 1 3 7 5\nf 2 6 8 4\n')
FAST = (*PAPER, *SMALL_CUBE, '-q', '--ground', 'none')


class Exposure(Case):
    def setUp(self):
        super().setUp()
        (self.folder / 'a.obj').write_text(CUBE)

    def report(self, *words, scene='a.obj'):
        self.succeed('render', scene, '--size', '64x48', *FAST, *words, '--json', 'a.json')
        return json.loads((self.folder / 'a.json').read_text())

    def stops(self, *words, scene='a.obj'):
        return self.report('-o', 'a.exr', *words, scene=scene)['exposure']

    def median(self, *words):
        self.succeed('render', 'a.obj', '--size', '64x48', *FAST, *words, '-o', 'a.png')
        png = Png((self.folder / 'a.png').read_bytes())
        values = [0.2126 * r + 0.7152 * g + 0.0722 * b for r, g, b in zip(
            *(png.values[c::png.channels] for c in range(3)))]
        return sorted(values)[len(values) // 2] / 255

    def test_median_of_the_display(self):
        self.assertLess(self.median('--exposure', '0'), 0.25)
        self.assertTrue(0.25 < self.median() < 0.45)
        self.assertTrue(0.25 < self.median('--ground', 'auto') < 0.45)
        self.assertTrue(0.25 < self.median('--env-exposure', '4') < 0.45)
        self.assertTrue(0.25 < self.median('--env-exposure', '-2', '--tone-curve', 'agx') < 0.45)

    def test_depends_on_the_view_alone(self):
        wanted = self.stops()
        self.assertGreater(wanted, 0)
        for words in (('--size', '128x96'), ('--quality', 'draft'), ('-r', 'reference'),
                      ('--tiles', '2x2'), ('--tiles', '2x2', '--tile', '3')):
            self.assertEqual(self.stops(*words), wanted, words)
        turns = ('--set', 'motion.ice=900', '-o')
        for chunk in ('1/2', '2/2'):
            words = ('--frames', '0-3', '--chunk', chunk, '--resume', *turns, 'f.##.exr')
            self.assertEqual(self.report(*words)['exposure'],
                             self.report(*turns, 'b.exr')['exposure'])

    def test_exr_is_linear_and_states_it(self):
        def draw(*words):
            stops = self.stops('--set', 'tonemap.dither=off', *words)
            exr = Exr((self.folder / 'a.exr').read_bytes())
            return stops, exr.text('firn/settings'), exr.read_planes(['R', 'G', 'B'])

        stops, said, pixels = draw()
        self.assertIn(f'tonemap.exposure={stops:g} ', said)
        self.assertEqual(pixels, draw('--exposure', '0')[2])

    def test_who_wins(self):
        auto = self.stops()
        (self.folder / 'look.txt').write_text('tonemap.exposure=-2\n')
        for words, wanted in ((('--exposure', '-1.5'), -1.5), (('--plain',), 0),
                              (('--plain', '--exposure', 'auto'), auto),
                              (('--set', 'tonemap.exposure=0'), 0),
                              (('--preset', 'look.txt'), -2),
                              (('--preset', 'look.txt', '--exposure', 'auto'), auto)):
            self.assertAlmostEqual(self.stops(*words), wanted, 5, words)
        self.assertEqual(self.stops(scene='sphere'), 0)
        self.assertNotEqual(self.stops('--exposure', 'auto', '--set', 'sky.strength=0.1',
                                       scene='sphere'), 0)
        for words in (('--exposure', '1', '--set', 'tonemap.exposure=1'),
                      ('--exposure', 'auto', '--set', 'tonemap.exposure=1'),
                      ('--exposure', 'x'), ('--exposure', '17'), ('--exposure', 'nan')):
            self.refuse(USAGE, 'render', 'a.obj', *words, names=['--exposure'])

    def test_scattering_media_are_metered(self):
        """The density of the file's medium is known before inclusion textures are generated."""
        def metered(*words):
            return self.stops('--exposure', 'auto', '--env', 'studio', *words, scene='ice-cube')
        self.assertNotEqual(metered('--set', 'air.media=40'), metered('--set', 'air.media=0'))

    def test_stated_background_is_not_metered(self):
        flat = ('--env', 'studio', '--background')
        self.assertEqual(self.stops(*flat, '0,0,0'), 0)
        bare = self.stops(*flat, 'none')
        for color in ('0,0,0', '9,9,9'):
            stops = self.stops('--exposure', 'auto', *flat, color)
            self.assertAlmostEqual(stops, bare, delta=0.15)  # pixels of edges have both
        self.assertEqual(self.stops('--exposure', 'auto', '--background', '0,0,0'), 0)

    def test_report_has_the_camera(self):
        camera = self.report('-o', 'a.exr', '--eye', '3,1,2', '--target', '0.5,0,0')['camera']
        self.assertEqual(camera, {'eye': [3, 1, 2], 'target': [0.5, 0, 0], 'fov': 45})
        self.assertEqual(self.report('-o', 'a.exr')['camera']['fov'], 24)


if __name__ == '__main__':
    main()
