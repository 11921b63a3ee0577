"""slate.py: model of an ice block in its meltwater on wet slate, lit by alps.exr."""
import functools
import math

from files import Model, glass, png, png_colors
from shapes import (Mesh, add, beads_mesh, closed_below, crack, crowd, dot, ice, ice_surface,
                    lattice, mix, scale, smooth_normals, smoothstep, sub, turned, unit, worms)
from surroundings import ramp

HALF = (0.0146, 0.0132, 0.0142)  # half extents of the ice
MIDDLE = (0, 0.0128, 0)
TURN = turned(24)
FORM = {'exponent': 7, 'waves': 0.00043, 'cell': 0.0031, 'bulge': 0.045, 'stretch': 1.25,
        'fine': 0.55}
VIEW = turned(165.6)  # rotates the scene so that the finest mountains are behind it
SLAB = (0.15, -0.125, 0.085, 0.012)  # half width, near and far edge, thickness of the slab
SIDE = 512  # texels along a side of the wetness texture
# Tileable grain of the stone: texels along a side, tile size in metres, and noise octaves, which
# are stretched along the cleavage: periods along and across it in the tile, amplitude in metres.
GRAIN, TILE = 384, 0.037
WAVES = ((7, 17, 0.00006), (19, 43, 0.000035), (47, 101, 0.000014), (113, 191, 0.000006))
# Broken flakes on the stone: centre, half extents and rotation (degrees) of the outline; thickness;
# number of layers that are visible as ledges at the edge.
FLAKES = (((0.084, 0.05), (0.054, 0.03), 12, 0.0024, 4),
          ((0.104, 0.058), (0.042, 0.022), 40, 0.0019, 3),
          ((-0.09, 0.055), (0.05, 0.027), -9, 0.0021, 4),
          ((-0.04, 0.012), (0.0058, 0.0032), 33, 0.0006, 2),
          ((0.047, 0.021), (0.0042, 0.0026), -28, 0.0005, 1))
BUMPS = 0.8  # normalTexture scale of the grain
LEVEL = 0.00035  # water level around the ice, above the stone's mean height, metres
RIM = 0.0032  # width of the flattened rim of the water, metres
MENISCUS = (0.0009, 0.0008)  # meniscus at the ice: height, decay length, metres
PUDDLE = 0.0255  # mean radius of the puddle, metres
MIN_WIDTH = 0.0055  # minimum width of the puddle around the ice, metres
WET = 0.038  # radius of the wet stone, metres
EYE, TARGET, ANGLE = (0.0056, 0.0226, -0.104), (-0.0012, 0.0186, 0), 27
ICE = glass('ice', 1.31, 2, 0.028, (0.82, 0.957, 1), 1, cloud=4)
WATER = glass('water', 1.333, 1, 0.0013, (0.746, 0.953, 1), 1)
AIR = glass('air', 1, 4, 0.0003)


# ---- stone ----

@functools.lru_cache(maxsize=None)
def lattice_value(x, z, seed):
    return lattice(x, z, 7, seed)


def noise_2d(x, z, seed, period=None):
    """2D value noise, -1 to 1, with features of size 1; tileable if `period` (in x, z) is given."""
    i, j = math.floor(x), math.floor(z)
    s, t = x - i, z - j
    s, t = s * s * (3 - 2 * s), t * t * (3 - 2 * t)
    k, n = i + 1, j + 1
    if period:
        (i, k), (j, n) = (i % period[0], k % period[0]), (j % period[1], n % period[1])
    low = lattice_value(i, j, seed) + (lattice_value(k, j, seed) - lattice_value(i, j, seed)) * s
    high = lattice_value(i, n, seed) + (lattice_value(k, n, seed) - lattice_value(i, n, seed)) * s
    return 2 * (low + (high - low) * t) - 1


def fractal(x, z, seed, octaves):
    """Fractal value noise, about -1 to 1, with features of size 1 and smaller."""
    total, weight = 0.0, 0.55
    for octave in range(octaves):
        total += weight * noise_2d(x, z, seed + octave)
        x, z, weight = 1.6 * x - 1.2 * z + 7.3, 1.2 * x + 1.6 * z + 3.1, 0.5 * weight
    return total


