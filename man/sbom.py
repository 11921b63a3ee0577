"""sbom.py: writes the software bill of materials (SPDX 2.3, JSON) of firn's programs.

Usage: sbom.py OUTPUT VERSION NAME=VERSION... | sbom.py --check SBOM BUILD PROGRAM

NAME is a name of `components`. The output is reproducible: the creation time is
SOURCE_DATE_EPOCH, or the year 1970. --check exits with 1 if a dependency that Meson has found, or a
library that the program is linked with, is missing from the file.
"""
import json
import os
import pathlib
import re
import subprocess
import sys
import time
import uuid

# Name: licence, supplier's page, what it is used as, and names in Meson and of shared libraries.
components = {
    'vulkan-headers': ('Apache-2.0', 'https://github.com/KhronosGroup/Vulkan-Headers', 'header',
                       ['vulkan']),
    'spirv-headers': ('MIT', 'https://github.com/KhronosGroup/SPIRV-Headers', 'header',
                      ['SPIRV-Headers']),
    'volk': ('MIT', 'https://github.com/zeux/volk', 'source', []),
    'cglm': ('MIT', 'https://github.com/recp/cglm', 'header', ['cglm']),
    'draco': ('Apache-2.0', 'https://github.com/google/draco', 'library', ['draco', 'libdraco']),
    'meshoptimizer': ('MIT', 'https://github.com/zeux/meshoptimizer', 'library',
                      ['meshoptimizer', 'libmeshoptimizer']),
    'libpng': ('libpng-2.0', 'http://www.libpng.org', 'library', ['libpng', 'libpng16']),
    'libwebp': ('BSD-3-Clause', 'https://chromium.googlesource.com/webm/libwebp', 'library',
                ['libwebp']),
    'jansson': ('MIT', 'https://github.com/akheron/jansson', 'library', ['jansson', 'libjansson']),
    'libseccomp': ('LGPL-2.1-only', 'https://github.com/seccomp/libseccomp', 'library',
                   ['libseccomp']),
    'openexr': ('BSD-3-Clause', 'https://github.com/AcademySoftwareFoundation/openexr', 'library',
                ['OpenEXR', 'libOpenEXRCore-3_1']),
    'stb': ('MIT OR Unlicense', 'https://github.com/nothings/stb', 'header', ['stb', 'libstb']),
    'libavif': ('BSD-2-Clause', 'https://github.com/AOMediaCodec/libavif', 'library', ['libavif']),
    'opencolorio': ('BSD-3-Clause', 'https://github.com/AcademySoftwareFoundation/OpenColorIO',
                    'library', ['OpenColorIO', 'libOpenColorIO']),
    'embree': ('Apache-2.0', 'https://github.com/embree/embree', 'library',
               ['embree3', 'embree4', 'libembree3', 'libembree4']),
    'glfw': ('Zlib', 'https://github.com/glfw/glfw', 'library', ['glfw3', 'libglfw']),
    'imgui': ('MIT', 'https://github.com/ocornut/imgui', 'library', ['imgui']),
    'fontconfig': ('MIT', 'https://gitlab.freedesktop.org/fontconfig/fontconfig', 'library',
                   ['fontconfig', 'libfontconfig']),
    'freetype': ('FTL OR GPL-2.0-only', 'https://gitlab.freedesktop.org/freetype/freetype',
                 'library', ['freetype2', 'libfreetype']),
    'libx11': ('MIT', 'https://gitlab.freedesktop.org/xorg/lib/libx11', 'library',
               ['x11', 'libX11']),
    'libxcb': ('MIT', 'https://gitlab.freedesktop.org/xorg/lib/libxcb', 'library',
               ['xcb', 'xcb-shm', 'libxcb', 'libxcb-shm']),
}
# Names that are no components: of the C and C++ run time, of tests, and of Meson itself.
others = {'threads', 'cmocka', 'libc', 'libm', 'libdl', 'libgcc_s', 'libstdc++', 'ld-linux-x86-64',
          'libpthread', 'librt', 'libgomp', 'libasan', 'libubsan', 'libtsan', 'dl', 'm'}


def package(name, version, licence, page, purpose):
    return {'SPDXID': f'SPDXRef-{name}', 'name': name, 'versionInfo': version,
            'downloadLocation': page or 'NOASSERTION', 'filesAnalyzed': False,
            'licenseConcluded': licence, 'licenseDeclared': licence, 'copyrightText': 'NOASSERTION',
            'supplier': 'NOASSERTION', 'primaryPackagePurpose': purpose}


def relation(first, kind, second):
    return {'spdxElementId': first, 'relationshipType': kind, 'relatedSpdxElement': second}


def document(version, found):
    seconds = int(os.environ.get('SOURCE_DATE_EPOCH', '0'))
    created = time.strftime('%Y-%m-%dT%H:%M:%SZ', time.gmtime(seconds))
    packages = [package('firn', version, 'MIT', '', 'APPLICATION')]
    relations = [relation('SPDXRef-DOCUMENT', 'DESCRIBES', 'SPDXRef-firn')]
    for name in sorted(found):
        licence, page, use, _ = components[name]
        packages.append(package(name, found[name] or 'NOASSERTION', licence, page, 'LIBRARY'))
        kind = 'DYNAMIC_LINK' if use == 'library' else 'CONTAINS'
        relations.append(relation('SPDXRef-firn', kind, f'SPDXRef-{name}'))
    key = json.dumps([version, found], sort_keys=True)
    return {'spdxVersion': 'SPDX-2.3', 'dataLicense': 'CC0-1.0', 'SPDXID': 'SPDXRef-DOCUMENT',
            'name': f'firn-{version}',
            'documentNamespace': f'urn:uuid:{uuid.uuid5(uuid.NAMESPACE_URL, key)}',
            'creationInfo': {'created': created, 'creators': ['Tool: sbom.py']},
            'packages': packages, 'relationships': relations}


def check(sbom, build, program):
    listed = {p['name'] for p in json.loads(pathlib.Path(sbom).read_text())['packages']}
    known = {alias for name in listed & components.keys() for alias in components[name][3]}
    info = json.loads((pathlib.Path(build) / 'meson-info/intro-dependencies.json').read_text())
    used = {row['name'] for row in info if row.get('type') != 'internal'}
    text = subprocess.run(['readelf', '-d', program], check=True, capture_output=True,
                          text=True).stdout
    used |= set(re.findall(r'\(NEEDED\).*\[(.+?)\.so', text))
    missing = sorted(name for name in used - known - others)
    for name in missing:
        print(f'{sbom}: {name} is missing: add it to `components` in sbom.py')
    return 1 if missing or not used & known else 0


def main():
    if sys.argv[1] == '--check':
        return check(*sys.argv[2:])
    found = dict(word.split('=', 1) for word in sys.argv[3:])
    text = json.dumps(document(sys.argv[2], found), indent=2) + '\n'
    pathlib.Path(sys.argv[1]).write_text(text)
    return 0


if __name__ == '__main__':
    sys.exit(main())
