"""test_preset.py: settings from files. Usage: see case.py."""
import re
import sys

sys.dont_write_bytecode = True  # the source tree stays clean
from case import DATA, NO_INPUT, USAGE, Case, main, unsanitized  # noqa: E402
from exr_file import Exr  # noqa: E402

TINY = ('--size', '16x12', '-q')
PLAIN = 'air.count=0\nbump.strength=0\n'


class Preset(Case):
    def write(self, text, name='look.txt'):
        (self.folder / name).write_text(text)
        return name

    def settings(self, *arguments):
        """{name: value} of a picture's settings."""
        self.succeed('render', 'sphere', *TINY, *arguments, '-o', 'a.exr')
        text = Exr((self.folder / 'a.exr').read_bytes()).text('firn/settings')
        return dict(re.findall(r' (\w+\.\w+)=(\S+)', text))

    def test_lines_of_a_file(self):
        look = self.write(f'# a look\n\n{PLAIN}  cracks.count=2\t\r\nrefract.ior=1.5')
        defaults = self.settings('--set', 'air.count=0', '--set', 'bump.strength=0')
        self.assertEqual(self.settings('--preset', look),
                         {**defaults, 'cracks.count': '2', 'refract.ior': '1.5'})

    def test_what_wins(self):
        look = ('--preset', self.write(f'{PLAIN}cracks.count=2\nrefract.ior=1.5\n'))
        for words in (('--set', 'cracks.count=3', *look), (*look, '--set', 'cracks.count=3')):
            self.assertEqual(self.settings(*words)['cracks.count'], '3')
        self.assertEqual(self.settings(*look, '--material', 'diamond')['refract.ior'], '2.417')

    def test_settings_of_a_picture(self):
        look = self.write(f'{PLAIN}cracks.count=2\ntonemap.curve=clip\n')
        words = ('--eye', '3,1,2', '-o', 'b.png', '--preset')
        wanted = self.settings(*words, look)
        first = (self.folder / 'a.exr').read_bytes()
        (self.folder / 'a.exr').rename(self.folder / ' fov=1 cracks.count=9.exr')
        for picture in (' fov=1 cracks.count=9.exr', 'b.png'):
            self.assertEqual(self.settings('--eye', '3,1,2', '--preset', picture), wanted)
            self.assertTrue((self.folder / 'a.exr').read_bytes() == first)

    @unsanitized
    def test_each_of_a_sweep(self):
        few, many = self.write(f'{PLAIN}cracks.count=0'), self.write('cracks.count=x', 'many.txt')
        self.succeed('sheet', 'sphere', *TINY, '--sweep', f'preset={few},{few}', '-o', 'a.png')
        self.refuse(DATA, 'sheet', 'sphere', *TINY, '--sweep', f'preset={few},{many}',
                    names=['many.txt:1:', 'cracks.count'])

    def test_all_settings_as_comments(self):
        text = self.succeed('list', 'settings', '--preset').stdout.decode()
        self.succeed('graph', 'sphere', '--preset', self.write(text))
        names = re.findall(r'(?m)^#(\w+\.\w+)=\S+$', text)
        listed = self.succeed('list', 'settings').stdout.decode().splitlines()[1:]
        self.assertEqual(names, [line.split()[0] for line in listed])
        given = self.write(re.sub(r'(?m)^#(\w+\.\w+=)', r'\1', text))
        self.assertEqual(self.settings('--preset', given), self.settings())
        self.refuse(USAGE, 'list', '--preset', names=['firn list settings --preset'])

    def test_what_is_wrong_is_said(self):
        for text, names in (('x', ['look.txt:2:', 'NAME=VALUE']),
                            ('cracks.cuont=1', ['look.txt:2:', "'cracks.count'?"]),
                            ('cracks.count=x', ['look.txt:2:', 'cracks.count', '0 to 64'])):
            self.refuse(DATA, 'graph', 'sphere', '--preset', self.write(f'\n{text}\n'),
                        names=names)
        self.refuse(NO_INPUT, 'graph', 'sphere', '--preset', 'nosuch.txt', names=['nosuch.txt'])
        self.refuse(USAGE, 'render', 'sphere', '--preset', 'b.exr', '-o', 'b.exr',
                    names=['--preset'])
        self.succeed('render', 'sphere', '--size', '4x4', '-n', '1', '-o', 'cube.exr')
        (self.folder / 'no.exr').write_bytes((self.folder / 'cube.exr').read_bytes().replace(
            b'firn/settings', b'firm/settings'))
        self.refuse(DATA, 'graph', 'sphere', '--preset', 'no.exr', names=['no.exr', 'no settings'])


if __name__ == '__main__':
    main()
