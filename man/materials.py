"""materials.py: generates docs/reference/materials.md on stdout from `firn list materials --json`.

Usage: materials.py FIRN
"""
import json
import sys

sys.dont_write_bytecode = True  # the source tree stays clean
from help import output_of  # noqa: E402

HEAD = '''# Materials

For users of `--material` and of the panel Material in `firn view`: all presets, with the sources
of their figures. `man/materials.py` generates this page from `firn list materials --json`.

    firn render statue.glb --material ruby -o ruby.png
    firn render statue.glb --material window-glass:frosted -o frosted.png
    firn render cup.gltf --material Cup=lead-crystal --material Tea=tea -o cup.png
    firn sheet sample --size 128x96 -o materials.png

- **Finish**: `NAME:rough` is a lightly ground surface (roughness 0.2), `NAME:frosted` a
  sandblasted one (0.5); both are chosen, not measured. `trace` and `reference` draw them, and
  `trace` is the default for them.
- **Index and Abbe number**: at 587.6 nm; for gems that split light, those of the ordinary ray or
  the mean. An empty Abbe number is no dispersion. A material with dispersion traces a path for
  each of red, green and blue.
- **Absorption**: 1/metre for linear red, green and blue, and the colour that remains after 1 cm.
  The scale of the model matters: files are in metres, so use `--scale` for others. A note says so
  if less than 1 % of the light passes. Objects of built-in scenes are 2 m wide and stand for
  objects of 28 mm: their absorption is scaled to that. "Colour of an example" means that no
  measurement was used, since it differs from piece to piece.
- **Scattering**: `cloudy-ice` and `glacier-ice` have the bubbles and cracks of `ice`, and a
  scattering medium that is densest in the core. `milk` is a medium of even density. Its optical
  depth is that across the object's width, of any size: real milk is much denser, and its phase
  function is not one of Henyey and Greenstein.
- **Whole files**: if a file has transmissive materials, `--material` replaces their index and,
  where the preset has them, dispersion, absorption and roughness.
- **Thin walls**: ice whose walls are thinner than its bubbles is clear, and a note says so. The
  mean thickness is twice the volume per surface area; the limit is 3 % of the diagonal of the
  bounding box. `--set cracks.count=2` and other settings of inclusions are kept.
'''


def number(value):
    return f'{value:.4g}'


def row(m):
    colored = max(m['absorption']) > 0
    depth = f'; optical depth {number(m["optical_depth"])}' if m['optical_depth'] else ''
    cells = (f'`{m["name"]}`', f'{m["ior"]:.4f}',
             number(m['abbe']) if m['abbe'] else '',
             ' '.join(map(number, m['absorption'])) if colored else '',
             ' '.join(f'{c:.3f}' for c in m['color_after_1_cm']) if colored else '',
             m['help'] + depth, m['source'])
    return '| ' + ' | '.join(cells) + ' |\n'


def page(firn):
    text, kind = HEAD, None
    for m in json.loads(output_of(firn, 'list', 'materials', '--json'))['materials']:
        if m['kind'] != kind:
            kind = m['kind']
            text += f'\n## {kind.capitalize()}\n\n'
            text += '| name | index | Abbe number | absorption, 1/m | after 1 cm | what '
            text += '| source |\n'
            text += '|---|---|---|---|---|---|---|\n'
        text += row(m)
    return text


if __name__ == '__main__':
    print(page(sys.argv[1]), end='')
