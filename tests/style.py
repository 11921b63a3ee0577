"""style.py: checks the rules of CONTRIBUTING.md that a machine can check.

Usage: style.py ROOT [LIBRARY...]   LIBRARY: a static library in which nothing may be writable
       style.py --self-test         gives every rule a violation to find
Prints one line for each fault, "file:line: what is wrong", and exits with 1 if there is any.
"""
import ast
import collections
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
from typing import NamedTuple

MAX_FUNCTION, MAX_COLUMN, MAX_SUBJECT = 60, 100, 72
LONG_FILE = 800  # lines, above which a file is reported
MAX_FILES = 40  # in a folder of CROWDED
CROWDED = ('shaders/', 'src/tech/', 'src/scene/')
SPOKEN = ('graph/', 'src/', 'shaders/', 'examples/', 'assets/', 'tests/support/')

FOLDERS = ('.ci', 'assets', 'completions', 'docs', 'graph', 'man', 'shaders', 'src', 'tests')
# Objects with tables of a library's header that are not const there: stb_easy_font's
THEIR_DATA = ('lab_ladder_canvas.c.o',)
# One that counts what a property of the process depends on: whether it is dumpable. Three with a
# property of each thread: where its messages, cache files and assets are.
PROCESS_DATA = ('file_reader_child_posix.c.o', 'base_log.c.o', 'base_disk_cache.c.o',
                'scene_bundled_assets.c.o')
C = ('.c', '.h', '.cpp')
GLSL = ('.vert', '.frag', '.comp', '.glsl')
CODE = (*C, *GLSL, '.py', '.sh', '.build')
TEXT = (*CODE, '.md', '.txt', '.json', '.supp')
SHELL_NAMES = ('run',)  # files without a suffix
TEXT_NAMES = (*SHELL_NAMES, 'LICENSE', '.clang-format', '.clang-tidy', '.gitignore')

# What the frame and the renderer know of techniques and shaders: nothing that is of a single one.
OF_ALL_TECHNIQUES = (
    'src/tech/frame_resources.h', 'src/tech/frame_media.h',
    'src/tech/inclusions/low_res_inclusions.h', 'src/tech/inclusions/medium_density_fields.h',
    'src/tech/aov_layer.h', 'src/tech/pass_arena.h',
    'src/tech/technique.h', 'src/tech/techniques.h',
    'shaders/specialization_constants.h', 'shaders/globals.h',
    'shaders/brdf.h', 'shaders/mesh_layout.h', 'shaders/surroundings/procedural_sky.h',
)

