"""api.py: Markdown pages of the C API, from the declarations and comments of public headers."""
import pathlib
import re

# Page: title, headers
PAGES = {
    'rg-tables': ('rg: tables and compiler', ('graph/rg.h', 'graph/rg_initializers.h')),
    'rg-plan': ('rg: compiled plans', ('graph/rg_plan.h',)),
    'rg-exec': ('rg-exec: execution on a device', ('graph/rg_exec.h',)),
    'rg-cmd': ('rg-exec: record functions', ('graph/rg_cmd.h',)),
    'firn-h': ('firn.h: firn as a library', ('src/lib/firn.h',)),
    'rg-profile': ('rg-exec: profiles of passes', ('graph/rg_profile.h',)),
}
COMMENT = re.compile(r'/\*(.*?)\*/', re.S)
NAME = (re.compile(r'^#define (\w+)'),
        re.compile(r'^(?:typedef )?(?:struct|enum|union) (\w+)\s*\{'),
        re.compile(r'\(\*?(\w+)\)\('), re.compile(r'(\w+)\s*\('))


def prose(comment):
    """Returns the text of a comment; lines with deeper indentation stay blocks of code."""
    lines = [re.sub(r'^\s*\*? ?', '', line).rstrip() for line in comment.strip().splitlines()]
    return '\n'.join(lines).strip()


def declarations(text):
    """Yields (comment or '', declaration) in order; both are text of the header."""
    text = re.sub(r'(?m)^#(?!define).*\n|^extern "C" \{\n', '', text)
    at, comment = 0, ''
    while at < len(text):
        rest = text[at:]
        if rest.startswith('/*'):
            end = rest.index('*/') + 2
            comment = rest[:end]
            at += end
        elif rest[0].isspace():
            if rest.startswith('\n\n'):
                comment = ''
            at += 1
        else:
            end = end_of(rest)
            yield comment, rest[:end].rstrip()
            at, comment = at + end, ''


def end_of(text):
    """Returns the length of the declaration or macro at the start of the text."""
    if text.startswith('#define'):
        return re.match(r'(?:.*\\\n)*.*', text).end()
    depth = at = 0
    while at < len(text):
        if text.startswith('/*', at):
            at = text.index('*/', at) + 2
            continue
        depth += {'{': 1, '(': 1, '}': -1, ')': -1}.get(text[at], 0)
        at += 1
        if depth <= 0 and text[at - 1] in ';}':
            tail = re.match(r'[^;{}\n]*;', text[at:]) if text[at - 1] == '}' else None
            line = re.match(r' */\*[^\n]*\*/', text[at + (tail.end() if tail else 0):])
            return at + (tail.end() if tail else 0) + (line.end() if line else 0)
    return at


def name_of(declaration):
    code = COMMENT.sub('', declaration)
    for pattern in NAME:
        match = pattern.search(code)
        if match:
            return match[1]
    return None


def entries(text):
    """Yields Markdown for each named declaration of a header."""
    for comment, declaration in declarations(text):
        name = name_of(declaration)
        if not name or name.endswith(('_H', '_API', '_BUILD')):
            continue
        yield f'\n## {name}\n\n'
        if comment:
            yield prose(comment[2:-2]) + '\n\n'
        yield f'```c\n{re.sub(r"[A-Z]+_API ", "", declaration)}\n```\n'


def page(title, headers):
    text = f'# {title}\n'
    for path in headers:
        header = path.read_text('utf-8')
        first = COMMENT.match(header)
        intro = prose(first[1]).partition(':')[2].strip()
        text += f'\n`{path.name}`: {intro}\n'
        text += ''.join(entries(header[first.end():]))
    return text


def pages(root):
    """Returns {name of the page: text} of the public headers that the source tree `root` has."""
    return {name: page(title, [pathlib.Path(root) / header for header in headers])
            for name, (title, headers) in PAGES.items()
            if all((pathlib.Path(root) / header).exists() for header in headers)}
