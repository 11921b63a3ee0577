"""installed.py: tests of an installation: libraries of graph/, examples, the program's assets.

Usage: installed.py ROOT MESON BUILD   BUILD: a folder in which everything is built
Installs the shared and static libraries, and builds the programs of
docs/how-to/use-the-render-graph.md
and graph/README.md outside the tree with the commands of the page; they must print the output
given there. The programs of examples/ must render their images. The libraries must export exactly
the functions of the headers, and have the SONAME of the version. The program must find its assets
also if it is installed to a folder other than its prefix. examples/views.c, as C and as C++, must
draw the same images with the installed libfirn.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

# Public headers of each library.
HEADERS = {'rg': ['rg.h'], 'rg-exec': ['rg_exec.h', 'rg_cmd.h', 'rg_profile.h']}
WARNINGS = '-Wall -Wextra -Wpedantic -Werror -Wno-missing-field-initializers'
EXAMPLES = {  # expected pixels of the examples' images: (x, y): colour
    'blur.c': {(128, 128): (255, 255, 255), (64, 128): (119, 119, 119), (4, 4): (0, 0, 0)},
    'culling.c': {(228, 130): (26, 26, 51), (300, 110): (183, 120, 56)},
    'deferred.c': {(160, 20): (123, 138, 161), (110, 105): (158, 96, 74),
                   (215, 115): (75, 113, 168), (160, 130): (255, 255, 254),
                   (85, 123): (85, 95, 108), (160, 220): (184, 187, 190)},  # sky to shadow, ground
    'materials.c': {(160, 5): (161, 178, 201), (160, 200): (188, 190, 194),
                    (160, 137): (92, 100, 114), (200, 142): (144, 93, 187)},  # sky, ground, shadow
    'particles.cpp': {(160, 211): (255, 255, 255), (10, 10): (0, 0, 0)},
}
TOLERANCE = 6  # of 8-bit values
COUNTS = r'(frame \d+: 1[01]\d\d of 4096 cubes\n){18}'  # printed by culling.c
CPLUSPLUS = '''\
#include "graph/rg_cmd.h"
#include "graph/rg_exec.h"

static void record(rg_cmd *cmd, const rg_frame *)
{
    rg_cmd_draw(cmd, 3);
}

int main()
{
    rg_pass pass = {};
    pass.record = record;
    rg_exec_destroy(nullptr);
    return pass.record ? rg_access_info(RG_SAMPLED)->writes_content : 1;
}
'''


def output(command, **options):
    return subprocess.run(command, check=True, capture_output=True, text=True, **options).stdout


def expect(what, wanted, found):
    if wanted != found:
        sys.exit(f'{what}: wanted\n{wanted}\nfound\n{found}')


def install(root, meson, prefix):
    for command in (['setup', prefix / 'build', root, '-Dfirn=false', '--prefix', prefix,
                     '--libdir', 'lib', '-Ddefault_library=both'],
                    ['install', '-C', prefix / 'build']):
        done = subprocess.run([meson, *command], capture_output=True, text=True)
        if done.returncode:
            sys.exit(f'meson {command[0]} failed:\n{done.stdout}{done.stderr}')


def remove_shared(prefix):
    """Removes shared libraries: a linker uses static ones only if there are no shared ones."""
    for file in (prefix / 'lib').glob('*.so*'):
        file.unlink()


def symbols(library, *options):
    """Returns the names of a library's symbols, without versions."""
    lines = output(['nm', '--format=posix', *options, library]).splitlines()
    return sorted(line.split()[0].split('@')[0] for line in lines if ' ' in line)


def declared(prefix, library):
    """Returns the functions that the library's headers declare, with any return type."""
    names = []
    for header in HEADERS[library]:
        text = (prefix / 'include' / 'firn' / 'graph' / header).read_text(encoding='utf-8')
        text = re.sub(r'/\*(?s:.*?)\*/|^#(?:.*\\\n)*.*$', '', text, flags=re.M)
        names += re.findall(r'^(?!typedef)\w[\w *]*?\b(\w+)\([^()]*\);', text, re.M)
    return sorted(names)


def dynamic(file, tag):
    return re.findall(rf'\({tag}\).*\[(.*)\]', output(['readelf', '-d', file]))


def soname(prefix, library, environment):
    version = output(['pkg-config', '--modversion', library], env=environment).split('.')
    return f'lib{library}.so.{version[0]}.{version[1]}'


def check_shared(prefix, environment):
    for library in HEADERS:
        file = prefix / 'lib' / f'lib{library}.so'
        expect(f'functions of {file.name}', declared(prefix, library),
               symbols(file, '-D', '--defined-only'))
        expect(f'name of {file.name}', [soname(prefix, library, environment)],
               dynamic(file, 'SONAME'))
        vulkan = [name for name in symbols(file, '-D', '--undefined-only') if name[:2] == 'vk']
        expect(f'functions that {file.name} wants of a loader', [], vulkan)


