"""drink.py: a cold tumbler of water with three ice cubes and a straw, on a wooden table."""
import math
import random

import surroundings as around
from files import Model, glass, lit, png
from shapes import (Mesh, add, beads_mesh, crack, cross, crowd, film, ice, ice_surface, lathe,
                    mix, noise, rounded, scale, smooth_normals, smoothstep, sub, turned, unit,
                    with_normals, worms)

BASE, FLOOR, HEIGHT = 0.0002, 0.0105, 0.09  # heights of the glass: foot, inner floor, rim
FOOT, RIM, WALL = 0.0335, 0.0395, 0.0024  # radii outside, and how thick the wall is at the rim
LEVEL = 0.066  # of the water
GLASS = glass('glass', 1.5, 3, 0.0024, (0.93, 0.97, 0.95), 0.1)
ICE = glass('ice', 1.31, 2, 0.028, (0.82, 0.957, 1), 1, cloud=13)
WATER = glass('water', 1.333, 1, 0.07, (0.746, 0.953, 1), 1)
AIR = glass('air', 1, 4, 0.0003)
# Where each cube is, how it is turned, and its half widths.
CUBES = (
    ((0.0153, 0.0566, 0.0058), (240.2, -9, 21), (0.014, 0.0136, 0.014)),
    ((-0.0131, 0.0603, -0.0045), (162.5, 17, -9), (0.0139, 0.0137, 0.0142)),
    ((-0.0071, 0.0303, 0.01), (217, 12.2, 6.7), (0.0138, 0.014, 0.0136)),
)
STRAW = ((-0.0195, 0.0137, 0.0), (0.0375, 0.1341, -0.036), 0.0026)  # foot, top, radius
DROPS = (1300, 0.00036, 0.0013)  # that are tried; least and greatest radius
TRACKS = 9  # of drops that ran down


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


PRINT = (128, 1024)  # texels around and along the straw


def paper():
    """Colours of the straw: a red stripe is wound around it once in 21 mm, and so is the paper,
    whose edge shows; fibres, and ink that has run a little."""
    width, height = PRINT
    length = math.dist(*STRAW[:2])
    rows = []
    for j in range(height):
        along = length * (j + 0.5) / height
        row = bytearray()
        for i in range(width):
            turn = (i + 0.5) / width
            c, s = math.cos(2 * math.pi * turn), math.sin(2 * math.pi * turn)
            at = (2.6 * c, 2.6 * s, 1000 * along)  # mm
            fibre = noise(scale(at, 2.2), 7) + 0.7 * noise((9 * at[0], 9 * at[1], at[2]), 8)
            stripe = (along / 0.021 + turn + 0.012 * noise(scale(at, 3), 9)) % 1
            edge = (along / 0.021 + turn + 0.27) % 1 < 0.012
            shade = 21 + 5 * fibre - (13 if edge else 0)
            row.append(int(min(max(shade, 0), 31)) + (32 if stripe < 0.5 else 0))
        rows.append(row)
    return png(rows, [*around.ramp([(.7, .68, .62), (.91, .89, .85), (.97, .96, .93)], 32),
                      *around.ramp([(.46, .1, .11), (.79, .17, .19), (.9, .33, .34)], 32)])


def straw():
    """Open at both ends, of paper()."""
    foot, top, radius = STRAW
    ahead = unit(sub(top, foot))
    side = unit(cross(ahead, (0, 0, 1)))
    up = cross(ahead, side)
    mesh = Mesh([], [], [])
    count = 41  # the last column is the first one, with other coordinates
    for r, out in ((radius, 1), (radius - 0.00035, -1)):
        for share in (0, 1):
            for k in range(count):
                a = 2 * math.pi * k / (count - 1)
                away = add(scale(side, math.cos(a)), scale(up, math.sin(a)))
                mesh.points.append(add(mix(foot, top, share), scale(away, r)))
                mesh.normals.append(scale(away, out))
                mesh.uvs.append((k / (count - 1), share) if out > 0 else (0.5, 0.075))
    for k in range(count - 1):
        a, b, c, d = (i * count + k for i in range(4))
        mesh.faces += [(a, a + 1, b + 1), (a, b + 1, b), (c, d + 1, c + 1), (c, d, d + 1),
                       (a, c + 1, a + 1), (a, c, c + 1), (b, b + 1, d + 1), (b, d + 1, d)]
    return mesh


