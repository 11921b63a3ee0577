"""make_seeds.py: makes files to begin with for each fuzzer. Usage: make_seeds.py FOLDER

Those of the fuzzer NAME are in FOLDER/NAME. Files of readers are those of tests/corpus, sound ones
and malformed ones.
"""
import pathlib
import struct
import sys

sys.dont_write_bytecode = True  # the source tree stays clean
sys.path.append(str(pathlib.Path(__file__).parents[1] / 'corpus'))
from builders import (  # noqa: E402
    AVIF, WEBP, glb, gltf, hdr, hdr_line, obj, ply, png, stl, stl_text, tent, textured)
from make_corpus import corpus  # noqa: E402
from pictures import profile, tile  # noqa: E402

SIZE_MAX = 4096  # bytes
SLOW = 'nodes: 100 000 deep, in cycles', 'huge counts'
READERS = {'exr': 'exr', 'hdr': 'hdr', 'png': 'png', 'json': 'profile_json', 'txt': 'preset',
           'glb': 'model', 'gltf': 'model', 'obj': 'model', 'ply': 'model', 'stl': 'model'}
TEXTS = {
    'camera': ('eye 1,2,3\ntarget 0,0,0\nfov 45\nsize 64x48', 'orbit 10,-20,5e3\ntarget 1,1,1'),
    'frame_range': ('1-9x2,-4--2,20',),
    'model_pipe': (),
    'session': ('scene=a%20b.glb\nenv=alps\nenv-rotate=-35.5\nrung=bounce\n'
                'time=3.25\ncamera=1,2,3,0,0.5,0,0,1,0,40,0,0\ncracks.count=5',),
    'settings': ('tonemap.curve=neutral', 'refract_paper.back_weight=0.5'),
}


def beside(text, content):
    """A model that names the file `beside`, and this."""
    return text + b'\0' + content


def spirv(*instructions):
    """A module of the instructions, tuples of an opcode and operands; `main` is of each stage."""
    entries = [(15, model, 1, 0x6e69616d, 0, 2, 3, 4) for model in (0, 4, 5)]
    words = [0x07230203, 0x10600, 0, 32, 0]
    for op, *operands in (*entries, *instructions, (54, 10, 1, 0, 11), (61, 12, 13, 2),
                          (61, 12, 20, 3), (61, 12, 21, 4), (56,)):
        words += [(len(operands) + 1) << 16 | op, *operands]
    return struct.pack(f'<{len(words)}I', *words)


def seeds_of_shaders():
    """A byte for the stage, and code with push constants, an array of images, an input."""
    interface = ((5, 3, 0x70), (71, 3, 33, 0), (71, 3, 34, 0), (71, 4, 30, 0), (72, 6, 0, 35, 4),
                 (71, 9, 1, 3), (22, 5, 32), (30, 6, 5), (32, 7, 9, 6), (59, 7, 2, 9),
                 (21, 8, 32, 0), (50, 8, 9, 2), (25, 14, 5, 1, 0, 0, 0, 1, 0), (27, 15, 14),
                 (28, 16, 15, 9), (32, 17, 0, 16), (59, 17, 3, 0), (23, 18, 5, 4),
                 (32, 19, 1, 18), (59, 19, 4, 1))
    for stage in range(3):
        yield bytes([stage]) + spirv(*interface)


def seeds():
    """Pairs of a fuzzer's name and bytes."""
    for name, texts in TEXTS.items():
        yield name, b''
        for text in texts:
            yield name, text.encode()
    for number in range(64):  # the random graphs themselves
        yield 'rg_compile', bytes([number])
    yield from (('rg_shaders', content) for content in seeds_of_shaders())
    for entry in corpus():
        if len(entry.content) <= SIZE_MAX and entry.kind not in SLOW:
            yield READERS[entry.name.rsplit('.', 1)[1]], entry.content
    for kind in range(8):
        yield 'reader_protocol', bytes([kind, 3, 20]) + b'firn: warning: x\nfirn'
    yield 'shell_quote', b"#it's a=b $(c)"
    yield 'bvh', bytes((*range(20), 8, 4, 0, 0, 3, 0, 0, 4, 0, 0))
    yield 'profile_json', profile()
    yield 'exr', tile(b'1 of 1x1 interleaved')
    yield 'hdr', hdr(hdr_line(16, b'\x90\x80') * 8)
    yield 'png', png(4, 4)
    yield from (('model', content) for content in (glb(), ply(), obj(), stl(), stl_text()))
    yield 'model', beside(gltf('beside'), tent()[0])
    yield 'model', beside(obj('mtllib beside\nusemtl a\n'), b'newmtl a\nKd 1 0.5 0\n')
    yield 'model', beside(gltf('beside', textured('beside')), png(4, 4))
    yield 'model', beside(gltf('beside', textured('beside')), WEBP)
    yield 'model', beside(gltf('beside', textured('beside')), AVIF)


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    for number, (name, content) in enumerate(seeds()):
        folder = pathlib.Path(sys.argv[1]) / name
        folder.mkdir(parents=True, exist_ok=True)
        (folder / str(number)).write_bytes(content)


if __name__ == '__main__':
    main()
