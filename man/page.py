"""page.py: generates a man page of firn with scdoc from its help, and from intro.scd for firn.1.

Usage: page.py FIRN SCDOC NAME OUTPUT   NAME: firn, firn-COMMAND or firn-LIST
"""
import pathlib
import re
import subprocess
import sys

sys.dont_write_bytecode = True  # the source tree stays clean
from help import COMMANDS, Command, names  # noqa: E402

# Pages of lists: their sections, subjects and introductions.
LISTS = {
    'settings': (5, 'settings of firn for --set, and files for --preset',
                 'A file for *--preset* has one NAME=VALUE per line. Empty lines, and lines that '
                 'begin with #, are ignored. *firn list settings --preset* prints such a file with '
                 'all settings. An EXR or PNG file that firn wrote holds its settings, too.'),
    'layers': (7, 'layers (AOVs) of EXR files that firn writes',
               'For *--aov* and *--show*. Layers are channels of the EXR file.'),
    'materials': (7, 'materials of firn for --material',
                  'Name, index of refraction, description and source of each preset. '
                  '*--material NAME:rough* and *NAME:frosted* roughen the surface.'),
}
SEE = ', '.join([f'*firn-{name}*(1)' for name in COMMANDS] +
                [f'*firn-{name}*({page[0]})' for name, page in LISTS.items()])


def plain(text):
    """Escapes characters that scdoc would take for formatting."""
    return re.sub(r'([\\*_#~<>\[\]|])', r'\\\1', text)


def literal(lines):
    return '```\n' + '\n'.join(lines) + '\n```\n'


def options_of(options):
    text = ''
    for option in options:
        text += f'*{plain(option.words())}*\n\t{plain(option.help)}\n\n'
    return text


def command_page(firn, name):
    command = Command(firn, name)
    text = f'firn-{name}(1)\n\n# NAME\n\nfirn-{name} - {plain(command.summary)}\n\n'
    text += f'# SYNOPSIS\n\n{plain(command.synopsis)}\n\n'
    if command.notes:
        text += '# DESCRIPTION\n\n' + plain(' '.join(command.notes)) + '\n\n'
    text += '# OPTIONS\n\n'
    for group, options in command.groups.items():
        if len(command.groups) > 1:
            text += f'## {group}\n\n'
        text += options_of(options)
    text += '# EXAMPLES\n\n' + literal(command.examples)
    return text + f'\n# SEE ALSO\n\n*firn*(1), {SEE}\n'


def list_page(firn, kind):
    section, subject, text = LISTS[kind]
    text = (f'firn-{kind}({section})\n\n# NAME\n\nfirn-{kind} - {subject}\n\n'
            f'# DESCRIPTION\n\n{text}\n\n# {kind.upper()}\n\n')
    for name, what in names(firn, kind).items():
        text += f'*{plain(name)}*\n\t{plain(what)}\n\n'
    return text + f'# SEE ALSO\n\n*firn*(1), {SEE}\n'


def main_page(firn):
    text = pathlib.Path(__file__).with_name('intro.scd').read_text()
    commands = ''
    for name in COMMANDS:
        commands += f'*firn-{name}*(1)\n\t{plain(Command(firn, name).summary)}\n\n'
    return text.replace('@COMMANDS@\n', commands).replace('@SEE@', SEE)


def main():
    firn, scdoc, name, output = sys.argv[1:]
    if name == 'firn':
        text = main_page(firn)
    elif name.removeprefix('firn-') in LISTS:
        text = list_page(firn, name.removeprefix('firn-'))
    else:
        text = command_page(firn, name.removeprefix('firn-'))
    page = subprocess.run([scdoc], input=text, check=True, capture_output=True, text=True).stdout
    # remove the current date that scdoc writes, so that builds are reproducible
    page = re.sub(r'(?m)^(\.TH "[^"]*" "\d") "[^"]*"', r'\1 ""', page)
    pathlib.Path(output).write_text(page)


main()
