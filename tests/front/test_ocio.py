"""test_ocio.py: option --ocio of `firn render`. Usage: see case.py."""
import sys

sys.dont_write_bytecode = True  # the source tree stays clean
from case import DATA, NO_DEVICE, NO_INPUT, SMALL, USAGE, Case, main  # noqa: E402
from exr_file import Exr  # noqa: E402
from png_file import Png  # noqa: E402

GAMMA = 2.2
# The view `table` reads a file beside the config; it inverts the colours of `plain`.
CONFIG = f'''ocio_profile_version: 2
search_path: luts
roles: {{default: raw}}
file_rules: [!<Rule> {{name: Default, colorspace: default}}]
displays:
  sRGB: [!<View> {{name: plain, colorspace: out}}, !<View> {{name: table, colorspace: inverted}}]
  other: [!<View> {{name: raw, colorspace: raw}}]
colorspaces:
  - !<ColorSpace> {{name: raw, isdata: true}}
  - !<ColorSpace> {{name: lin_rec709}}
  - !<ColorSpace>
    name: out
    from_scene_reference: !<ExponentTransform>
      {{value: [{GAMMA}, {GAMMA}, {GAMMA}, 1], direction: inverse}}
  - !<ColorSpace>
    name: inverted
    from_scene_reference: !<GroupTransform>
      children:
        - !<ExponentTransform> {{value: [{GAMMA}, {GAMMA}, {GAMMA}, 1], direction: inverse}}
        - !<FileTransform> {{src: invert.spi1d}}
'''
TABLE = 'Version 1\nFrom 0 1\nLength 2\nComponents 1\n{\n1\n0\n}\n'
DRAW = ('render', 'sphere', *SMALL, '-q')


class Ocio(Case):
    def setUp(self):
        super().setUp()
        (self.folder / 'luts').mkdir()
        (self.folder / 'luts/invert.spi1d').write_text(TABLE)
        (self.folder / 'a.ocio').write_text(CONFIG)
        if self.firn(*DRAW, '--ocio', 'a.ocio,plain', '-o', 'a.png').returncode == NO_DEVICE:
            self.skipTest('this build has no OpenColorIO')

    def pixels(self, view, *more):
        """Returns linear and shown values, both from 0 to 1."""
        self.succeed(*DRAW, '--ocio', f'a.ocio,{view}', '-o', 'a.png', '-o', 'a.exr', *more)
        planes = Exr((self.folder / 'a.exr').read_bytes()).read_planes('RGB')
        linear = [planes[c][i] for i in range(len(planes['R'])) for c in 'RGB']
        png = Png((self.folder / 'a.png').read_bytes())
        return linear, png.values, (1 << png.bits) - 1

    def test_views(self):
        for view, more, shown in (
                ('plain', (), lambda x: x ** (1 / GAMMA)),
                ('sRGB/plain', ('--png-bits', '16'), lambda x: x ** (1 / GAMMA)),
                ('plain', ('--exposure', '-1'), lambda x: (x / 2) ** (1 / GAMMA)),
                ('table', (), lambda x: 1 - min(x, 1) ** (1 / GAMMA)),
                ('other/raw', (), lambda x: x)):
            with self.subTest(view=view, more=more):
                linear, values, white = self.pixels(view, *more)
                far = max(abs(min(shown(x), 1) - value / white)
                          for x, value in zip(linear, values))
                self.assertLess(far, 2 / 255)

    def test_linear_files_have_no_view(self):
        done = self.succeed(*DRAW, '--ocio', 'a.ocio,plain', '-o', 'a.exr')
        self.assertIn(b'warning: --ocio', done.stderr)

    def test_wrong_words(self):
        for value in ('a.ocio', ',plain', 'a.ocio,'):
            self.refuse(USAGE, *DRAW, '--ocio', value, '-o', 'b.png', names=['--ocio'])
        self.refuse(NO_INPUT, *DRAW, '--ocio', 'none.ocio,plain', '-o', 'b.png')
        self.refuse(DATA, *DRAW, '--ocio', 'a.ocio,plane', '-o', 'b.png', names=['plane', 'plain'])
        (self.folder / 'b.ocio').write_text('ocio_profile_version: {')
        self.refuse(DATA, *DRAW, '--ocio', 'b.ocio,plain', '-o', 'b.png', names=['b.ocio'])
        (self.folder / 'b.ocio').write_text(CONFIG.replace('lin_rec709', 'lin'))
        self.refuse(DATA, *DRAW, '--ocio', 'b.ocio,plain', '-o', 'b.png', names=['Rec. 709'])
        self.assertNotIn('b.png', self.files())


if __name__ == '__main__':
    main()
