"""models.py: generates the models of docs/how-to/recipes.md.

Usage: models.py [FOLDER]   writes wine-glass.glb, whisky.glb, vase.glb, ring.glb, aquarium.glb,
bottle.glb, globe.glb and sea-ice.glb. Lengths are metres. It needs only Python's standard library.
"""
import math
import pathlib
import random
import sys

sys.dont_write_bytecode = True  # keep __pycache__ out of the source tree
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / 'assets' / 'generate'))
import boards  # noqa: E402
from files import Model, glass, lit  # noqa: E402
from shapes import (Mesh, cross, ice, lathe, noise, ring, rounded, scale,  # noqa: E402
                    smooth_normals, sphere, sub, tube, turned, unit, with_normals)

GLASS = glass('glass', 1.52, 3, 0.002, (0.96, 0.98, 0.97), 0.1)
WATER = glass('water', 1.333, 1, 0.05)
ICE = glass('ice', 1.31, 2, 0.028)


def paint(name, color, roughness=0.6, metallic=0):
    return lit(name, roughness, metallicFactor=metallic, baseColorFactor=[*color, 1])


def curve(points, steps=6):
    """Profile for lathe(): Catmull-Rom spline through points (radius, height)."""
    out = []
    last = len(points) - 1
    for i in range(last):
        a, b, c, d = (points[min(max(k, 0), last)] for k in (i - 1, i, i + 1, i + 2))
        for step in range(steps + (i == last - 1)):
            t = step / steps
            out.append(tuple(0.5 * (2 * q + (r - p) * t + (2 * p - 5 * q + 4 * r - s) * t * t +
                                    (3 * q - p - 3 * r + s) * t ** 3)
                             for p, q, r, s in zip(a, b, c, d)))
    return with_normals([(max(r, 0), y, None) for r, y in out])


def flat(mesh):
    """Gives each face its own vertices and normal."""
    points, normals = [], []
    for face in mesh.faces:
        corners = [mesh.points[i] for i in face]
        normal = cross(sub(corners[1], corners[0]), sub(corners[2], corners[0]))
        if math.hypot(*normal) > 0:
            points += corners
            normals += [unit(normal)] * 3
    faces = [(i, i + 1, i + 2) for i in range(0, len(points), 3)]
    return Mesh(points, faces, normals)


def box(profile, half_x, half_z):
    """Rectangular counterpart of lathe(): radius 1 is at the walls of the box."""
    mesh = lathe(with_normals([(r, y, None) for r, y in profile]), 4).placed(turned(45), (0, 0, 0))
    root = math.sqrt(2)
    mesh.points = [(x * root * half_x, y, z * root * half_z) for x, y, z in mesh.points]
    return flat(mesh)


def smooth(mesh):
    mesh.normals = smooth_normals(mesh.points, mesh.faces)
    return mesh


def wine_glass(model):
    model.add('glass', lathe(curve((
        (0, .0008), (.030, .0004), (.0335, .0006), (.034, .0014), (.033, .0022), (.018, .0045),
        (.0065, .011), (.0042, .025), (.004, .06), (.0045, .078), (.009, .0855), (.020, .092),
        (.031, .104), (.037, .122), (.0375, .135), (.035, .155), (.0307, .182), (.0303, .1844),
        (.0297, .1846), (.0294, .182), (.0338, .155), (.0363, .135), (.0358, .122), (.0298, .1048),
        (.019, .0935), (.008, .088), (0, .0872))), 96), GLASS)
    model.add('wine', lathe(curve((
        (0, .0868), (.008, .0876), (.019, .0931), (.0302, .1044), (.0362, .1218), (.0365, .1250),
        (.0362, .1253), (.0352, .1249), (.02, .1248), (0, .1248))), 96), WATER)
    model.camera((.1, .18, .42), (0, .095, 0), 30)


