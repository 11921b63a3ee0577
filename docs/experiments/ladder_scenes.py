"""ladder_scenes.py: generates two objects and a panorama for ladder.sh and bounce_options.py.

Usage: ladder_scenes.py FOLDER
"""
import math
import pathlib
import sys

STEPS = 96  # segments along an edge of the rounded cube, and around the tube of the torus
TURNS = 192  # segments around the axis of the torus
ROUND = 0.3  # radius of the cube's edges; its half width is 1
RING, TUBE = 0.8, 0.35  # major and minor radius of the torus
WIDTH = 1024  # width of the panorama, pixels


def write_obj(path, grids):
    """Writes grids of (point, normal) as an OBJ file of triangles that face outwards."""
    lines, first = [], 1
    for rows in grids:
        across = len(rows[0])
        for row in rows:
            for point, normal in row:
                lines.append('v {:.7f} {:.7f} {:.7f}'.format(*point))
                lines.append('vn {:.7f} {:.7f} {:.7f}'.format(*normal))
        for y in range(len(rows) - 1):
            for x in range(across - 1):
                a = first + y * across + x
                b, c, d = a + 1, a + across + 1, a + across
                lines.append(f'f {a}//{a} {b}//{b} {c}//{c}')
                lines.append(f'f {a}//{a} {c}//{c} {d}//{d}')
        first += across * len(rows)
    path.write_text('\n'.join(lines) + '\n')


def on_rounded_cube(point):
    """Projects a point of the enclosing cube; returns point and normal of the rounded cube."""
    core = [max(-1 + ROUND, min(1 - ROUND, c)) for c in point]
    away = [p - c for p, c in zip(point, core)]
    length = math.sqrt(sum(a * a for a in away))
    normal = [a / length for a in away]
    return [c + ROUND * n for c, n in zip(core, normal)], normal


def rounded_cube():
    """Yields a grid for each face, finer at the rounded edges."""
    flat = [-1 + ROUND + 2 * (1 - ROUND) * i / (STEPS // 3) for i in range(STEPS // 3 + 1)]
    curve = [1 - ROUND + ROUND * math.tan(math.pi / 4 * i / (STEPS // 3))
             for i in range(1, STEPS // 3 + 1)]
    line = [-c for c in reversed(curve)] + flat + curve
    for axis in range(3):
        for side in (-1, 1):
            rows = []
            for v in line:
                row = []
                for u in line[::side]:
                    point = [0.0, 0.0, 0.0]
                    point[axis] = side
                    point[(axis + 1) % 3], point[(axis + 2) % 3] = u, v
                    row.append(on_rounded_cube(point))
                rows.append(row)
            yield rows


def torus():
    rows = []
    for y in range(STEPS + 1):
        tube = 2 * math.pi * y / STEPS
        row = []
        for x in range(TURNS + 1):
            turn = -2 * math.pi * x / TURNS
            normal = [math.cos(tube) * math.cos(turn), math.sin(tube),
                      math.cos(tube) * math.sin(turn)]
            row.append(([RING * math.cos(turn) + TUBE * normal[0], TUBE * normal[1],
                         RING * math.sin(turn) + TUBE * normal[2]], normal))
        rows.append(row)
    yield rows


def radiance(azimuth, elevation):
    """Radiance of hills, a sky with a glow around the sun, and a checkered ground."""
    hill = 0.14 + 0.07 * math.sin(3 * azimuth) + 0.05 * math.sin(7 * azimuth + 1)
    if elevation > hill:
        sun = math.cos(azimuth - 1) * math.cos(elevation) * 0.8 + math.sin(elevation) * 0.6
        glow = 6 * max(sun, 0) ** 200 + 0.3 * max(sun, 0) ** 4
        blue = min(1.0, 0.3 + elevation)
        return [0.75 - 0.5 * blue + glow, 0.85 - 0.3 * blue + glow, 0.95 + glow * 0.8]
    if elevation > 0:
        stripe = 0.6 + 0.4 * math.sin(40 * azimuth + 30 * elevation)
        return [0.32 * stripe, 0.3 * stripe, 0.34 * stripe]
    far = min(40.0, 1 / math.tan(max(-elevation, 0.02)))
    x, y = far * math.cos(azimuth), far * math.sin(azimuth)
    light = (math.floor(x) + math.floor(y)) % 2
    return [0.1 + 0.25 * light, 0.22 + 0.2 * light, 0.06 + 0.1 * light]


def write_hdr(path):
    """Writes the panorama as an uncompressed Radiance RGBE file."""
    data = bytearray()
    height = WIDTH // 2
    for y in range(height):
        for x in range(WIDTH):
            color = radiance(2 * math.pi * (x + 0.5) / WIDTH, math.pi * (0.5 - (y + 0.5) / height))
            _, exponent = math.frexp(max(color))
            data += bytes(int(c * 256 / 2 ** exponent) for c in color) + bytes([exponent + 128])
    path.write_bytes(b'#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n' +
                     f'-Y {height} +X {WIDTH}\n'.encode() + data)


folder = pathlib.Path(sys.argv[1])
folder.mkdir(parents=True, exist_ok=True)
write_obj(folder / 'rounded-cube.obj', rounded_cube())
write_obj(folder / 'torus.obj', torus())
write_hdr(folder / 'around.hdr')
