"""amber.py: model of two cherries, a leaf and a brass ring frozen in an ice block on slate."""
import math
import random

import surroundings as around
from files import Model, glass, unlit
from shapes import (Mesh, add, beads_mesh, crack, cross, ice, mix, noise, ring, scale,
                    smooth_normals, smoothstep, sphere, tube, turned, unit)

HALF = (0.036, 0.027, 0.026)
MIDDLE = (0, 0.0265, 0)
TURN = turned(-17)
ICE = glass('ice', 1.31, 2, 0.05, (0.72, 0.9, 1), 0.25)
AIR = glass('air', 1, 4, 0.0003)
CHERRIES = ((-0.0145, 0.0185, 0.004), 0.0105), ((0.0075, 0.0165, 0.0085), 0.0098)
KNOT = (0.001, 0.0415, 0.001)  # joint of both stems


def block():
    """The ice block; its base is flattened, as if melted onto the stone."""
    mesh = ice(HALF, 30, 5, exponent=9, waves=0.0004, cell=0.012, bulge=0.025).placed(TURN, MIDDLE)

    def pressed(p):
        x, y, z = p
        height = (y - 0.0007) / 0.0006
        soft = 0.0007 + 0.0006 * math.log1p(math.exp(height)) if height < 30 else y
        return (x, soft, z)
    mesh.points = [pressed(p) for p in mesh.points]
    mesh.normals = smooth_normals(mesh.points, mesh.faces)
    return mesh


def stem_of(center, radius):
    """Returns the path of a bent stem, from the dimple on top of a cherry to KNOT."""
    base = add(center, (0.0006, radius * 0.72, 0))
    bend = add(mix(base, KNOT, 0.5), ((base[0] - KNOT[0]) * 0.35, 0.002, 0.002))
    return [mix(mix(base, bend, i / 14), mix(bend, KNOT, i / 14), i / 14) for i in range(15)]


def cherry(center, radius, seed):
    mesh = sphere(1, 14)

    def grown(p):
        x, y, z = p
        across = math.hypot(x, z)
        dimple = 0.42 * math.exp(-(across / 0.3) ** 2) if y > 0 else 0.06 * math.exp(-across * 9)
        seam = 0.05 * math.exp(-(x / 0.1) ** 2) * smoothstep(-0.8, 0.6, y) * (z > 0)
        return add(center, scale((x * (1 - seam), y * 0.93 - math.copysign(dimple, y),
                                  z * (1 - seam)), radius))
    mesh.points = [grown(p) for p in mesh.points]
    mesh.normals = smooth_normals(mesh.points, mesh.faces)

    def skin(p, n):
        blush = noise(scale(p, 170), seed) * 0.5 + 0.5
        shine = max(n[0] * 0.35 + n[1] * 0.85 + n[2] * 0.4, 0) ** 40
        return add(mix((0.36, 0.012, 0.02), (0.62, 0.04, 0.03), blush), (0.3 * shine,) * 3)
    mesh.painted(around.painter(skin))
    stem = tube(stem_of(center, radius), lambda t: 0.00055 + 0.0007 * t ** 6, 12)
    return mesh.join(stem.painted(around.painter((0.3, 0.36, 0.07))))


def leaf(base, ahead, facing, length):
    """A thin leaf with a toothed edge and veins, curved along its width and length."""
    columns, rows = 16, 42
    side = unit(cross(ahead, facing))
    up = cross(side, ahead)
    points, colors = [], []
    for face in (1, -1):
        for j in range(rows + 1):
            s = j / rows
            width = 0.3 * length * math.sin(math.pi * s ** 0.8) ** 0.8 * (1 - 0.3 * s)
            width *= 1 - 0.07 * ((j * 0.5) % 1 > 0.4) if 0 < j < rows else 0
            for i in range(columns + 1):
                t = 2 * i / columns - 1
                height = (0.16 * width * t * t + 0.13 * length * s * (1 - s) * 2 +
                          0.012 * length * math.sin(9 * s + 3 * abs(t)) * abs(t))
                thick = 0.00015 * (1 - t * t) * min(1, 4 * s, 4 - 4 * s)
                at = add(scale(ahead, s * length), scale(side, width * t))
                points.append(add(add(base, at), scale(up, height + face * thick)))
                side_vein = math.exp(-((s * 6.5 - abs(t) * 1.1) % 1 - 0.5) ** 2 / 0.02)
                vein = max(math.exp(-(t / 0.08) ** 2), 0.45 * (1 - abs(t)) * side_vein)
                colors.append(mix((0.06, 0.2, 0.03), (0.3, 0.44, 0.14), vein))
    size = (rows + 1) * (columns + 1)
    faces = []
    for face in (0, 1):
        for j in range(rows):
            for i in range(columns):
                a = face * size + j * (columns + 1) + i
                quad = (a, a + 1, a + columns + 2, a + columns + 1)
                quad = quad[::-1] if face else quad
                faces += [(quad[0], quad[1], quad[2]), (quad[0], quad[2], quad[3])]
    mesh = Mesh(points, faces)
    shaded = around.painter((1, 1, 1), fill=0.5)
    mesh.colors = [tuple(a * b for a, b in zip(color, shaded(p, n)))
                   for color, p, n in zip(colors, mesh.points, mesh.normals)]
    return mesh


