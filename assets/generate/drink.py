"""drink.py: model of a cold tumbler of water with three ice cubes and a straw, on a table."""
import math
import random

import boards
import surroundings as around
from files import TRANSMISSION, Model, glass, lit, png
from shapes import (Mesh, add, beads_mesh, crack, cross, crowd, dot, ice, ice_surface, lathe,
                    lattice, mix, noise, puddle, rounded, scale, smooth_normals, smoothstep, sub,
                    turned, unit, with_normals, worms)

BASE, FLOOR, HEIGHT = 0.0002, 0.0122, 0.1  # heights of the tumbler's foot, inner bottom and rim
FOOT, RIM, WALL = 0.033, 0.039, 0.0025  # outer radii of the tumbler; wall thickness at the rim
LEVEL = 0.07  # height of the water surface
GLASS = glass('glass', 1.5, 3, 0.0024, (0.93, 0.97, 0.95), 0.1)
ICE = glass('ice', 1.31, 2, 0.028, (0.82, 0.957, 1), 1, cloud=2.5)
WATER = glass('water', 1.333, 1, 0.07, (0.746, 0.953, 1), 1)
AIR = glass('air', 1, 4, 0.0003)
# Position, rotation (degrees, see turned()) and half extents of each ice cube.
CUBES = (
    ((0.01524, 0.06109, -0.00088), (10.8, -12.4, -113.9), (0.014, 0.0136, 0.014)),
    ((-0.01458, 0.05965, 0.00326), (139.3, -68.5, 47.5), (0.0139, 0.0137, 0.0142)),
    ((0.00749, 0.0367, 0.01051), (-176.0, 13.7, -68.6), (0.0138, 0.014, 0.0136)),
)
STRAW = ((-0.0208, 0.0154, -0.0024), (0.035, 0.1441, -0.036), 0.0026)  # lower, upper end; radius
DROPS = (1060, 0.00044, 0.0013)  # dew drops: number of attempts; smallest and largest radius
DEW = (0.0125, 0.0745)  # lowest and highest dew, heights in metres
GREASE = 0.22  # fraction of light that the densest grease scatters
FOG = 0.114  # scattering of the densest fog, as a fraction of GREASE
# Fingerprints on the dry glass: azimuth, height, tilt (radians), half width and half height
FINGERPRINTS = ((1.94, 0.0862, 0.35, 0.0062, 0.0082), (2.16, 0.0812, 0.5, 0.006, 0.0085),
                (1.27, 0.0868, -0.2, 0.0058, 0.0078))
TRAILS = 13  # number of trails of drops that ran down


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
    """The water, which overlaps the glass by 30 % of the wall thickness to avoid gaps."""
    deep = 0.3 * WALL
    profile = [(0.0, FLOOR - 0.3 * 0.009, 0)]
    profile.append((inner_radius(FLOOR) + deep, FLOOR - 0.3 * 0.009, 0.006))
    edge = inner_radius(LEVEL + 0.0018)
    profile.append((edge + deep, LEVEL + 0.0018, 0))
    points = rounded(profile)
    points = [(r, y, (nr, ny)) for r, y, nr, ny in points[:-1]]
    points.append((edge + deep, LEVEL + 0.0018, None))
    for i in range(56):  # meniscus at the glass
        r = edge * (1 - (i / 55) ** 2)  # finer rings towards the glass
        points.append((r, LEVEL + 0.0018 * math.exp(-(edge - r) / 0.0013), None))
    mesh = lathe(with_normals(points), 120)
    ice_cubes = [(at, tuple(zip(*turned(*turn))), relative_radius(i))
                 for i, (at, turn, _) in enumerate(CUBES)]
    foot, top, thick = STRAW
    along = unit(sub(top, foot))

    def rise(p):
        """Height of the meniscus at ice and straw, lower where the glass raises the water."""
        gap = math.dist(p, add(foot, scale(along, dot(sub(p, foot), along)))) - thick
        for at, back, share in ice_cubes:
            q = sub(p, at)
            gap = min(gap, math.hypot(*q) * (1 - 1 / share(tuple(dot(row, q) for row in back))))
        return 0.0013 * math.exp(-max(gap, 0) / 0.0014) * max(1 - (p[1] - LEVEL) / 0.0018, 0)

    def wave(p):
        if p[1] < LEVEL - 0.0005:
            return p
        inside = smoothstep(0, 0.01, edge - math.hypot(p[0], p[2]))
        q = (p[0] / 0.011, 0.5, p[2] / 0.011)
        return (p[0], p[1] + inside * 0.00016 * noise(q, 4) + rise(p), p[2])
    mesh.points = [wave(p) for p in mesh.points]
    mesh.normals = smooth_normals(mesh.points, mesh.faces)
    return mesh