def height(x, z):
    """Height of the stone: nearly flat, with hollows that collect water."""
    below = 1 - smoothstep(0.012, 0.019, math.hypot(x, z))  # flatter below the ice
    return 0.00042 * fractal(x / 0.013, z / 0.009, 24, 4) * (1 - 0.7 * below)


def wetness(x, z):
    """Wetness, 0 to 1: highest around the ice; extends into hollows and along the cleavage."""
    out = math.hypot(x, z) / WET
    along = (0.88 * x + 0.48 * z) / 0.034, (0.88 * z - 0.48 * x) / 0.0075
    streaks = fractal(x / 0.031, z / 0.021, 21, 3) + 0.55 * fractal(*along, 47, 4)
    wet = 1.2 - out + 1.1 * streaks - 420 * height(x, z)
    return smoothstep(0.08, 0.5, wet)


def slab_point(s, t):
    """Maps grid coordinates, -1 to 1 from edge to edge, to a point of the slab. The grid is finer
    near the ice, and the slab has broken edges."""
    x = SLAB[0] * (0.34 * s + 0.66 * s ** 3)
    middle = -SLAB[1] / (SLAB[2] - SLAB[1]) * 2 - 1  # t at the ice
    eased = middle + (t - middle) * (0.34 + 0.66 * ((t - middle) / (1 + abs(middle))) ** 2)
    z = SLAB[1] + (SLAB[2] - SLAB[1]) * (eased + 1) / 2
    rim = max(abs(s), abs(t)) ** 12
    broken = 0.012 * noise_2d(x / 0.03, z / 0.03, 31) + 0.006 * noise_2d(x / 0.008, z / 0.008, 32)
    return x * (1 + rim * broken / 0.09), z + rim * broken * (1 if t > 0 else -1)


def albedo(x, z):
    """Albedo of the stone: blue-grey with rust stains, darker where wet."""
    shade = 1 + 0.3 * fractal(x / 0.024, z / 0.014, 41, 4)
    shade += 0.2 * fractal((0.88 * x + 0.48 * z) / 0.02, (0.88 * z - 0.48 * x) / 0.0025, 51, 3)
    rust = smoothstep(0.25, 0.7, fractal(x / 0.03, z / 0.02, 43, 4))
    base = mix((0.145, 0.168, 0.2), (0.2, 0.178, 0.155), 0.4 * rust)
    wet = wetness(x, z)
    dark = tuple(v ** (1 + 0.12 * wet) for v in base)  # wet stone is more saturated
    return scale(dark, shade * (1 - 0.52 * wet))


def slab_uvs(mesh):
    """Texture coordinates for textures that cover the whole slab."""
    half, near, far, _ = SLAB
    return [((x + half) / (2 * half), (z - near) / (far - near)) for x, _, z in mesh.points]


def slab(columns=102, rows=84):
    thick = SLAB[3]
    grid = [slab_point(2 * i / columns - 1, 2 * j / rows - 1)
            for j in range(rows + 1) for i in range(columns + 1)]
    points = [(x, height(x, z), z) for x, z in grid]
    faces = []
    for j in range(rows):
        for i in range(columns):
            a = j * (columns + 1) + i
            b, c, d = a + 1, a + columns + 2, a + columns + 1
            faces += [(a, d, c), (a, c, b)]
    edge = [j * (columns + 1) for j in range(rows)]
    edge += [rows * (columns + 1) + i for i in range(columns)]
    edge += [(rows - j) * (columns + 1) + columns for j in range(rows)]
    edge += [columns - i for i in range(columns)]
    top = Mesh(points, faces)
    count = len(edge)
    sides, side_faces = [], []
    for layer in range(4):
        for x, y, z in (points[i] for i in edge):
            out = 0.0025 * (noise_2d(x / 0.012 + 9 * layer, z / 0.012, 51) - 0.4) if layer else 0
            sides.append((x * (1 + out / 0.1), y - thick * layer / 3,
                          z + out * (1 if z > 0 else -1)))
    for layer in range(3):
        for k in range(count):
            a, b = layer * count + k, layer * count + (k + 1) % count
            side_faces += [(a, a + count, b + count), (a, b + count, b)]
    mesh = top.join(Mesh(sides, side_faces))
    mesh.uvs = slab_uvs(mesh)
    return mesh.painted(lambda p, n: albedo(p[0], p[2]))


