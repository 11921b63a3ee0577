"""slate.py: a block of ice in its meltwater, on a slab of wet slate, for the light of alps.exr."""
import functools
import math

from files import Model, glass, png, png_colors
from shapes import (Mesh, add, beads_mesh, closed_below, crack, crowd, dot, film, ice, lattice, mix,
                    scale, smooth_normals, smoothstep, turned, unit, worms)
from surroundings import ramp

HALF = (0.0146, 0.0132, 0.0142)  # of the ice
MIDDLE = (0, 0.0128, 0)
TURN = turned(24)
VIEW = turned(165.6)  # of all, towards the finest mountains
SLAB = (0.15, -0.125, 0.085, 0.012)  # half width, near and far edge, thickness
SIDE = 256  # texels of the textures' sides
TILE = 0.042  # metres after which the stone's grain repeats
# The grain: waves along x and z in a tile, and their height, metres.
WAVES = ((7, 10, 0.00009), (19, 27, 0.00005), (61, 83, 0.000015), (128, 128, 0.000005))
LEDGE = 0.00022  # height of its ledges
FISSURE = 0.00035  # depth of its cracks
STEP = 0.0008  # height of a layer of the stone
REACHES = (1, 2, 4)  # texels at which ledges are looked for that hide the sky
SHADE = 2  # by how much they do, beside the sine of the elevation that they reach
FILM = 0.0012  # thickness of the puddle
CLIMB = (0.0012, 0.0009)  # how high water climbs at the ice, and how far from it, metres
SHEET = (0.037, 0.0003)  # water that has run over the stone: mean radius, how high it stands
EYE, TARGET, ANGLE = (0.0056, 0.0226, -0.104), (-0.0012, 0.0186, 0), 27
# Shallow pools: where, half widths, turn, seed.
POOLS = (((-0.044, 0.02), (0.017, 0.008), 0.3, 1), ((0.05, 0.034), (0.022, 0.007), -0.2, 2),
         ((0.036, -0.03), (0.012, 0.006), 0.2, 3), ((-0.03, -0.045), (0.014, 0.006), -0.4, 4),
         ((-0.075, 0.045), (0.02, 0.008), 0.1, 5), ((0.012, 0.052), (0.016, 0.005), 0.1, 6))
ICE = glass('ice', 1.31, 2, 0.028, (0.82, 0.957, 1), 1, cloud=4)
WATER = glass('water', 1.333, 1, 0.0013, (0.746, 0.953, 1), 1)
AIR = glass('air', 1, 4, 0.0003)


# ---- stone ----

@functools.lru_cache(maxsize=None)
def knot(x, z, seed):
    return lattice(x, z, 7, seed)


def rough(x, z, seed, period=None):
    """Smooth, from -1 to 1, with features of size 1; repeats after a period, of x and of z."""
    i, j = math.floor(x), math.floor(z)
    s, t = x - i, z - j
    s, t = s * s * (3 - 2 * s), t * t * (3 - 2 * t)
    k, n = i + 1, j + 1
    if period:
        (i, k), (j, n) = (i % period[0], k % period[0]), (j % period[1], n % period[1])
    low = knot(i, j, seed) + (knot(k, j, seed) - knot(i, j, seed)) * s
    high = knot(i, n, seed) + (knot(k, n, seed) - knot(i, n, seed)) * s
    return 2 * (low + (high - low) * t) - 1


def pool_shape(pool, angle):
    """Half the width of a pool in a direction, as a share of its half widths."""
    seed = pool[3]
    return (1 + 0.22 * math.cos(2 * angle + seed) + 0.16 * math.cos(3 * angle - 2 * seed) +
            0.12 * rough(2 + 2 * math.cos(angle), 2 + 2 * math.sin(angle), 60 + seed))


