"""sample.py: model of a rounded block before a striped wall, for the thumbnails of materials."""
import surroundings as around
from files import Model, glass, png, unlit
from shapes import sheet, sphere, turned, unit

WIDTH, HEIGHT, DEPTH = 0.017, 0.0145, 0.012  # half sides of the block
EXPONENT = 3.2  # of the superellipsoid
WALL = -0.042  # distance of the wall behind the block
GLASS = glass('sample', 1.5, 3, 2 * DEPTH)


def block():
    """Closed superellipsoid that stands on the floor."""
    mesh = sphere(1, 24)
    points, normals = [], []
    for point in mesh.points:
        norm = sum(abs(c) ** EXPONENT for c in point) ** (1 / EXPONENT)
        at = tuple(c / norm for c in point)
        sides = (WIDTH, HEIGHT, DEPTH)
        points.append(tuple(c * s for c, s in zip(at, sides)))
        normals.append(unit(tuple((abs(c) ** (EXPONENT - 1) * (1 if c > 0 else -1)) / s
                                  for c, s in zip(at, sides))))
    mesh.points, mesh.normals = points, normals
    return mesh.placed(turned(-24), (0, HEIGHT + 0.0001, 0))


def stripes(side=64):
    """PNG: a light and a dark stripe, each with a thin line of colour."""
    rows = []
    for _ in range(4):
        row = bytearray()
        for x in range(side):
            half = x % (side // 2)
            line = 10 <= half < 14
            row.append((2 if x < side // 2 else 3) if line else (1 if x < side // 2 else 0))
        rows.append(row)
    return png(rows, [(.16, .19, .23), (.93, .91, .86), (.85, .33, .12), (.30, .62, .72)])


def chequer(side=32):
    """PNG: 2 x 2 squares, alternately light and dark."""
    rows = [bytearray((x < side // 2) != (y < side // 2) for x in range(side))
            for y in range(side)]
    return png(rows, [(.33, .34, .36), (.82, .80, .76)])


def wall():
    """Vertical rectangle behind the block, brighter in the middle."""
    mesh = sheet((-0.12, 0, WALL), (0.24, 0, 0), (0, 0.12, 0), 16, 8)
    mesh.uvs = [(x / 0.013, y / 0.013) for x, y, _ in mesh.points]
    return mesh.painted(lambda p, n: (max(0.35, 1 - (abs(p[0]) / 0.06) ** 2),) * 3)


def make():
    model = Model()
    shadow = around.shade([(0, 0, 0.011)], 0.55, 0.012)
    model.add('floor', around.floor(0.12, 0.016, shadow, 24),
              unlit('chequer', model.texture(chequer())))
    model.add('wall', wall(), unlit('stripes', model.texture(stripes())))
    model.add('block', block(), GLASS)
    model.camera((0, 0.033, 0.092), (0, 0.0125, 0), 22)
    return model.file()
