"""make.py: generates shell completions for firn from its help and lists.

Usage: make.py FIRN SHELL OUTPUT   SHELL: bash, zsh or fish
"""
import pathlib
import re
import sys

sys.dont_write_bytecode = True  # the source tree stays clean
sys.path.append(str(pathlib.Path(__file__).parents[1] / 'man'))
from help import COMMANDS, LISTS, Command, choices, names  # noqa: E402

# Options whose values are one name (NAMED) or comma-separated names (LISTED) from a category of
# `firn list`, or fixed words (WORDS). Options in FILES accept files of these kinds, too; without a
# kind, all files.
NAMED = {'refraction': 'refractions', 'split': 'refractions', 'material': 'materials',
         'show': 'layers', 'env': 'environments', 'quality': 'qualities'}
LISTED = {'rungs': 'refractions', 'aov': 'layers'}
WORDS = {'clock': ('auto', 'timestamps', 'submits'),
         'present': ('fifo', 'mailbox', 'immediate'),
         'exposure': ('auto',), 'curve': ('aces', 'hable', 'reinhard'),
         'overlay': ('on', 'off'), 'only': ('heat',), 'sandbox': ('on', 'off'),
         'pixel-filter': ('blackman-harris', 'box', 'point'), 'png-bits': ('8', '16'),
         'samples': ('auto',),
         'ground': ('auto', 'none', 'shadow', 'studio', 'slate', 'wood'), 'up': ('y', 'z')}
MODELS = ('gltf', 'glb', 'obj', 'ply', 'stl')
IMAGES = ('exr', 'hdr', 'png')
FILES = {'output': ('exr', 'png'), 'screenshot': ('exr', 'png'), 'env': ('exr', 'hdr'),
         'surroundings': MODELS, 'cracks': MODELS, 'bump': IMAGES, 'bump-mask': IMAGES,
         'air': IMAGES, 'mask': ('exr', 'png'), 'truth': IMAGES, 'baseline': ('json',),
         'json': ('json',), 'trace': ('json',), 'csv': ('csv',), 'session': ('firn',),
         'ocio': ('ocio',),
         'preset': ('txt', 'exr', 'png'), 'watch': ()}
# Kinds of the files that commands take as arguments; other commands take models.
ARGUMENTS = {'diff': IMAGES, 'merge': ('exr',), 'list': None, 'selftest': None}
CATEGORIES = (*LISTS, 'devices', 'sandbox')


class Facts:
    def __init__(self, firn):
        self.commands = [Command(firn, name) for name in COMMANDS]
        self.lists = {kind: names(firn, kind) for kind in LISTS}
        for kind in ('scenes', 'environments'):
            self.lists[kind].pop('FILE')

    def settings(self):
        """Yields NAME=VALUE for each value of settings that accept words, and NAME= for others."""
        for name, what in self.lists['settings'].items():
            values = choices(what)
            yield from (f'{name}={value}' for value in values or [''])

    def values(self, option):
        """Returns the words that complete an option's value; [] if it is a file or a number."""
        if option.name in NAMED:
            return list(self.lists[NAMED[option.name]])
        if option.name in LISTED:
            every = ['all'] if option.name == 'aov' else []
            return list(self.lists[LISTED[option.name]]) + every
        if option.name == 'set':
            return list(self.settings())
        if option.name == 'tone-curve':
            return choices(self.lists['settings']['tonemap.curve'])
        return list(WORDS.get(option.name, ()))

    def positionals(self, command):
        """Returns the words that complete an argument of a command; None if only files do."""
        if command.name == 'list':
            return list(CATEGORIES)
        if command.name == 'selftest':
            return []
        kinds = ['slurm', 'parallel', 'status'] if command.name == 'farm' else []
        return None if command.name in ('diff', 'merge') else kinds + list(self.lists['scenes'])


