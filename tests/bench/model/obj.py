"""How long reading a large OBJ file takes.

obj.py FIRN [TRIANGLES]: writes a torus, with and without normals, and prints the CPU seconds of
`firn info`, reader and parent together, and its elapsed seconds, the best of three.
"""
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import time

TURNS = 3


def write(path, side, has_normals):
    """A closed torus of side times side vertices."""
    cos = [math.cos(2 * math.pi * i / side) for i in range(side)]
    sin = [math.sin(2 * math.pi * i / side) for i in range(side)]
    corner = '%d//%d' if has_normals else '%d'
    with open(path, 'w', encoding='ascii') as file:
        for c, s in zip(cos, sin):
            file.writelines('v %.6f %.6f %.6f\n' % (c * (2 + x), y, s * (2 + x))
                            for x, y in zip(cos, sin))
        for c, s in zip(cos, sin) if has_normals else ():
            file.writelines('vn %.6f %.6f %.6f\n' % (c * x, y, s * x) for x, y in zip(cos, sin))
        for i in range(side):
            this, other = i * side + 1, (i + 1) % side * side + 1
            for k in range(side):
                after = (k + 1) % side
                for face in ((this + k, this + after, other + k),
                             (other + k, this + after, other + after)):
                    file.write('f ' + ' '.join(
                        corner % ((v, v) if has_normals else v) for v in face) + '\n')


def measure(firn, path):
    before, start = os.times(), time.monotonic()
    subprocess.run((firn, 'info', path), check=True, stdout=subprocess.DEVNULL)
    elapsed, after = time.monotonic() - start, os.times()
    return (after.children_user + after.children_system - before.children_user -
            before.children_system, elapsed)


def main():
    side = math.isqrt(int(sys.argv[2]) // 2) if len(sys.argv) > 2 else 1414
    with tempfile.TemporaryDirectory() as folder:
        for name in ('positions', 'normals'):
            path = pathlib.Path(folder) / f'{name}.obj'
            write(path, side, name == 'normals')
            cpu, elapsed = (min(found) for found in zip(
                *(measure(sys.argv[1], path) for _ in range(TURNS))))
            print(f'{2 * side * side} triangles, {name}, {path.stat().st_size / 1e6:.0f} MB: '
                  f'{cpu:.2f} s of CPU, {elapsed:.2f} s')


main()
