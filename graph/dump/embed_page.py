"""embed_page.py: embeds an ASCII page in a C file as two strings: before and after @PLAN@.

Usage: embed_page.py PAGE C_FILE
"""
import pathlib
import sys

parts = pathlib.Path(sys.argv[1]).read_bytes().split(b'@PLAN@')
source = '#include "graph/dump/dump_internal.h"\n'
for name, part in zip(('begin', 'end'), parts, strict=True):
    # a list of numbers, because string literals may have only 4095 characters
    numbers = ', '.join(str(byte) for byte in part)
    source += f'const char rg_dump_page_{name}[] = {{ {numbers}, 0 }};\n'
pathlib.Path(sys.argv[2]).write_text(source, encoding='ascii')