def files_of(command):
    """Returns the kinds of files that a command takes as arguments; None if it takes no files."""
    return ARGUMENTS.get(command.name, MODELS)


def bash_files(kinds):
    return f'$(_firn_files {" ".join(kinds)})'


def bash_words(facts, option):
    """Returns the words that complete an option's value, as shell code."""
    values = facts.values(option)
    if option.name == 'set':
        values = sorted({value.split('=')[0] + '=' for value in values})
    return ' '.join([*values, *([bash_files(FILES[option.name])] if option.name in FILES else [])])


BASH = '''# firn: made by completions/make.py
# _firn_files KIND...: prints folders and files of these kinds that begin with the current word
_firn_files()
{
    local kind
    compgen -d -- "$cur"
    for kind; do
        compgen -f -X "!*.$kind" -- "$cur"
    done
}
_firn()
{
    local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD - 1]} command=${COMP_WORDS[1]}
    local words= options= before=
    COMPREPLY=()
    if ((COMP_CWORD == 1)); then
        COMPREPLY=($(compgen -W "@COMMANDS@ help --help --version" -- "$cur"))
        return
    fi
    # readline splits NAME=VALUE into three words
    local name= at=0
    if [[ $cur == "=" ]]; then
        name=$prev at=$((COMP_CWORD - 2)) cur=
    elif [[ $prev == "=" ]]; then
        name=${COMP_WORDS[COMP_CWORD - 2]} at=$((COMP_CWORD - 3))
    fi
    if ((at > 1)) && [[ ${COMP_WORDS[at]} == --set ]]; then
        for words in @SETTINGS@; do
            [[ $words == "$name"=* ]] && options+=" ${words#*=}"
        done
        COMPREPLY=($(compgen -W "$options" -- "$cur"))
        return
    fi
    case $command in
@CASES@    help) words="@COMMANDS@" ;;
    esac
    if [[ $cur == -* ]]; then
        COMPREPLY=($(compgen -W "$options" -- "$cur"))
    elif [[ $words ]]; then
        COMPREPLY=($(compgen -P "$before" -W "$words" -- "${cur#"$before"}"))
        [[ ${COMPREPLY[*]} == *= ]] && compopt -o nospace 2>/dev/null
    fi
    return 0
}
complete -o filenames -F _firn firn
'''


def bash(facts):
    cases = ''
    for command in facts.commands:
        options = ' '.join(f'--{option.name}' for option in command.options())
        positionals = facts.positionals(command)
        rest = ' '.join(positionals or [])
        cases += f'    {command.name})\n        options="{options}"\n        case $prev in\n'
        for option in command.options():
            if not option.value or option.is_optional:
                continue
            keys = f'--{option.name}' + (f' | -{option.letter}' if option.letter else '')
            before = ' before=${cur%"${cur##*,}"}' if option.name in LISTED else ''
            cases += f'        {keys}) words="{bash_words(facts, option)}"{before} ;;\n'
        kinds = files_of(command)
        files = '' if kinds is None else bash_files(kinds)
        cases += f'        *) words="{rest} {files}" ;;\n        esac\n        ;;\n'
    valued = ' '.join(value for value in facts.settings() if not value.endswith('='))
    return (BASH.replace('@COMMANDS@', ' '.join(COMMANDS)).replace('@CASES@', cases)
            .replace('@SETTINGS@', valued))


def quoted(text):
    return "'" + text.replace("'", "'\\''") + "'"