STRAW_RINGS = 16  # rings of quads along the straw
STRAW_TEXELS = (128, 1024)  # texels of the straw's texture, around and along it


def paper():
    """PNG of the paper straw: a red stripe and the edge of the paper strip wind around it once in
    21 mm. The paper has fibres and bled ink, and is darker and more saturated where wet."""
    width, height = STRAW_TEXELS
    foot, top, _ = STRAW
    length = math.dist(foot, top)
    rows = []
    for j in range(height):
        along = length * (j + 0.5) / height
        high = foot[1] + (top[1] - foot[1]) * (j + 0.5) / height - LEVEL
        row = bytearray()
        for i in range(width):
            turn = (i + 0.5) / width
            c, s = math.cos(2 * math.pi * turn), math.sin(2 * math.pi * turn)
            at = (2.6 * c, 2.6 * s, 1000 * along)  # mm
            fibre = noise(scale(at, 2.2), 7) + 0.7 * noise((9 * at[0], 9 * at[1], at[2]), 8)
            stripe = (along / 0.021 + turn + 0.012 * noise(scale(at, 3), 9)) % 1
            edge = (along / 0.021 + turn + 0.27) % 1 < 0.012
            is_wet = high < 0.0035 + 0.0012 * noise(scale(at, 0.6), 10)  # water soaks up the paper
            shade = 19 + 7 * fibre - (13 if edge else 0)
            row.append(int(min(max(shade, 0), 31)) + (32 if stripe < 0.5 else 0) +
                       (64 if is_wet else 0))
        rows.append(row)
    dry = [*around.ramp([(.58, .56, .51), (.8, .78, .74), (.89, .875, .84)], 32),
           *around.ramp([(.36, .07, .08), (.66, .11, .13), (.78, .24, .25)], 32)]
    wet = [tuple(0.86 * v ** 1.45 for v in color) for color in dry]
    return png(rows, dry + wet)


def straw():
    """The straw: a tube open at both ends, textured by paper()."""
    foot, top, radius = STRAW
    ahead = unit(sub(top, foot))
    side = unit(cross(ahead, (0, 0, 1)))
    up = cross(ahead, side)
    mesh = Mesh([], [], [])
    count = 41  # last column: same points as the first, u = 1 instead of 0
    # Strips of rings: outside upwards, upper cut, inside downwards, lower cut. The walls have many
    # rings: the bounding box of a long slanted triangle is as large as the straw's, and slows BVHs.
    thin = radius - 0.00048
    for r, end_r, share, end_share, out, steps in (
            (radius, radius, 0, 1, 1, STRAW_RINGS), (radius, thin, 1, 1, 0, 1),
            (thin, thin, 1, 0, -1, STRAW_RINGS), (thin, radius, 0, 0, 0, 1)):
        for i in range(steps + 1):
            first = len(mesh.points)
            t = i / steps
            at = share + t * (end_share - share)
            for k in range(count):
                a = 2 * math.pi * k / (count - 1)
                away = add(scale(side, math.cos(a)), scale(up, math.sin(a)))
                mesh.points.append(add(mix(foot, top, at), scale(away, r + t * (end_r - r))))
                mesh.normals.append(scale(away, out) if out else scale(ahead, 2 * at - 1))
                mesh.uvs.append((k / (count - 1), at) if out > 0 else (0.5, 0.075))
            for a in range(first, first + count - 1 if i < steps else first):
                b = a + count
                mesh.faces += [(a, a + 1, b + 1), (a, b + 1, b)]
    return mesh