def broken_outline(middle, half, turn_deg, seed, corners, parts):
    """Outline of a broken flake: a polygon with rough edges of `parts` segments each."""
    turn = math.radians(turn_deg)
    ends = []
    for k in range(corners):
        angle = 2 * math.pi * (k + 0.55 * lattice(k, 0, 0, seed)) / corners
        out = 0.72 + 0.36 * lattice(k, 1, 0, seed)
        x, z = half[0] * out * math.cos(angle), half[1] * out * math.sin(angle)
        ends.append((x * math.cos(turn) - z * math.sin(turn),
                     x * math.sin(turn) + z * math.cos(turn)))
    outline = []
    for k, (x, z) in enumerate(ends):
        to_x, to_z = ends[(k + 1) % corners]
        for i in range(parts):
            t = i / parts
            bay = min(4 * t, 4 - 4 * t, 1) if parts > 1 else 0  # keep the corners
            rugged = 1 + 0.13 * bay * fractal(2.3 * (k + t), 0.7, seed, 5)
            outline.append((middle[0] + rugged * (x + (to_x - x) * t),
                            middle[1] + rugged * (z + (to_z - z) * t)))
    return outline


def band(upper, lower):
    """Strip of triangles between two closed loops of points."""
    count = len(upper)
    faces = []
    for k in range(count):
        a, b = k, (k + 1) % count
        faces += [(a, b, b + count), (a, b + count, a + count)]
    return Mesh([*upper, *lower], faces)


def flake(middle, outline, thick, layers, seed, shares, tilt=(0, 0)):
    """Flake of slate on the stone, with a flat top and an edge with a step for each layer."""
    count = len(outline)

    def at(share, k, low):
        x, z = (m + share * (o - m) for m, o in zip(middle, outline[k]))
        leaning = tilt[0] * (x - middle[0]) + tilt[1] * (z - middle[1])
        return (x, height(x, z) + thick * (1 - low) + leaning, z)

    points = [at(0, 0, 0)]
    for share in shares:
        points += [at(share, k, 0) for k in range(count)]
    faces = [(0, 1 + (k + 1) % count, 1 + k) for k in range(count)]
    for ring in range(len(shares) - 1):
        for k in range(count):
            a, b = (1 + ring * count + i % count for i in (k, k + 1))
            faces += [(a, b, b + count), (a, b + count, a + count)]
    mesh = Mesh(points, faces)
    last, out = points[-count:], [1.0] * count
    for layer in range(layers):
        if layer:  # a ledge of varying width
            wider = [max(noise_2d(0.17 * k, 2.3 * layer, seed) + 0.25, 0.02) for k in range(count)]
            out = [a + 0.035 * b for a, b in zip(out, wider)]
            ledge = [(at(o, k, 0)[0], y, at(o, k, 0)[2])
                     for k, (o, (_, y, _)) in enumerate(zip(out, last))]
            mesh.join(band(last, ledge))
            last = ledge
        lows = [(layer + 1 + (0.55 * noise_2d(0.11 * k, 9.1 * layer, seed) if layer + 1 < layers
                              else 0.4)) / layers for k in range(count)]
        below = [at(o, k, low) for k, (o, low) in enumerate(zip(out, lows))]
        mesh.join(band(last, below))
        last = below
    return mesh


def chip(i):
    """Splinter number `i`, placed outside the puddle."""
    angle = 2 * math.pi * lattice(i, 0, 0, 91)
    out = 0.038 + 0.06 * lattice(i, 1, 0, 91) ** 1.3
    middle = (out * math.cos(angle), 0.8 * out * math.sin(angle))
    size = 0.00018 + 0.0012 * lattice(i, 2, 0, 91) ** 6
    half = (size, size * (0.4 + 0.5 * lattice(i, 3, 0, 91)))
    outline = broken_outline(middle, half, 360 * lattice(i, 4, 0, 91), 300 + i, 5, 1)
    tilt = tuple(0.7 * (lattice(i, 5 + axis, 0, 91) - 0.5) for axis in (0, 1))
    return flake(middle, outline, size * (0.2 + 0.3 * lattice(i, 7, 0, 91)), 1, 300 + i, (1,), tilt)