def zsh(facts):
    def files(kinds):
        return f'_files -g "*.({"|".join(kinds)})(-.)"' if kinds else '_files'

    def described(text):
        return re.sub(r'([\\\[\]:])', r'\\\1', text)

    text = '#compdef firn\n# made by completions/make.py\n_firn() {\n    local -a commands\n'
    text += '    local context state state_descr line\n    typeset -A opt_args\n    commands=(\n'
    for command in facts.commands:
        text += f'        {quoted(command.name + ":" + described(command.summary))}\n'
    text += '''        'help:the help of a command'
    )
    _arguments -C '1:command:->command' '*::word:->words'
    case $state in
    command) _describe command commands ;;
    words)
        case $words[1] in
'''
    for command in facts.commands:
        text += f'        {command.name})\n            _arguments -s'
        for option in command.options():
            values = facts.values(option)
            action = ''
            if option.value:
                offered = f'({" ".join(values)})' if values else files(FILES[option.name]) if (
                    option.name in FILES) else ' '
                if option.name in LISTED:
                    offered = f'_sequence compadd - {" ".join(values)}'
                if values and option.name in FILES:
                    offered = '{compadd -- ' + ' '.join(values) + f'; {files(FILES[option.name])}}}'
                name = option.value.split('|')[0].replace(':', '')
                action = f':{"" if not option.is_optional else ":"}{name}:{offered}'
            mark = '=' if option.value and not option.is_optional else (
                '=-' if option.is_optional else '')
            spec = f'*--{option.name}{mark}[{described(option.help)}]{action}'
            text += f' \\\n                {quoted(spec)}'
            if option.letter:
                spec = f'*-{option.letter}[{described(option.help)}]{action}'
                text += f' \\\n                {quoted(spec)}'
        positionals = facts.positionals(command)
        offered = f'({" ".join(positionals)})' if positionals else ''
        if command.name == 'list':
            text += f" \\\n                {quoted('1:what:' + offered)}\n"
        elif positionals:
            both = '*:scene:{compadd -- ' + ' '.join(positionals) + f'; {files(MODELS)}}}'
            text += f' \\\n                {quoted(both)}\n'
        elif positionals is None:
            image = '*:image:' + files(files_of(command))
            text += f' \\\n                {quoted(image)}\n'
        else:
            text += '\n'
        text += '            ;;\n'
    return text + '''        help) _describe command commands ;;
        esac
        ;;
    esac
}
_firn "$@"
'''


def fish(facts):
    def files(kinds):
        return f'(__firn_files {" ".join(kinds)})'

    text = '''# firn: made by completions/make.py
function __firn_files -d 'Prints folders and files of these kinds that begin with the current word'
    set -l typed (commandline -ct)
    set -l word (string replace -r '^~(?=/)' -- $HOME $typed)
    set -l all $word*/
    for kind in $argv
        set -a all $word*.$kind
    end
    if string match -q '~/*' -- $typed
        set all (string replace -- $HOME '~' $all)
    end
    string join -- \\n $all
end
'''
    for command in facts.commands:
        text += (f'complete -c firn -f -n __fish_use_subcommand -a {command.name} '
                 f'-d {quoted(command.summary)}\n')
    text += "complete -c firn -f -n __fish_use_subcommand -a help -d 'the help of a command'\n"
    for command in facts.commands:
        here = f"complete -c firn -n '__fish_seen_subcommand_from {command.name}'"
        for option in command.options():
            text += here + f' -l {option.name}'
            text += f' -s {option.letter}' if option.letter else ''
            values = facts.values(option)
            if option.name in LISTED:
                values = [f'(__fish_append , {" ".join(values)})']
            if option.name in FILES and FILES[option.name]:
                values = [*values, files(FILES[option.name])]
            if option.value and not option.is_optional:
                text += ' -r' if option.name == 'watch' else ' -kx'
            if values:
                text += f' -a {quoted(" ".join(values))}'
            text += f' -d {quoted(option.help)}\n'
        positionals = facts.positionals(command)
        kinds = files_of(command)
        offered = [*(positionals or []), *([files(kinds)] if kinds else [])]
        text += here + f' -kf -a {quoted(" ".join(offered))}\n'
    return text


def main():
    firn, shell, output = sys.argv[1:]
    facts = Facts(firn)
    pathlib.Path(output).write_text({'bash': bash, 'zsh': zsh, 'fish': fish}[shell](facts))


main()
