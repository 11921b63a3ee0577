"""test_pixels.py: what options do to the pixels of a picture. Usage: see case.py."""
import pathlib
import sys

sys.dont_write_bytecode = True  # the source tree stays clean
sys.path.append(str(pathlib.Path(__file__).parents[1] / 'support'))
from case import PLAIN, USAGE, Case, main  # noqa: E402
from exr_file import Exr  # noqa: E402

TINY = ('sphere', '--size', '32x24', *PLAIN, '-q')
HAS_REFERENCE = '--without' not in sys.argv


class Pixels(Case):
    def draw(self, *arguments, scene=TINY):
        """An EXR."""
        self.succeed('render', *scene, *arguments, '-o', 'a.exr')
        return Exr((self.folder / 'a.exr').read_bytes())


class PixelFilter(Pixels):
    def test_point_is_at_the_centre(self):
        for more in ((), ('--tiles', '2x1')) + ((('-r', 'reference'),) if HAS_REFERENCE else ()):
            with self.subTest(more=more):
                one = self.draw(*more)
                point = self.draw('--samples', '2', '--pixel-filter', 'point', *more)
                self.assertEqual(point.pixels, one.pixels)
                box = self.draw('--samples', '2', *more)
                self.assertNotEqual(box.pixels, one.pixels)

    def test_only_point_is_recorded(self):
        self.assertNotIn('pixel-filter', self.draw('--pixel-filter', 'box').text('firn/settings'))
        point = self.draw('--pixel-filter', 'point', '--frames', '3')
        self.assertIn(' pixel-filter=point ', point.text('firn/settings'))

    def test_others_are_refused(self):
        for name in ('', 'Box', 'gauss'):
            self.refuse(USAGE, 'render', *TINY, '--pixel-filter', name,
                        names=['--pixel-filter', name, 'box or point'])


class ToneCurve(Pixels):
    def test_each_differs_and_is_recorded(self):
        words = ('render', *TINY, '-o', 'a.png', '-o', 'a.exr')
        pictures, linear = set(), set()
        for curve in ('neutral', 'clip', 'agx', 'aces', 'hable'):
            self.succeed(*words, '--tone-curve', curve)
            picture = Exr((self.folder / 'a.exr').read_bytes())
            self.assertIn(f' tonemap.curve={curve} ', picture.text('firn/settings') + ' ')
            pictures.add((self.folder / 'a.png').read_bytes())
            linear.add(picture.pixels)
        self.assertEqual((len(pictures), len(linear)), (5, 1))
        self.refuse(USAGE, *words, '--tone-curve', 'filmic', names=['--tone-curve', 'agx'])


if __name__ == '__main__':
    if not HAS_REFERENCE:
        sys.argv.remove('--without')
    main()
