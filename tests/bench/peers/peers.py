"""peers.py FIRN [--modules FOLDER]: frames of firn and of others, drawn in turn; see README.md.

Exits 77, with one line, where Chromium or all of the others are missing.
"""
import argparse
import base64
import json
import os
import pathlib
import shutil
import statistics
import subprocess
import sys
import tempfile
import time

sys.dont_write_bytecode = True  # the source tree stays clean
import page  # noqa: E402

DATA = page.HERE.parents[1] / 'data' / 'truth'
SIZE = (1024, 768)
START_SIZE = (256, 256)
START_PEER = 'three-paper'
EYES = {
    'fifth': (1.0526181704997268, 0.9263039900397595, 4.210472681998907),
    'full': (0.44117964765103773, 0.3882380899329132, 1.764718590604151),
}
PRINTED = ['refract.fresnel=paper', 'refract.lookup=infinite', 'env_cube.size=512']
PLAIN = [*PRINTED, 'air.count=0', 'cracks.count=0', 'bubbles.count=0', 'bump.strength=0',
         'light.count=0']
WHOLE = [*PRINTED, 'bubbles.count=0', 'cracks.clip=convex', 'cracks.count=2',
         'texture.anisotropy=1']
# name: (camera, rung, settings), and of which peers, at most so much of their time, is wanted
SCENES = {
    'whole paper': ('fifth', 'paper', WHOLE, {'three-envmap': 0.9, 'three-paper': 0.6}),
    'paper': ('fifth', 'paper', PLAIN, {'three-paper': None}),
    'bounce': ('fifth', 'bounce', PLAIN, {'three-physical': 0.7, 'babylon-refraction': None,
                                          'babylon-transmission': None, 'filament-ssr': 0.2}),
    'paper, full': ('full', 'paper', PLAIN, {'three-paper': 0.8}),
}
# The cube is drawn anew in every frame, as the others draw it; or, as firn does unasked, kept.
CUBES = {', cube anew': ['env_cube.always=on'], ', cube kept': []}
FIRN = {name + cube: (camera, rung, settings + more, wanted)
        for name, (camera, rung, settings, wanted) in SCENES.items()
        for cube, more in CUBES.items()}


def skip(what):
    print(f'peers.py: {what}, so there is nothing to compare with: see README.md beside it')
    sys.exit(77)


def scene_of(peer, camera, size, picture):
    return {'object': (DATA / 'cube.obj').read_text(), 'eye': EYES[camera], 'size': size,
            'landscape': (DATA / 'landscape.obj').read_text(), 'picture': picture,
            'material': peer.split('-', 1)[1]}


def draw_peer(options, peer, camera, folder):
    """what its page posts at the end"""
    scene = scene_of(peer, camera, SIZE, bool(options.pictures))
    result = page.show(options.chromium, options.modules, peer, scene, folder)[1]
    if options.pictures:
        path = options.pictures / f'{peer}-{camera}.png'
        path.write_bytes(base64.b64decode(result['picture'].split(',')[1]))
    return result


def draw_firn(options, camera, rung, settings):
    """milliseconds of frames"""
    command = [options.firn, 'profile', DATA / 'cube.obj', '--surroundings', DATA / 'landscape.obj',
               '--background', '0.75,0.8,0.88', '--eye', ','.join(map(str, EYES[camera])),
               '--target', '0,0,0', '--size', '%dx%d' % SIZE, '-r', rung, '-q', '--json', '-']
    for setting in settings:
        command += ['--set', setting]
    text = subprocess.run(command, check=True, stdout=subprocess.PIPE).stdout
    return json.loads(text)['plain']['ms']


