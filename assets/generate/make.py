"""make.py: regenerates the files of assets/, bit-identically with the same version of zlib.

Usage: make.py FOLDER [NAME...]
    NAME: drink, amber, hollow, ice_cube, sample, slate, stage, studio or window; default: all
"""
import importlib
import pathlib
import sys

sys.dont_write_bytecode = True  # keep __pycache__ out of the source tree
FILES = {'amber': 'amber.glb', 'drink': 'drink.glb', 'hollow': 'hollow.glb',
         'ice_cube': 'ice-cube.glb', 'sample': 'sample.glb', 'slate': 'slate.glb',
         'stage': 'stage.exr', 'studio': 'studio.exr', 'window': 'window.exr'}


def main(folder, *names):
    for name in names or FILES:
        data = importlib.import_module(name).make()
        (pathlib.Path(folder) / FILES[name]).write_bytes(data)


if __name__ == '__main__':
    if len(sys.argv) < 2 or not set(sys.argv[2:]) <= set(FILES):
        sys.exit(__doc__)
    main(*sys.argv[1:])
