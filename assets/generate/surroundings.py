"""surroundings.py: surfaces around the models (slate, tiles, floor, wall), and baked light."""
import math

from files import png, unlit
from shapes import lattice, mix, scale, sheet, smoothstep


def ramp(colors, count=64):
    """Returns a palette that interpolates evenly spaced colours linearly."""
    out = []
    for i in range(count):
        t = i / (count - 1) * (len(colors) - 1)
        k = min(int(t), len(colors) - 2)
        out.append(mix(colors[k], colors[k + 1], t - k))
    return out


def row_noise(count, cells, seed):
    """One row of tileable value noise, 0 to 1."""
    knots = [lattice(i, 0, 0, seed) for i in range(cells)]
    out = []
    for i in range(count):
        x = i * cells / count
        k = int(x)
        t = x - k
        t = t * t * (3 - 2 * t)
        out.append(knots[k % cells] + (knots[(k + 1) % cells] - knots[k % cells]) * t)
    return out


def slate(seed, side=256):
    """PNG: tileable texture of dark split stone."""
    rows = [bytearray(side) for _ in range(side)]
    layers = [[row_noise(side, cells, seed + cells * 31 + k) for k in range(cells)]
              for cells in (4, 9, 23, 64)]
    for y in range(side):
        total = [0.0] * side
        for layer, weight in zip(layers, (22, 17, 13, 12)):
            at = y * len(layer) / side
            k = int(at)
            t = smoothstep(0, 1, at - k)
            a, b = layer[k], layer[(k + 1) % len(layer)]
            total = [s + weight * (p + (q - p) * t) for s, p, q in zip(total, a, b)]
        rows[y][:] = bytes(int(min(max(value - 6 + 7 * lattice(x, y, 2, seed), 0), 63))
                           for x, value in enumerate(total))
    return png(rows, ramp([(.16, .165, .175), (.27, .28, .295), (.38, .39, .41), (.54, .54, .53)]))


def tiles(seed, side=256):
    """PNG: 2 x 2 floor tiles, alternately light and dark, with joints."""
    half = side // 2
    rows = []
    for y in range(side):
        row = bytearray()
        for x in range(side):
            edge = min(x % half, y % half, half - 1 - x % half, half - 1 - y % half)
            if edge < 2:
                row.append(0)
                continue
            dark = (x < half) != (y < half)
            row.append((8 if dark else 40) + int(6 * lattice(x // 2, y // 2, dark, seed)) +
                       int(9 * lattice(x // 9, y, 3, seed)))
        rows.append(row)
    return png(rows, ramp([(.15, .14, .13), (.17, .27, .31), (.30, .42, .45), (.78, .75, .69),
                           (.93, .91, .86)]))


def floor(half, tile, light, steps=30):
    """Horizontal square at height 0 with a texture of period `tile`, coloured by light(x, z)."""
    mesh = sheet((-half, 0, half), (2 * half, 0, 0), (0, 0, -2 * half), steps, steps)
    mesh.uvs = [(x / tile, z / tile) for x, _, z in mesh.points]
    return mesh.painted(lambda p, n: (light(p[0], p[2]),) * 3)


def shade(centers, dark, reach):
    """Returns a function of x and z: baked light with contact shadows of discs (x, z, radius)."""
    def light(x, z):
        value = 1.0
        for cx, cz, radius in centers:
            d = math.hypot(x - cx, z - cz) - radius
            value *= 1 - dark * (1.0 if d < 0 else math.exp(-d / reach))
        return value
    return light


def wall(z, half, bottom, top, colors, spot):
    """Wall that faces the camera, brightest at `spot` (x, y, radius)."""
    dark, bright = colors
    mesh = sheet((-half, bottom, z), (2 * half, 0, 0), (0, top - bottom, 0), 32, 24)
    mesh.uvs = []

    def color(p, _):
        d = math.hypot((p[0] - spot[0]) / spot[2], (p[1] - spot[1]) / spot[2])
        return mix(dark, bright, math.exp(-d * d))
    return mesh.painted(color)


def painter(albedo, key=(0.5, 0.75, 0.45), fill=0.42):
    """Returns a function of point and normal: baked colour under a soft key and ambient light."""
    length = math.hypot(*key)
    key = scale(key, 1 / length)

    def color(p, n):
        lit = max(n[0] * key[0] + n[1] * key[1] + n[2] * key[2] + 0.25, 0) / 1.25
        share = fill * (0.75 + 0.25 * n[1]) + (1 - fill) * lit
        base = albedo(p, n) if callable(albedo) else albedo
        return tuple(min(c * share, 1) for c in base)
    return color


PAINTED = unlit('painted')  # vertex colours only
