"""make_seeds.py: makes files to begin with for each fuzzer. Usage: make_seeds.py FOLDER

Those of the fuzzer NAME are in FOLDER/NAME. Files of readers are those of tests/corpus, sound ones
and malformed ones.
"""
import pathlib
import sys

sys.dont_write_bytecode = True  # the source tree stays clean
sys.path.append(str(pathlib.Path(__file__).parents[1] / 'corpus'))
from builders import glb, gltf, hdr, hdr_line, obj, ply, png, tent, textured  # noqa: E402
from make_corpus import corpus  # noqa: E402
from pictures import profile, tile  # noqa: E402

SIZE_MAX = 4096  # bytes
SLOW = 'nodes: 100 000 deep, in circles', 'huge counts'
READERS = {'exr': 'exr', 'hdr': 'hdr', 'png': 'png', 'json': 'profile_json', 'txt': 'preset',
           'glb': 'model', 'gltf': 'model', 'obj': 'model', 'ply': 'model'}
TEXTS = {
    'camera': ('eye 1,2,3\ntarget 0,0,0\nfov 45\nsize 64x48', 'orbit 10,-20,5e3\ntarget 1,1,1'),
    'frame_range': ('1-9x2,-4--2,20',),
    'mesh_pipe': (),
    'settings': ('tonemap.curve=neutral', 'refract_paper.a=0.5'),
}


def beside(text, content):
    """A model that names the file `beside`, and this."""
    return text + b'\0' + content


def seeds():
    """Pairs of a fuzzer's name and bytes."""
    for name, texts in TEXTS.items():
        yield name, b''
        for text in texts:
            yield name, text.encode()
    for number in range(64):  # the random graphs themselves
        yield 'rg_compile', bytes([number])
    for entry in corpus():
        if len(entry.content) <= SIZE_MAX and entry.kind not in SLOW:
            yield READERS[entry.name.rsplit('.', 1)[1]], entry.content
    yield 'profile_json', profile()
    yield 'exr', tile(b'1 of 1x1 interleaved')
    yield 'hdr', hdr(hdr_line(16, b'\x90\x80') * 8)
    yield 'png', png(4, 4)
    yield from (('model', content) for content in (glb(), ply(), obj()))
    yield 'model', beside(gltf('beside'), tent()[0])
    yield 'model', beside(obj('mtllib beside\nusemtl a\n'), b'newmtl a\nKd 1 0.5 0\n')
    yield 'model', beside(gltf('beside', textured('beside')), png(4, 4))


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    for number, (name, content) in enumerate(seeds()):
        folder = pathlib.Path(sys.argv[1]) / name
        folder.mkdir(parents=True, exist_ok=True)
        (folder / str(number)).write_bytes(content)


if __name__ == '__main__':
    main()