# What a file may include begins with one of these; the longest folder that fits the file counts.
MAY_INCLUDE = {
    'graph/': ('graph/rg',),
    'graph/compile/': ('graph/compile/', 'graph/rg.h'),
    'graph/dump/': ('graph/dump/', 'graph/rg.h'),
    'graph/exec/': ('graph/exec/', 'graph/rg'),
    'src/base/': ('src/base/',),
    'src/settings/': ('src/settings/', 'src/base/', 'src/scene/generate/generate.h', 'shaders/'),
    'src/file/': ('src/file/', 'src/base/'),
    'src/gpu/': ('src/gpu/', 'src/base/', 'graph/'),
    'src/scene/': ('src/scene/', 'src/file/', 'src/base/', 'shaders/'),
    'src/scene/generate/': ('src/scene/generate/', 'src/scene/bubble_intersect.h',
                            'src/scene/geometry/', 'src/scene/mip_levels.h', 'shaders/'),
    'src/tech/': ('src/tech/', 'src/settings/', 'src/scene/camera.h', 'src/scene/geometry/mesh.h',
                  'src/scene/scene.h', 'src/scene/ao_occluder_transmission.h',
                  'src/scene/gpu_material_table.h',
                  'src/scene/environment/image_based_lighting.h', 'shaders/', 'graph/rg.h',
                  'graph/rg_cmd.h'),
    'src/render/frame/': ('src/render/frame/', *OF_ALL_TECHNIQUES, 'src/scene/', 'src/settings/',
                          'src/base/', 'graph/rg.h', 'graph/rg_cmd.h'),
    'src/render/': ('src/render/', *OF_ALL_TECHNIQUES, 'src/scene/', 'src/settings/', 'src/file/',
                    'src/gpu/', 'src/base/', 'graph/'),
    'src/lab/metric/': ('src/lab/metric/', 'src/file/', 'src/base/'),
    'src/lab/reference/': ('src/lab/reference/', 'src/render/', 'src/tech/', 'src/scene/',
                           'src/settings/', 'src/file/', 'src/base/', 'shaders/'),
    'src/lab/profile/': ('src/lab/profile/', 'src/render/', 'src/file/', 'src/gpu/', 'src/base/',
                         'shaders/', 'graph/'),
    'src/lab/ladder/': ('src/lab/', 'src/render/', 'src/file/', 'src/base/'),
    'src/setup/': ('src/setup/', 'src/lab/reference/', 'src/render/', 'src/tech/', 'src/scene/',
                   'src/settings/', 'src/file/', 'src/gpu/', 'src/base/', 'src/version.h',
                   'shaders/', 'graph/'),
    'src/lib/': ('src/lib/', 'src/app/options/set_option.h', 'src/setup/', 'src/lab/',
                 'src/render/', 'src/tech/', 'src/scene/', 'src/settings/', 'src/file/', 'src/gpu/',
                 'src/base/', 'src/version.h', 'graph/'),
    'src/app/': ('src/app/', 'src/lib/', 'src/setup/', 'src/lab/', 'src/render/', 'src/tech/',
                 'src/scene/', 'src/settings/', 'src/file/', 'src/gpu/', 'src/base/',
                 'src/version.h', 'shaders/', 'graph/'),
    'src/view/': ('src/view/', 'src/setup/', 'src/lab/', 'src/render/', 'src/tech/', 'src/scene/',
                  'src/settings/', 'src/file/', 'src/gpu/', 'src/base/', 'src/version.h',
                  'shaders/', 'graph/'),
    'src/programs/': ('src/app/', 'src/view/viewer.h', 'src/scene/import/sandboxed_load.h',
                      'src/gpu/gpu_fallback.h',
                      'src/base/', 'src/version.h'),
    'tests/': ('tests/', 'src/', 'graph/', 'shaders/'),
}

# The same for <headers>; folders that are not listed may include any.
C_STANDARD = tuple(f'{name}.h' for name in (
    'assert complex ctype errno fenv float inttypes limits locale math setjmp signal stdalign '
    'stdarg stdatomic stdbool stddef stdint stdio stdlib stdnoreturn string tgmath threads time '
    'uchar wchar wctype').split())
MAY_INCLUDE_SYSTEM = {
    'graph/': (*C_STANDARD, 'vulkan/'),
    'graph/compile/': (*C_STANDARD, 'spirv/'),
    'graph/exec/pass_timing.c': (*C_STANDARD, 'windows.h'),
    'src/tech/': (*C_STANDARD, 'cglm/struct.h'),
    'shaders/': ('stdint.h', 'cglm/struct/vec3.h', 'cglm/types-struct.h'),
}

# Headers and functions of POSIX, and those of C that MinGW-w64 lacks. They belong in files of
# SYSTEM_FOLDERS named *_posix.c, beside which *_win.c does the same on Windows. The window and its
# folder are not built for Windows. strdup() is in C23 and in MinGW-w64.
SYSTEM_FOLDERS = ('src/base/', 'src/file/')
SYSTEM_NAMES = re.compile(r'_(?:posix|win)\.[ch]$')
POSIX_HEADERS = (
    'dirent dlfcn fcntl fnmatch ftw glob io langinfo libgen poll process pthread pwd regex '
    'sched semaphore signal spawn strings syslog termios threads unistd utime windows').split()
POSIX_CALLS = (
    'access aligned_alloc chdir clock_gettime close dlopen dlsym execve execvp execv fdopen '
    'fileno flockfile fmemopen fork fseeko fstat ftello getcwd getline getpid getrusage '
    'gmtime_r isatty kill localtime_r lseek lstat mkdir mkstemp mmap nanosleep open '
    'open_memstream opendir pipe poll putenv read realpath secure_getenv setenv sigaction '
    'sigaddset sigemptyset stat stpcpy strcasecmp strcasestr strncasecmp strndup strnlen '
    'strtok_r sysconf unlink unsetenv usleep waitpid write').split()
