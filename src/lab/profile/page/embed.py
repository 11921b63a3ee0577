"""embed.py: embeds the HTML page of a profile, with its style and scripts, in one C file.

Usage: embed.py OUTPUT.c PAGE.html STYLE.css SCRIPT.js...
The C file defines `const struct page_part page_parts[]` (embedded_page.h): the text before,
between and after the two placeholders for JSON data."""
import pathlib
import sys

PLACEHOLDERS = ('@PROFILE@', '@SWEEP@')


def read(path):
    return pathlib.Path(path).read_text(encoding='ascii').rstrip('\n')


def array(name, text):
    codes = text.encode('ascii')
    lines = (', '.join(str(code) for code in codes[i:i + 24]) for i in range(0, len(codes), 24))
    return f'static const char {name}[] = {{\n    ' + ',\n    '.join(lines) + ',\n};\n'


def main(output, page, style, *scripts):
    text = read(page) + '\n'
    text = text.replace('@STYLE@', read(style))
    text = text.replace('@SCRIPT@', '\n\n'.join(read(script) for script in scripts))
    parts = []
    for place in PLACEHOLDERS:
        part, found, text = text.partition(place)
        if not found:
            sys.exit(f'{page}: {place} is missing')
        parts.append(part)
    parts.append(text)
    source = '#include "src/lab/profile/page/embedded_page.h"\n\n'
    source += '\n'.join(array(f'part_{i}', part) for i, part in enumerate(parts))
    source += '\nconst struct page_part page_parts[PAGE_PART_COUNT] = {\n'
    source += ''.join(f'    {{ part_{i}, sizeof(part_{i}) }},\n' for i in range(len(parts)))
    pathlib.Path(output).write_text(source + '};\n', encoding='ascii')


main(*sys.argv[1:])
