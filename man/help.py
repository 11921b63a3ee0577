"""help.py: parses the output of `firn --help` and `firn list` for man pages and completions."""
import re
import subprocess

COMMANDS = ('render', 'view', 'profile', 'graph', 'diff', 'ladder', 'sheet', 'farm',
            'merge', 'info', 'selftest', 'list')
LISTS = ('scenes', 'environments', 'refractions', 'materials', 'layers', 'qualities', 'settings')


def output_of(firn, *words):
    return subprocess.run([firn, *words], check=True, capture_output=True, text=True).stdout


class Option:
    """An option, parsed from a line of the help: "  -o, --output FILE   write ..."."""
    LINE = re.compile(r'^  (?:-(?P<letter>\w), |    )--(?P<name>[\w-]+)(?P<value>(?:\[?=| )\S+)? +'
                      r'(?P<help>\S.*)$')

    def __init__(self, match):
        self.letter, self.name, self.help = match['letter'], match['name'], match['help']
        value = (match['value'] or '').strip()
        self.is_optional = value.startswith('[=')
        self.value = value.strip('[]=') or None

    def words(self):
        """Returns the option and its value as written on a command line."""
        value = f'[={self.value}]' if self.is_optional else f' {self.value}' if self.value else ''
        return (f'-{self.letter}, ' if self.letter else '') + f'--{self.name}{value}'


class Command:
    def __init__(self, firn, name):
        self.name = name
        usage, *lines = output_of(firn, name, '--help').splitlines()
        self.synopsis, self.summary = usage.split(': ', 1)
        self.examples, self.notes, self.groups = [], [], {}
        group = None
        for line in lines:
            match = Option.LINE.match(line)
            if match:
                self.groups.setdefault(group, []).append(Option(match))
            elif re.match(r'^[A-Z][\w ]*:$', line):
                group = line[:-1]
            elif group == 'Examples' and line.startswith('  '):
                self.examples.append(line.strip())
            elif line:
                self.notes.append(line)
        self.groups = {name or 'Other': options for name, options in self.groups.items()}

    def options(self):
        return [option for options in self.groups.values() for option in options]


def names(firn, kind):
    """Returns {name: description} of the output of `firn list KIND`."""
    lines = output_of(firn, 'list', kind).splitlines()[1:]
    return dict(line.split(None, 1) for line in lines if line.strip())


def choices(text):
    """Returns the words that a setting accepts, from its description; [] if it is a number."""
    match = re.search(r'one of ([\w, -]+)', text)
    if match:
        return match.group(1).split(', ')
    return ['on', 'off'] if re.search(r'default (on|off)$', text) else []