POSIX_TYPES = (
    'NAME_MAX PATH_MAX clockid_t off_t pid_t sigset_t ssize_t').split()
POSIX_HEADER = re.compile(
    rf'#include <(?:(?:sys|linux|netinet)/\S+|(?:{"|".join(POSIX_HEADERS)})\.h)>')
POSIX_CALL = re.compile(
    rf'(?<![\w.>])(?:{"|".join(POSIX_CALLS)}|posix_\w+|pthread_\w+)\('
    rf'|\b(?:{"|".join(POSIX_TYPES)}|pthread_\w+|struct stat|struct timespec)\b')

# Words that tell of where a line was written, not of what it is for. Not looked for in this file.
LEAKS = (
    (r'(?<![\w&%#])#\d{1,4}\b', 'number of an issue'),
    (r'\bissue \d', 'number of an issue'),
    (r'(?<![\w.}$])/(home|root|Users|mnt|srv)/', 'path of one machine'),
    (r'\b(TODO|FIXME|XXX)\b', 'unfinished business'),
)

# C that compiles but is not written here.
NOT_OURS = (
    (r'\bglm_(vec|mat|quat)\w*\(', 'array API of cglm: use the value types, glms_...'),
    (r'^\s*typedef (struct|union|enum)\b[^(]*$', 'typedef of a struct, union or enum'),
    (r'\bgoto (?!fail;)', 'the one label is "fail"'),
    # clang-tidy sees to names in headers; in every file it would look at all of Vulkan's each time
    (r'^ *(?!return |goto |else |case |typedef |extern |struct \w+;)(\w+ )+\**'
     r'(?!LLVM|RENDERDOC|ABI_)\w*[A-Z]\w*( = |;|\[|\(|, )', 'capitals in a name'),
)


# Header of the library, whose users write `firn *`.
PUBLIC_HEADER = 'src/lib/firn.h'

# Words of a private dialect in comments, help and messages, and what to write instead. Only what is
# always wrong is here. Left to the reader, since each has an ordinary meaning as well: part, share,
# picture, turn, place, words, look, still, quick, mirror, contact, smooth, foot, seen, beside.
PRIVATE_WORDS = tuple((re.compile(rf'\b(?:{words})\b'), term) for words, term in (
    (r'ways? (?:of|that) (?:light|waits?)|light ways?', 'path, pending branch'),
    (r'straight parts?', 'segment'),
    (r'(?:rays?|paths?|ways?) (?:that )?meets?', 'hits, intersects'),
    (r'trees? of (?:the )?triangles', 'BVH'),
    (r'trees? (?:is|are) (?:fitted|made)', 'BVH refit, rebuild'),
    (r'anew', 'rebuild, again'),
    (r'(?:cloudy|clouds of) ice', 'scattering medium'),
    (r'dress(?:es|ed)?', 'material'),
    (r'hairs?', 'epsilon'),
    (r'floes?', 'floating ice'),
    (r'(?:films?|sheets?) of water', 'water layer'),
    (r'shares? of (?:the |a )?(?:light|ray|pixel)', 'fraction, throughput'),
    (r'pixels? (?:that )?sees?|sun sees', 'primary hit, shadow map'),
    (r'eye rays?|the eye sees', 'primary ray, camera'),
    (r'mirrored by (?:the )?surroundings', 'screen-space reflections'),
    (r'smooth(?:s|ed)? over pixels', 'denoise'),
    (r'rungs? of refraction|rung of', 'refraction model'),
    (r'a hand (?:has|moves|drags|changes|sets)', 'the user'),
    (r'(?:used )?longest ago', 'least recently used'),
    (r'greatest memory', 'peak memory'),
    (r'lack of lifetimes', 'alias'),
    (r'linear between', 'linearly interpolated'),
    (r'bit for bit|byte for byte', 'bit-identical'),
    (r'joins? corners', 'welds vertices'),
    (r'gives? away|gave away', 'moves ownership to'),
    (r'could not interrupt', 'real-time priority'),
))
# How a comment does not begin, and how it does not name a sentinel.
PRIVATE_SYNTAX = (
    (re.compile(r'^(?:What|Whether|How|That of|Those|Of) '), 'begin with a verb or a noun'),
    (re.compile(r'(?:\b\d+|NULL|""|\{0\}|\{ 0 \}): (?:none|nothing)\b'), '"; 0 if there is none"'),
)
# The same for the parts of identifiers, between underscores.
PRIVATE_NAMES = {
    'way': 'path', 'ways': 'paths', 'dress': 'material', 'dressed': 'material', 'hair': 'epsilon',
    'floe': 'floating_ice', 'meet': 'hit', 'meets': 'hits', 'met': 'hit', 'hand': 'user, input',
    'hands': 'user, input', 'rung': 'model', 'cloud': 'medium', 'clouds': 'media',
    'cloudy': 'medium', 'smooths': 'denoises',
}