# Shape of the ice cubes, and chips broken off each cube: direction in the object space of the cube,
# distance of the fracture plane from its centre.
FORM = {'exponent': 9, 'waves': 0.00045, 'cell': 0.007, 'bulge': 0.04, 'fine': 0.1}
CHIPS = (
    (((0.885, 0.379, 0.27), 0.0184), ((0.199, -0.075, -0.977), 0.0169)),
    (((-0.839, 0.428, -0.336), 0.0181), ((0.426, 0.096, -0.899), 0.0173)),
    (((0.576, 0.135, -0.806), 0.0176), ((0.724, -0.57, 0.389), 0.0171)),
)


def form(i):
    """Returns the arguments of ice_surface() for the shape of cube `i`."""
    return {**FORM, 'chips': [(unit(direction), distance) for direction, distance in CHIPS[i]]}


def relative_radius(i):
    """Returns a function of a point in the object space of cube `i`: the distance from the centre,
    as a fraction of the distance of the surface."""
    half = CUBES[i][2]
    surface = ice_surface(half, 40 + 13 * i, **form(i))

    def at(p):
        shares = [v / h for v, h in zip(p, half)]
        most = max(map(abs, shares))
        return math.hypot(*p) / math.hypot(*surface([v / most for v in shares]))
    return at


def cubes():
    return [ice(half, 46, 40 + 13 * i, **form(i)).placed(turned(*turn), at)
            for i, (at, turn, half) in enumerate(CUBES)]


SUBMERGED = 0.917  # submerged fraction of floating ice (Archimedes)


def volume_above(mesh, level):
    """Volume of a closed mesh above a level: sum of projected area times mean height of faces."""
    volume = 0.0
    for face in mesh.faces:
        a, b, c = (mesh.points[i] for i in face)
        low, mid, high = sorted(p[1] - level for p in (a, b, c))
        mean = (low + mid + high) / 3 if mid > 0 else 0.0
        if low < 0 < mid:
            mean -= low ** 3 / (3 * (mid - low) * (high - low))
        elif mid <= 0 < high:
            mean = high ** 3 / (3 * (high - low) * (high - mid))
        volume += mean * cross(sub(b, a), sub(c, a))[1] / 2
    return volume


def check_floating(ice_cubes):
    """
    Asserts that the ice floats in equilibrium: the cubes together displace their weight, no cube
    intersects the glass, the straw or another cube, and the lowest cube, whose buoyancy lifts the
    other two, touches both.
    """
    out, all_of = (sum(volume_above(cube, level) for cube in ice_cubes) for level in (LEVEL, -1))
    assert abs(out / all_of - (1 - SUBMERGED)) < 0.001, f'{out / all_of:.4f} of the ice is dry'
    foot, top, thick = STRAW
    along = unit(sub(top, foot))
    gaps = {}
    for i, cube in enumerate(ice_cubes):
        for p in cube.points:
            assert math.hypot(p[0], p[2]) < inner_radius(p[1]) - 0.0002, f'cube {i + 1}, glass'
            assert math.dist(p, add(foot, scale(along, dot(sub(p, foot), along)))) > thick, (
                f'cube {i + 1}, straw')
        assert min(p[1] for p in cube.points) > FLOOR + 0.0006, f'cube {i + 1}, floor'
        for k, (at, turn, _) in enumerate(CUBES):
            back, share = tuple(zip(*turned(*turn))), relative_radius(k)
            near = (sub(p, at) for p in cube.points if k != i and math.dist(p, at) < 0.021)
            gaps[i, k] = min((math.hypot(*p) * (1 - 1 / share(tuple(dot(row, p) for row in back)))
                              for p in near), default=1)
    assert min(gaps.values()) > 0, 'a cube is in another one'
    assert max(min(gaps[2, k], gaps[k, 2]) for k in (0, 1)) < 0.0004, 'the lowest lifts nothing'
    return ice_cubes


