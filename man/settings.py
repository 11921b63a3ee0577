"""settings.py: writes docs/reference/settings.md, from `firn list settings`, to stdout.

Usage: settings.py FIRN
"""
import sys

sys.dont_write_bytecode = True  # the source tree stays clean
from help import names  # noqa: E402


def page(firn):
    text = '# Settings\n\n'
    text += 'For users of `--set NAME=VALUE`, of every command that draws, and of the panel of\n'
    text += '`firn view`: all settings, with their defaults and ranges.\n'
    text += '`man/settings.py` generates this page from `firn list settings`.\n'
    group = None
    for name, what in names(firn, 'settings').items():
        if name.split('.')[0] != group:
            group = name.split('.')[0]
            text += f'\n## {group}\n\n| setting | what |\n|---|---|\n'
        what = what.replace('|', '\\|')
        text += f'| `{name}` | {what} |\n'
    return text


if __name__ == '__main__':
    print(page(sys.argv[1]), end='')
