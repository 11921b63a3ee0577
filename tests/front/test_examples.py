"""test_examples.py: every command that the README, the docs and the help show, run small.

Usage: test_examples.py FIRN [--no-window] [--pages=K/N] [TEST...]
    --no-window: `firn view` cannot open a window; --pages: every N-th page, beginning with page K

The commands are run unchanged, except for smaller sizes, fewer runs, frames and inclusions, and
without pipes.
"""
import base64
import json
import pathlib
import re
import shutil
import struct
import subprocess
import sys

sys.dont_write_bytecode = True  # the source tree stays clean
from case import SMALL_CUBE, Case, environment, main  # noqa: E402
from desktop import Desktop  # noqa: E402

QUICK = ('--plain', *SMALL_CUBE)  # with whatever rung the page names
NO_WINDOW = '--no-window' in sys.argv
if NO_WINDOW:
    sys.argv.remove('--no-window')
PART, PARTS = 1, 1
if len(sys.argv) > 2 and sys.argv[2].startswith('--pages='):
    PART, PARTS = map(int, sys.argv.pop(2).removeprefix('--pages=').split('/'))

ROOT = pathlib.Path(__file__).parents[2]
COMMANDS = ('render', 'view', 'profile', 'graph', 'diff', 'ladder', 'list', 'sheet',
            'farm', 'merge', 'info', 'selftest')
# Settings of a technique that a reader is to write
TO_BE_WRITTEN = 'fog.density'
SMALL = {
    'render': '--size 48x36', 'view': '--size 48x36 --frames 1 -q',
    'profile': '--warmup 0 --clock submits --runs 2', 'ladder': '--size 48x36 --runs 0',
    'graph': '', 'diff': '', 'list': '', 'sheet': '--size 48x36',
    'farm': '', 'merge': '', 'info': '', 'selftest': '',
}
BASELINE_RUNS = '--runs 12'  # fewer cannot show a difference
# Of what costs most: words of a command, and fewer of the same.
FEWER = (
    (r'^firn (?!render)(\w+)(.*) ice-cube\b', r'firn \1\2 valley'),  # is loaded sooner
    (r'--frames (\d+)-\d+', r'--frames \1-\1'), (r'--samples \d+', '--samples 2'),
    (r'--quality high', '--quality high --samples 2'),
    (r'--time \d+', '--time 0.1'),
    (r'--sweep size=\S+', '--sweep size=16x16,32x24,48x36'),
    (r'--sweep cracks.count=\S*', '--sweep cracks.count=0,1'),
    (r'--sweep ice.melt=\S*', '--sweep ice.melt=0.5'),
    (r'(object.triangles=\S*),100000', r'\1'),
    (r'(caustics.directions)=\d+', r'\1=4'),
)


def examples(text):
    """Indented lines that begin with the program, joined where they go on."""
    text = text.replace('\\\n', ' ')
    for line in re.findall(rf'(?m)^(?: {{4}}|  )(?:build/)?(firn (?:{"|".join(COMMANDS)})\b.*)$',
                           text):
        yield re.split(r' {3,}(?=[a-z])|\s+\|', line)[0].strip()


def shrink(line):
    """The same with less work."""
    command = line.split()[1]
    for words, fewer in FEWER:
        line = re.sub(words, fewer, line)
    more = SMALL[command]
    if '--truth' in line:
        more = '--runs 0 --rungs paper'
    elif more.startswith('--size'):
        line = re.sub(r' --size \S+', '', line)
    elif command == 'profile' and 'size=' not in line:
        more += ' --size 48x36'
    if command == 'view':
        line = re.sub(r'--frames \S+', '', line)
    if command == 'ladder' and '--rungs' not in line + more:
        more += ' --rungs paper'
    if command == 'render' and '--samples' not in line and '--quality' not in line:
        more += ' --samples 1'
    if more and command != 'view':
        more += ' ' + ' '.join(QUICK)
    if 'before.json' in line:
        more = more.replace('--runs 2', BASELINE_RUNS)
    before, to, after = line.partition(' > ')
    return f'{before} {more}{to}{after}'


def tetrahedron():
    """JSON and bytes of a glTF file with one glassy part, which moves, and one around it."""
    points = [(-1, -1, -1), (1, 1, -1), (1, -1, 1), (-1, 1, 1)]
    data = b''.join(struct.pack('<3f', *p) for p in points)
    data += struct.pack('<12H', 0, 1, 2, 0, 2, 3, 0, 3, 1, 1, 3, 2)
    data += struct.pack('<8f', 0, 2, 0, 0, 0, 0, 1, 0)
    mesh = {'attributes': {'POSITION': 0}, 'indices': 1}
    return {
        'asset': {'version': '2.0'}, 'scene': 0, 'scenes': [{'nodes': [0, 1]}],
        'nodes': [{'mesh': 0, 'name': 'Cup'},
                  {'mesh': 1, 'translation': [0, -4, 0], 'scale': [3, 1, 3]}],
        'meshes': [{'primitives': [{**mesh, 'material': 0}]}, {'primitives': [mesh]}],
        'materials': [{'extensions': {'KHR_materials_transmission': {'transmissionFactor': 1}}}],
        'extensionsUsed': ['KHR_materials_transmission'],
        'accessors': [
            {'bufferView': 0, 'componentType': 5126, 'count': 4, 'type': 'VEC3',
             'min': [-1, -1, -1], 'max': [1, 1, 1]},
            {'bufferView': 1, 'componentType': 5123, 'count': 12, 'type': 'SCALAR'},
            {'bufferView': 2, 'componentType': 5126, 'count': 2, 'type': 'SCALAR', 'min': [0],
             'max': [2]},
            {'bufferView': 3, 'componentType': 5126, 'count': 2, 'type': 'VEC3'}],
        'animations': [{'name': 'rise', 'samplers': [{'input': 2, 'output': 3}], 'channels': [
            {'sampler': 0, 'target': {'node': 0, 'path': 'translation'}}]}],
        'bufferViews': [{'buffer': 0, 'byteLength': 48},
                        {'buffer': 0, 'byteOffset': 48, 'byteLength': 24},
                        {'buffer': 0, 'byteOffset': 72, 'byteLength': 8},
                        {'buffer': 0, 'byteOffset': 80, 'byteLength': 24}],
        'buffers': [{'byteLength': 104}],
    }, data