def pieces(parts=22, layers_max=4, shares=(0.35, 0.62, 0.82, 0.94, 1), chips=320):
    """All flakes and splinters on the stone."""
    mesh = Mesh([], [], [])
    for i, (middle, half, turn_deg, thick, layers) in enumerate(FLAKES):
        outline = broken_outline(middle, half, turn_deg, 80 + i, 7, parts)
        mesh.join(flake(middle, outline, thick, min(layers, layers_max), 80 + i, shares))
    for i in range(chips):
        mesh.join(chip(i))
    mesh.uvs = slab_uvs(mesh)
    return mesh.painted(lambda p, n: scale(albedo(p[0], p[2]), 1 + 0.25 * (1 - n[1])))


def roughness():
    """metallicRoughnessTexture of the slab: roughness in the green channel, lower where wet."""
    half, near, far, _ = SLAB
    rows = []
    for row in range(SIDE):
        z = near + (row + 0.5) / SIDE * (far - near)
        values = bytearray()
        for column in range(SIDE):
            wet = wetness(((column + 0.5) / SIDE * 2 - 1) * half, z)
            values += bytes((0, int(255 * (0.62 - 0.5 * wet)), 0))
        rows.append(values)
    return png_colors(rows)


def grain():
    """Tileable normal map and tone texture of the cleavage grain, without conspicuous features."""
    heights = []
    for row in range(GRAIN):
        v = row / GRAIN
        heights.append([sum(weight * noise_2d(a * u, b * v, a, (a, b)) for a, b, weight in WAVES)
                        for u in (column / GRAIN for column in range(GRAIN))])
    normals, tones = [], []
    apart = TILE / GRAIN
    for row in range(GRAIN):
        bent, tints = bytearray(), bytearray()
        for column in range(GRAIN):
            here = heights[row][column]
            x = (heights[row][(column + 1) % GRAIN] - here) / apart
            z = (heights[(row + 1) % GRAIN][column] - here) / apart
            n = unit((-x, z, 1))  # u along +x, v along +z; green points along -v
            bent += bytes(min(2 * int(63.75 + 63.75 * v + 0.5), 255) for v in n)
            speck = lattice(column, row, 2, 6)
            grit = 22 if speck > 0.98 else -26 if speck < 0.03 else 22 * (speck - 0.5)
            tints.append(int(min(max(34 + 3.6e5 * here + grit, 0), 63)))
        normals.append(bent)
        tones.append(tints)
    return png_colors(normals), png(tones, ramp([(.34, .35, .36), (.74, .75, .76), (1, 1, 1)]))


# ---- water and ice ----

def block_radii(mesh, segments):
    """Returns the radius of the block in each direction, at the height of the meniscus."""
    reach = [0.0] * segments
    for x, y, z in mesh.points:
        if 0.0005 < y < LEVEL + MENISCUS[0]:
            k = round(math.atan2(-z, x) / (2 * math.pi) * segments) % segments
            reach[k] = max(reach[k], math.hypot(x, z))
    for _ in range(3):
        reach = [(max(reach[k - 1], a) + 2 * a + max(reach[(k + 1) % segments], a)) / 4
                 for k, a in enumerate(reach)]
    return reach


def puddle_radius(angle):
    """Radius of the puddle in a direction."""
    c, s = math.cos(angle), math.sin(angle)
    out = 1 + 0.1 * math.cos(2 * angle + 0.5) + 0.08 * math.cos(3 * angle - 1.2)
    out += 0.3 * fractal(4 + 1.7 * c, 4 + 1.7 * s, 64, 2)
    return PUDDLE * (out + 0.12 * fractal(20 + 9 * c, 20 + 9 * s, 66, 4))


def meltwater(mesh, segments=224):
    """The puddle around the block, with a flattened rim and a meniscus at the ice."""
    shares = (0, 0.02, 0.05, 0.09, 0.14, 0.2, 0.28, 0.38, 0.5, 0.62, 0.72, 0.8, 0.86, 0.91, 0.95,
              0.98, 1)
    inner = block_radii(mesh, segments)
    edge, points = [], [(0, LEVEL + MENISCUS[0], 0)]
    for k in range(segments):
        angle = 2 * math.pi * k / segments
        out = max(puddle_radius(angle), inner[k] + MIN_WIDTH)
        edge.append((out * math.cos(angle), -out * math.sin(angle)))
    for share in (-1, *shares):
        for k, (x, z) in enumerate(edge):
            out = math.hypot(x, z)
            near = min(inner[k] - 0.0003, 0.92 * out)
            r = 0.6 * near if share < 0 else near + share * (out - near)
            inward = min((out - r) / RIM, 1)
            low = min(height(x, z), LEVEL - 0.0002)  # height of the edge
            high = low + (LEVEL - low) * (1 - (1 - inward) ** 2)
            high += MENISCUS[0] * inward * math.exp(-max(r - near, 0) / MENISCUS[1])
            points.append((x * r / out, high, z * r / out))
    return closed_below(points, edge, (0, 0), 0)