def in_pool(pool, x, z):
    """How far out a place is: 1 at the rim."""
    (cx, cz), (across, along), turn, _ = pool
    c, s = math.cos(turn), math.sin(turn)
    dx, dz = x - cx, z - cz
    u, v = (c * dx + s * dz) / across, (c * dz - s * dx) / along
    return math.hypot(u, v) / pool_shape(pool, math.atan2(v, u))


def sheet_edge(angle):
    """How far the sheet of water around the ice reaches in a direction."""
    c, s = math.cos(angle), math.sin(angle)
    out = 1 + 0.16 * math.cos(2 * angle + 0.5) + 0.12 * math.cos(3 * angle - 1.2)
    out += 0.2 * rough(4 + 2.3 * c, 4 + 2.3 * s, 64) + 0.14 * rough(9 + 7 * c, 9 + 7 * s, 65)
    return SHEET[0] * (out + 0.05 * rough(20 + 19 * c, 20 + 19 * s, 66))


def in_sheet(x, z):
    """How far out a place is in the sheet: 1 at its edge."""
    return math.hypot(x, z) / sheet_edge(math.atan2(z, x))


def layers(x, z):
    """Height of the split surface, in layers: even at the ice and in pools, in steps elsewhere."""
    wide = 1.6 * rough(x / 0.05, z / 0.036, 3) + 0.8 * rough(x / 0.017, z / 0.012, 4)
    wide += 0.42 * rough(x / 0.0052, z / 0.0042, 5) + 14 * (x * 0.3 + z * 0.95)
    whole = math.floor(wide)
    edge = 0.86 + 0.1 * rough(x / 0.002, z / 0.0016, 6)
    step = whole + 0.16 * (wide - whole) + 0.84 * smoothstep(edge, edge + 0.06, wide - whole)
    return smoothstep(1, 1.35, in_sheet(x, z)) * step


@functools.lru_cache(maxsize=None)
def pool_level(pool):
    return math.floor(layers(*pool[0]) + 0.5) * STEP


def height(x, z):
    level = STEP * layers(x, z)
    # The bed of the sheet: uneven, here and there above the water, and higher at its edge.
    out = in_sheet(x, z)
    bed = rough(x / 0.009, z / 0.006, 24) + 0.5 * rough(x / 0.0035, z / 0.0027, 25)
    at_edge = smoothstep(0.45, 0.7, out) * (1 - smoothstep(1.2, 1.5, out))
    level += 0.00042 * at_edge * (bed + out - 0.1)
    for pool in POOLS:
        level += (pool_level(pool) - level) * (1 - smoothstep(1, 1.5, in_pool(pool, x, z)))
    return level


def wetness(x, z):
    """From 0, dry, to 1, wet through."""
    near = 1 - smoothstep(0.75, 1.5, in_sheet(x, z))
    for pool in POOLS:
        near = max(near, 1 - smoothstep(0.9, 2.4, in_pool(pool, x, z)))
    patches = 0.5 * rough(x / 0.03, z / 0.02, 21) + 0.35 * rough(x / 0.009, z / 0.007, 22)
    return smoothstep(-0.2, 0.3, 0.95 * near - 0.28 + patches)


def place(s, t):
    """A point of the slab, for -1 to 1 from edge to edge: what is close to the ice is spread out,
    and the edges are broken."""
    x = SLAB[0] * (0.42 * s + 0.58 * s ** 3)
    middle = -SLAB[1] / (SLAB[2] - SLAB[1]) * 2 - 1  # the row at the ice
    eased = middle + (t - middle) * (0.4 + 0.6 * ((t - middle) / (1 + abs(middle))) ** 2)
    z = SLAB[1] + (SLAB[2] - SLAB[1]) * (eased + 1) / 2
    rim = max(abs(s), abs(t)) ** 12
    broken = 0.012 * rough(x / 0.03, z / 0.03, 31) + 0.006 * rough(x / 0.008, z / 0.008, 32)
    return x * (1 + rim * broken / 0.09), z + rim * broken * (1 if t > 0 else -1)