def write_models(folder):
    model, data = tetrahedron()
    text = json.dumps(model).encode()
    text += b' ' * (-len(text) % 4)
    chunks = struct.pack('<II', len(text), 0x4e4f534a) + text
    chunks += struct.pack('<II', len(data), 0x004e4942) + data
    (folder / 'statue.glb').write_bytes(struct.pack('<III', 0x46546c67, 2, 12 + len(chunks)) +
                                        chunks)
    model['buffers'][0]['uri'] = ('data:application/octet-stream;base64,' +
                                  base64.b64encode(data).decode())
    (folder / 'room.gltf').write_text(json.dumps(model))
    model['nodes'][1]['name'] = 'Tea'
    (folder / 'cup.gltf').write_text(json.dumps(model))
    for name in ('spot', 'teapot'):
        shutil.copy(ROOT / 'tests/data/truth/cube.obj', folder / f'{name}.obj')
    subprocess.run([sys.executable, ROOT / 'docs/recipes/models.py', folder], check=True)
    (folder / 'studio.hdr').write_bytes(b'#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 4 +X 8\n' +
                                        bytes((128, 120, 110, 129)) * 32)


class Examples(Case):
    @classmethod
    def setUpClass(cls):
        cls.display = {}
        if not NO_WINDOW:
            desktop = Desktop()
            cls.addClassCleanup(desktop.close)
            cls.display = {'DISPLAY': desktop.env['DISPLAY']}

    def setUp(self):
        """What the examples read lies there."""
        super().setUp()
        write_models(self.folder)
        small = ('--size', '48x36', *QUICK)
        self.succeed('render', 'sphere', *small, '--aov', 'exit,thickness', '-o', 'reference.exr',
                     '-o', 'before.png')
        self.succeed('profile', 'valley', *small, *SMALL['profile'].split(),
                     *BASELINE_RUNS.split(), '-q', '--json', 'before.json')
        for name in ('a', 'b', 'golden', 'ice', 'new', 'test'):
            shutil.copy(self.folder / 'reference.exr', self.folder / f'{name}.exr')
        shutil.copy(self.folder / 'before.png', self.folder / 'after.png')
        self.succeed('render', 'sphere', '--size', '16x8', '-o', 'studio.exr')
        self.succeed('render', 'sphere', '--size', '4x24', '-o', 'cube.exr')
        (self.folder / 'session-0001.firn').write_text('scene=sphere\nrung=paper\n')
        (self.folder / 'shaders').symlink_to(ROOT / 'shaders')
        (self.folder / 'FOLDER').symlink_to(ROOT / 'shaders')

    def draw_tiles(self):
        for i in range(1, 9):
            self.succeed('render', 'valley', '--size', '48x36', *QUICK, '--tiles', '4x2',
                         '--tile', i, '-o', f'tile.{i}.exr')

    def run_all(self, lines):
        if any('tile.' in line for line in lines):
            self.draw_tiles()
        for line in lines:
            if TO_BE_WRITTEN in line:
                continue
            if NO_WINDOW and line.startswith('firn view'):
                continue
            with self.subTest(line):
                small = shrink(line).replace('firn', f'"{Case.program}"', 1)
                done = subprocess.run(['sh', '-c', small], cwd=self.folder, check=False,
                                      env=environment({**self.display,
                                                       'D': str(ROOT / 'tests/data/truth')}),
                                      stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                      stderr=subprocess.PIPE, timeout=300)
                # firn profile --baseline says with 1 that something has become slower
                # and firn farm status that frames are missing
                is_asking = '--baseline' in line or line.startswith('firn farm status')
                expected = (0, 1) if is_asking else (0,)
                self.assertIn(done.returncode, expected, f'{small}: {done.stderr.decode()}')

    def pages(self):
        """What examples are on, by their names."""
        pages = {str(path.relative_to(ROOT)): path.read_text()
                 for path in (ROOT / 'README.md', *sorted((ROOT / 'docs').rglob('*.md')))}
        pages['--help'] = self.succeed('--help').stdout.decode()
        for command in COMMANDS:
            done = self.firn(command, '--help')  # none of `firn view` where that was not built
            pages[f'{command} --help'] = done.stdout.decode()
        return pages

    def test_every_page(self):
        pages = self.pages()
        lines = {name: list(examples(text)) for name, text in pages.items()}
        counts = [sum(len(lines[name]) for name in pages if name.endswith(kind))
                  for kind in ('.md', '--help')]
        self.assertGreater(counts[0], 50)
        self.assertGreater(counts[1], 20)
        once = {line: name for name in pages for line in lines[name]}  # on the last of its pages
        lines = {name: [line for line in once if once[line] == name] for name in pages}
        by_length = sorted(pages, key=lambda name: len(lines[name]))  # so that parts are alike
        self.run_all([line for name in by_length[PART - 1::PARTS] for line in lines[name]])


if __name__ == '__main__':
    main()
