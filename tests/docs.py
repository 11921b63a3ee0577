"""docs.py: checks links, lengths, images and figures of the documentation.

Usage: docs.py ROOT   prints a line for each fault; the exit code is 1 if there is one
"""
import os
import pathlib
import re
import sys

sys.dont_write_bytecode = True  # keep __pycache__ out of the source tree
WORDS, ALL_WORDS = 1500, 35000  # per user page, of all hand-written pages
DIGITS = 12  # per 100 words of a user page
WORDS_PER_IMAGE = 300
GENERATED = ('docs/reference/settings.md', 'docs/reference/materials.md')
PROGRAMMERS = ('docs/how-to/adding-a-technique.md', 'docs/how-to/library.md',
               'docs/how-to/use-the-render-graph.md')
SITE = {f'docs/reference/{name}.md' for name in (  # pages that docs/build_site.py generates
    'firn-h', 'python-api', 'rg-cmd', 'rg-exec', 'rg-plan', 'rg-profile', 'rg-tables')}
LINK = re.compile(r'(!?)\[[^]\[]*\]\(([^)\s]+)\)')
CODE = re.compile(r'(?ms)^```.*?^```$|^(?: {4}|\t)[^\n]*$')


def anchor(heading):
    """Returns the anchor of a heading, as GitHub and MyST make it."""
    text = re.sub(r'\[([^]]*)\]\([^)]*\)', r'\1', heading).lower()
    return re.sub(r'[^\w\- ]', '', text).strip().replace(' ', '-')


def anchors(text):
    prose = re.sub(r'(?ms)^```.*?^```$', '', text)
    return {anchor(match[1]) for match in re.finditer(r'(?m)^#+ (.*)$', prose)}


def link_faults(root, page, text):
    for match in LINK.finditer(CODE.sub('', text)):
        target, _, mark = match[2].partition('#')
        if re.match(r'\w+:', target):
            continue
        path = os.path.normpath(os.path.join(os.path.dirname(page), target)) if target else page
        if path in SITE:
            continue
        if not (root / path).exists():
            yield f'{page}: no such file: {match[2]}'
        elif mark and path.endswith('.md') and mark not in anchors(
                (root / path).read_text('utf-8')):
            yield f'{page}: no such heading: {match[2]}'


def break_faults(page, text):
    """Finds prose lines whose first characters begin a comment (of MyST) or a list."""
    lines = CODE.sub('', text).split('\n')
    for before, line in zip(['', *lines], lines):
        if re.match(r'%|\d+[.)] ', line) and re.match(r'[^\W\d]|[`*(\[]', before):
            yield f'{page}: breaks its paragraph: {line}'


def is_for_users(page):
    return page.startswith(('docs/tutorial/', 'docs/how-to/')) and page not in PROGRAMMERS


def count_words(text):
    """Counts words with a letter or digit, so that rulers of tables do not count."""
    return sum(bool(re.search(r'\w', word)) for word in text.split())


def counts(text):
    """Returns the number of words of a page, its digits outside of code and links, its images."""
    prose = LINK.sub('', re.sub(r'`[^`]*`', '', CODE.sub('', text)))
    return count_words(text), len(re.findall(r'\d', prose)), len(re.findall(r'!\[', text))


def length_faults(page, text):
    words, digits, images = counts(text)
    if words > WORDS:
        yield f'{page}: {words} words, at most {WORDS}'
    if 100 * digits > DIGITS * words:
        yield f'{page}: {100 * digits // words} digits per 100 words, at most {DIGITS}'
    if images < words // WORDS_PER_IMAGE:
        yield f'{page}: {images} images, at least {words // WORDS_PER_IMAGE}'


def strip_faults(root):
    """Compares the settings that docs/strips.txt and the page of settings list."""
    listed = re.findall(r'(?m)^\| `([a-z_]+\.[a-z_]+)` \|',
                        (root / 'docs/reference/settings.md').read_text('utf-8'))
    strips = re.findall(r'(?m)^([a-z_]+\.[a-z_]+) ', (root / 'docs/strips.txt').read_text('utf-8'))
    for name in sorted(set(listed) ^ set(strips)):
        yield f'docs/strips.txt: {name}: in the list of settings or in that of strips, not in both'


def faults(root):
    sys.path.insert(0, str(root / 'man'))
    import figures
    texts = {str(path.relative_to(root)): path.read_text('utf-8')
             for path in (*sorted((root / 'docs').rglob('*.md')), *root.glob('*.md'),
                          root / 'graph/README.md', root / 'assets/README.md')}
    for page, text in texts.items():
        yield from link_faults(root, page, text)
        yield from break_faults(page, text)
        if figures.filled(text, figures.load()) != text:
            yield f'{page}: differs from docs/figures.json: run man/figures.py'
        if is_for_users(page):
            yield from length_faults(page, text)
    yield from strip_faults(root)
    written = [text for page, text in texts.items()
               if page.startswith('docs/') and page not in GENERATED]
    words = sum(map(count_words, written))
    if words > ALL_WORDS:
        yield f'docs: {words} words, at most {ALL_WORDS}'
    if len(texts['README.md'].splitlines()) > 120:
        yield 'README.md: more than 120 lines'


def report(root):
    """Prints the counts of each page."""
    for path in sorted((root / 'docs').rglob('*.md')):
        words, digits, images = counts(path.read_text('utf-8'))
        print(f'{path.relative_to(root)}: {words} words, '
              f'{100 * digits / words:.1f} digits per 100, {images} images')


if __name__ == '__main__':
    folder = pathlib.Path(sys.argv[1]).resolve()
    if '--report' in sys.argv:
        report(folder)
    found = list(faults(folder))
    print(*found, sep='\n', end='\n' if found else '')
    sys.exit(bool(found))
