"""make_corpus.py: makes malformed files, each with one fault. Usage: make_corpus.py FOLDER

corpus() lists them. All files are made here, and their bytes are always the same.
"""
import functools
import itertools
import pathlib
import sys

sys.dont_write_bytecode = True  # the source tree stays clean
import models  # noqa: E402
import models_more  # noqa: E402
import pictures  # noqa: E402
import presets  # noqa: E402
from builders import Entry  # noqa: E402

# What a file is given to: by what it is, or by its suffix.
MODEL, SURROUNDINGS, ENVIRONMENT = 'model', 'surroundings', 'environment'
DIFF, MERGE, BASELINE, PRESET = 'diff', 'merge', 'baseline', 'preset'
BY_SUFFIX = {'exr': ENVIRONMENT, 'hdr': ENVIRONMENT, 'png': DIFF, 'json': BASELINE,
             'txt': PRESET}

KINDS = {
    'cut short': models.truncated,
    'flipped bits': models.bit_flips,
    'wrong lengths': models.lengths,
    'indices out of range': models.indices,
    'numbers: not finite, too large': models.numbers,
    'nodes: 100 000 deep, in cycles': models.trees,
    'huge counts': models.counts,
    'URIs that lead elsewhere': models.uris,
    'bad base64': models.base64_text,
    'empty': models.empty,
    'shapes: degenerate, non-manifold': models.shapes,
    'names and types': models.names,
    'textures': models.textures,
    'colours: 3e38, 1e-45, negative': models_more.colors,
    'glTF: accessors': models_more.accessors,
    'glTF: skins, animations, images': models_more.references,
    'GLB: chunks': models_more.chunks,
    'OBJ, MTL: lines': models_more.obj_lines,
    'PLY: headers': models_more.ply_headers,
    'STL: facets, lines': models_more.stl_facets,
    'EXR: gigantic windows': pictures.windows,
    'EXR: parts, tiles, attributes': pictures.parts,
    'HDR: bad runs': pictures.runs,
    'PNG: bombs, chunks (`diff`)': pictures.chunks,
    'tiles (`merge`)': pictures.tiles,
    'profiles (`profile --baseline`)': pictures.profiles,
    'settings (`graph --preset`)': presets.presets,
}

# What the suffix says is not what the first bytes say.
OTHER_FORMATS = 'content of another format'


def use_of(kind, name):
    if kind.startswith('colours'):
        return SURROUNDINGS
    return MERGE if 'merge' in kind else BY_SUFFIX.get(name.rsplit('.', 1)[1], MODEL)


@functools.cache
def corpus():
    entries = [Entry(kind, use_of(kind, values[0]), *values)
               for kind, make in KINDS.items() for values in make()]
    for name, content, wanted in itertools.chain(models_more.other_formats(),
                                                 pictures.other_formats()):
        entries.append(Entry(OTHER_FORMATS, use_of('', name), name, content, wanted))
    return tuple(entries)


def write(entry, folder):
    """The path of the file to read."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, content in entry.others:
        (folder / name).write_bytes(content)
    (folder / entry.name).write_bytes(entry.content)
    return folder / entry.name


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    kinds = list(dict.fromkeys(entry.kind for entry in corpus()))
    for entry in corpus():
        write(entry, pathlib.Path(sys.argv[1]) / str(kinds.index(entry.kind)))


if __name__ == '__main__':
    main()
