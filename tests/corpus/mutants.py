"""mutants.py: runs firn on mutated valid files of all formats.

Usage: mutants.py RUNNER COUNT SEED [--trace] [--seconds=N] FILE_OR_FOLDER...

RUNNER is tests/fuzz/mutant-runner of a build with -Dfuzz=true. Models go to `firn info`; JPEG,
WebP, AVIF and every other PNG too, as the texture of a quad; other images to `firn diff`, and every
fourth to `firn graph --env`; settings to `firn graph --preset`; JSON to `firn profile --baseline`;
.cube files to `firn render --ocio`. After N seconds, or on SIGTERM, no more runs start. With
--trace, what `firn info` accepts is also rendered, 48 x 36 pixels. Prints and keeps those that end
in anything but success, or one error line with 65 or 66; that a sanitizer reports; or that need
more than a minute of CPU time. Prints the exit codes for each format. Exits with 1 if there was a
fault.
"""
import concurrent.futures
import json
import os
import pathlib
import random
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import threading

MODELS = {'.gltf', '.glb', '.obj', '.ply', '.stl'}
IMAGES = {'.exr', '.hdr', '.png'}
TEXTURES = {'.jpg', '.jpeg', '.webp', '.avif'}
SETTINGS = {'.set', '.txt'}
BASELINES = {'.json'}
TABLES = {'.cube'}
QUAD = {'asset': {'version': '2.0'}, 'scene': 0, 'scenes': [{'nodes': [0]}], 'nodes': [{'mesh': 0}],
        'meshes': [{'primitives': [{'attributes': {'POSITION': 0, 'TEXCOORD_0': 1}, 'mode': 5,
                                    'material': 0}]}],
        'materials': [{'pbrMetallicRoughness': {'baseColorTexture': {'index': 0}}}],
        'textures': [{'source': 0}],
        'buffers': [{'byteLength': 80, 'uri': 'quad.bin'}],
        'bufferViews': [{'buffer': 0, 'byteLength': 48},
                        {'buffer': 0, 'byteOffset': 48, 'byteLength': 32}],
        'accessors': [{'bufferView': 0, 'componentType': 5126, 'count': 4, 'type': 'VEC3',
                       'min': [0, 0, 0], 'max': [1, 1, 0]},
                      {'bufferView': 1, 'componentType': 5126, 'count': 4, 'type': 'VEC2'}]}
QUAD_DATA = struct.pack('<20f', 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 0, 1, 0, 0, 1, 1, 1)
CONFIG = '''ocio_profile_version: 2
roles: {default: lin_rec709, scene_linear: lin_rec709}
displays:
  Own:
    - !<View> {name: Own, colorspace: own}
colorspaces:
  - !<ColorSpace> {name: lin_rec709}
  - !<ColorSpace>
    name: own
    from_scene_reference: !<FileTransform> {src: FILE, interpolation: linear}
'''
WORDS = (0, 1, 2, 3, 4, 5, 0x7f, 0x80, 0xff, 0x100, 0x7fff, 0x8000, 0xffff, 0x10000, 0x7fffffff,
         0x80000000, 0xfffffffe, 0xffffffff, 0x7f800000, 0xff800000, 0x7fc00000, 0x7149f2ca,
         0x00000001, 0x3f800000)
VALUES = (0, -1, 1, 2, 0.5, 1e30, 1e-38, -1e38, 4294967295, 4294967296, 9007199254740993, True,
          None, '', 'data:,', [], {}, [0, 0, 0], [1e30] * 3, 5120, 5126, 'CUBICSPLINE', 'BLEND')
stop = threading.Event()  # set when no more runs start
own = threading.local()   # the runner of each thread