def clinging_bubbles(cube, rng):
    """Yields bubbles that cling to the submerged surface of an ice cube."""
    wet = [(p, n) for p, n in zip(cube.points, cube.normals) if p[1] < LEVEL - 0.003]
    for _ in range(32):
        at, normal = rng.choice(wet)
        radius = 0.00024 + 0.00045 * rng.random() ** 3
        yield add(at, scale(normal, 0.9 * radius)), (0, 1, 0), radius, radius


def bubbles():
    """Worm- and egg-shaped bubbles in the cubes, round bubbles on the cubes and the glass."""
    beads = []
    rng = random.Random(77)
    for i, ((at, turn, half), cube) in enumerate(zip(CUBES, cubes())):
        matrix = turned(*turn)
        inside = [*worms(half, 60, 900 + i, bend=0.6),
                  *crowd(half, 110, 940 + i, 0.0002, 0.0006)]
        for where, along, *form in inside:
            where, along = (tuple(sum(a * b for a, b in zip(row, v)) for row in matrix)
                            for v in (where, along))
            beads.append((add(where, at), along, *form))
        beads += clinging_bubbles(cube, rng)
    for _ in range(60):
        y = FLOOR + 0.007 + (LEVEL - FLOOR - 0.011) * rng.random()
        angle, radius = rng.uniform(0, 2 * math.pi), 0.0002 + 0.0005 * rng.random() ** 2
        r = inner_radius(y) - radius * 1.05
        beads.append(((r * math.cos(angle), y, r * math.sin(angle)), (0, 1, 0), radius, radius))
    return beads_mesh(beads)


# Cracks near the tops of the upper cubes that reflect a window: index of the cube, rotation and
# position in the object space of the cube, radius.
MIRROR_CRACKS = (
    (1, (73, 57), (0.0017, 0.0052, 0.0078), 0.0085),
    (0, (-34, 68), (-0.0077, -0.006, 0.0037), 0.0075),
)


def cracks():
    """Cracks: thin sheets of air, clipped at the surface of their cube."""
    mesh = Mesh([], [], [])

    def split(i, lean, away, radius, seed):
        at, turn, _ = CUBES[i]
        share = relative_radius(i)
        whole = crack(radius, seed, bend=16, is_inside=lambda p: share(
            add(tuple(dot(row, p) for row in lean), away)) < 0.985)
        mesh.join(whole.placed(lean, away).placed(turned(*turn), at))
    for i in range(len(CUBES)):
        for k, tilt in enumerate(((70 + 9 * i, 20, 0), (15, 80 - 14 * i, 40),
                                  (-50, 40, 75 + 8 * i), (35, -30 + 20 * i, 110),
                                  (95, 130, 10 + 25 * i))):
            if (i, k) in ((1, 1), (2, 0), (0, 4), (1, 4), (2, 2), (2, 4)):  # white, or crowded
                continue
            radius = 0.0121 if k == 1 else 0.0112 - 0.0012 * k  # spans the cube
            aside = 1 - k if k < 3 else k - 4.5
            split(i, turned(*tilt), scale((0.0022, -0.0018, 0.0026), aside), radius,
                  300 + 10 * i + k)
    for k, (i, tilt, away, radius) in enumerate(MIRROR_CRACKS):
        split(i, turned(*tilt), away, radius, 360 + k)
    return mesh


def outer_radius(y):
    return FOOT + (RIM - FOOT) * (y - BASE) / (HEIGHT - BASE)


def drop_trails(rng):
    """Yields trails of drops that ran down: azimuth, lower and upper height, half width."""
    for _ in range(TRAILS):
        high = DEW[0] + (DEW[1] - DEW[0]) * rng.uniform(0.35, 0.95)
        low = high - rng.uniform(0.012, 0.045)
        yield rng.uniform(0, 2 * math.pi), max(low, DEW[0]), high, rng.uniform(0.0009, 0.002)


