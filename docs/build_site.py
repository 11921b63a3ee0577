"""build_site.py: builds the documentation as a site with Sphinx, MyST and furo.

Usage: build_site.py FIRN SPHINX_BUILD FOLDER   (`meson compile docs`)
       build_site.py --install FOLDER DIRECTORY   (`meson install`)   nothing if it is not built
FIRN is - for a site without strips. FOLDER/source is a staged copy of the pages, with generated
ones: a strip of images of each setting (docs/strips.txt), and the APIs of C and Python. FOLDER/html
is the site. A broken link is an error.
"""
import hashlib
import os
import pathlib
import re
import shutil
import subprocess
import sys

sys.dont_write_bytecode = True  # keep __pycache__ out of the source tree
ROOT = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / 'man'))
import api  # noqa: E402
import python_api  # noqa: E402
from help import names  # noqa: E402

PAGES = ('CHANGELOG.md', 'CONTRIBUTING.md', 'README.md', 'SECURITY.md', 'graph/README.md',
         'assets/README.md')
LINK = re.compile(r'(!?)\[([^]\[]*)\]\(([^)#\s]+)(#[^)\s]*)?\)')
ORPHAN = '---\norphan: true\n---\n'  # front matter of a page without a place in the contents
STRIP = ('--size', '160x120', '--samples', '4', '-q')  # unless a line of strips.txt has its own


def strips():
    """Yields (setting, values, other words) for each line of docs/strips.txt; values is `-` for a
    setting without a strip, whose reason follows."""
    for line in (ROOT / 'docs/strips.txt').read_text('utf-8').splitlines():
        if line and not line.startswith('#'):
            name, values, *words = line.split()
            yield name, values, words


def commands(name, values, words):
    """Yields (words of firn, command to show) of a strip: one sheet or, since sheets have no
    reference, an image per value."""
    if 'reference' in words:
        for value in values.split(','):
            words_of_value = [*words, '--set', f'{name}={value}']
            yield ['render', *STRIP, *words_of_value], f'firn render {" ".join(words_of_value)}'
    else:
        words = [*words, '--sweep', f'{name}={values}']
        yield ['sheet', *STRIP, *words], f'firn sheet {" ".join(words)}'


def draw_strips(firn, folder):
    """Draws the strips that `folder` lacks; a file's name has the hash of its command. Returns
    {setting: [(file, command to show)]}."""
    folder.mkdir(parents=True, exist_ok=True)
    drawn = {}
    for name, values, words in strips():
        for command, shown in commands(name, values, words) if values != '-' else ():
            mark = hashlib.sha256(' '.join(command).encode()).hexdigest()[:8]
            path = folder / f'{name}-{mark}.png'
            if not path.exists():
                subprocess.run([firn, *command, '-o', path], check=True,
                               stderr=subprocess.DEVNULL)
            drawn.setdefault(name, []).append((path, shown))
    return drawn


def strips_page(firn, drawn, prefix):
    text = '# Settings in images\n\nEach strip shows three values of one setting, or all where it '
    text += 'has fewer. [The table of settings](settings.md) has defaults and ranges.\n'
    group = None
    for name, what in names(firn, 'settings').items():
        if name in drawn:
            if name.split('.')[0] != group:
                group = name.split('.')[0]
                text += f'\n## {group}\n'
            text += f'\n### {name}\n\n{what}\n\n'
            text += '\n'.join(f'![{name}]({prefix}{path.name})' for path, _ in drawn[name])
            text += '\n\n' + ''.join(f'    {command}\n' for _, command in drawn[name])
    return text


def staged(page, text, source):
    """Copies the files that a page links to, and unlinks folders."""
    def link(match):
        path = pathlib.Path(os.path.normpath((page.parent / match[3])))
        if ':' in match[3] or str(path).startswith('..'):
            return match[0]
        if (ROOT / path).is_dir():
            return match[2]
        if (ROOT / path).is_file() and not (source / path).exists():
            (source / path).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(ROOT / path, source / path)
            if path.suffix == '.md':
                (source / path).write_text(ORPHAN + (ROOT / path).read_text('utf-8'), 'utf-8')
        return match[0]
    return LINK.sub(link, text)


def toctrees(index, paths):
    """Returns hidden tables of contents: the links below each heading of the index, in their order,
    and the other pages of `paths` in the section of their folder, or in More."""
    text = ''
    for section in re.split(r'(?m)^## ', index)[1:]:
        pages = dict.fromkeys(m[3] for m in LINK.finditer(section) if m[3].endswith('.md'))
        caption = section.splitlines()[0]
        folder = '' if caption == 'More' else caption.lower()
        pages.update((page, 0) for page in (path.removeprefix('docs/') for path in paths)
                     if os.path.dirname(page) == folder and page not in ('index.md', *PAGES))
        rows = '\n'.join(page.removesuffix('.md') for page in pages)
        text += f'\n```{{toctree}}\n:hidden:\n:caption: {caption}\n\n{rows}\n```\n'
    return text


def stage(source, generated):
    """Writes all pages to `source`; `generated` are {path: text}."""
    shutil.rmtree(source, ignore_errors=True)
    (source / 'docs').mkdir(parents=True)
    for name in ('meson.build', 'docs/conf.py'):
        shutil.copy(ROOT / name, source / pathlib.Path(name).name)
    shutil.copytree(ROOT / 'docs/static', source / 'docs/static')
    pages = {path: (ROOT / path).read_text('utf-8') for path in
             (*PAGES, *(str(p.relative_to(ROOT)) for p in (ROOT / 'docs').rglob('*.md')))}
    pages.update(generated)
    for path, text in pages.items():
        if path == 'docs/index.md':
            text += toctrees(text, pages)
        elif path in PAGES:
            text = ORPHAN + text
        (source / path).parent.mkdir(parents=True, exist_ok=True)
        (source / path).write_text(staged(pathlib.Path(path), text, source), 'utf-8')


def main(firn, sphinx, folder):
    folder = pathlib.Path(folder).resolve()
    generated = {f'docs/reference/{name}.md': text for name, text in api.pages(ROOT).items()}
    if (ROOT / 'python').is_dir():
        generated['docs/reference/python-api.md'] = python_api.page(ROOT)
    drawn = draw_strips(firn, folder / 'strips') if firn != '-' else {}
    if drawn:
        generated['docs/reference/settings-images.md'] = strips_page(firn, drawn, '../strips/')
    stage(folder / 'source', generated)
    (folder / 'source/docs/strips').mkdir()
    for path, _ in (image for images in drawn.values() for image in images):
        shutil.copy(path, folder / 'source/docs/strips')
    html = folder / 'html'
    done = subprocess.run([sphinx, '-q', '-W', '--keep-going', '-b', 'html', folder / 'source',
                           html], check=False)
    if done.returncode:
        sys.exit(done.returncode)
    (html / 'index.html').write_text('<meta http-equiv="refresh" content="0; url=docs/index.html">')
    print(html / 'index.html')


def install(folder, directory):
    """Copies the site, if it has been built, below the prefix of `meson install`."""
    target = pathlib.Path(os.environ['MESON_INSTALL_DESTDIR_PREFIX']) / directory / 'html'
    if (pathlib.Path(folder) / 'html/index.html').exists():
        shutil.copytree(pathlib.Path(folder) / 'html', target, dirs_exist_ok=True)


if __name__ == '__main__':
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    if sys.argv[1] == '--install':
        install(*sys.argv[2:])
    else:
        main(*sys.argv[1:])