def whisky(model):
    model.add('glass', lathe(rounded((
        (0, .001, 0), (.030, .001, .001), (.035, .003, .003), (.040, .085, .0012),
        (.0378, .085, .0012), (.0335, .016, .006), (0, .015, 0)), 6), 90), GLASS)
    model.add('whisky', lathe(with_normals((
        (0, .0145, None), (.028, .0151, None), (.0325, .018, None), (.0342, .024, None),
        (.0356, .0445, None), (.0356, .0455, None), (.0345, .0449, None), (.03, .0447, None),
        (0, .0447, None))), 90), WATER)
    for seed, (turn, at) in enumerate((((12, 8, 30), (-.010, .0395, .004)),
                                       ((50, -14, 10), (.0155, .0445, -.006)))):
        block = smooth(ice((.0125, .012, .0125), 30, 40 + seed, exponent=8))
        model.add(f'ice {seed + 1}', block.placed(turned(*turn), at), ICE)
    model.add('table', boards.table(), lit('wood', .9, baseColorTexture={
        'index': model.texture(boards.texture())}))
    model.camera((.03, .12, .25), (0, .038, 0), 25)


def vase(model):
    model.add('vase', lathe(curve((
        (0, .003), (.028, .002), (.034, .004), (.045, .035), (.049, .07), (.040, .115),
        (.024, .155), (.022, .175), (.030, .200), (.0305, .2015), (.0290, .2020), (.020, .176),
        (.0215, .155), (.037, .115), (.0455, .07), (.042, .036), (.031, .0105), (0, .010))), 96),
        glass('vase', 1.52, 3, .003, (.55, .86, .92), .006))
    stem = [(.004 + .05 * t * t, .02 + .27 * t, .004 * math.sin(5 * t))
            for t in (i / 20 for i in range(21))]
    model.add('stem', smooth(tube(stem, lambda t: .0016, 12)), paint('green', (.1, .28, .06)))
    bud = sphere(1, 12)
    bud.points = [(.013 * x, .02 * y, .013 * z) for x, y, z in bud.points]
    model.add('bud', smooth(bud).placed(turned(0, 0, -20), (.056, .305, 0)),
              paint('red', (.6, .03, .05)))
    model.camera((.12, .26, .72), (.012, .158, 0), 28)


def brilliant():
    """Round brilliant cut of radius 1: table, stars, bezels, girdle and pavilion."""
    def at(radius, height, step):
        angle = math.pi * step / 8
        return (radius * math.cos(angle), height, -radius * math.sin(angle))
    faces = []
    for i in range(0, 16, 2):
        tip, bezel, pavilion = (0, -.43, 0), at(.8, .099, i + 1), at(.25, -.334, i + 1)
        t0, t1 = at(.55, .16, i), at(.55, .16, i + 2)
        upper = [at(1, .015, i + k) for k in range(3)]
        lower = [at(1, -.015, i + k) for k in range(3)]
        faces += [((0, .16, 0), t0, t1), (t0, bezel, t1), (t0, upper[0], bezel),
                  (t1, bezel, upper[2]), (bezel, upper[0], upper[1]), (bezel, upper[1], upper[2]),
                  (tip, pavilion, lower[0]), (tip, lower[2], pavilion),
                  (pavilion, lower[1], lower[0]), (pavilion, lower[2], lower[1])]
        for k in (0, 1):
            faces += [(lower[k], lower[k + 1], upper[k + 1]), (lower[k], upper[k + 1], upper[k])]
    points = [p for face in faces for p in face]
    return flat(Mesh(points, [(i, i + 1, i + 2) for i in range(0, len(points), 3)]))


def diamond_ring(model):
    gold = paint('gold', (1, .72, .32), .18, 1)
    circle = [(.0088 * math.cos(a), .0098 + .0088 * math.sin(a), 0)
              for a in (2 * math.pi * i / 96 for i in range(96))]
    model.add('band', smooth(ring(circle, .001, 20)), gold)
    top = .0222
    for i in range(4):
        a = math.pi * (i + .5) / 2
        path = [(r * math.cos(a), top + y, r * math.sin(a)) for r, y in
                ((.0006, -.0036), (.0022, -.0016), (.0031, 0), (.0029, .0004), (.0025, .0005))]
        model.add(f'prong {i + 1}', smooth(tube(path, lambda t: .00032, 10)), gold)
    stone = brilliant()
    stone.points = [scale(p, .003) for p in stone.points]
    model.add('stone', stone.placed(turned(9), (0, top, 0)), glass('diamond', 2.417, 3, .003))
    model.camera((.018, .036, .07), (0, .0125, 0), 24)