class File(NamedTuple):
    path: str  # from the root, with slashes
    text: str

    @property
    def lines(self):
        return self.text.splitlines()

    def ends(self, suffixes):
        return pathlib.PurePath(self.path).suffix in suffixes


def matches(file, patterns):
    for number, line in enumerate(file.lines, 1):
        for pattern, message in patterns:
            found = re.search(pattern, line)
            if found:
                yield number, f'{message}: {found[0].strip()}'


def layout_rule(file):
    for number, line in enumerate(file.lines, 1):
        if '\t' in line:
            yield number, 'tab'
        if line != line.rstrip():
            yield number, 'trailing space'
        if len(line) > MAX_COLUMN and (file.ends(CODE) or file.path in SHELL_NAMES):
            yield number, f'{len(line)} columns, at most {MAX_COLUMN}'
    if file.text and not file.text.endswith('\n'):
        yield len(file.lines), 'no newline at the end'


def functions(file):
    """(first line, last line) of every function."""
    if file.ends(('.py',)):
        for node in ast.walk(ast.parse(file.text)):
            if isinstance(node, ast.FunctionDef):
                yield node.lineno, node.end_lineno
    if file.ends(C + GLSL):  # clang-format puts both braces into column 1
        first = None
        for number, line in enumerate(file.lines, 1):
            if line == '{':
                first = number
            elif line == '}' and first:
                yield first, number
                first = None


def function_rule(file):
    for first, last in functions(file):
        if last - first + 1 > MAX_FUNCTION:
            yield first, f'function of {last - first + 1} lines, at most {MAX_FUNCTION}'


def row_for(path, table):
    fitting = [folder for folder in table if path.startswith(folder)]
    return table[max(fitting, key=len)] if fitting else None


def include_fault(path, header, system):
    if system:
        allowed = row_for(path, MAY_INCLUDE_SYSTEM)
        if allowed and not header.startswith(allowed):
            return f'{os.path.dirname(path)}/ may not include <{header}>'
    elif path.startswith('shaders/'):  # -Ishaders: GLSL compilers know no other root
        if header.startswith(('shaders/', 'src/', 'graph/', 'tests/', '.')):
            return f'shaders/ include each other, from shaders/, and nothing else: "{header}"'
    elif not header.startswith(('assets/', 'src/', 'graph/', 'shaders/',
                                'tests/')) or '..' in header:
        return f'include "{header}" does not start from the root'
    elif path.startswith('src/') and not row_for(path, MAY_INCLUDE):
        return f'{os.path.dirname(path)}/ has no row of what it may include in tests/style.py'
    elif not header.startswith(row_for(path, MAY_INCLUDE) or ('',)):
        return f'{os.path.dirname(path)}/ may not include "{header}"'
    return None


def include_rule(file):
    if not file.ends(C + GLSL):
        return
    for number, line in enumerate(file.lines, 1):
        found = re.match(r'\s*#\s*include\s*([<"])([^>"]*)', line)
        fault = found and include_fault(file.path, found[2], found[1] == '<')
        if fault:
            yield number, fault


def leak_rule(file):
    if file.path != 'tests/style.py':
        yield from matches(file, LEAKS)


def c_rule(file):
    if file.ends(C) and file.path != PUBLIC_HEADER:
        yield from matches(file, NOT_OURS)


def code_of(text):
    """Returns C or GLSL with comments and strings blanked; lines keep their numbers."""
    return re.sub(r'"(?:\\.|[^"\\\n])*"|/\*.*?\*/|//[^\n]*',
                  lambda found: '\n' * found[0].count('\n'), text, flags=re.S)