def dew_density(angle, y):
    """Density of the dew, 0 to 1, between irregular limits above the table and the water level."""
    c, s = math.cos(angle), math.sin(angle)
    uneven = noise((2.2 * c, 2.2 * s, 60 * y), 21) + 0.5 * noise((7 * c, 7 * s, 200 * y), 22)
    top = DEW[1] + 0.0016 * uneven
    return (smoothstep(top + 0.0015, top - 0.004, y) *
            smoothstep(DEW[0] - 0.001, DEW[0] + 0.004 + 0.002 * uneven, y))


def scatter_drops(rng, trails):
    """Dew drops (azimuth, height, radius) by dart throwing, largest first, without overlaps."""
    tries, least, most = DROPS
    steep = 1.7  # power law: density of radii ~ radius ** -2.7
    kept = [(angle, low, 1.25 * half) for angle, low, _, half in trails]
    near = {}  # drops by grid cell (3 mm), each in 9 cells

    def cells(angle, y):
        i, j = int(angle * FOOT / 0.003), int(y / 0.003)
        return [(a, b) for a in (i - 1, i, i + 1) for b in (j - 1, j, j + 1)]

    def keep(circle):
        for cell in cells(*circle[:2]):
            near.setdefault(cell, []).append(circle)
    for circle in kept:
        keep(circle)
    radii = sorted(((least ** -steep + rng.random() * (most ** -steep - least ** -steep)) **
                    (-1 / steep) for _ in range(tries)), reverse=True)
    for radius in radii:
        angle, y = rng.uniform(0, 2 * math.pi), rng.uniform(DEW[0], DEW[1] + 0.002)
        if rng.random() > dew_density(angle, y) or any(
                low < y < high and abs(math.remainder(angle - a, 2 * math.pi)) * FOOT < half
                for a, low, high, half in trails):
            continue
        across = outer_radius(y)
        if all(math.hypot(math.remainder(angle - a, 2 * math.pi) * across, y - b) >
               1.12 * (radius + r) for a, b, r in near.get(cells(angle, y)[4], ())):
            kept.append((angle, y, radius))
            keep(kept[-1])
    return kept


def drop(angle, y, radius):
    """Mesh of a drop: a slightly sagging, irregular spherical cap that overlaps the glass."""
    segments, rings = (9, 2) if radius < 0.0005 else (12, 3) if radius < 0.0008 else (18, 5)
    slope = (RIM - FOOT) / (HEIGHT - BASE)
    c, s = math.cos(angle), math.sin(angle)
    up = unit((slope * c, 1, slope * s))
    aside, out = (-s, 0, c), unit((c, -slope, s))
    middle = (outer_radius(y) * c, y, outer_radius(y) * s)
    contact = math.radians(62)
    ball = radius / math.sin(contact)
    first, second = 977 * angle, 3331 * y / LEVEL  # phases of the outline

    def at(share, turn):
        uneven = 1 + share * (0.07 * math.cos(2 * turn + first) +
                              0.06 * math.cos(3 * turn + second))
        flat = radius * share
        high = math.sqrt(ball * ball - flat * flat) - ball * math.cos(contact)
        v = 1.1 * flat * uneven * math.sin(turn) - 0.3 * high
        return add(middle, add(scale(aside, flat * uneven * math.cos(turn)),
                               add(scale(up, v), scale(out, high))))

    def normal(share, turn):
        return unit(cross(sub(at(share, turn), at(share - 0.02, turn)),
                          sub(at(share, turn + 0.02), at(share, turn - 0.02))))
    turns = [2 * math.pi * k / segments for k in range(segments)]
    points, normals = [at(0, 0)], [out]
    for i in range(1, rings + 2):
        share = math.sin(i / (rings + 1) * math.pi / 2)
        points += [at(share, turn) for turn in turns]
        normals += [normal(share, turn) for turn in turns]
    points.append(add(middle, scale(out, -0.0003 - 0.2 * radius)))
    normals.append(scale(out, -1))
    faces = []
    last = len(points) - 1
    for k in range(segments):
        n = (k + 1) % segments
        faces += [(0, 1 + n, 1 + k), (last, last - segments + k, last - segments + n)]
        for i in range(rings):
            a, b = 1 + i * segments, 1 + (i + 1) * segments
            faces += [(a + k, a + n, b + n), (a + k, b + n, b + k)]
    return Mesh(points, faces, normals)