def fish(at, turn, size):
    body = sphere(1, 14)
    body.points = [(size * x, size * .42 * y, size * .2 * z) for x, y, z in body.points]
    tail = Mesh([(-.8 * size, 0, .03 * size), (-1.5 * size, .42 * size, 0),
                 (-1.5 * size, -.42 * size, 0), (-.8 * size, 0, -.03 * size)],
                [(0, 1, 2), (3, 2, 1), (0, 3, 1), (0, 2, 3)])
    return smooth(body).join(flat(tail)).placed(turned(turn), at)


def aquarium(model):
    x, z, wall = .15, .09, .004
    model.add('tank', box(((0, .0005), (1, .0005), (1, .2), (1 - wall / z, .2),
                           (1 - wall / z, .0085), (0, .0085)), x, z), GLASS)
    model.add('water', box(((0, .0075), (1 - .7 * wall / z, .0075), (1 - .7 * wall / z, .175),
                            (0, .175)), x, z), WATER)
    rng = random.Random(3)
    pebbles = Mesh([], [], [])
    for _ in range(420):
        at = (rng.uniform(-.128, .128), .0125 + .008 * rng.random(), rng.uniform(-.07, .07))
        stone = sphere(rng.uniform(.004, .0075), 4)
        stone.points = [(px, .6 * py, pz) for px, py, pz in stone.points]
        pebbles.join(stone.placed(turned(rng.uniform(0, 360)), at))
    model.add('pebbles', pebbles, paint('pebble', (.42, .36, .28), .8))
    for i in range(9):
        side = -.115 + .012 * i if i < 5 else .075 + .012 * (i - 5)
        height, lean = rng.uniform(.06, .135), rng.uniform(-.02, .02)
        path = [(side + lean * t * t + .004 * math.sin(7 * t + i), .012 + height * t,
                 -.045 + .006 * (i % 3)) for t in (k / 16 for k in range(17))]
        model.add(f'plant {i + 1}', smooth(tube(path, lambda t: .0036 * (1.02 - t), 10)),
                  paint('plant', (.08, .3, .07)))
    for i, (at, turn, size) in enumerate((((-.03, .095, .02), 20, .021),
                                          ((.045, .125, -.01), 165, .016),
                                          ((.065, .065, .03), 200, .018))):
        model.add(f'fish {i + 1}', fish(at, turn, size), paint('fish', (.85, .25, .03), .4))
    model.camera((.2, .25, .58), (0, .085, 0), 28)


def bottle(model):
    model.add('bottle', lathe(rounded((
        (0, .004, 0), (.026, .001, .003), (.033, .002, .004), (.033, .135, .02),
        (.0125, .170, .012), (.0125, .212, .001), (.0105, .212, .001), (.0105, .169, .012),
        (.0305, .133, .02), (.0305, .007, .004), (0, .010, 0)), 8), 96),
        glass('glass', 1.52, 3, .0025, (.75, .93, .8), .02))
    model.add('oil', lathe(rounded((
        (0, .0094, 0), (.0312, .0064, .004), (.0312, .1325, .02), (.0152, .160, .001),
        (0, .160, 0)), 8), 96), WATER)
    model.add('cork', lathe(rounded((
        (0, .195, 0), (.0100, .195, .001), (.0102, .2135, .0004), (.014, .2135, .001),
        (.014, .226, .002), (0, .226, 0)), 6), 64), paint('cork', (.38, .24, .13), .8))
    model.camera((.12, .19, .62), (0, .112, 0), 26)