FORM = {'exponent': 8, 'waves': 0.00075, 'cell': 0.0045, 'bulge': 0.07}  # of cubes


def cubes():
    return [ice(half, 46, 40 + 13 * i, **FORM).placed(turned(*turn), at)
            for i, (at, turn, half) in enumerate(CUBES)]


def clinging(cube, pick):
    """Places on a cube below the water, from which bubbles hang."""
    wet = [(p, n) for p, n in zip(cube.points, cube.normals) if p[1] < LEVEL - 0.003]
    for _ in range(70):
        at, normal = pick.choice(wet)
        radius = 0.00018 + 0.0005 * pick.random() ** 3
        yield add(at, scale(normal, 0.9 * radius)), (0, 1, 0), radius, radius


def bubbles():
    """Worms and eggs in the cubes, and beads on them, on the inside of the glass and its floor."""
    beads = []
    pick = random.Random(77)
    for i, ((at, turn, half), cube) in enumerate(zip(CUBES, cubes())):
        matrix = turned(*turn)
        inside = [*worms(half, 190, 900 + i, bend=0.6),
                  *crowd(half, 700, 940 + i, 0.00007, 0.0005)]
        for where, along, *form in inside:
            where, along = (tuple(sum(a * b for a, b in zip(row, v)) for row in matrix)
                            for v in (where, along))
            beads.append((add(where, at), along, *form))
        beads += clinging(cube, pick)
    for _ in range(60):
        y = FLOOR + 0.007 + (LEVEL - FLOOR - 0.011) * pick.random()
        angle, radius = pick.uniform(0, 2 * math.pi), 0.0002 + 0.0005 * pick.random() ** 2
        r = inner_radius(y) - radius * 1.05
        beads.append(((r * math.cos(angle), y, r * math.sin(angle)), (0, 1, 0), radius, radius))
    return beads_mesh(beads)


def cracks():
    """Sheets, each of which ends at its cube's surface, if it reaches it."""
    mesh = Mesh([], [], [])
    for i, (at, turn, half) in enumerate(CUBES):
        surface = ice_surface(half, 40 + 13 * i, **FORM)

        def is_inside(p, surface=surface, half=half):
            shares = [v / h for v, h in zip(p, half)]
            most = max(map(abs, shares))
            return math.hypot(*p) < 0.985 * math.hypot(*surface([v / most for v in shares]))
        for k, tilt in enumerate(((70 + 9 * i, 20, 0), (15, 80 - 14 * i, 40),
                                  (-50, 40, 75 + 8 * i), (35, -30 + 20 * i, 110),
                                  (95, 130, 10 + 25 * i))):
            radius = 0.0121 if k == 1 else 0.0112 - 0.0012 * k  # one goes through all of the cube
            aside = 1 - k if k < 3 else k - 4.5
            lean, away = turned(*tilt), scale((0.0022, -0.0018, 0.0026), aside)
            sheet = crack(radius, 300 + 10 * i + k, bend=16, is_inside=lambda p: is_inside(
                add(tuple(sum(a * b for a, b in zip(row, p)) for row in lean), away)))
            mesh.join(sheet.placed(lean, away).placed(turned(*turn), at))
    return mesh


def outer_radius(y):
    return FOOT + (RIM - FOOT) * (y - BASE) / (HEIGHT - BASE)


def scattered(pick):
    """Drops (angle, height, radius): large ones first, none on another one or in a track."""
    tries, least, most = DROPS
    bottom, top = 0.006, LEVEL + 0.003
    tracks = []
    for _ in range(TRACKS):
        high = bottom + (top - bottom) * pick.uniform(0.35, 0.95)
        low = high - pick.uniform(0.012, 0.04)
        tracks.append((pick.uniform(0, 2 * math.pi), max(low, bottom), high,
                       pick.uniform(0.0009, 0.0015)))
    kept = [(angle, low, 1.25 * half) for angle, low, _, half in tracks]
    radii = sorted(((least ** -1.2 + pick.random() * (most ** -1.2 - least ** -1.2)) ** (-1 / 1.2)
                    for _ in range(tries)), reverse=True)
    for radius in radii:
        angle, y = pick.uniform(0, 2 * math.pi), pick.uniform(bottom, top)
        if any(low < y < high and abs(math.remainder(angle - a, 2 * math.pi)) * FOOT < half
               for a, low, high, half in tracks):
            continue
        across = outer_radius(y)
        if all(math.hypot(math.remainder(angle - a, 2 * math.pi) * across, y - b) >
               1.1 * (radius + r) for a, b, r in kept):
            kept.append((angle, y, radius))
    return kept