def compare_frames(options, folder):
    pairs = sorted({(camera, peer) for camera, _, _, wanted in FIRN.values() for peer in wanted
                    if peer.split('-')[0] in options.engines})
    ours = {name: [] for name in FIRN}
    theirs = {pair: [] for pair in pairs}
    who = {}
    for _ in range(options.rounds):
        for name, (camera, rung, settings, _) in FIRN.items():
            ours[name] += draw_firn(options, camera, rung, settings)
        for camera, peer in pairs:
            result = draw_peer(options, peer, camera, folder)
            theirs[camera, peer] += result['times']
            who[result['version']] = result['renderer']
    for version, renderer in who.items():
        print(f'{version}: {renderer}')
    print(f'milliseconds a frame, medians of {options.rounds} rounds in turn\n')
    for name, (camera, _, _, wanted) in FIRN.items():
        mine = statistics.median(ours[name])
        for peer, most in wanted.items():
            if (camera, peer) not in theirs:
                continue
            other = statistics.median(theirs[camera, peer])
            goal = f', wanted {most}' if most else ''
            print(f'{name:23} {mine:7.1f}   {peer:20} {other:7.1f}   '
                  f'ratio {mine / other:5.2f}{goal}')


def start_firn(options, folder):
    """seconds from exec until the picture is there, which it is as a whole or not at all"""
    environment = {**os.environ, 'XDG_CACHE_HOME': str(folder / 'cache')}
    environment.pop('MESA_SHADER_CACHE_DIR', None)
    picture = folder / 'sphere.exr'
    picture.unlink(missing_ok=True)
    command = [options.firn, 'render', 'sphere', '--size', '%dx%d' % START_SIZE, '-q',
               '-o', picture]
    begin = time.monotonic()
    with subprocess.Popen(command, env=environment) as program:
        while not picture.exists():
            if program.poll() is not None:
                sys.exit(f'peers.py: firn ends with {program.returncode} and draws nothing')
            time.sleep(0.001)
        end = time.monotonic()
    return end - begin


def start_peer(options, folder):
    """seconds from exec of Chromium until its page has finished the first image"""
    scene = scene_of(START_PEER, 'fifth', START_SIZE, False)
    return page.show(options.chromium, options.modules, START_PEER, scene, folder)[0]


def compare_starts(options):
    """Each cold, without caches, then warm, with those that it has left."""
    seconds = {(who, how): [] for who in (start_firn, start_peer) for how in ('cold', 'warm')}
    for _ in range(options.rounds):
        for who in (start_firn, start_peer):
            with tempfile.TemporaryDirectory() as folder:
                for how in ('cold', 'warm'):
                    seconds[who, how].append(who(options, pathlib.Path(folder)))
    print(f'seconds until the first picture of {START_SIZE[0]} x {START_SIZE[1]}, medians of '
          f'{options.rounds} rounds in turn\n')
    for how, goal in (('cold', ', wanted 0.5'), ('warm', '')):
        mine = statistics.median(seconds[start_firn, how])
        other = statistics.median(seconds[start_peer, how])
        print(f'{how}: firn {mine:.2f}   {START_PEER} {other:.2f}   '
              f'ratio {mine / other:.2f}{goal}')


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('firn')
    parser.add_argument('--modules', type=pathlib.Path, default=pathlib.Path('node_modules'),
                        help='where npm has put the others (node_modules)')
    parser.add_argument('--rounds', type=int, default=0, help='3, of starts 9')
    parser.add_argument('--start', action='store_true',
                        help='the time until the first picture instead of frames')
    parser.add_argument('--pictures', type=pathlib.Path, metavar='FOLDER',
                        help='leaves what the others have drawn there')
    options = parser.parse_args()
    options.chromium = shutil.which('chromium')
    options.rounds = options.rounds or (9 if options.start else 3)
    options.engines = [name for name, files in page.ENGINES.items()
                       if (options.modules / files[0]).is_file()]
    if not options.chromium:
        skip('there is no chromium')
    for name in page.ENGINES.keys() - set(options.engines):
        print(f'peers.py: {options.modules / page.ENGINES[name][0]} is missing: without {name}')
    if not options.engines or options.start and 'three' not in options.engines:
        skip('none of them is here' if not options.engines else 'three.js is missing')
    if options.pictures:
        options.pictures.mkdir(parents=True, exist_ok=True)
    if options.start:
        compare_starts(options)
        return
    with tempfile.TemporaryDirectory() as folder:
        compare_frames(options, pathlib.Path(folder))


main()