def fingerprint(angle, y):
    """Grease density of the fingerprints, 0 to 1: loop patterns of ridges 0.55 mm apart."""
    most = 0.0
    for k, (middle, high, lean, wide, tall) in enumerate(FINGERPRINTS):
        x, up = (angle - middle) * outer_radius(y), y - high
        c, s = math.cos(lean), math.sin(lean)
        x, up = c * x + s * up, c * up - s * x
        far = math.hypot(x / wide, up / tall)
        if far < 1.2:
            uneven = noise((300 * x, 300 * up, k), 51)
            ridge = (math.hypot(1.3 * (x + 0.5 * up), max(up + 0.001, 0)) +
                     0.0006 * noise((400 * x, 400 * up, k), 52))
            pressed = smoothstep(1.05 + 0.12 * uneven, 0.8, far) * (0.62 + 0.38 * uneven)
            most = max(most, pressed * (0.3 + 0.7 * smoothstep(
                -0.3, 0.5, math.sin(2 * math.pi * ridge / 0.00055))))
    return most


FOG_TEXELS = (1024, 640)  # texels of the fog's texture: around half of the glass, and upwards


def fog_texture(trails, drops):
    """
    PNG for transmissionTexture: the fraction of light that the glass transmits unscattered. A fog
    of microscopic drops covers the glass, except where trails and larger drops have absorbed the
    fog. The texture covers the front of the glass, and is mirrored on its back.
    """
    width, height = FOG_TEXELS
    rows = []
    for j in range(height):
        y = HEIGHT * (1 - (j + 0.5) / height)
        rows.append([])
        for i in range(width):
            angle = math.pi * (i + 0.5) / width
            at = (2.2 * math.cos(angle), 2.2 * math.sin(angle), 60 * y)
            fog = dew_density(angle, y)
            if fog:
                fog *= 0.7 + 0.5 * noise(at, 31) + 0.25 * lattice(i, j, 0, 32)
            rows[-1].append(fog)

    def wipe(angle, low, high, half, soft):
        """Removes the fog within `half` metres of a vertical line."""
        for j in range(max(int(height * (1 - (high + 2 * half) / HEIGHT)), 0),
                       min(int(height * (1 - (low - 2 * half) / HEIGHT)) + 1, height)):
            y = HEIGHT * (1 - (j + 0.5) / height)
            away = y - min(max(y, low), high)
            reach = 2 * half / outer_radius(y)
            for i in range(max(int(width * (angle - reach) / math.pi), 0),
                           min(int(width * (angle + reach) / math.pi) + 1, width)):
                aside = (math.pi * (i + 0.5) / width - angle) * outer_radius(y)
                rows[j][i] *= smoothstep(half, (1 + soft) * half, math.hypot(aside, away))
    for angle, low, high, half in trails:
        wipe(angle, low, high, half, 0.25)
    for angle, y, radius in drops:
        if radius > 0.0003:
            wipe(angle, y, y, 1.12 * radius, 0.35)
    touched = [[max(FOG * min(v, 1), fingerprint(math.pi * (i + 0.5) / width,
                                                 HEIGHT * (1 - (j + 0.5) / height)))
                for i, v in enumerate(row)] for j, row in enumerate(rows)]
    steps = [bytes(round(min(max(v, 0), 1) * 100) for v in row) for row in touched]
    return png(steps, [(1 - GREASE * k / 100,) * 3 for k in range(101)])


def with_fog_uvs(mesh):
    """Adds texture coordinates for fog_texture(): u from right to left, v up the outer side."""
    for x, y, z in mesh.points:
        r = math.hypot(x, z)
        is_outside = r > outer_radius(y) - 0.0006 or y < 0.004
        mesh.uvs.append((math.acos(min(max(x / r, -1), 1)) / math.pi if r else 0.5,
                         1 - min(max(y / HEIGHT, 0.001), 0.999) if is_outside else 0.001))
    return mesh