def drop(angle, y, radius):
    """A cap of water that hangs a little, and reaches into the glass."""
    segments, rings = (7, 1) if radius < 0.0003 else (9, 2) if radius < 0.0006 else (14, 4)
    slope = (RIM - FOOT) / (HEIGHT - BASE)
    c, s = math.cos(angle), math.sin(angle)
    up = unit((slope * c, 1, slope * s))
    aside, out = (-s, 0, c), unit((c, -slope, s))
    middle = (outer_radius(y) * c, y, outer_radius(y) * s)
    contact = math.radians(55)
    ball = radius / math.sin(contact)

    def at(share, turn, deep=0.0):
        flat = radius * share
        high = math.sqrt(ball * ball - flat * flat) - ball * math.cos(contact) - deep
        v = 1.12 * flat * math.sin(turn) - 0.3 * max(high, 0)
        return add(middle, add(scale(aside, flat * math.cos(turn)),
                               add(scale(up, v), scale(out, high))))
    turns = [2 * math.pi * k / segments for k in range(segments)]
    points = [at(0, 0)]
    for i in range(1, rings + 2):
        share = math.sin(i / (rings + 1) * math.pi / 2)
        points += [at(share, turn) for turn in turns]
    points += [at(0.97, turn, 0.0003) for turn in turns]
    points.append(add(middle, scale(out, -0.0003)))
    faces = []
    last = len(points) - 1
    for k in range(segments):
        n = (k + 1) % segments
        faces.append((0, 1 + n, 1 + k))
        for i in range(rings + 1):
            a, b = 1 + i * segments, 1 + (i + 1) * segments
            faces += [(a + k, a + n, b + n), (a + k, b + n, b + k)]
        faces.append((last, last - segments + k, last - segments + n))
    return Mesh(points, faces)


def dew():
    mesh = Mesh([], [], [])
    for row in scattered(random.Random(55)):
        mesh.join(drop(*row))
    return mesh


def spilled():
    """The ring of water that has run down the glass, and drops beside it."""
    pick = random.Random(91)

    def outline(middle, uneven, seed):
        def at(angle):
            c, s = math.cos(angle), math.sin(angle)
            out = middle * (1 + uneven * noise((2 * c + seed, 2 * s, seed), seed) +
                            0.4 * uneven * noise((6 * c, 6 * s + seed, seed), seed + 1))
            return out * c, -out * s
        return at
    mesh = film(outline(FOOT + 0.0006, 0.03, 5), 0, 0.0006, 0.0011)
    for angle, away, radius in ((-70, 0.047, 0.0022), (-52, 0.0425, 0.0012), (-63, 0.053, 0.0009),
                                (-118, 0.046, 0.0016), (-20, 0.046, 0.0012), (160, 0.049, 0.0019)):
        angle = math.radians(angle + pick.uniform(-4, 4))
        mesh.join(film(outline(radius, 0.16, round(1e5 * radius)), 0, 0.28 * radius + 0.0002,
                       0.9 * radius, (away * math.cos(angle), -away * math.sin(angle)),
                       segments=48))
    return mesh


def lamplit(x, z):
    """The table's light: less of it farther from the window to the left, behind."""
    return 1 - 0.72 * smoothstep(-0.16, 0.2, x + 0.4 * z)


def make():
    model = Model()
    years, fibres = (model.texture(data) for data in around.wood(21, width=256))
    wood = lit('wood', 1, baseColorTexture={'index': years},
               metallicRoughnessTexture={'index': fibres})
    model.add('table', around.boards(9, 0.085, 1.1, lamplit, 12, 1), wood)
    printed = model.texture(paper())
    model.add('straw', straw(), lit('straw', 0.5, baseColorTexture={'index': printed}))
    model.add('water', water(), WATER)
    model.add('spilled', spilled(), WATER)
    for i, cube in enumerate(cubes()):
        model.add(f'cube {i + 1}', cube, ICE)
    model.add('glass', tumbler(), GLASS)
    model.add('dew', dew(), WATER)
    model.add('bubbles', bubbles(), AIR)
    model.add('cracks', cracks(), AIR)
    model.camera((0.0135, 0.092, 0.262), (0.002, 0.0475, 0), 26)
    return model.file()
