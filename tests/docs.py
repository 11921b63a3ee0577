"""docs.py: the program in docs/render-graph.md compiles against the library and runs.

Usage: docs.py ROOT LIBRARY
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile

root, library = map(pathlib.Path, sys.argv[1:])
text = (root / 'docs' / 'render-graph.md').read_text(encoding='utf-8')
program, = re.findall(r'```c\n(.*?)```', text, re.S)
barriers, batches = re.search(r'(\d+) barriers in (\d+) batches', text).groups()

with tempfile.TemporaryDirectory() as folder:
    source = pathlib.Path(folder) / 'example.c'
    source.write_text(program, encoding='utf-8')
    binary = source.with_suffix('')
    compiler = os.environ.get('CC', 'cc').split()
    flags = ['-std=c17', '-Wall', '-Wextra', '-Wpedantic', '-Werror',
             '-Wno-missing-field-initializers']  # tables leave out what is zero
    subprocess.run([*compiler, *flags, f'-I{root}', '-o', binary, source, library, '-lm'],
                   check=True)
    printed = subprocess.run([binary], check=True, capture_output=True, text=True).stdout

expected = f'barriers: {barriers} in {batches} batches'
if expected not in printed:
    sys.exit(f'the program does not print "{expected}" but:\n{printed}')