def system_rule(file):
    """Finds functions and headers of one operating system outside the files for them."""
    is_of_system = file.path.startswith(SYSTEM_FOLDERS) and SYSTEM_NAMES.search(file.path)
    if (not file.ends(C) or not file.path.startswith('src/') or is_of_system
            or file.path.startswith('src/view/')):
        return
    code = code_of(file.text)
    if not POSIX_CALL.search(code) and not re.search(POSIX_HEADER.pattern, code):
        return
    declared = re.compile(r'^(?:static |\w[\w ]*[ *])\w+\(')
    for number, line in enumerate(code.splitlines(), 1):
        found = POSIX_HEADER.match(line) or (
            not declared.match(line) and POSIX_CALL.search(line))
        if found:
            yield number, f'not portable, belongs in src/base/*_posix.c: {found[0].strip("(")}'


def texts(text):
    """Yields (line, is comment, text) of the comments and the strings of C or GLSL."""
    pattern = r'"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])*\'|/\*.*?\*/|//[^\n]*'
    for found in re.finditer(pattern, text, re.S):
        words = ' '.join(re.sub(r'^\s*(/\*+|\*/|\*|//)', '', found[0], flags=re.M).split())
        if found[0][0] != "'":
            yield text.count('\n', 0, found.start()) + 1, found[0][0] == '/', words.strip(' */')


def identifiers(text):
    """Yields (line, identifier) of C or GLSL, outside comments and strings."""
    for number, line in enumerate(code_of(text).splitlines(), 1):
        for name in re.findall(r'[A-Za-z_]\w*', line):
            yield number, name


def language_rule(file):
    if not file.ends(C + GLSL) or not file.path.startswith(SPOKEN):
        return
    for line, is_comment, words in texts(file.text):
        for pattern, term in PRIVATE_WORDS + PRIVATE_SYNTAX[0 if is_comment else 1:]:
            found = pattern.search(words)
            if found:
                yield line, f'"{found[0].strip()}": write {term}'
    for line, name in identifiers(file.text):
        for part in name.lower().split('_'):
            if part in PRIVATE_NAMES:
                yield line, f'{name}: "{part}" is {PRIVATE_NAMES[part]}'


RULES = (language_rule, layout_rule, function_rule, include_rule, leak_rule, c_rule, system_rule)


def check_file(file):
    return [f'{file.path}:{number}: {message}' for rule in RULES for number, message in rule(file)]


def check_circles(files):
    """Pairs of files, with headers, that include each other; not headers that have no .c."""
    needs = {}
    for file in files:
        stem, suffix = os.path.splitext(file.path)
        if suffix in ('.c', '.h') and file.path.startswith(('src/', 'graph/')):
            found = re.findall(r'^#include "(.*)\.h"', file.text, re.MULTILINE)
            needs.setdefault(stem, set()).update(found)
    units = {file.path[:-2] for file in files if file.path.endswith('.c')}
    return [f'{a}: it and {b} include each other' for a in sorted(units & needs.keys())
            for b in sorted(needs[a] & units) if a < b and a in needs.get(b, ())]


def check_headers(files):
    """Files whose first line does not say what they are."""
    header = r'(?:/\*\n \* |/\* |// )'
    return [f'{file.path}:1: the first line is not a comment "NAME: what the file is"'
            for file in files if file.ends(C + GLSL) and file.path.startswith(SPOKEN) and
            not re.match(header + re.escape(os.path.basename(file.path)) + ': ', file.text)]


def check_folders(files):
    count = collections.Counter(os.path.dirname(file.path) for file in files
                                if file.path.startswith(CROWDED))
    return [f'{folder}/: {number} files, at most {MAX_FILES}'
            for folder, number in sorted(count.items()) if number > MAX_FILES]


def read_tree(root):
    inside = (path for folder in FOLDERS for path in (root / folder).rglob('*'))
    for path in sorted([*root.iterdir(), *inside]):
        if path.is_file() and (path.suffix in TEXT or path.name in TEXT_NAMES):
            yield File(path.relative_to(root).as_posix(), path.read_text(encoding='utf-8'))