def check_static(prefix, _):
    """Checks names in archives: their internal symbols, too, could clash with a program's."""
    for library in HEADERS:
        file = prefix / 'lib' / f'lib{library}.a'
        names = symbols(file, '-g', '--defined-only')
        expect(f'functions missing in {file.name}', set(), {*declared(prefix, library)} - {*names})
        expect(f'names in {file.name} that are not the library\'s', [],
               [name for name in names if not name.startswith('rg_')])


def compile_and_run(command, source, text, environment):
    """Compiles a source with a shell command, runs the program, and returns its output."""
    source.write_text(text, encoding='utf-8')
    subprocess.run(['sh', '-e', '-c', command], cwd=source.parent, env=environment, check=True)
    return output([source.with_suffix('')], env=environment)


def check_programs(prefix, environment, static, page):
    """Checks the programs of a page: each is followed by its compile command and its output."""
    compiler = os.environ.get('CC', 'cc')
    programs = re.findall(
        r'```c\n(.*?)```.*?\n    cc ([^\n]* (\w+\.c) [^\n]*)\n.*?```text\n(.*?)```', page, re.S)
    expect('programs', page.count('```c\n'), len(programs))
    whole = ''
    for text, command, name, prints in programs:
        if 'int main' not in text:  # functions for the program before it
            run = re.search(r'(?ms)^static VkResult run\(.*?^}\n', whole)[0]
            text = whole.replace(run, text)
            text = text.replace('run(exec);', 'run(exec, &params);')
        whole = text
        if static:
            command = command.replace('pkg-config', 'pkg-config --static')
        source = prefix / name
        expect(f'{name} prints', prints,
               compile_and_run(f'{compiler} {WARNINGS} {command}', source, text, environment))
        needed = {*dynamic(source.with_suffix(''), 'NEEDED')}
        ours = {soname(prefix, library, environment) for library in HEADERS}
        expect(f'{name} needs a shared library of ours', not static, bool(needed & ours))


def check_uninstalled(prefix, environment, pages):
    """Checks the programs of the pages with the libraries and pkg-config files of a build."""
    build = prefix / 'build'
    for page in pages:
        check_programs(prefix, {**environment, 'LD_LIBRARY_PATH': str(build / 'graph'),
                                'PKG_CONFIG_PATH': str(build / 'meson-uninstalled')}, False, page)


def check_cplusplus(prefix, environment):
    compiler = os.environ.get('CXX', 'c++')
    command = f'{compiler} -std=c++17 {WARNINGS} -o other other.cpp ' \
              '$(pkg-config --cflags --libs rg-exec)'
    compile_and_run(command, prefix / 'other.cpp', CPLUSPLUS, environment)


def build_example(folder, environment, name):
    """Builds an example with the command of its page."""
    program = pathlib.Path(name).stem
    compiler = (f'{os.environ.get("CC", "cc")} -std=c17 {WARNINGS}' if name.endswith('.c') else
                f'{os.environ.get("CXX", "c++")} -std=c++20 -Wall -Wextra -Werror')
    command = f'{compiler} -o {program} {name} $(pkg-config --cflags --libs rg-exec vulkan) -lm'
    subprocess.run(['sh', '-e', '-c', command], cwd=folder, env=environment, check=True)
    return [folder / program, folder / 'out.ppm']


def run_example(folder, environment, name):
    """Builds and runs an example, and returns its image."""
    printed = output(build_example(folder, environment, name), env=environment)
    if not re.fullmatch(COUNTS if name.startswith('culling.') else '', printed):
        sys.exit(f'{name} prints {printed}')
    return (folder / 'out.ppm').read_bytes()


def check_example(folder, environment, name, pixels):
    """Checks some pixels of an example, and that its C++ twin draws the same image."""
    image = run_example(folder, environment, name)
    twin = pathlib.Path(name).with_suffix('.cpp').name
    if name != twin and (folder / twin).exists() and \
            image != run_example(folder, environment, twin):
        sys.exit(f'{twin} draws another image than {name}')
    _, size, _, texels = image.split(b'\n', 3)
    width = int(size.split()[0])
    for (x, y), color in pixels.items():
        found = tuple(texels[3 * (y * width + x):][:3])
        if any(abs(a - b) > TOLERANCE for a, b in zip(color, found)):
            sys.exit(f'{name}: pixel {x}, {y}: wanted {color}, found {found}')


