"""drink.py: a tumbler of water with three ice cubes and a straw, on a wooden table."""
import math
import random

import surroundings as around
from files import Model, glass, unlit
from shapes import (Mesh, add, beads_mesh, crack, hollows, ice, lathe, mix, noise, rounded, scale,
                    smooth_normals, smoothstep, sub, tube, turned, unit, with_normals, worms)

BASE, FLOOR, HEIGHT = 0.0002, 0.0105, 0.09  # heights of the glass: foot, inner floor, rim
FOOT, RIM, WALL = 0.0335, 0.0395, 0.0024  # radii outside, and how thick the wall is at the rim
LEVEL = 0.066  # of the water
GLASS = glass('glass', 1.5, 3, 0.0024, (0.93, 0.97, 0.95), 0.1)
ICE = glass('ice', 1.31, 2, 0.028, (0.82, 0.957, 1), 1)
WATER = glass('water', 1.333, 1, 0.07, (0.746, 0.953, 1), 1)
AIR = glass('air', 1, 4, 0.0003)
# Where each cube is, how it is turned, and its half widths.
CUBES = (
    ((0.0155, 0.0552, 0.0059), (240.2, -2.6, 13), (0.014, 0.0136, 0.014)),
    ((-0.0131, 0.0553, -0.0045), (162.5, 11.1, 6.3), (0.0139, 0.0137, 0.0142)),
    ((-0.0071, 0.0285, 0.01), (217, 12.2, 6.7), (0.0138, 0.014, 0.0136)),
)
STRAW = ((0.0235, 0.0133, -0.0078), (-0.0335, 0.1341, -0.0462), 0.003)  # foot, top, radius


def inner_radius(y):
    return 0.0302 + (RIM - WALL - 0.0302) * (y - FLOOR) / (HEIGHT - FLOOR)


def tumbler():
    inner = inner_radius(FLOOR)
    return lathe(rounded((
        (0.0, 0.0014, 0), (FOOT * 0.62, 0.0014, 0.004), (FOOT * 0.8, BASE, 0.003),
        (FOOT, BASE, 0.0028), (RIM, HEIGHT, 0.0011), (RIM - WALL, HEIGHT, 0.0011),
        (inner, FLOOR, 0.006), (0.0, FLOOR + 0.0006, 0),
    ), 6), 90)


def water():
    """It reaches 30 % of the wall into the glass, so that there is no gap."""
    deep = 0.3 * WALL
    profile = [(0.0, FLOOR - 0.3 * 0.009, 0)]
    profile.append((inner_radius(FLOOR) + deep, FLOOR - 0.3 * 0.009, 0.006))
    edge = inner_radius(LEVEL + 0.0018)
    profile.append((edge + deep, LEVEL + 0.0018, 0))
    points = rounded(profile)
    points = [(r, y, (nr, ny)) for r, y, nr, ny in points[:-1]]
    points.append((edge + deep, LEVEL + 0.0018, None))
    for i in range(36):  # the water climbs at the glass
        r = edge * (1 - (i / 35) ** 2)  # the closer to the glass, the finer
        points.append((r, LEVEL + 0.0018 * math.exp(-(edge - r) / 0.0013), None))
    mesh = lathe(with_normals(points), 90)

    def wave(p):
        if p[1] < LEVEL - 0.0005:
            return p
        inside = smoothstep(0, 0.01, edge - math.hypot(p[0], p[2]))
        q = (p[0] / 0.011, 0.5, p[2] / 0.011)
        return (p[0], p[1] + inside * 0.00016 * noise(q, 4), p[2])
    mesh.points = [wave(p) for p in mesh.points]
    mesh.normals = smooth_normals(mesh.points, mesh.faces)
    return mesh