def check_library(library):
    """Sections of an archive's objects that can be written to; .data.rel.ro cannot."""
    sizes = subprocess.run(['size', '-A', library], capture_output=True, text=True, check=True)
    faults, member = [], '?'
    for line in sizes.stdout.splitlines():
        member = line.split()[0] if ' (ex ' in line or line.endswith(':') else member
        section = re.match(r'(\.t?(?:data|bss)(?!\.rel\.ro)\S*)\s+([1-9]\d*)', line)
        if section and pathlib.Path(member).name not in THEIR_DATA + PROCESS_DATA:
            faults.append(f'{library}:{member}: {section[2]} writable bytes in {section[1]}')
    return faults


def subject_fault(subject):
    if len(subject) > MAX_SUBJECT:
        return f'{len(subject)} columns, at most {MAX_SUBJECT}'
    if not re.match(r'[a-z0-9_./-]+(, ?[a-z0-9_./-]+)*: \S', subject):
        return 'not of the form "area: subject"'
    if subject.endswith('.') or re.search(r'^[^ ]+: [A-Z][a-z]', subject):
        return 'a subject begins in lower case and ends without a full stop'
    return None


def check_commits(root):
    if not (root / '.git').exists():
        return []
    if not shutil.which('git'):
        return ['.git: there is no git program to read the commits']
    git = ['git', '-c', 'safe.directory=*', '-C', str(root)]
    head = subprocess.run([*git, 'rev-parse', '-q', '--verify', 'HEAD'], capture_output=True)
    if head.returncode:
        return []  # no commit yet
    log = subprocess.run([*git, 'log', '--no-merges', '--format=%h %s'], capture_output=True,
                         text=True, check=True)
    commits = (line.split(' ', 1) for line in log.stdout.splitlines())
    return [f'commit {commit}: {subject_fault(subject)}: {subject}'
            for commit, subject in commits if subject_fault(subject)]


