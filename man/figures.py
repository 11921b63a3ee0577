"""figures.py: writes the tables of docs/figures.json into the pages that show them.

Usage: figures.py [--check]   --check: names the pages that differ, and changes nothing
A page shows a table between the lines `<!-- figures: NAME -->` and `<!-- end -->`.
"""
import json
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
BLOCK = re.compile(r'(?s)(<!-- figures: (\w+) -->\n).*?(<!-- end -->)')


def table(figure):
    rows = [figure['head'], ['---'] * len(figure['head']), *figure['rows']]
    return ''.join(f'| {" | ".join(row)} |\n'.replace('|  |', '| |') for row in rows)


def filled(text, figures):
    """Returns the text of a page with its tables as in docs/figures.json."""
    return BLOCK.sub(lambda m: f'{m[1]}\n{table(figures[m[2]])}\n{m[3]}', text)


def pages():
    return [ROOT / 'README.md', *sorted((ROOT / 'docs').rglob('*.md'))]


def load():
    return json.loads((ROOT / 'docs/figures.json').read_text('utf-8'))


def main(is_check):
    differing = []
    for page in pages():
        text = page.read_text('utf-8')
        if filled(text, load()) != text:
            differing.append(str(page.relative_to(ROOT)))
            if not is_check:
                page.write_text(filled(text, load()), 'utf-8')
    if is_check and differing:
        sys.exit(f'differs from docs/figures.json: {", ".join(differing)}')


if __name__ == '__main__':
    main('--check' in sys.argv)
