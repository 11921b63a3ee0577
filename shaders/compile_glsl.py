"""compile_glsl.py: compiles many GLSL files to SPIR-V with a single glslc process.

One process for all files is faster: starting glslc takes ten times as long as compiling a shader.

Usage: compile_glsl.py DEPFILE GLSLC WORD... -- SOURCE... -- MODULE...   WORD: argument of glslc
"""
import pathlib
import subprocess
import sys
import tempfile

first, second = (i for i, word in enumerate(sys.argv) if word == '--')
depfile, *command = sys.argv[1:first]
sources = [pathlib.Path(source).resolve() for source in sys.argv[first + 1:second]]
modules = [pathlib.Path(module).resolve() for module in sys.argv[second + 1:]]
included = set()
with tempfile.TemporaryDirectory(dir=modules[0].parent) as folder:
    done = subprocess.run([*command, '-MD', '-c', *sources], cwd=folder)
    if done.returncode:
        sys.exit(done.returncode)
    for source, module in zip(sources, modules):
        compiled = pathlib.Path(folder) / f'{source.name}.spv'
        rule = compiled.with_suffix('.spv.d').read_text(encoding='utf-8')
        included.update('/' + path for path in rule.rstrip().split(' /')[1:])  # all absolute
        compiled.replace(module)
names = ' '.join(path.replace(' ', '\\ ') for path in sorted(included))
pathlib.Path(depfile).write_text(f'{sys.argv[second + 1]}: {names}\n', encoding='utf-8')