# Path, text, and part of the message that must come; None: nothing may come.
LONG = 'x = 1;\n'
SAMPLES = (
    ('src/a.c', 'int x;\n\treturn;\n', 'a.c:2: tab'),
    ('docs/a.md', 'words \n', 'a.md:1: trailing space'),
    ('src/a.c', 'int x;', 'no newline'),
    ('src/a.c', 'x' * 101 + '\n', '101 columns'),
    ('run', 'x' * 101 + '\n', '101 columns'),
    ('src/a.cpp', 'x' * 101 + '\n', '101 columns'),
    ('src/a.py', 'x' * 101 + '\n', '101 columns'),
    ('docs/a.md', 'x' * 101 + '\n', None),
    ('src/a.c', 'void f(void)\n{\n' + LONG * 59 + '}\n', 'a.c:2: function of 61 lines'),
    ('shaders/a.frag', 'void main()\n{\n' + LONG * 59 + '}\n', 'function of 61 lines'),
    ('src/a.c', 'void f(void)\n{\n' + LONG * 58 + '}\n', None),
    ('tests/a.py', 'def f():\n' + '    x = 1\n' * 60, 'a.py:1: function of 61 lines'),
    ('graph/a.c', '#include "src/base/log.h"\n', 'graph/ may not include "src/base/log.h"'),
    ('graph/rg.h', '#include "graph/exec/executor_internal.h"\n', 'graph/ may not include'),
    ('graph/compile/a.c', '#include "graph/exec/executor_internal.h"\n',
      'graph/compile/ may not include'),
    ('graph/compile/a.c', '#include "graph/rg_exec.h"\n', 'graph/compile/ may not include'),
    ('graph/dump/a.c', '#include "graph/compile/arena.h"\n', 'graph/dump/ may not include'),
    ('graph/exec/a.c', '#include "graph/compile/arena.h"\n', 'graph/exec/ may not include'),
    ('graph/exec/a.c',
      '#include "graph/exec/executor_internal.h"\n#include "graph/rg_profile.h"\n', None),
    ('graph/a.c', '#include <cglm/struct.h>\n', 'graph/ may not include <cglm'),
    ('graph/a.c', '#include <stdlib.h>\n#include <vulkan/vulkan_core.h>\n', None),
    ('graph/exec/a.c', '#include <spirv/unified1/spirv.h>\n', 'graph/exec/ may not include'),
    ('src/tech/a.c', '#include "graph/rg_exec.h"\n', 'may not include "graph/rg_exec.h"'),
    ('src/tech/a.c', '#include "src/gpu/gpu.h"\n', 'may not include "src/gpu/gpu.h"'),
    ('src/tech/a.c', '#include <volk.h>\n', 'may not include <volk.h>'),
    ('graph/a.c', '#include <volk.h>\n', 'may not include <volk.h>'),
    ('src/tech/a.c', '#include "graph/rg_cmd.h"\n#include "src/tech/b.h"\n', None),
    ('src/scene/a.c', '#include "src/render/a.h"\n', 'may not include "src/render/a.h"'),
    ('src/new/a.c', '#include "src/base/log.h"\n', 'src/new/ has no row'),
    ('src/scene/a.c', '#include "src/file/image.h"\n', None),
    ('src/file/a.c', '#include "src/scene/geometry/mesh.h"\n', 'may not include "src/scene'),
    ('src/lab/metric/a.c', '#include "src/render/frame/frames.h"\n',
      'may not include "src/render/frame/frames.h"'),
    ('src/gpu/a.c', '#include "src/tech/a.h"\n', 'may not include "src/tech/a.h"'),
    ('src/render/frame/a.c', '#include "src/tech/over.h"\n', 'may not include "src/tech/over.h"'),
    ('src/render/a.c', '#include "src/tech/lighting/bump.h"\n', 'may not include "src/tech'),
    ('src/render/a.c', '#include "shaders/lighting/bump.h"\n', 'may not include "shaders'),
    ('src/render/frame/a.c', '#include "src/tech/technique.h"\n', None),
    ('src/render/renderer.c', '#include "src/app/app.h"\n', 'may not include "src/app/app.h"'),
    ('src/app/a.c', '#include "src/app/app.h"\n#include "src/render/renderer.h"\n', None),
    ('src/tech/a.c', '#include "b.h"\n', 'does not start from the root'),
    ('src/a.c', '#include "src/../graph/rg.h"\n', 'does not start from the root'),
    ('shaders/a.h', '#include "src/tech/frame_resources.h"\n', 'shaders/ include each other'),
    ('shaders/a.frag', '#include "lib/optics.glsl"\n', None),
    ('docs/a.md', 'see #12\n', 'number of an issue: #12'),
    ('docs/a.md', 'see issue 12\n', 'number of an issue'),
    ('src/a.c', '/* as in /home/me/firn */\n', 'path of one machine'),
    ('src/a.c', '/* TODO: all */\n', 'unfinished business'),
    ('src/a.c', 'log("%#08x");\n#version 460\n', None),
    ('src/a.c', 'glm_vec3_add(a, b, c);\n', 'array API of cglm'),
    ('src/a.c', 'float f = glm_rad(3);\n', None),
    ('src/a.h', 'typedef struct a a;\n', 'typedef of a struct'),
    ('src/a.c', 'typedef enum status set_fn(int value);\n', None),
    ('src/a.c', '    goto out;\n', 'the one label'),
    ('src/a.c', '    goto fail;\n', None),
    ('src/a.c', '    const float *aB[3];\n', 'capitals in a name'),
    ('src/a.c', 'static void getA(struct a *b)\n', 'capitals in a name'),
    ('src/a.c', '    VkResult r = VK_SUCCESS;\n', None),
    ('src/app/a.c', '#include <unistd.h>\n', 'not portable'),
    ('src/app/a.c', '#include <sys/stat.h>\n', 'not portable'),
    ('src/app/a_posix.c', '#include <unistd.h>\n', 'not portable'),
    ('src/base/a.c', '    return close(file) == 0;\n', 'not portable'),
    ('src/base/a.h', '    sigset_t signals;\n', 'not portable'),
    ('src/base/a_posix.c', '#include <unistd.h>\n    close(file);\n', None),
    ('src/file/a_win.c', '#include <windows.h>\n', None),
    ('src/app/a.c', 'static void write(int x)\n    x->read(y); /* open() */\n', None),
    ('src/app/a.c', '    puts("kill(1)");\n', None),
)
# Comments and names in a private dialect.
SPEECH = (
    ('/* Returns the light of straight parts. */', 'segment'),
    ('/* The ray meets no face. */', 'hits'),
    ('/* Requirements that meet here. */', None),
    ('/* Whether it is on. */', 'begin with a verb'),
    ('/* How it is drawn. */', 'begin with a verb'),
    ('/* Returns true if it is on. */', None),
    ('int count; /* 0: none */', '0 if there is none'),
    ('int count; /* 0 if there is none */', None),
    ('log_error("the tree is made anew");', 'rebuild'),
    ('struct refract_way *w;', '"way" is path'),
    ('float always, away;', None),
    ('int is_met = meets_all(hand);', '"met" is hit'),
)
# Files of one tree, each a path and what it includes.
TREES = (
    ((('src/a.c', 'src/b'), ('src/b.c', 'src/a')), 'src/a: it and src/b include each other'),
    ((('src/a.c', 'src/b'), ('src/b.h', 'src/a'), ('src/b.c', 'src/b')), 'include each other'),
    ((('src/a.c', 'src/parts'), ('src/parts.h', 'src/a')), None),
    ((('src/a.c', 'src/a'), ('src/a.h', 'src/b'), ('src/b.c', 'src/b')), None),
)
SUBJECTS = (
    ('Add the cracks', 'not of the form'),
    ('cracks: ' + 'x' * 65, '73 columns'),
    ('cracks: clip against depth.', 'without a full stop'),
    ('cracks: Clip against depth', 'lower case'),
    ('graph/alias: pack largest first', None),
    ('image, tests: EXR files keep their layers', None),
)
OBJECTS = (
    ('static int count;\nint f(void);\nint f(void) { return count++; }\n', '.bss'),
    ('int count = 1;\n', '.data'),
    ('_Thread_local int count;\n', '.tbss'),
    ('static int x;\nint *p = &x;\n', '.data'),
    ('extern int x;\nint *const p[] = { &x };\nconst int c = 3;\n', None),
)