def globe(model):
    center, radius = (0, .062, 0), .038
    model.add('globe', sphere(radius, 32).join(sphere(radius - .0022, 32).inside_out())
              .placed(turned(0), center), GLASS)
    model.add('water', sphere(radius - .0016, 32).placed(turned(0), center), WATER)
    model.add('base', lathe(rounded((
        (0, .0005, 0), (.036, .0005, .002), (.031, .034, .002), (0, .034, 0)), 6), 96),
        paint('base', (.2, .07, .035), .35))
    rng = random.Random(8)
    ground = sphere(1, 16)
    ground.points = [(.0285 * x, .007 * y, .0285 * z) for x, y, z in ground.points]
    model.add('ground', smooth(ground).placed(turned(0), (0, .0405, 0)),
              paint('snow', (.9, .92, .95)))
    for i, (x, z, size) in enumerate(((-.004, 0, 1), (.014, .006, .62), (-.017, .01, .5))):
        parts = Mesh([], [], [])
        for k in range(4):
            low, wide = (.003 + .0075 * k) * size, (.0115 - .0024 * k) * size
            parts.join(lathe(with_normals(((0, low, None), (wide, low, None),
                                           (0, low + .013 * size, None))), 32))
        parts.join(lathe(with_normals(((0, -.003, None), (.0016, -.003, None), (.0016, .004, None),
                                       (0, .004, None))), 16))
        model.add(f'tree {i + 1}', flat(parts).placed(turned(0), (x, .0455, z)),
                  paint('fir', (.05, .2, .09), .8))
    flakes = Mesh([], [], [])
    while len(flakes.points) < 150 * len(sphere(1, 2).points):
        p = tuple(rng.uniform(-1, 1) for _ in range(3))
        if math.hypot(*p) < 1 and p[1] > -.45:
            flakes.join(sphere(rng.uniform(.0004, .0008), 2).placed(
                turned(0), tuple(.033 * a + b for a, b in zip(p, center))))
    model.add('flakes', flakes, paint('snow', (.9, .92, .95)))
    model.camera((.03, .12, .27), (0, .048, 0), 25)


def sea_ice(model):
    radii = [30 * (i / 70) ** 2 for i in range(71)]
    sea = lathe(with_normals([(0, -3, None), (30, -3, None), *((r, 0, None) for r in radii[:0:-1]),
                              (0, 0, None)]), 160)
    sea.points = [(x, y + (y == 0) * (.016 * noise((1.3 * x, 0, 2.1 * z), 5) +
                                      .006 * noise((4 * x, 0, 6 * z), 6)), z)
                  for x, y, z in sea.points]
    model.add('sea', smooth(sea), glass('sea', 1.34, 1, 3, (.2, .55, .65), 2))
    model.add('bed', lathe(with_normals(((0, -4, None), (31, -4, None), (31, -3.2, None),
                                         (0, -3.2, None))), 32), paint('bed', (.01, .03, .04), 1))
    floes = (((0, -.14, 0), (1.15, .3, .8), 20), ((-1.9, -.09, -1.6), (.9, .2, .6), 70),
             ((2.2, -.1, -2.2), (1.1, .22, .9), 130), ((.2, -.05, -4.6), (1.5, .2, 1), 200),
             ((-3.4, -.06, -5), (1.2, .2, .9), 10), ((1.3, -.03, 1.1), (.28, .09, .2), 50))
    for i, (at, half, turn) in enumerate(floes):
        floe = ice(half, 40, 60 + i, exponent=6, waves=.02, cell=.35, bulge=.12)
        model.add(f'floe {i + 1}', smooth(floe).placed(turned(turn), at),
                  glass('floe', 1.31, 2, .4, (.72, .9, 1), .8, cloud=5))
    model.camera((1.1, 1.05, 4.6), (0, -.05, -.4), 38)


MODELS = {'wine-glass': wine_glass, 'whisky': whisky, 'vase': vase, 'ring': diamond_ring,
          'aquarium': aquarium, 'bottle': bottle, 'globe': globe, 'sea-ice': sea_ice}


def main(folder='.'):
    for name, build in MODELS.items():
        model = Model()
        build(model)
        (pathlib.Path(folder) / f'{name}.glb').write_bytes(model.file())


if __name__ == '__main__':
    main(*sys.argv[1:2])
