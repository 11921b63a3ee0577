"""make_wheel.py: builds firn-VERSION-py3-none-PLATFORM.whl, offline.

Usage: make_wheel.py VERSION LIBRARY READER FOLDER
LIBRARY is libfirn.so.0, READER the program firn-reader; the wheel is written to FOLDER.
"""
import pathlib
import shutil
import subprocess
import sys
import tempfile

SOURCE = pathlib.Path(__file__).resolve().parent


def main(version, library, reader, folder):
    """Copies the files of the wheel into a temporary folder, and runs pip there."""
    with tempfile.TemporaryDirectory() as name:
        work = pathlib.Path(name)
        for file in ('pyproject.toml', 'setup.py'):
            shutil.copy(SOURCE / file, work)
        shutil.copytree(SOURCE / 'firn', work / 'firn',
                        ignore=shutil.ignore_patterns('__pycache__'))
        shutil.copytree(SOURCE.parent / 'assets', work / 'firn' / 'assets',
                        ignore=lambda folder, names: [name for name in names if not
                                                      name.endswith(('.glb', '.exr'))])
        (work / 'VERSION').write_text(version)
        for source, target in ((library, 'libfirn.so.0'), (reader, 'firn-reader')):
            subprocess.run(['strip', '-o', work / 'firn' / target, source], check=True)
        return subprocess.run([sys.executable, '-m', 'pip', '-q', 'wheel', '--no-deps',
                               '--no-build-isolation', '-w', folder, work],
                              check=False).returncode


if __name__ == '__main__':
    sys.exit(main(*sys.argv[1:]) if len(sys.argv) == 5 else __doc__)