def compile_library(folder, source):
    base = pathlib.Path(folder)
    (base / 'a.c').write_text(source, encoding='utf-8')
    compiler = os.environ.get('CC', 'cc').split()
    subprocess.run([*compiler, '-fPIC', '-c', 'a.c', '-o', 'a.o'], cwd=base, check=True)
    (base / 'a.a').unlink(missing_ok=True)
    subprocess.run(['ar', 'crT', 'a.a', 'a.o'], cwd=base, check=True)
    return str(base / 'a.a')


def self_test():
    """What the rules say of the samples, compared with what they should say."""
    with tempfile.TemporaryDirectory() as folder:
        said = [(text, check_file(File(path, text)), want) for path, text, want in SAMPLES]
        said += [(text, list(language_rule(File('src/a.c', text))), want) for text, want in SPEECH]
        said += [(text, list(filter(None, [subject_fault(text)])), want) for text, want in SUBJECTS]
        said += [(str(tree), check_circles([File(path, f'#include "{header}.h"\n')
                                            for path, header in tree]), want)
                 for tree, want in TREES]
        said += [(text, check_library(compile_library(folder, text)), want)
                 for text, want in OBJECTS]
    wrong = 0
    for text, faults, want in said:
        if any(want in str(fault) for fault in faults) if want else not faults:
            continue
        wrong += 1
        print(f'{text[:80]!r}: expected {want!r}, got {faults}')
    print(f'{len(said)} samples, {wrong} judged wrongly')
    return wrong


def main(arguments):
    if arguments == ['--self-test']:
        return bool(self_test())
    if not arguments:
        print(__doc__, file=sys.stderr)
        return 2
    root = pathlib.Path(arguments[0])
    files = list(read_tree(root))
    faults = [fault for file in files for fault in check_file(file)] + check_circles(files)
    faults += check_folders(files) + check_headers(files)
    for file in files:
        if file.ends(CODE) and len(file.lines) > LONG_FILE:
            print(f'{file.path}: warning: {len(file.lines)} lines; split it by what it owns')
    faults += [fault for library in arguments[1:] for fault in check_library(library)]
    faults += check_commits(root)
    print(*faults, sep='\n', end='\n' if faults else '')
    return bool(faults)


if __name__ == '__main__':
    sys.exit(main(sys.argv[1:]))