def change_bytes(data, pick, other):
    """Mutates bytes: flips bits, sets words, cuts, repeats or splices. Returns the result."""
    data = bytearray(data)
    for _ in range(pick.choice((1, 1, 2, 4, 16))):
        if not data:
            break
        at = pick.randrange(len(data) if pick.random() < .6 else min(len(data), 512))
        how = pick.randrange(7)
        if how == 0:
            data[at] ^= 1 << pick.randrange(8)
        elif how == 1:
            size = pick.choice((1, 2, 4, 8))
            word = pick.choice(WORDS) & (1 << 8 * size) - 1
            data[at:at + size] = word.to_bytes(size, pick.choice(('little', 'big')))
        elif how == 2:
            del data[at:at + pick.choice((1, 4, 64, len(data)))]
        elif how == 3:
            data[at:at] = data[at:at + pick.randrange(1, 65)] * pick.choice((1, 2, 100))
        elif how == 4:
            start = pick.randrange(max(1, len(other)))
            data[at:at + 64] = other[start:start + pick.randrange(1, 65)]
        elif how == 5:
            data[at] = pick.randrange(256)
        else:
            data[at:at + 4] = bytes(4)
    return bytes(data)


def places(node):
    """Returns all (container, key) pairs of a JSON document."""
    rows = node.items() if isinstance(node, dict) else enumerate(node)
    for key, value in rows:
        yield node, key
        if isinstance(value, (dict, list)):
            yield from places(value)


def change_json(document, pick):
    """Replaces, removes, copies or exchanges parts of a document."""
    for _ in range(pick.choice((1, 1, 2, 5))):
        rows = list(places(document))
        if not rows:
            break
        node, key = pick.choice(rows)
        source, source_key = pick.choice(rows)
        how = pick.randrange(5)
        if how == 0:
            node[key] = pick.choice(VALUES)
        elif how == 1:
            del node[key]
        elif how == 2:
            node[key] = json.loads(json.dumps(source[source_key]))
        elif how == 3 and isinstance(node, list):
            node.extend([node[key]] * pick.choice((1, 10, 1000)))
        elif isinstance(node[key], (int, float)) and not isinstance(node[key], bool):
            node[key] = pick.choice((node[key] + 1, node[key] - 1, -node[key], node[key] * 1000))
    return json.dumps(document).encode()


def mutate(path, pick, other):
    data = path.read_bytes()
    try:
        if path.suffix == '.gltf' and pick.random() < .8:
            return change_json(json.loads(data), pick)
        if path.suffix == '.glb' and pick.random() < .6:
            size = int.from_bytes(data[12:16], 'little')
            text = change_json(json.loads(data[20:20 + size]), pick)
            text += b' ' * (-len(text) % 4)
            rest = data[20 + size:]
            head = (b'glTF', 2, 20 + len(text) + len(rest), len(text))
            return (head[0] + b''.join(n.to_bytes(4, 'little') for n in head[1:]) + b'JSON' + text +
                    rest)
    except (ValueError, RecursionError):
        pass
    return change_bytes(data, pick, other)


def fault_of(command, folder):
    """Returns a description of a bad end of the run, or None, and the exit code."""
    messages = pathlib.Path(folder) / 'messages'
    runner = getattr(own, 'runner', None)
    if not runner:
        own.runner = runner = subprocess.Popen(command[:1], stdin=subprocess.PIPE,
                                               stdout=subprocess.PIPE, text=True)
    runner.stdin.write('\t'.join(map(str, [messages, *command[1:]])) + '\n')
    runner.stdin.flush()
    code = int(runner.stdout.readline())
    text = messages.read_bytes().decode(errors='replace')
    lines = [line for line in text.splitlines()
             if not line.startswith(('firn: note:', 'firn: warning:'))]
    wanted = 0 if code == 0 else 1
    if code in (0, 65, 66) and len(lines) == wanted and 'Sanitizer' not in text:
        return None, code
    return f'{code}: {text[:2000]}', code


def textured(image):
    """Writes a model with the image as its texture beside it. Returns its path."""
    path = image.parent / 'quad.gltf'
    path.write_text(json.dumps({**QUAD, 'images': [{'uri': image.name}]}))
    path.with_suffix('.bin').write_bytes(QUAD_DATA)
    return path


