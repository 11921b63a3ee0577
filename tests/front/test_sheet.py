"""test_sheet.py: tests `firn sheet`, which draws several pictures side by side.

Usage: see case.py.
"""
import json
import sys

sys.dont_write_bytecode = True  # the source tree stays clean
from case import CANT_CREATE, CRACKED, NO_INPUT, USAGE, Case, main, unsanitized  # noqa: E402
from test_show import Png  # noqa: E402

WIDTH, HEIGHT = 64, 48
SIZE = ('--size', f'{WIDTH}x{HEIGHT}')
MARGIN, LABEL, GREY = 8, 16, (34, 34, 34)


class Sheet(Case):
    def sheet(self, *arguments):
        self.succeed('sheet', *SIZE, *CRACKED, '-o', 'sheet.png', *arguments)
        return Png((self.folder / 'sheet.png').read_bytes())

    def check_cell(self, sheet, column, row, *arguments):
        """What is there is what render draws with these words, under words in light letters."""
        self.succeed('render', *SIZE, *CRACKED, '-q', '-o', 'one.png', *arguments)
        one = Png((self.folder / 'one.png').read_bytes())
        left = MARGIN + column * (WIDTH + MARGIN)
        top = MARGIN + row * (HEIGHT + LABEL + MARGIN)
        for y in range(HEIGHT):
            for x in range(WIDTH):
                self.assertEqual(sheet[left + x, top + LABEL + y], one[x, y])
        label = [sheet[left + x, top + y] for x in range(WIDTH) for y in range(LABEL)]
        self.assertTrue(any(min(pixel) > 150 for pixel in label))

    def size_of(self, columns, rows):
        return (MARGIN + columns * (WIDTH + MARGIN), MARGIN + rows * (HEIGHT + LABEL + MARGIN))

    @unsanitized
    def test_every_material(self):
        done = self.succeed('sheet', 'sphere', *SIZE, *CRACKED)
        listed = json.loads(self.succeed('list', 'materials', '--json').stdout)['materials']
        materials = [material['name'] for material in listed]
        self.assertEqual(done.stderr.decode(), f'sheet.png: {len(materials)} images of 64x48\n')
        sheet = Png((self.folder / 'sheet.png').read_bytes())
        width, height = self.size_of(4, (len(materials) + 3) // 4)
        self.assertEqual((sheet.width, sheet.height), (width, height))
        for i, material in list(enumerate(materials))[::5]:  # cells of all rows and columns
            self.check_cell(sheet, i % 4, i // 4, 'sphere', '--material', material)
        if len(materials) % 4:
            self.assertEqual(sheet[width - 20, height - 20], GREY)
        self.assertEqual(sheet.texts['firn/labels'],
                         ','.join(f'material={material}' for material in materials))

    def test_a_setting(self):
        words = ('sphere', '--set', 'refract.fresnel=crossfade', '--samples', '2')
        sheet = self.sheet(*words, '--sweep', 'refract.crossfade=0,0.5,1')
        self.assertEqual((sheet.width, sheet.height), self.size_of(3, 1))
        for i, share in enumerate((0, 0.5, 1)):
            self.check_cell(sheet, i, 0, *words, '--set', f'refract.crossfade={share}')

    def test_two_parameters_are_rows_and_columns(self):
        sheet = self.sheet('sphere', '--sweep', 'refraction=paper,one-sided', '--sweep',
                           'cracks.count=0,1,2')
        self.assertEqual((sheet.width, sheet.height), self.size_of(3, 2))
        self.assertEqual(sheet.texts['firn/labels'].split(',')[::5],
                         ['refraction=paper cracks.count=0', 'refraction=one-sided cracks.count=2'])
        self.check_cell(sheet, 0, 1, 'sphere', '--refraction', 'one-sided', '--set',
                        'cracks.count=0')
        self.check_cell(sheet, 2, 0, 'sphere', '-r', 'paper', '--set', 'cracks.count=2')

    def test_wrong_words(self):
        many = 'air.seed=' + ','.join(map(str, range(65)))
        for words, names in (((), ('SCENE',)),
                             (('sphere', '-o', 'a.exr'), ('a.exr', '.png')),
                             (('sphere', '-o', 'a.png', '-o', 'b.png'), ('b.png',)),
                             (('sphere', '--sweep', 'size=2x2,4x4'), ('size=2x2,4x4', '--size')),
                             (('sphere', '--sweep', 'material=ice,snow'), ('snow',)),
                             (('sphere', '--sweep', 'refract.ior=1.5,9'), ('refract.ior',)),
                             (('sphere', '--sweep', 'cracks.count'), ('cracks.count',)),
                             (('sphere', '--sweep', 'refraction=paper,reference'), ('reference',)),
                             (('sphere', '--sweep', many), ('got 65', '64'))):
            self.refuse(USAGE, 'sheet', *words, names=names)
        self.refuse(NO_INPUT, 'sheet', 'gone.obj', names=['gone.obj'])
        self.refuse(CANT_CREATE, 'sheet', 'sphere', '-o', 'gone/a.png', names=['gone/a.png'])
        self.assertEqual(self.files(), [])


if __name__ == '__main__':
    main()