def dew(drops):
    mesh = Mesh([], [], [])
    for placement in drops:
        mesh.join(drop(*placement))
    return mesh


def spilled_water():
    """Water on the table: a ring around the foot of the glass, and drops beside it."""
    rng = random.Random(91)

    def outline(middle, uneven, seed):
        def at(angle):
            c, s = math.cos(angle), math.sin(angle)
            out = middle * (1 + uneven * noise((2 * c + seed, 2 * s, seed), seed) +
                            0.4 * uneven * noise((6 * c, 6 * s + seed, seed), seed + 1))
            return out * c, -out * s
        return at
    mesh = puddle(outline(FOOT + 0.0006, 0.03, 5), 0, 0.0006, 0.0011)
    for angle, away, radius in ((-70, 0.047, 0.0022), (-52, 0.0425, 0.0012), (-63, 0.053, 0.0009),
                                (-118, 0.046, 0.0016), (-20, 0.046, 0.0012), (160, 0.049, 0.0019)):
        angle = math.radians(angle + rng.uniform(-4, 4))
        mesh.join(puddle(outline(radius, 0.16, round(1e5 * radius)), 0, 0.28 * radius + 0.0002,
                       0.9 * radius, (away * math.cos(angle), -away * math.sin(angle)),
                       segments=48))
    return mesh.join(ring_remains())


RING = (-0.05, -0.014)  # centre of a wet ring, the former position of the glass: x, z


def ring_remains():
    """Remains of the wet ring that the glass left at RING: elongated drops along a circle."""
    rng = random.Random(47)
    mesh = Mesh([], [], [])
    angle = 0.95  # the rest of the circle is covered by the glass
    while angle < 2 * math.pi - 0.95:
        long, wide = rng.uniform(0.0015, 0.009) * rng.random() + 0.001, rng.uniform(5e-4, 0.0011)
        angle += long / FOOT
        if rng.random() < 0.7:
            lobes, seed = rng.uniform(0.1, 0.35), rng.randrange(99)

            def outline(a, long=long, wide=wide, lobes=lobes, seed=seed):
                uneven = 1 + lobes * noise((math.cos(a) * 2, math.sin(a) * 3, seed), seed)
                return wide * uneven * math.cos(a), -long * math.sin(a)
            part = puddle(outline, 0, 0.3 * wide, 0.9 * wide, rings=6, segments=40)
            for k, (x, y, z) in enumerate(part.points):
                r, turn = FOOT - 0.003 + x, angle + z / FOOT
                part.points[k] = (RING[0] + r * math.cos(turn), y, RING[1] + r * math.sin(turn))
            part.normals = smooth_normals(part.points, part.faces)
            mesh.join(part)
        angle += long / FOOT + rng.uniform(0.0004, 0.004) / FOOT
    return mesh


def make():
    model = Model()
    rng = random.Random(55)
    trails = [*drop_trails(rng)]
    drops = scatter_drops(rng, trails)
    grain = {'index': model.texture(boards.texture())}
    # Late wood is darker and smoother: the green channel also serves as roughness.
    wood = lit('wood', 0.95, baseColorTexture=grain, metallicRoughnessTexture=grain)
    model.add('table', boards.table(), wood)
    fogged = {**GLASS, 'extensions': {**GLASS['extensions'], TRANSMISSION: {
        'transmissionFactor': 1,
        'transmissionTexture': {'index': model.texture(fog_texture(trails, drops))}}}}
    printed = model.texture(paper())
    model.add('straw', straw(), lit('straw', 0.8, baseColorTexture={'index': printed}))
    model.add('water', water(), WATER)
    model.add('spilled', spilled_water(), WATER)
    for i, cube in enumerate(check_floating(cubes())):
        model.add(f'cube {i + 1}', cube, ICE)
    model.add('glass', with_fog_uvs(tumbler()), fogged)
    model.add('dew', dew(drops), WATER)
    model.add('bubbles', bubbles(), AIR)
    model.add('cracks', cracks(), AIR)
    model.camera((0.0135, 0.1045, 0.262), (0.002, 0.0505, 0), 26)
    return model.file()