def tone(x, z):
    """Albedo: blue-grey, darker where wet, here and there of rust."""
    shade = 1 + 0.3 * rough(x / 0.016, z / 0.009, 41) + 0.15 * rough(x / 0.004, z / 0.003, 42)
    rust = smoothstep(0.3, 0.7, rough(x / 0.026, z / 0.02, 43))
    base = mix((0.262, 0.255, 0.25), (0.3, 0.24, 0.18), 0.6 * rust)
    return scale(base, shade * (1 - 0.45 * wetness(x, z)))


def texture_places(mesh):
    """Where points are in textures of the whole slab."""
    half, near, far, _ = SLAB
    return [((x + half) / (2 * half), (z - near) / (far - near)) for x, _, z in mesh.points]


def slab(columns=102, rows=84):
    thick = SLAB[3]
    grid = [place(2 * i / columns - 1, 2 * j / rows - 1)
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
            out = 0.0025 * (rough(x / 0.012 + 9 * layer, z / 0.012, 51) - 0.4) if layer else 0
            sides.append((x * (1 + out / 0.1), y - thick * layer / 3,
                          z + out * (1 if z > 0 else -1)))
    for layer in range(3):
        for k in range(count):
            a, b = layer * count + k, layer * count + (k + 1) % count
            side_faces += [(a, a + count, b + count), (a, b + count, b)]
    mesh = top.join(Mesh(sides, side_faces))
    mesh.uvs = texture_places(mesh)
    return mesh.painted(lambda p, n: tone(p[0], p[2]))


def openness():
    """How much of the sky the ledges leave to each texel of the slab, 0 to 1."""
    half, near, far, _ = SLAB
    apart = (2 * half / SIDE, (far - near) / SIDE)
    high = [[height((i + 0.5) * apart[0] - half, near + (j + 0.5) * apart[1])
             for i in range(SIDE)] for j in range(SIDE)]
    ways = [(x, z, math.hypot(x * apart[0], z * apart[1]))
            for x, z in ((1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1))]
    rows = []
    for j in range(SIDE):
        rows.append([])
        for i in range(SIDE):
            hidden = 0
            for x, z, length in ways:
                slope = max((high[min(max(j + k * z, 0), SIDE - 1)]
                             [min(max(i + k * x, 0), SIDE - 1)] - high[j][i]) / (k * length)
                            for k in REACHES)
                hidden += max(slope, 0) / math.hypot(1, slope)
            rows[-1].append(max(1 - SHADE * hidden / len(ways), 0))
    return rows


def damp(is_shaded=False):
    """Roughness over the whole slab, in green; how open it is to the sky, in red."""
    half, near, far, _ = SLAB
    rows = []
    shades = openness() if is_shaded else [[1] * SIDE] * SIDE
    for row in range(SIDE):
        z = near + (row + 0.5) / SIDE * (far - near)
        values = bytearray()
        for column in range(SIDE):
            wet = wetness(((column + 0.5) / SIDE * 2 - 1) * half, z)
            value = 0.6 - 0.47 * wet + 0.05 * (lattice(column, row, 1, 5) - 0.5)
            values += bytes((int(255 * shades[row][column]), int(255 * value), 0))
        rows.append(values)
    return png_colors(rows)


def fissures(u, v):
    """How deep thin cracks of the stone are, from 0 to 1: across each other, and not everywhere."""
    deep = 0.0
    for along, across, seed in ((2, 5, 18), (6, 3, 19), (9, 13, 20)):
        bent = rough(along * u, across * v, seed, (along, across))
        bent += 0.12 * rough(31 * u, 29 * v, seed + 3, (31, 29))
        there = smoothstep(0.05, 0.35, rough(3 * u, 4 * v, seed + 6, (3, 4)))
        deep = max(deep, there * (1 - smoothstep(0, 0.16 / max(along, across), abs(bent))))
    return deep


def ledges(u, v):
    """Broken edges of the cleavage, in layers."""
    wide = 2.6 * rough(4 * u, 7 * v, 15, (4, 7)) + 0.9 * rough(13 * u, 21 * v, 16, (13, 21))
    wide += 0.3 * rough(40 * u, 56 * v, 17, (40, 56))
    whole = math.floor(wide)
    return whole + 0.3 * (wide - whole) + 0.7 * smoothstep(0.88, 0.97, wide - whole)


def grain():
    """Normals and tones of the cleavage, which repeat after TILE."""
    heights = []
    for row in range(SIDE):
        v = row / SIDE
        heights.append([sum(weight * rough(a * u, b * v, a, (a, b)) for a, b, weight in WAVES) +
                        LEDGE * ledges(u, v) - FISSURE * fissures(u, v)
                        for u in (column / SIDE for column in range(SIDE))])
    normals, tones = [], []
    apart = TILE / SIDE
    for row in range(SIDE):
        bent, tints = bytearray(), bytearray()
        for column in range(SIDE):
            here = heights[row][column]
            x = (heights[row][(column + 1) % SIDE] - here) / apart
            z = (heights[(row + 1) % SIDE][column] - here) / apart
            n = unit((-x, z, 1))  # u goes to +x, v to +z; green points against v
            bent += bytes(int(127.5 + 127.5 * v + 0.5) for v in n)
            speck = lattice(column, row, 2, 6)
            grit = 16 if speck > 0.985 else -18 if speck < 0.02 else 14 * (speck - 0.5)
            tints.append(int(min(max(34 + 7e4 * here + grit, 0), 63)))
        normals.append(bent)
        tones.append(tints)
    return png_colors(normals), png(tones, ramp([(.55, .56, .57), (.93, .94, .96), (1, 1, 1)]))


# ---- water and ice ----

def foot(mesh, segments):
    """How far the block reaches in each direction, where water climbs it."""
    reach = [0.0] * segments
    for x, y, z in mesh.points:
        if 0.0008 < y < FILM + CLIMB[0]:
            k = round(math.atan2(-z, x) / (2 * math.pi) * segments) % segments
            reach[k] = max(reach[k], math.hypot(x, z))
    for _ in range(3):
        reach = [(max(reach[k - 1], a) + 2 * a + max(reach[(k + 1) % segments], a)) / 4
                 for k, a in enumerate(reach)]
    return reach


def meltwater(mesh, thick=FILM, climb=CLIMB, segments=168):
    """The puddle around the block: it climbs the ice, and ends in a rim, here steep, there flat."""
    shares = (0, 0.02, 0.05, 0.09, 0.14, 0.2, 0.28, 0.38, 0.5, 0.62, 0.73, 0.82, 0.89, 0.94, 0.975,
              1)
    inner = foot(mesh, segments)
    edge = [puddle(2 * math.pi * k / segments) for k in range(segments)]
    points = [(0, thick, 0)]
    for share in (-1, *shares):
        for k, (x, z) in enumerate(edge):
            out = math.hypot(x, z)
            near = min(inner[k] - 0.0003, 0.92 * out)
            r = 0.6 * near if share < 0 else near + share * (out - near)
            rim = 0.0021 + 0.0009 * rough(7 + 3 * x / out, 7 + 3 * z / out, 67)
            inward = min((out - r) / rim, 1)
            high = thick * (1 - (1 - inward) ** 2.2)
            high += climb[0] * inward * math.exp(-max(r - near, 0) / climb[1])
            points.append((x * r / out, high, z * r / out))
    return closed_below(points, edge, (0, 0), 0)


def puddle(angle):
    """The edge of the puddle: it follows the block, and has crept out further here and there."""
    c, s = math.cos(angle), math.sin(angle)
    turn = math.radians(24)
    across, along = (abs(c * math.cos(turn) + s * math.sin(turn)),
                     abs(s * math.cos(turn) - c * math.sin(turn)))
    out = 0.018 * (across ** 5 + along ** 5) ** -0.2
    out += 0.0024 * math.cos(angle - 2.6)
    out += 0.0034 * rough(3 + 1.6 * c, 3 + 1.6 * s, 61) + 0.0024 * rough(6 + 5 * c, 6 + 5 * s, 62)
    out += 0.0007 * rough(14 + 13 * c, 14 + 13 * s, 63)
    return out * c, -out * s


def run_out(angle):
    """The edge of the sheet of water, as film() has it."""
    out = sheet_edge(-angle)
    return out * math.cos(angle), -out * math.sin(angle)


def water():
    """The puddle around the ice, the sheet that has run out of it, and the pools."""
    mesh = meltwater(block()).join(film(run_out, 0, SHEET[1], 0.003))
    for pool in POOLS:
        center, (across, along), turn, _ = pool
        c, s = math.cos(turn), math.sin(turn)

        def outline(angle, pool=pool, across=across, along=along, c=c, s=s):
            out = pool_shape(pool, -angle)
            u, v = across * out * math.cos(angle), -along * out * math.sin(angle)
            return c * u - s * v, s * u + c * v
        mesh.join(film(outline, pool_level(pool), 0.0005, 0.0015, center))
    return mesh


def block(cells=72):
    """Flat below, where it has melted onto the stone."""
    mesh = ice(HALF, cells, 17, exponent=7, waves=0.00043, cell=0.0031, bulge=0.045, stretch=1.25,
               fine=0.55)
    mesh.placed(TURN, MIDDLE)

    def pressed(p):
        x, y, z = p
        rise = (y - 0.0003) / 0.0007
        return (x, 0.0003 + 0.0007 * math.log1p(math.exp(rise)) if rise < 30 else y, z)
    mesh.points = [pressed(p) for p in mesh.points]
    mesh.normals = smooth_normals(mesh.points, mesh.faces)
    return mesh


def bubbles():
    """Worms of air in rows along the way the ice grew, and a cloud of eggs where it ended."""
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
            ((0.0075, 0.0185, -0.0045), (52, 74, 15), 0.0058),  # to below the upper face
            ((-0.005, 0.011, 0.002), (120, 35, 75), 0.0058))):
        mesh.join(crack(size, 70 + i, gap=0.00004, bend=14).placed(turned(*turn), at))
    return mesh


