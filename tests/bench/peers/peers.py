"""peers.py FIRN --three FOLDER: frames of firn and of three.js, drawn in turn; see README.md.

Exits 77, with one line, where Chromium, Node or three.js are missing.
"""
import argparse
import json
import pathlib
import shutil
import statistics
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).parent
DATA = HERE.parents[1] / 'data' / 'truth'
SIZE = (1024, 768)
EYES = {
    'fifth': (1.0526181704997268, 0.9263039900397595, 4.210472681998907),
    'full': (0.44117964765103773, 0.3882380899329132, 1.764718590604151),
}
PLAIN = ['air.count=0', 'cracks.count=0', 'bubbles.count=0', 'bump.strength=0', 'light.count=0']
WHOLE = ['bubbles.count=0', 'cracks.clip=convex', 'cracks.count=2', 'texture.anisotropy=1']
# name: (camera, rung, settings), and of which peers, at most so much of their time, is wanted
FIRN = {
    'whole paper': ('fifth', 'paper', WHOLE, {'envmap': 0.9, 'paper': 0.6}),
    'paper': ('fifth', 'paper', PLAIN, {'paper': None}),
    'bounce': ('fifth', 'bounce', PLAIN, {'physical': 0.7}),
    'paper, full': ('full', 'paper', PLAIN, {'paper': 0.8}),
}
PAGE = '''<!DOCTYPE html><meta charset="utf-8"><body><script>window.SCENE = %s;</script>
<script type="importmap">{"imports": {"three": "%s"}}</script>
<script type="module" src="%s"></script></body>
'''
CHROMIUM = ['--headless=new', '--no-sandbox', '--allow-file-access-from-files', '--use-gl=angle',
            '--use-angle=gl-egl', '--ignore-gpu-blocklist', '--disable-gpu-watchdog',
            '--no-first-run', '--disable-background-networking', '--timeout=120000', '--dump-dom']


def skip(what):
    print(f'peers.py: {what}, so there is nothing to compare with: see README.md beside it')
    sys.exit(77)


def time_three(chromium, module, material, camera, folder):
    """milliseconds of frames, and who drew them"""
    scene = {'object': (DATA / 'cube.obj').read_text(), 'eye': EYES[camera], 'size': SIZE,
             'landscape': (DATA / 'landscape.obj').read_text(), 'material': material}
    page = folder / 'page.html'
    page.write_text(PAGE % (json.dumps(scene), module.as_uri(), (HERE / 'three.mjs').as_uri()))
    environment = {'LIBGL_ALWAYS_SOFTWARE': '1', 'GALLIUM_DRIVER': 'llvmpipe',
                   'HOME': str(folder), 'PATH': '/usr/bin:/bin'}
    dom = subprocess.run([chromium, *CHROMIUM, f'--user-data-dir={folder}/profile',
                          page.as_uri()], env=environment, stdout=subprocess.PIPE,
                         stderr=subprocess.DEVNULL, text=True, timeout=300).stdout
    found = dom[dom.find('{"'):dom.rfind('}') + 1]
    result = json.loads(found) if found else {'error': 'the page shows nothing'}
    if 'error' in result:
        sys.exit(f'peers.py: three-{material}: {result["error"]}')
    return result['times'], f'three.js r{result["version"]}, {result["renderer"]}'


def time_firn(firn, camera, rung, settings):
    command = [firn, 'profile', DATA / 'cube.obj', '--surroundings', DATA / 'landscape.obj',
               '--background', '0.75,0.8,0.88', '--eye', ','.join(map(str, EYES[camera])),
               '--target', '0,0,0', '--size', '%dx%d' % SIZE, '-r', rung, '-q', '--json', '-']
    for setting in settings:
        command += ['--set', setting]
    text = subprocess.run(command, check=True, stdout=subprocess.PIPE).stdout
    return json.loads(text)['plain']['ms']


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('firn')
    parser.add_argument('--three', type=pathlib.Path, default=pathlib.Path('node_modules/three'),
                        help='folder of three.js (node_modules/three)')
    parser.add_argument('--rounds', type=int, default=3)
    options = parser.parse_args()
    chromium = shutil.which('chromium')
    module = (options.three / 'build' / 'three.module.js').resolve()
    if not chromium:
        skip('there is no chromium')
    if not module.is_file():
        skip(f'{module} is missing')
    peers = sorted({(camera, peer) for camera, _, _, wanted in FIRN.values() for peer in wanted})
    ours = {name: [] for name in FIRN}
    theirs = {peer: [] for peer in peers}
    who = ''
    with tempfile.TemporaryDirectory() as folder:
        for _ in range(options.rounds):
            for name, (camera, rung, settings, _) in FIRN.items():
                ours[name] += time_firn(options.firn, camera, rung, settings)
            for camera, peer in peers:
                times, who = time_three(chromium, module, peer, camera, pathlib.Path(folder))
                theirs[camera, peer] += times
    print(f'{who}\nmilliseconds a frame, medians of {options.rounds} rounds in turn\n')
    for name, (camera, _, _, wanted) in FIRN.items():
        mine = statistics.median(ours[name])
        for peer, most in wanted.items():
            other = statistics.median(theirs[camera, peer])
            goal = f', wanted {most}' if most else ''
            print(f'{name:12} {mine:7.1f}   three-{peer:9} {other:7.1f}   '
                  f'ratio {mine / other:5.2f}{goal}')


main()
