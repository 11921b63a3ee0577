"""shapes.py: procedural meshes (closed, outward normals, metres), vector math and noise."""
import math
import random
from itertools import product


def add(a, b):
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def sub(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def scale(a, s):
    return (a[0] * s, a[1] * s, a[2] * s)


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit(a):
    length = math.sqrt(dot(a, a))
    return scale(a, 1 / length) if length else (0.0, 1.0, 0.0)


def smoothstep(low, high, x):
    t = min(max((x - low) / (high - low), 0), 1)
    return t * t * (3 - 2 * t)


def mix(a, b, t):
    return tuple(x + (y - x) * t for x, y in zip(a, b))


class Mesh:
    """Triangle mesh: points, normals, faces; optionally texture coordinates and colours."""

    def __init__(self, points, faces, normals=None, uvs=()):
        self.points, self.faces, self.uvs, self.colors = points, faces, list(uvs), []
        self.normals = normals or smooth_normals(points, faces)

    def join(self, other):
        """Appends another mesh to this one."""
        first = len(self.points)
        self.points += other.points
        self.normals += other.normals
        self.uvs += other.uvs
        self.colors += other.colors
        self.faces += [(a + first, b + first, c + first) for a, b, c in other.faces]
        return self

    def inside_out(self):
        self.faces = [(a, c, b) for a, b, c in self.faces]
        self.normals = [scale(n, -1) for n in self.normals]
        return self

    def placed(self, turn, at):
        """Rotates by the matrix `turn` (a tuple of rows), then translates by `at`."""
        self.points = [add(tuple(dot(row, p) for row in turn), at) for p in self.points]
        self.normals = [tuple(dot(row, n) for row in turn) for n in self.normals]
        return self

    def painted(self, color_of):
        """Sets the vertex colours to color_of(point, normal)."""
        self.colors = [color_of(p, n) for p, n in zip(self.points, self.normals)]
        return self


def smooth_normals(points, faces):
    """Vertex normals: area-weighted means of face normals."""
    sums = [(0.0, 0.0, 0.0)] * len(points)
    for face in faces:
        a, b, c = (points[i] for i in face)
        normal = cross(sub(b, a), sub(c, a))
        for i in face:
            sums[i] = add(sums[i], normal)
    return [unit(n) for n in sums]


def turned(yaw_deg, pitch_deg=0, roll_deg=0):
    """Rotation matrix: first roll about z, then pitch about x, then yaw about y."""
    (cy, sy), (cx, sx), (cz, sz) = ((math.cos(math.radians(a)), math.sin(math.radians(a)))
                                    for a in (yaw_deg, pitch_deg, roll_deg))
    return ((cy * cz + sy * sx * sz, -cy * sz + sy * sx * cz, sy * cx),
            (cx * sz, cx * cz, -sx),
            (-sy * cz + cy * sx * sz, sy * sz + cy * sx * cz, cy * cx))


# ---- noise ----

def lattice(x, y, z, seed):
    """Hash of an integer lattice point, 0 to 1."""
    h = (x * 73856093 ^ y * 19349663 ^ z * 83492791 ^ seed * 2654435761) & 0xffffffff
    h = (h ^ h >> 15) * 0x2c1b3c6d & 0xffffffff
    h = (h ^ h >> 12) * 0x297a2d39 & 0xffffffff
    return (h ^ h >> 15) / 0xffffffff


def noise(p, seed=0):
    """Value noise, -1 to 1, with features of size 1."""
    cell = [math.floor(v) for v in p]
    t = [v - c for v, c in zip(p, cell)]
    t = [v * v * v * (v * (v * 6 - 15) + 10) for v in t]
    total = 0.0
    for i, j, k in product((0, 1), repeat=3):
        weight = ((t[0] if i else 1 - t[0]) * (t[1] if j else 1 - t[1]) *
                  (t[2] if k else 1 - t[2]))
        total += weight * lattice(cell[0] + i, cell[1] + j, cell[2] + k, seed)
    return 2 * total - 1


def hollows(p, seed=0):
    """Worley noise, -1 to about 0: round hollows between sharp ridges, as on melting ice."""
    cell = [math.floor(v) for v in p]
    nearest = 9.0
    for i, j, k in product((-1, 0, 1), repeat=3):
        x, y, z = cell[0] + i, cell[1] + j, cell[2] + k
        d = (x + lattice(x, y, z, seed) - p[0], y + lattice(x, y, z, seed + 1) - p[1],
             z + lattice(x, y, z, seed + 2) - p[2])
        nearest = min(nearest, dot(d, d))
    return min(nearest, 1) - 1


# ---- surfaces ----

def rounded(corners, steps=8):
    """
    Returns a profile for lathe(), points with normals (r, y, nr, ny), through corners (radius,
    height, fillet radius). The solid is on the left of the direction of travel.
    """
    out = []
    for i, (r, y, fillet) in enumerate(corners):
        if i in (0, len(corners) - 1) or not fillet:
            out.append((r, y, None))
            continue
        ends = []
        for other in (corners[i - 1], corners[i + 1]):
            d = (other[0] - r, other[1] - y)
            length = math.hypot(*d)
            ends.append((d[0] / length, d[1] / length))
        (ax, ay), (bx, by) = ends
        half = math.acos(min(max(ax * bx + ay * by, -1), 1)) / 2
        reach = fillet / math.tan(half)
        mx, my = ax + bx, ay + by
        far = fillet / math.sin(half) / math.hypot(mx, my)
        center = (r + mx * far, y + my * far)
        left = ax * by - ay * bx < 0  # convex corner of the solid
        start = math.atan2(y + ay * reach - center[1], r + ax * reach - center[0])
        sweep = math.pi - 2 * half
        for k in range(steps + 1):
            angle = start + (sweep if left else -sweep) * k / steps
            c, s = math.cos(angle), math.sin(angle)
            sign = 1 if left else -1
            out.append((center[0] + fillet * c, center[1] + fillet * s, (sign * c, sign * s)))
    return with_normals(out)


def with_normals(points):
    """Computes missing normals (None) of a profile from the neighbouring points."""
    result = []
    for i, (r, y, normal) in enumerate(points):
        if normal is None:
            a, b = points[max(i - 1, 0)], points[min(i + 1, len(points) - 1)]
            d = (b[0] - a[0], b[1] - a[1])
            length = math.hypot(*d)
            normal = (d[1] / length, -d[0] / length)
            if r == 0:
                normal = (0.0, 1.0 if normal[1] > 0 else -1.0)
        result.append((r, y, *normal))
    return result


def lathe(profile, segments):
    """Surface of revolution about the y axis of a profile (r, y, nr, ny); its ends have r = 0."""
    points, normals, faces = [], [], []
    angles = [2 * math.pi * i / segments for i in range(segments)]
    circle = [(math.cos(a), math.sin(a)) for a in angles]
    rings = []
    for r, y, nr, ny in profile:
        ring = len(points)
        count = segments if r > 0 else 1
        rings.append((ring, count))
        for c, s in circle[:count]:
            points.append((r * c, y, -r * s))
            normals.append((nr * c, ny, -nr * s))
    for (a, na), (b, nb) in zip(rings, rings[1:]):
        for i in range(segments):
            j = (i + 1) % segments
            if na > 1:
                faces.append((a + i, a + j, b + (j if nb > 1 else 0)))
            if nb > 1:
                faces.append((a + (i if na > 1 else 0), b + j, b + i))
    return Mesh(points, faces, normals)


def cube_grid(n, ease=0.0):
    """Points and faces of a cube of half width 1; `ease` 0 to 1 refines it towards the edges."""
    steps = [2 * i / n - 1 for i in range(n + 1)]
    steps = [(1 - ease) * s + ease * math.sin(s * math.pi / 2) for s in steps]
    index, points, faces = {}, [], []
    for axis, sign in product(range(3), (-1, 1)):
        grid = []
        for i, j in product(range(n + 1), repeat=2):
            p = [0.0] * 3
            p[axis], p[(axis + 1) % 3], p[(axis + 2) % 3] = sign, steps[i], steps[j]
            p = tuple(p)
            if p not in index:
                index[p] = len(points)
                points.append(p)
            grid.append(index[p])
        for i, j in product(range(n), repeat=2):
            a, b = grid[i * (n + 1) + j], grid[(i + 1) * (n + 1) + j]
            c, d = grid[(i + 1) * (n + 1) + j + 1], grid[i * (n + 1) + j + 1]
            quad = (a, b, c, d) if sign > 0 else (a, d, c, b)
            faces += [(quad[0], quad[1], quad[2]), (quad[0], quad[2], quad[3])]
    return points, faces


def sphere(radius, n):
    points, faces = cube_grid(n)
    points = [tuple(math.tan(v * math.pi / 4) for v in p) for p in points]
    normals = [unit(p) for p in points]
    return Mesh([scale(p, radius) for p in normals], faces, normals)


def ice_surface(half, seed, exponent=7, waves=0.00025, cell=0.0065, bulge=0.03, stretch=1.0,
                fine=0.35, chips=()):
    """
    Returns the surface of a melting ice block, as a function of points on a cube of half width 1: a
    superellipsoid with low-frequency bulges and Worley hollows of size `cell`, depth `waves` and
    aspect ratio `stretch`, and smaller hollows, `fine` times as deep. Each of `chips`, (direction,
    distance), is a plane at that distance from the centre that cuts off a piece.
    """
    def at(p):
        r = sum(abs(v) ** exponent for v in p) ** (-1 / exponent)
        q = [v * r * h for v, h in zip(p, half)]
        d = unit(q)
        q = scale(q, 1 + bulge * noise(scale(d, 1.3), seed))
        for direction, distance in chips:
            distance *= 1 + 0.03 * noise(scale(q, 300), seed + 3)
            q = scale(q, min(distance / max(dot(q, direction), 1e-9), 1))
        place = (q[0] / cell, q[1] / cell / stretch, q[2] / cell)
        depth = waves * (hollows(place, seed + 7) + fine * hollows(scale(place, 2.1), seed + 11))
        return add(q, scale(d, depth))
    return at


def ice(half, n, seed, **form):
    """Mesh of an ice block with the surface ice_surface()."""
    points, faces = cube_grid(n, ease=0.6)
    surface = ice_surface(half, seed, **form)
    return Mesh([surface(p) for p in points], faces)


def tube(path, radius_of, segments, caps=True):
    """Tube along a path; radius_of(t) is its radius, with t from 0 to 1 along the path."""
    points, faces = [], []
    side = None
    for i, p in enumerate(path):
        ahead = unit(sub(path[min(i + 1, len(path) - 1)], path[max(i - 1, 0)]))
        if side is None:
            side = cross(ahead, (0, 0, 1) if abs(ahead[2]) < 0.9 else (1, 0, 0))
        side = unit(sub(side, scale(ahead, dot(side, ahead))))
        up = cross(ahead, side)
        r = radius_of(i / (len(path) - 1))
        for k in range(segments):
            a = 2 * math.pi * k / segments
            points.append(add(p, add(scale(side, r * math.cos(a)), scale(up, r * math.sin(a)))))
    for i in range(len(path) - 1):
        for k in range(segments):
            a, b = i * segments + k, i * segments + (k + 1) % segments
            faces += [(a, b, b + segments), (a, b + segments, a + segments)]
    if caps:
        for ring, flip in ((0, True), ((len(path) - 1) * segments, False)):
            points.append(path[-1 if ring else 0])
            for k in range(segments):
                a, b = ring + k, ring + (k + 1) % segments
                faces.append((len(points) - 1, b, a) if flip else (len(points) - 1, a, b))
    return Mesh(points, faces)


def ring(path, radius, segments):
    """Tube along a closed path."""
    n = len(path)
    mesh = tube([*path, path[0], path[1]], lambda _: radius, segments, caps=False)
    # The frame is rotated after one round: connect each last point to the nearest first one.
    first = mesh.points[:segments]
    last = mesh.points[n * segments:(n + 1) * segments]
    shift = min(range(segments), key=lambda s: sum(
        math.dist(last[k], first[(k + s) % segments]) for k in range(segments)))
    faces = []
    for face in mesh.faces:
        if max(face) < (n + 1) * segments:
            faces.append(tuple(i if i < n * segments else (i - n * segments + shift) % segments
                               for i in face))
    return Mesh(mesh.points[:n * segments], faces)


def bead(at, along, radius, length, n=8, bend=0.0):
    """Egg-shaped air bubble of half length `length` with its tip towards `along`; both ends are
    displaced sideways by `bend` times `length`."""
    profile = []
    for i in range(n // 2 + 2):
        a = math.pi * i / (n // 2 + 1) - math.pi / 2
        width = radius * math.cos(a) * (1 - 0.25 * math.sin(a)) if 0 < i < n // 2 + 1 else 0.0
        profile.append((width, length * math.sin(a), None))
    mesh = lathe(with_normals(profile), n)
    if bend:
        mesh = Mesh([(x + bend * y * y / length, y, z) for x, y, z in mesh.points], mesh.faces)
    up = unit(along)
    side = unit(cross(up, (0, 0, 1) if abs(up[2]) < 0.9 else (1, 0, 0)))
    front = cross(side, up)
    return mesh.placed(tuple(zip(side, up, front)), at)


def worms(half, count, seed, bend=0.0):
    """
    Returns worm-shaped bubbles in a block around the origin, as they form when ice freezes inwards:
    up to `count`, roughly normal to the faces. Neighbours are bent alike, by up to `bend` lengths.
    """
    rng = random.Random(seed)
    beads = []
    for _ in range(count):
        axis, side = rng.randrange(3), rng.choice((-1, 1))
        out = rng.uniform(0.36, 0.7)
        at = [rng.uniform(-0.66, 0.66) * h for h in half]
        at[axis] = side * out * half[axis]
        if max(abs(v / h) for v, h in zip(at, half)) > out + 0.02:
            continue
        along = [-0.25 * v / h + 0.06 * rng.gauss(0, 1) for v, h in zip(at, half)]
        along[axis] = -side
        radius = 0.00008 * math.exp(0.35 * rng.gauss(0, 1))
        beads.append((tuple(at), unit(along), radius,
                      min(0.0004 + 0.0011 * rng.expovariate(1), 0.0032), 6,
                      bend * noise(scale(at, 1 / 0.005), seed)))
    return beads


def crowd(half, count, seed, least=0.00006, most=0.0003):
    """
    Returns clustered small bubbles around the centre of a block at the origin, where ice freezes
    last. Their radii, `least` to `most`, follow a power law, so that most are small.
    """
    rng = random.Random(seed)
    beads = []
    while len(beads) < count:
        spread = 0.3 * rng.random() ** 0.5
        at = tuple(spread * h * rng.gauss(0, 1) for h in half)
        if max(abs(v / h) for v, h in zip(at, half)) > 0.72:
            continue
        clump = noise(scale(at, 1 / 0.0034), seed) + 0.5 * noise(scale(at, 1 / 0.0015), seed + 1)
        if clump + 0.15 * rng.gauss(0, 1) < 0.05:
            continue
        radius = 1 / math.sqrt(1 / least ** 2 +
                               rng.random() * (1 / most ** 2 - 1 / least ** 2))
        along = unit(tuple(rng.gauss(0, 1) for _ in range(3)))
        sides = 4 if radius < 0.0001 else 6 if radius < 0.00018 else 8
        beads.append((at, along, radius, radius * rng.uniform(1, 1.35), sides))
    return beads


def beads_mesh(beads):
    mesh = Mesh([], [], [])
    for arguments in beads:
        mesh.join(bead(*arguments))
    return mesh


def crack(radius, seed, gap=0.00006, bend=9.0, is_inside=lambda p: True):
    """
    Crack: a curved, lobed sheet of air normal to the y axis, with faint fracture arcs and a rougher
    outer part. Its thickness `gap` falls to 0 at the rim. It is clipped to the region in which
    is_inside(point) is true.
    """
    rings, segments = 12, 42
    rng = random.Random(seed)
    turn, lobes = rng.uniform(0, 6), rng.uniform(0, 6)

    def height(x, z):
        r = math.hypot(x, z)
        share = r / radius
        wide, fine = ((x / size, seed, z / size) for size in (0.55 * radius, 0.16 * radius))
        return (bend * r * r + radius * (0.035 * noise(wide, seed) +
                                         0.016 * smoothstep(0.3, 1, share) * noise(fine, seed) +
                                         0.0022 * share * math.sin(36 * share + wide[0])))

    def normal(x, z):
        d = 0.01 * radius
        return unit((height(x - d, z) - height(x + d, z), 2 * d,
                     height(x, z - d) - height(x, z + d)))

    def place(r, k):
        a = 2 * math.pi * k / segments
        x, z = r * math.cos(a), -r * math.sin(a)
        return x, height(x, z), z

    def reach(k):
        a = 2 * math.pi * k / segments
        r = radius * (0.9 + 0.2 * math.cos(a - turn) + 0.14 * math.cos(3 * a - lobes) +
                      0.07 * math.cos(5 * a + lobes))
        while not is_inside(place(r, k)):
            r -= 0.02 * radius
        return r
    reaches = [reach(k) for k in range(segments)]

    def point(share, k, side):
        x, y, z = place(share * reaches[k], k)
        return (x, y + side * gap / 2 * math.sqrt(1 - share * share), z)

    points = [point(1, k, 0) for k in range(segments)]
    signs, faces = [1] * segments, []
    for side in (1, -1):
        outside, quads = 0, []
        for i in range(rings - 1, 0, -1):
            inside = len(points)
            points += [point(i / rings, k, side) for k in range(segments)]
            for k in range(segments):
                n = (k + 1) % segments
                quads += [(outside + k, outside + n, inside + n),
                          (outside + k, inside + n, inside + k)]
            outside = inside
        points.append(point(0, 0, side))
        quads += [(outside + k, outside + (k + 1) % segments, len(points) - 1)
                  for k in range(segments)]
        faces += quads if side > 0 else [(a, c, b) for a, b, c in quads]
        signs += [side] * (len(points) - len(signs))
    # Normals ignore the thickness, so that both sides look smooth up to the rim.
    return Mesh(points, faces, [scale(normal(x, z), s) for s, (x, _, z) in zip(signs, points)])


def puddle(outline, level, thick, rim, center=(0, 0), rings=12, segments=168):
    """Closed mesh of a puddle with a rounded rim; outline(angle) returns a point of its edge."""
    points = [(center[0], level + thick, center[1])]
    edge = [outline(2 * math.pi * k / segments) for k in range(segments)]
    for ring in range(1, rings + 1):
        share = math.sin(ring / rings * math.pi / 2)
        for x, z in edge:
            inward = min(math.hypot(x, z) * (1 - share) / rim, 1)
            points.append((center[0] + x * share,
                           level + thick * (1 - (1 - inward) ** 2.2),
                           center[1] + z * share))
    return closed_below(points, edge, center, level)


def closed_below(points, edge, center, level):
    """Closed mesh of a centre point and rings of points, of which the last is the edge; its base is
    below ground."""
    segments, faces = len(edge), []
    rings = (len(points) - 1) // segments
    points += [(center[0] + 0.97 * x, level - 0.004, center[1] + 0.97 * z) for x, z in edge]
    points.append((center[0], level - 0.004, center[1]))
    for k in range(segments):
        n = (k + 1) % segments
        faces.append((0, 1 + k, 1 + n))
        for ring in range(rings):
            a = 1 + ring * segments
            b = a + segments
            faces += [(a + k, b + k, b + n), (a + k, b + n, a + n)]
        last = 1 + rings * segments
        faces.append((len(points) - 1, last + n, last + k))
    return Mesh(points, faces)


def sheet(corner, across, along, columns, rows):
    """Planar grid with texture coordinates 0 to 1; its front faces along cross(across, along)."""
    normal = unit(cross(across, along))
    points, uvs, faces = [], [], []
    for j in range(rows + 1):
        for i in range(columns + 1):
            u, v = i / columns, j / rows
            points.append(add(corner, add(scale(across, u), scale(along, v))))
            uvs.append((u, v))
    for j in range(rows):
        for i in range(columns):
            a = j * (columns + 1) + i
            b, c, d = a + 1, a + columns + 2, a + columns + 1
            faces += [(a, b, c), (a, c, d)]
    return Mesh(points, faces, [normal] * len(points), uvs)