def straw():
    """Paper, open at both ends, with stripes."""
    foot, top, radius = STRAW
    ahead = unit(sub(top, foot))
    length = math.dist(foot, top)
    shares = [0.0]
    while shares[-1] < 1:  # each stripe begins and ends at a pair of near rings
        end = min(shares[-1] + 0.0105 / length, 1)
        shares += [end] if end == 1 else [end - 0.0002 / length, end]
    path = [mix(foot, top, share) for share in shares]
    outer = tube(path, lambda _: radius, 40, caps=False)
    inner = tube(path, lambda _: radius - 0.00035, 40, caps=False).inside_out()
    count = len(outer.points)
    mesh = Mesh(outer.points, outer.faces, outer.normals).join(inner)
    last = count - 40
    for k in range(40):  # both rims
        n = (k + 1) % 40
        mesh.faces += [(k, count + n, n), (k, count + k, count + n)]
        mesh.faces += [(last + k, last + n, count + last + n),
                       (last + k, count + last + n, count + last + k)]

    def stripes(p, _):
        along = sum(a * b for a, b in zip(sub(p, foot), ahead))
        return (0.88, 0.86, 0.8) if int(along / 0.0105 + 0.001) % 2 else (0.66, 0.04, 0.05)
    return mesh.painted(around.painter(stripes))


def cubes():
    return [ice(half, 20, 40 + 13 * i).placed(turned(*turn), at)
            for i, (at, turn, half) in enumerate(CUBES)]


def bubbles():
    """Eggs in the cores of the cubes, and beads on the inside of the glass and on its floor."""
    beads = []
    for i, (at, turn, half) in enumerate(CUBES):
        matrix = turned(*turn)
        for where, along, radius, length in worms((0, 0, 0), half, 95, 900 + i):
            where, along = (tuple(sum(a * b for a, b in zip(row, v)) for row in matrix)
                            for v in (where, along))
            beads.append((add(where, at), along, radius, length, 6))
    pick = random.Random(77)
    for _ in range(60):
        y = FLOOR + 0.007 + (LEVEL - FLOOR - 0.011) * pick.random()
        angle, radius = pick.uniform(0, 2 * math.pi), 0.0002 + 0.0005 * pick.random() ** 2
        r = inner_radius(y) - radius * 1.05
        beads.append(((r * math.cos(angle), y, r * math.sin(angle)), (0, 1, 0), radius, radius))
    return beads_mesh(beads)


def cracks():
    mesh = Mesh([], [], [])
    for i, (at, turn, _) in enumerate(CUBES):
        for k, tilt in enumerate(((70 + 9 * i, 20, 0), (15, 80 - 14 * i, 40),
                                   (-50, 40, 75 + 8 * i))):
            sheet = crack(0.0108 - 0.0016 * k, 300 + 10 * i + k)
            sheet.placed(turned(*tilt), scale((0.0022, -0.0018, 0.0026), 1 - k))
            mesh.join(sheet.placed(turned(*turn), at))
    return mesh


def table_light():
    """The foot's shadow, and the light that the glass gathers towards the eye."""
    shadow = around.shade([(0, 0, FOOT - 0.004)], 0.5, 0.013)

    def light(x, z):
        across, ahead = (x + 0.02) / 0.022, (z - 0.06) / 0.03
        gathered = 0.28 * math.exp(-across * across - ahead * ahead)
        far = smoothstep(-0.45, 0.25, z)
        return min((0.62 + 0.2 * far) * shadow(x, z) + gathered, 1)
    return light


def make():
    model = Model()
    wood = unlit('wood', model.texture(around.wood(21)))
    model.add('table', around.boards(9, 0.085, 1.1, table_light(), 40, 5), wood)
    model.add('wall', around.wall(-0.42, 0.75, -0.1, 0.75, ((0.09, 0.075, 0.06), (0.98, 0.9, 0.76)),
                                  (-0.05, 0.2, 0.33)), around.PAINTED)
    model.add('straw', straw(), around.PAINTED)
    model.add('water', water(), WATER)
    for i, cube in enumerate(cubes()):
        model.add(f'cube {i + 1}', cube, ICE)
    model.add('glass', tumbler(), GLASS)
    model.add('bubbles', bubbles(), AIR)
    model.add('cracks', cracks(), AIR)
    model.camera((0.012, 0.122, 0.262), (0.003, 0.056, 0), 30)
    return model.file()