def stone(model, is_shaded=False):
    """Where light is not traced, its ledges do not shade it: `is_shaded` is a texture of that."""
    normals, tones = (model.texture(data) for data in grain())
    half, near, far, _ = SLAB
    often = {'scale': [round(2 * half / TILE, 4), round((far - near) / TILE, 4)]}
    transform = {'KHR_texture_transform': often}
    wet = {'index': model.texture(damp(is_shaded))}
    return {
        'name': 'slate',
        'pbrMetallicRoughness': {'metallicFactor': 0, 'roughnessFactor': 1,
                                 'baseColorTexture': {'index': tones, 'extensions': transform},
                                 'metallicRoughnessTexture': wet},
        'normalTexture': {'index': normals, 'scale': 0.45, 'extensions': transform},
        **({'occlusionTexture': wet} if is_shaded else {}),
    }


def make():
    model = Model()
    model.used.add('KHR_texture_transform')
    for name, mesh, material in (('slab', slab(), stone(model)), ('water', water(), WATER),
                                 ('cube', block(), ICE), ('bubbles', bubbles(), AIR),
                                 ('cracks', cracks(), AIR)):
        model.add(name, mesh.placed(VIEW, (0, 0, 0)), material)
    eye, target = (tuple(dot(row, p) for row in VIEW) for p in (EYE, TARGET))
    model.camera(eye, target, ANGLE)
    return model.file()
