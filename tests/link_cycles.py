"""link_cycles.py: no file calls, through others, one that calls it. Usage: link_cycles.py BUILD

Reads the symbols of all object files of BUILD with nm, and looks for strongly connected components
of files (Tarjan 1972). Pairs that are allowed are listed with their reason."""
import collections
import json
import os
import pathlib
import subprocess
import sys

# Files that call each other.
ALLOWED = (
    # a buffer view is decompressed from the bytes of another buffer view
    {'src/scene/import/gltf/gltf_accessor.c', 'src/scene/import/gltf/gltf_meshopt.c'},
    # two models of where bubbles are, which share the test of a bubble's distance from the surface
    {'src/scene/generate/bubble_placement.c', 'src/scene/generate/frozen_bubbles.c'},
    # samples are added to the sums that are denoised; both are read back in the same way
    {'src/render/renderer_denoise.c', 'src/render/renderer_sample.c'},
    # `auto` settings of all refraction models are those of the paper for the paper's model
    {'src/tech/refract/refract.c', 'src/tech/refract/refract_paper.c'},
)


def objects(build):
    """Yields each compiled file of the product, relative to the root, and its object file."""
    root = pathlib.Path(__file__).resolve().parents[1]
    for row in json.loads((build / 'compile_commands.json').read_text()):
        path = os.path.relpath(os.path.join(row['directory'], row['file']), root)
        if path.startswith(('src/', 'graph/')) and (build / row['output']).exists():
            yield path, build / row['output']


def calls(build):
    """Returns a dictionary: the files whose symbols each file uses."""
    paths = {str(file): path for path, file in objects(build)}
    defined, used = {}, collections.defaultdict(set)
    for line in subprocess.run(['nm', '-A', '-g', '-P', *paths], capture_output=True, text=True,
                               check=True).stdout.splitlines():
        file, name, kind = line.split()[:3]
        path = paths[file.rstrip(':')]
        if kind == 'U':
            used[path].add(name)
        else:
            defined.setdefault(name, path)
    return {path: {defined[name] for name in names if name in defined} - {path}
            for path, names in used.items()}


def components(graph):
    """Yields the strongly connected components of more than one node."""
    index, low, stack = {}, {}, []

    def visit(node):
        index[node] = low[node] = len(index)
        stack.append(node)
        for other in graph.get(node, ()):
            if other not in index:
                yield from visit(other)
            if other in stack:
                low[node] = min(low[node], low[other])
        if low[node] == index[node]:
            at = stack.index(node)
            found = set(stack[at:])
            del stack[at:]
            if len(found) > 1:
                yield found

    for node in graph:
        if node not in index:
            yield from visit(node)


def self_test():
    made = {'a': {'b'}, 'b': {'c', 'd'}, 'c': {'a'}, 'd': {'e'}, 'e': set()}
    assert list(components(made)) == [{'a', 'b', 'c'}], 'a circle of three is found'


def main():
    self_test()
    sys.setrecursionlimit(10000)
    graph = calls(pathlib.Path(sys.argv[1]))
    assert len(graph) > 200, 'the objects of a build'
    found = list(components(graph))
    for files in found:
        if files not in ALLOWED:
            print('these files call each other in a circle:', ', '.join(sorted(files)))
    for files in ALLOWED:
        if files not in found:
            print('no longer a circle, so it needs no exception:', ', '.join(sorted(files)))
    return any(files not in ALLOWED for files in found) or any(f not in found for f in ALLOWED)


sys.exit(main())
