"""test_show.py: layers in PNG files, `firn render --show`. Usage: see case.py."""
import struct
import sys
import zlib

sys.dont_write_bytecode = True  # the source tree stays clean
from case import NO_DRIVER, SMALL, USAGE, Case, long, main, unsanitized  # noqa: E402

WIDTH, HEIGHT = 64, 48
CRACKS = ('--set', 'cracks.count=2', '--set', 'light.count=2')
MIDDLE, CORNER = (32, 24), (0, 0)
LAYERS = ('Z', 'N', 'P', 'back.N', 'front.Z', 'back.Z', 'thickness', 'intervals', 'exit',
          'refraction', 'reflection', 'fresnel', 'path', 'bounces', 'tir', 'air', 'bubbles',
          'cracks')


def chunks(data):
    at = 8
    while at < len(data):
        size, kind = struct.unpack_from('>I4s', data, at)
        yield kind, data[at + 8:at + 8 + size]
        at += 12 + size


def unfilter(kind, left, up, corner):
    if kind < 4:
        return (0, left, up, (left + up) // 2)[kind]
    near = left + up - corner
    return min((left, up, corner), key=lambda value: abs(near - value))


class Png:
    """Of 8-bit RGB: the pixels, and its words."""
    def __init__(self, data):
        parts = list(chunks(data))
        self.texts = dict(body.decode().split('\0', 1) for kind, body in parts if kind == b'tEXt')
        packed = zlib.decompress(b''.join(body for kind, body in parts if kind == b'IDAT'))
        self.width, self.height = struct.unpack('>II', parts[0][1][:8])
        row, above, self.rows = 3 * self.width, bytes(3 * self.width), []
        for y in range(self.height):
            kind, *line = packed[y * (row + 1):(y + 1) * (row + 1)]
            for i, byte in enumerate(line):
                left, corner = (line[i - 3], above[i - 3]) if i > 2 else (0, 0)
                line[i] = (byte + unfilter(kind, left, above[i], corner)) & 255
            self.rows.append(line)
            above = line

    def __getitem__(self, place):
        x, y = place
        return tuple(self.rows[y][3 * x:3 * x + 3])

    def pixels(self):
        return [self[x, y] for y in range(self.height) for x in range(self.width)]

    @property
    def settings(self):
        return self.texts['firn/settings']


class Show(Case):
    def show(self, layer, *arguments):
        return Png(self.render(f'{layer}.png', '--show', layer, *arguments))

    def test_front_is_near_and_bright(self):
        picture = self.show('front.Z', '--orbit', '0,0,4')
        levels = {red for red, green, blue in picture.pixels() if red == green == blue}
        self.assertEqual(len(set(picture.pixels())), len(levels))  # grey
        self.assertEqual((min(levels - {0}), max(levels)), (32, 255))
        self.assertGreater(picture[MIDDLE][0], 240)  # a sphere's nearest point
        self.assertEqual(picture[CORNER], (0, 0, 0))

    def test_thickness_is_bright_where_it_is_thick(self):
        picture = self.show('thickness', '--orbit', '0,0,4')
        self.assertGreater(picture[MIDDLE][0], 240)
        rim = [level for level, _, _ in picture.pixels() if level]
        self.assertLess(min(rim), 64)
        self.assertEqual(picture[CORNER], (0, 0, 0))

    def test_what_is_the_same_everywhere_is_white(self):
        self.assertEqual(set(self.show('intervals').pixels()), {(0, 0, 0), (255, 255, 255)})

    def test_directions(self):
        picture = self.show('N', '--orbit', '0,0,4', '--background', '0,0,0')
        for got, want in zip(picture[MIDDLE], (128, 128, 255)):
            self.assertLess(abs(got - want), 16)
        right, above = picture[44, 24], picture[32, 12]
        self.assertGreater(right[0], 180)
        self.assertGreater(above[1], 180)
        for other in ('back.N', 'exit'):
            self.assertLess(self.show(other, '--orbit', '0,0,4')[MIDDLE][2], 32)  # along -z

    def test_positions_fill_every_axis(self):
        picture = self.show('P', '--orbit', '0,0,4', '--background', '0,0,0')
        for axis in range(3):
            levels = {pixel[axis] for pixel in picture.pixels()}
            self.assertEqual((min(levels), max(levels)), (0, 255))
        self.assertGreater(picture[44, 24][0], picture[20, 24][0])
        self.assertGreater(picture[32, 12][1], picture[32, 36][1])

    def test_colours_are_encoded(self):
        plain = ('--background', '0.5,0.2,0.05', '--set', 'light.count=0')
        for layer in ('refraction', 'reflection'):
            colours = set(self.show(layer, *plain).pixels()) - {(0, 0, 0)}
            red, green, blue = max(colours)
            self.assertGreater(red, green)
            self.assertGreater(green, blue)
        # a cracks layer of flat red: linear (1, 0, 0, 1)
        cracks = self.show('cracks', *CRACKS, '--set', 'cracks.debug=on')
        self.assertEqual(set(cracks.pixels()), {(0, 0, 0), (255, 0, 0)})

    def test_half_of_the_light_is_188(self):
        arguments = ('--background', '0.5,0.5,0.5', '--set', 'light.count=0')
        levels = [red for red, _, _ in self.show('refraction', *arguments).pixels() if red]
        self.assertEqual(max(set(levels), key=levels.count), 188)

    @long
    def test_every_layer_has_a_picture_of_its_own(self):
        more = (*CRACKS, '--set', 'air.count=3', '--set', 'bubbles.count=30')
        seen = set()
        for layer in LAYERS:
            name = f'{layer}.png'
            way = ('--refraction', 'bounce') if layer in ('path', 'bounces', 'tir') else ()
            self.succeed('render', 'valley', *SMALL, '-o', name, '--show', layer, *more, *way)
            picture = Png((self.folder / name).read_bytes())
            self.assertGreater(len(set(picture.pixels())), 1, layer)
            self.assertIn(f' show={layer} ', picture.settings)
            seen.add(tuple(picture.pixels()))
        self.assertEqual(len(seen), len(LAYERS))

    @unsanitized
    def test_exr_files_stay_as_they_are(self):
        for layer, *more in (('cracks', *CRACKS), ('thickness', '--aov', 'N,thickness'),
                             ('cracks', *CRACKS, '--aov', 'N', '--samples', '2')):
            plain = self.render('plain.exr', *more)
            both = self.render('both.exr', '-o', 'both.png', '--show', layer, *more)
            self.assertTrue(plain == both, f'{layer} {more}: other bytes')
            shown = (self.folder / 'both.png').read_bytes()
            alone = self.render('alone.png', '--show', layer, *more)
            self.assertEqual(Png(shown).pixels(), Png(alone).pixels())

    def test_sequence_and_resume(self):
        command = ('render', 'sphere', *SMALL, '--frames', '1-2', '--set', 'motion.count=3',
                   '--resume', '-o', '#.png', '-o', '#.exr')
        first = self.succeed(*command, '--show', 'Z').stderr.decode()
        self.assertNotIn('up to date', first)
        again = self.succeed(*command, '--show', 'Z', env=NO_DRIVER).stderr.decode()
        self.assertEqual(again.count('up to date'), 4)
        other = self.succeed(*command, '--show', 'N').stderr.decode()
        self.assertEqual([line for line in other.splitlines() if 'up to date' in line],
                         ['1.exr: up to date', '2.exr: up to date'])
        plain = self.succeed(*command).stderr.decode()
        self.assertEqual(plain.count('up to date'), 2)
        self.assertNotIn('show=', Png((self.folder / '1.png').read_bytes()).settings)

    def test_wrong_words(self):
        for name in ('depth', 'z', '', 'Z,N', 'all', 'beauty'):
            self.refuse(USAGE, 'render', 'sphere', '-o', 'a.png', '--show', name,
                        names=['--show', f"'{name}'", 'firn list layers'])
        for outputs in ((), ('-o', 'a.exr'), ('-o', '-')):
            self.refuse(USAGE, 'render', 'sphere', '--show', 'Z', *outputs, env=NO_DRIVER,
                        names=['--show Z', '.png'])
        self.assertEqual(self.files(), [])

    def test_help(self):
        text = self.succeed('render', '--help').stdout.decode()
        self.assertRegex(text, r'(?m)^Output:\n(  .*\n)+ +--show LAYER ')


if __name__ == '__main__':
    main()
