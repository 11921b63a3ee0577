"""make.py: builds the bundle firn-VERSION-linux-x86_64.tar.zst, which runs without installation.

Usage: make.py BUILD FOLDER   BUILD: in which everything is built; FOLDER: for the archive
Programs are in libexec/, and bin/firn (launcher.c) starts them. lib/ has their libraries. Those of
lib/c++ and lib/window are used only if the system has none, because its drivers and desktop need
its own. lib/lavapipe is the driver for machines without a Vulkan device. glibc is the system's.
"""
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import zipfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
GLIBC = re.compile(r'(ld-linux.*|lib(c|m|dl|rt|pthread|resolv|util|mvec))\.so\.\d+')
CXX = re.compile(r'lib(stdc\+\+|gcc_s)\.so\.\d+')
WINDOW = re.compile(r'lib(X.*|xcb|fontconfig|freetype|brotli.*|bsd|md)\.so\.\d+')
LOADED = ('libvulkan.so.1', 'libXi.so.6', 'libXrandr.so.2', 'libXcursor.so.1', 'libXinerama.so.1',
          'libXrender.so.1', 'libXxf86vm.so.1', 'libX11-xcb.so.1')  # opened at run time
DRIVER = 'libvulkan_lvp.so'
SHARE = ('firn', 'man', 'doc', 'applications', 'icons', 'metainfo', 'mime', 'bash-completion', 'zsh',
         'fish')
PAGES = ('README.md', 'CHANGELOG.md', 'LICENSE')


def output(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def find_library(name):
    """Returns the path of a library of this system."""
    for line in output('/sbin/ldconfig', '-p').splitlines():
        match = re.match(rf'\s+{re.escape(name)} \(libc6,x86-64.*\) => (\S+)', line)
        if match:
            return pathlib.Path(match[1])
    sys.exit(f'bundle: {name} is not installed')


def needed(file):
    """Returns the paths of all libraries that a program or library needs, except those of glibc."""
    text = output('ldd', str(file))
    if 'not found' in text:
        sys.exit(f'bundle: {file} needs a library that is not installed:\n{text}')
    paths = [pathlib.Path(path) for path in re.findall(r' => (/\S+)', text)]
    return [path for path in paths if not GLIBC.fullmatch(path.name)]


def collect(bundle):
    """Copies the libraries, and returns {copy: original}."""
    copies = {}

    def add(path, folder):
        for file in (*needed(path), path):
            kind = 'c++' if CXX.fullmatch(file.name) else 'window' if (
                WINDOW.fullmatch(file.name)) else folder
            if file.name not in {copy.name for copy in copies}:
                copies[bundle / 'lib' / kind / file.name] = file

    for program in ('firn', 'firn-view'):
        for path in needed(bundle / 'libexec' / program):
            add(path, '')
    for name in LOADED:
        add(find_library(name), '')
    add(find_library('libLLVM-15.so.1').parent / DRIVER, 'lavapipe')
    for copy, path in copies.items():
        copy.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(path.resolve(), copy)
        folders = '$ORIGIN' if copy.parent.name == 'lib' else (
            '$ORIGIN:$ORIGIN/..:$ORIGIN/../window')
        subprocess.run(['patchelf', '--set-rpath', folders, copy], check=True)
    return copies


def add_licences(bundle, libraries):
    """Copies the copyright files of the packages that contain the libraries."""
    folder = bundle / 'share/doc/firn/licences'
    folder.mkdir(parents=True, exist_ok=True)
    for path in libraries:
        owner = output('dpkg-query', '-S', f'*/{path.resolve().name}').split(':')[0]
        shutil.copyfile(f'/usr/share/doc/{owner}/copyright', folder / owner)


def copy_wheel(wheel, folder):
    """Stores a wheel uncompressed, so that the archive can compress assets that occur twice."""
    with zipfile.ZipFile(wheel) as source, zipfile.ZipFile(folder / wheel.name, 'w') as target:
        for entry in source.infolist():
            target.writestr(entry, source.read(entry), zipfile.ZIP_STORED)


def install(build, bundle, stage):
    """Copies the stripped programs and the files of share/ that they need."""
    subprocess.run(['meson', 'install', '-C', build, '--no-rebuild', '--destdir', stage],
                   check=True, stdout=subprocess.DEVNULL)
    program, = stage.rglob('bin/firn')
    for name in ('firn', 'firn-view'):
        target = bundle / 'libexec' / name
        target.parent.mkdir(parents=True, exist_ok=True)
        subprocess.run(['strip', '-o', target, program.with_name(name)], check=True)
    for name in SHARE:
        if (program.parents[1] / 'share' / name).exists():
            shutil.copytree(program.parents[1] / 'share' / name, bundle / 'share' / name)
    for wheel in pathlib.Path(build).glob('firn-*.whl'):
        copy_wheel(wheel, bundle / 'share')
    docs = bundle / 'share/doc/firn'
    docs.mkdir(parents=True, exist_ok=True)
    for page in PAGES:
        shutil.copy(ROOT / page, docs)
    if not (docs / 'html').exists():
        shutil.copytree(ROOT / 'docs', docs / 'docs')


def launcher(bundle):
    source = pathlib.Path(__file__).with_name('launcher.c')
    (bundle / 'bin').mkdir()
    subprocess.run(['cc', '-std=c17', '-D_POSIX_C_SOURCE=200809L', '-Wall', '-Wextra', '-Werror',
                    '-Os', '-static', '-s', '-o', bundle / 'bin/firn', source], check=True)


def driver_manifest(bundle):
    manifest = {'file_format_version': '1.0.0',
                'ICD': {'library_path': f'./{DRIVER}', 'api_version': '1.3.0'}}
    (bundle / 'lib/lavapipe/icd.json').write_text(json.dumps(manifest, indent=4) + '\n')


def pack(bundle, archive):
    """Packs the folder reproducibly: the archive depends only on the files' names and contents."""
    epoch = os.environ.get('SOURCE_DATE_EPOCH', '0')
    subprocess.run(['tar', '-C', bundle.parent, '--sort=name', f'--mtime=@{epoch}', '--owner=0',
                    '--group=0', '--numeric-owner', '--mode=u=rwX,go=rX', '-I',
                    'zstd -12 --long=27 -T0 -q', '-cf', archive, bundle.name], check=True)


def main(build, folder):
    version = json.loads(output('meson', 'introspect', build, '--projectinfo'))['version']
    name = f'firn-{version}-linux-x86_64'
    archive = pathlib.Path(folder).resolve() / f'{name}.tar.zst'
    with tempfile.TemporaryDirectory() as temporary:
        bundle = pathlib.Path(temporary) / name
        bundle.mkdir()
        install(build, bundle, pathlib.Path(temporary) / 'stage')
        copies = collect(bundle)
        for program in (bundle / 'libexec').iterdir():
            subprocess.run(['patchelf', '--set-rpath', '$ORIGIN/../lib', program], check=True)
        add_licences(bundle, copies.values())
        launcher(bundle)
        driver_manifest(bundle)
        pack(bundle, archive)
    print(f'{archive}: {archive.stat().st_size / 1e6:.1f} MB')


if __name__ == '__main__':
    main(*sys.argv[1:])