def block(cells=72):
    """The ice block; its base is flattened, as if melted onto the stone."""
    mesh = ice(HALF, cells, 17, **FORM)
    mesh.placed(TURN, MIDDLE)

    def pressed(p):
        x, y, z = p
        rise = (y - 0.0003) / 0.0007
        return (x, 0.0003 + 0.0007 * math.log1p(math.exp(rise)) if rise < 30 else y, z)
    mesh.points = [pressed(p) for p in mesh.points]
    mesh.normals = smooth_normals(mesh.points, mesh.faces)
    return mesh


def is_inside_block(p):
    """True in the block, and just outside it, so that cracks can cut through the surface."""
    own = sub(p, MIDDLE)
    own = tuple(sum(TURN[i][k] * own[i] for i in range(3)) for k in range(3))
    share = max(abs(v / h) for v, h in zip(own, HALF))
    if share < 0.5:
        return True
    end = ice_surface(HALF, 17, **FORM)(tuple(v / h / share for v, h in zip(own, HALF)))
    return p[1] > 0.001 and dot(own, own) < 1.004 * dot(end, end)


def bubbles():
    """Worm-shaped bubbles along the freezing direction, egg-shaped bubbles where ice froze last."""
    placed = []
    beads = [*worms(HALF, 150, 30, bend=0.6), *crowd(HALF, 950, 31, 0.0001, 0.0009)]
    for at, along, *form in beads:
        at = add(at, (0.0006, 0.0012, 0))
        at, along = (tuple(dot(row, v) for row in TURN) for v in (at, along))
        placed.append((add(at, MIDDLE), along, *form))
    return beads_mesh(placed)


def cracks():
    mesh = Mesh([], [], [])
    for i, (at, turn, size) in enumerate((
            ((0.004, 0.0165, -0.003), (25, 62, 20), 0.0066),
            ((0.0075, 0.0185, -0.0045), (52, 74, 15), 0.0058),
            ((-0.005, 0.011, 0.002), (120, 35, 75), 0.0058),
            # These two cut through the surface.
            ((-0.0045, 0.0205, -0.004), (-52, 78, 12), 0.0085),
            ((0.0105, 0.0115, 0.001), (64, 68, -20), 0.0075))):
        matrix = turned(*turn)

        def is_inside(p, matrix=matrix, at=at):
            return is_inside_block(add(tuple(dot(row, p) for row in matrix), at))
        mesh.join(crack(size, 70 + i, 0.00004, 14, is_inside).placed(matrix, at))
    return mesh


def stone(model):
    normals, tones = (model.texture(data) for data in grain())
    half, near, far, _ = SLAB
    often = {'scale': [round(2 * half / TILE, 4), round((far - near) / TILE, 4)]}
    transform = {'KHR_texture_transform': often}
    return {
        'name': 'slate',
        'pbrMetallicRoughness': {'metallicFactor': 0, 'roughnessFactor': 1,
                                 'baseColorTexture': {'index': tones, 'extensions': transform},
                                 'metallicRoughnessTexture': {'index': model.texture(roughness())}},
        'normalTexture': {'index': normals, 'scale': BUMPS, 'extensions': transform},
    }


def make():
    model = Model()
    model.used.add('KHR_texture_transform')
    cube = block()
    for name, mesh, material in (('slab', slab().join(pieces()), stone(model)),
                                 ('water', meltwater(cube), WATER), ('cube', cube, ICE),
                                 ('bubbles', bubbles(), AIR), ('cracks', cracks(), AIR)):
        model.add(name, mesh.placed(VIEW, (0, 0, 0)), material)
    eye, target = (tuple(dot(row, p) for row in VIEW) for p in (EYE, TARGET))
    model.camera(eye, target, ANGLE)
    return model.file()