def band(center, radius, thick):
    """The brass ring, tilted."""
    turn = turned(35, 62, 10)
    path = [(radius * math.cos(a), 0, -radius * math.sin(a))
            for a in (2 * math.pi * i / 56 for i in range(56))]
    mesh = ring(path, thick, 16).placed(turn, center)

    def brass(_, n):
        shine = max(n[0] * -0.3 + n[1] * 0.7 + n[2] * 0.64, 0) ** 14
        sky = smoothstep(-0.3, 0.9, n[1])
        tone = mix((0.24, 0.13, 0.035), (0.92, 0.66, 0.24), sky)
        return add(tone, scale((0.6, 0.55, 0.4), shine))
    return mesh.painted(around.painter(brass, fill=0.6))


def bubbles(things):
    """Egg-shaped bubbles that point to the centre, outside `things`; a chain above a cherry."""
    rng = random.Random(12)
    beads = []
    taken = [p for thing in things for p in thing.points[::11]]
    for _ in range(90):
        d = unit([rng.gauss(0, 1) for _ in range(3)])
        share = 0.62 + 0.26 * rng.random()
        radius = 0.00016 + 0.0005 * rng.random() ** 3
        at = add(tuple(h * 0.9 * share * v for v, h in zip(d, HALF)), MIDDLE)
        length = radius * rng.uniform(1.4, 6)
        if all(math.dist(at, p) > length + 0.0015 for p in taken):
            beads.append((at, scale(d, -1), radius, length))
    for i in range(9):
        at = (0.0185 + 0.0006 * rng.uniform(-1, 1), 0.014 + 0.0032 * i, 0.012)
        beads.append((at, (0, 1, 0.1), 0.0004 + 0.00006 * i, 0.0005 + 0.00006 * i))
    return beads_mesh(beads)


def cracks():
    mesh = Mesh([], [], [])
    for i, (at, turn, size) in enumerate((
            ((0.017, 0.027, -0.0165), (20, 60, 30), 0.0088),
            ((-0.02, 0.039, -0.012), (-40, 15, 70), 0.009),
            ((0.022, 0.012, -0.011), (70, 100, 0), 0.008))):
        mesh.join(crack(size, 60 + i, gap=0.00009, bend=7).placed(turned(*turn), at))
    return mesh


def make():
    model = Model()
    stone = unlit('slate', model.texture(around.slate(8)))
    contacts = [(-0.017, 0.003, 0.016), (0.017, -0.003, 0.016), (0, 0, 0.02)]
    shadow = around.shade(contacts, 0.22, 0.011)
    model.add('table', around.floor(0.5, 0.16, lambda x, z: 0.92 * shadow(x, z), 44), stone)
    model.add('wall', around.wall(-0.4, 0.8, -0.1, 0.75, ((0.03, 0.035, 0.045), (0.62, 0.7, 0.78)),
                                  (0.08, 0.16, 0.26)), around.PAINTED)
    things = {f'cherry {i + 1}': cherry(*row, i) for i, row in enumerate(CHERRIES)}
    things['leaf'] = leaf(KNOT, unit((0.86, -0.5, 0.1)), unit((0.25, 0.45, 0.85)), 0.026)
    things['ring'] = band((-0.0015, 0.0105, -0.0125), 0.0085, 0.0011)
    for name, thing in things.items():
        model.add(name, thing, around.PAINTED)
    model.add('ice', block(), ICE)
    model.add('bubbles', bubbles(things.values()), AIR)
    model.add('cracks', cracks(), AIR)
    model.camera((0.03, 0.078, 0.185), (0.001, 0.0235, 0), 30)
    return model.file()