def commands(firn, mutant, turn, traces):
    is_texture = mutant.suffix in TEXTURES or mutant.suffix == '.png' and turn % 2
    if mutant.suffix in MODELS or is_texture:
        model = textured(mutant) if is_texture else mutant
        yield [firn, 'info', '--no-cache', model]
        if traces:
            yield [firn, 'render', model, '-q', '-r', 'trace', '--size', '48x36', '--samples', '1',
                   '-o', mutant.parent / 'out.exr']
    elif mutant.suffix in SETTINGS:
        yield [firn, 'graph', 'sphere', '--preset', mutant]
    elif mutant.suffix in TABLES:
        config = mutant.parent / 'config.ocio'
        config.write_text(CONFIG.replace('FILE', mutant.name))
        yield [firn, 'render', 'sphere', '-q', '--plain', '--ocio', f'{config},Own', '--size',
               '8x8', '--samples', '1', '-o', mutant.parent / 'out.png']
    elif mutant.suffix in BASELINES:
        yield [firn, 'profile', 'sphere', '--baseline', mutant]
    else:
        yield [firn, 'diff', mutant, mutant]
        if turn % 4 == 0 and mutant.suffix != '.png':
            yield [firn, 'graph', 'sphere', '--env', mutant]


def run(firn, number, seed, groups, traces, kept):
    """Runs a mutant; formats take turns. Returns the format, a description of a fault, the code, or
    None after a stop."""
    if stop.is_set():
        return None
    pick = random.Random(f'{seed} {number}')
    path = pick.choice(groups[number % len(groups)])
    other = pick.choice(pick.choice(groups))
    with tempfile.TemporaryDirectory() as folder:
        text = path.read_bytes()
        for beside in path.parent.iterdir() if path.suffix in ('.gltf', '.obj') else ():
            if beside.is_file() and beside.name.encode() in text:  # readers follow no link
                shutil.copy(beside, folder)
        mutant = pathlib.Path(folder) / f'mutant{path.suffix}'
        mutant.write_bytes(mutate(path, pick, other.read_bytes()))
        code = None
        for command in commands(firn, mutant, number // len(groups), traces):
            fault, code = fault_of(command, folder)
            if fault and stop.is_set() and code == -signal.SIGTERM:
                return None  # the signal went to the whole process group
            if fault:
                shutil.copy(mutant, kept / f'{seed}-{number}{path.suffix}')
                return path.suffix, f'{path.name} ({seed} {number}): {command[1]}: {fault}', code
            if code:
                break
    return path.suffix, None, code


def main():
    words = [word for word in sys.argv[1:] if not word.startswith('--')]
    seconds = [float(word[10:]) for word in sys.argv if word.startswith('--seconds=')]
    firn, count, seed = words[0], int(words[1]), words[2]
    files = [path for word in map(pathlib.Path, words[3:])
             for path in (sorted(word.rglob('*')) if word.is_dir() else [word])
             if path.suffix in MODELS | IMAGES | TEXTURES | SETTINGS | BASELINES | TABLES and
             0 < path.stat().st_size < 1 << 20]
    suffixes = sorted({path.suffix for path in files})
    groups = [[path for path in files if path.suffix == suffix] for suffix in suffixes]
    kept = pathlib.Path(f'mutants-{seed}')
    kept.mkdir(exist_ok=True)
    signal.signal(signal.SIGTERM, lambda *_: stop.set())
    for limit_s in seconds:
        timer = threading.Timer(limit_s, stop.set)
        timer.daemon = True
        timer.start()
    codes, faults = {}, 0  # number of runs for each pair of format and exit code
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        jobs = [pool.submit(run, firn, number, seed, groups, '--trace' in sys.argv, kept)
                for number in range(count)]
        for job in concurrent.futures.as_completed(jobs):
            if not job.result():
                continue
            suffix, fault, code = job.result()
            codes[suffix, code] = codes.get((suffix, code), 0) + 1
            if fault:
                faults += 1
                print(fault, flush=True)
    for suffix in suffixes:
        rows = {code: n for (of, code), n in sorted(codes.items(), key=str) if of == suffix}
        print(f'{suffix[1:]}: {sum(rows.values())}, exit codes {rows}')
    print(f'{sum(codes.values())} of {count} mutants of {len(files)} files, {faults} faults')
    return 1 if faults else 0


if __name__ == '__main__':
    sys.exit(main())
