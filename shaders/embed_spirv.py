"""embed_spirv.py: embeds SPIR-V files in a C file as `const struct rg_shader`; writes its header.

The assembler includes the binary modules, because a C array would have half a million numbers.

Usage: embed_spirv.py C_FILE HEADER MODULE... [-- ORIGIN...]

Shaders are named like their files, with '_' for '.'. <stem>_all lists them and ends at NULL.
<stem>_origins lists their sources in the same order. ORIGIN is a GLSL file and its compiler flags,
separated by spaces.
"""
import hashlib
import pathlib
import sys


def write(path, text):
    """Writes a file unless it is unchanged, so that its dependents are not rebuilt."""
    file = pathlib.Path(path)
    if not file.exists() or file.read_text(encoding='utf-8') != text:
        file.write_text(text, encoding='utf-8')


# The read-only data section of ELF, and of PE, which has no hidden symbols.
SECTIONS = '''
#ifdef _WIN32
#define RODATA       ".section .rdata,\\"dr\\"\\n"
#define HIDDEN(name) ""
#else
#define RODATA       ".section .rodata\\n"
#define HIDDEN(name) ".hidden " name "\\n"
#endif
'''

source_path, header_path, *modules = sys.argv[1:]
origins = []
if '--' in modules:
    end = modules.index('--')
    modules, origins = modules[:end], modules[end + 1:]
names = [pathlib.Path(module).stem.replace('.', '_') for module in modules]
stem = pathlib.Path(header_path).stem
source = f'#include "{stem}.h"\n#include <stddef.h>\n' + SECTIONS
header = f'#ifndef {stem.upper()}_H\n#define {stem.upper()}_H\n#include "graph/rg.h"\n'
for name, module in zip(names, modules):
    path = pathlib.Path(module).resolve()
    data = path.read_bytes()
    sum_ = hashlib.sha1(data).hexdigest()  # makes the C file change with the module
    source += f'''
__asm__(RODATA ".globl {name}_words\\n" HIDDEN("{name}_words")
        ".balign 4\\n{name}_words: .incbin \\"{path}\\" /* {sum_} */\\n.text\\n");
extern const uint32_t {name}_words[];
const struct rg_shader {name} = {{ "{name}", {name}_words, {len(data) // 4} }};
'''
    header += f'extern const struct rg_shader {name};\n'
source += f'\nconst struct rg_shader *const {stem}_all[] = {{\n    '
source += ',\n    '.join([*(f'&{name}' for name in names), 'NULL']) + ',\n};\n'
header += f'extern const struct rg_shader *const {stem}_all[];\n'
if origins:
    most = max(len(origin.split()) for origin in origins)  # file + flags = flags + NULL
    header += f'struct {stem}_origin {{\n'
    header += f'    const char *file, *flags[{most}]; /* ends at NULL */\n}};\n'
    header += f'extern const struct {stem}_origin {stem}_origins[{len(origins)}];\n'
    source += f'\nconst struct {stem}_origin {stem}_origins[] = {{\n'
    for origin in origins:
        file, *flags = origin.split()
        flags = ', '.join([*(f'"{flag}"' for flag in flags), 'NULL'])
        source += f'    {{ "{file}", {{ {flags} }} }},\n'
    source += '};\n'
write(source_path, source)
write(header_path, header + '#endif\n')
