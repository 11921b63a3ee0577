"""shared_structs.py: writes the structs of headers that C and GLSL share as rows of a C table.

Usage: shared_structs.py FOLDER HEADERS STRUCTS
Reads all headers below the folder. Writes lines that include those with structs, and the rows:
{ "name", sizeof(struct name), { { "member", offset, size }, ... } },
"""
import pathlib
import re
import sys


def members(body):
    """Yields the names of a struct's members, in order."""
    body = re.sub(r'/\*.*?\*/|//[^\n]*', '', body, flags=re.S)
    for declaration in body.split(';'):
        words = declaration.strip()
        if words:
            words = re.sub(r'^(ABI_STRUCT\(\w+\)|struct \w+|\w+)\s+', '', words)
            for name in words.split(','):
                yield re.match(r'\s*(\w+)', name)[1]


def write(path, lines):
    """Writes a file only if its content changes, so that dependants are not rebuilt."""
    text = ''.join(lines)
    path = pathlib.Path(path)
    if not path.exists() or path.read_text(encoding='utf-8') != text:
        path.write_text(text, encoding='utf-8')


def main():
    includes, rows = [], []
    root = pathlib.Path(sys.argv[1])
    for header in sorted(root.rglob('*.h')):
        text = header.read_text(encoding='utf-8')
        structs = re.findall(r'^struct (\w+) \{\n(.*?)^\};', text, re.S | re.M)
        includes += [f'#include "shaders/{header.relative_to(root)}"\n'] if structs else []
        for name, body in structs:
            fields = ', '.join(f'{{ "{m}", offsetof(struct {name}, {m}), '
                               f'sizeof(((struct {name} *)0)->{m}) }}' for m in members(body))
            rows.append(f'{{ "{name}", sizeof(struct {name}), {{ {fields} }} }},\n')
    write(sys.argv[2], includes)
    write(sys.argv[3], rows)


main()