def check_mistake(folder, environment):
    """A buffer in which a shader counts, declared as only written, must be a fault."""
    source = folder / 'particles.cpp'
    right = '&draw, .access = RG_STORAGE_READ_WRITE'
    text = source.read_text(encoding='utf-8')
    source.write_text(text.replace(right, right.replace('READ_', '')), encoding='utf-8')
    done = subprocess.run(build_example(folder, environment, source.name), env=environment,
                          capture_output=True, text=True, check=False)
    expect('particles.cpp with a mistake', (1, 'fault: particles row 1 (move): draw access differs '
           "from that of the shader; binding 2: 'particles_move.comp' loads from 'draw': expected "
           'RG_STORAGE_READ_WRITE\n'), (done.returncode, done.stderr))


def check_examples(root, prefix, environment):
    folder = prefix / 'examples'
    shutil.copytree(pathlib.Path(root) / 'examples', folder)
    for shader in sorted(folder.iterdir()):
        if shader.suffix in ('.comp', '.vert', '.frag'):
            subprocess.run(['glslangValidator', '--quiet', '--target-env', 'vulkan1.3', '--vn',
                            shader.name.replace('.', '_'), '-o', f'{shader.name}.h', shader.name],
                           cwd=folder, check=True)
    for name, pixels in EXAMPLES.items():
        check_example(folder, environment, name, pixels)
    check_mistake(folder, environment)


def check_assets(root, meson, build):
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run([meson, 'install', '--no-rebuild', '-C', build, '--destdir', folder],
                              capture_output=True, text=True)
        if done.returncode:
            sys.exit(f'meson install failed:\n{done.stdout}{done.stderr}')
        program, = pathlib.Path(folder).rglob('bin/firn')
        environment = {name: value for name, value in os.environ.items() if name != 'FIRN_ASSETS'}
        for scene in ('drink', 'amber', 'hollow'):
            output([program, 'graph', scene, '--env', 'studio'], env=environment)
        check_library(root, pathlib.Path(folder))


def check_library(root, folder):
    """Builds the example of libfirn outside the tree, as C and C++, and runs it."""
    reader, = folder.rglob('libexec/firn-reader')
    library = next(folder.rglob('libfirn.so.0'))
    header, = folder.rglob('include/firn.h')
    assets = next(folder.rglob('share/firn'))
    environment = {**os.environ, 'PKG_CONFIG_PATH': str(library.parent / 'pkgconfig'),
                   'PKG_CONFIG_SYSROOT_DIR': str(folder), 'LD_LIBRARY_PATH': str(library.parent),
                   'FIRN_READER': str(reader), 'FIRN_ASSETS': str(assets)}
    functions = re.findall(r'^FIRN_API [\w *]*?(\w+)\(', header.read_text(encoding='utf-8'), re.M)
    expect('functions of libfirn', sorted(functions), symbols(library, '-D', '--defined-only'))
    expect('name of libfirn', ['libfirn.so.0'], dynamic(library, 'SONAME'))
    source = (pathlib.Path(root) / 'examples/views.c').read_text(encoding='utf-8')
    images = []
    for name, compiler in (('views.c', f'{os.environ.get("CC", "cc")} -std=c17'),
                           ('views.cpp', f'{os.environ.get("CXX", "c++")} -std=c++17')):
        command = f'{compiler} {WARNINGS} -o views {name} $(pkg-config --cflags --libs firn) -lm'
        (folder / name).write_text(source, encoding='utf-8')
        subprocess.run(['sh', '-e', '-c', command], cwd=folder, env=environment, check=True)
        printed = output([folder / 'views'], cwd=folder, env=environment)
        if not re.fullmatch(r'(view\d.ppm: 4\.\d\d\d m\n){4}', printed):
            sys.exit(f'{name} prints {printed}')
        images.append([(folder / f'view{i}.ppm').read_bytes() for i in range(4)])
    expect('images of views.cpp', images[0], images[1])


def main(root, meson, build):
    check_assets(root, meson, build)
    pages = [(pathlib.Path(root) / page).read_text(encoding='utf-8')
             for page in ('docs/how-to/use-the-render-graph.md', 'graph/README.md')]
    with tempfile.TemporaryDirectory() as folder:
        prefix = pathlib.Path(folder)
        install(root, meson, prefix)
        environment = {
            **os.environ,
            'PKG_CONFIG_PATH': str(prefix / 'lib' / 'pkgconfig'),
            'LD_LIBRARY_PATH': str(prefix / 'lib'),
            'VK_INSTANCE_LAYERS': 'VK_LAYER_KHRONOS_validation',  # prints validation errors
        }
        for static, check in ((False, check_shared), (True, check_static)):
            if static:
                remove_shared(prefix)
            else:
                check_examples(root, prefix, environment)
                check_uninstalled(prefix, environment, pages)
            check(prefix, environment)
            for page in pages:
                check_programs(prefix, environment, static, page)
            check_cplusplus(prefix, environment)


if __name__ == '__main__':
    main(*sys.argv[1:])
