"""hollow.py: model of a coloured knot in the cavity of a thick glass ball, on a tiled floor."""
import math

import surroundings as around
from files import Model, glass, unlit
from shapes import add, ring, scale, smoothstep, sphere, turned

OUTSIDE, INSIDE = 0.04, 0.0225  # radii of the ball and of its cavity
STAND, ROD = 0.018, 0.0045  # radii of the torus that the ball rests on
BALL = (0, ROD + math.sqrt((OUTSIDE + ROD + 0.00005) ** 2 - STAND ** 2), 0)
GLASS = glass('glass', 1.5, 3, 0.035, (0.9, 0.97, 0.94), 0.12)


def ball():
    """Closed shell of glass: a sphere, and the inner sphere with inverted normals."""
    mesh = sphere(OUTSIDE, 32).join(sphere(INSIDE, 24).inside_out())
    return mesh.placed(turned(0), BALL)


def hue(share):
    """Muted colour of a hue circle, around which `share` goes once from 0 to 1."""
    return tuple(0.09 + 0.74 * smoothstep(0.25, 1, 0.5 + 0.5 * math.cos(2 * math.pi * (share - at)))
                 for at in (0, 0.36, 0.66))


def knot():
    """A trefoil knot that rests on the bottom of the cavity, coloured along its length."""
    steps = 180
    path = []
    for i in range(steps):
        t = 2 * math.pi * i / steps
        r = 2 + math.cos(3 * t)
        p = (r * math.cos(2 * t), 1.25 * math.sin(3 * t), -r * math.sin(2 * t))
        path.append(scale(p, 0.0046))
    mesh = ring(path, 0.0036, 18)
    turns = [i // 18 / steps for i in range(len(mesh.points))]
    mesh.placed(turned(25, 58, 8), add(BALL, (0, -0.0003, 0)))
    shaded = around.painter((1, 1, 1))
    mesh.colors = [tuple(a * b for a, b in zip(hue(share), shaded(p, n)))
                   for share, p, n in zip(turns, mesh.points, mesh.normals)]
    return mesh


def stand():
    path = [(STAND * math.cos(a), ROD + 0.0002, -STAND * math.sin(a))
            for a in (2 * math.pi * i / 64 for i in range(64))]
    return ring(path, ROD, 20).painted(around.painter((0.09, 0.075, 0.065)))


def make():
    model = Model()
    floor = unlit('tiles', model.texture(around.tiles(5)))
    shadow = around.shade([(0, 0, 0.014)], 0.62, 0.02)

    def light(x, z):
        across, ahead = (x + 0.012) / 0.013, (z - 0.03) / 0.013
        gathered = 0.35 * math.exp(-across * across - ahead * ahead)
        return min(0.68 * shadow(x, z) + gathered, 1)
    model.add('floor', around.floor(0.5, 0.05, light, 44), floor)
    model.add('wall', around.wall(-0.5, 0.9, -0.1, 0.8, ((0.1, 0.09, 0.09), (0.93, 0.86, 0.78)),
                                  (0.06, 0.2, 0.34)), around.PAINTED)
    model.add('stand', stand(), around.PAINTED)
    model.add('knot', knot(), around.PAINTED)
    model.add('ball', ball(), GLASS)
    model.camera((0.02, 0.105, 0.24), (0, 0.041, 0), 26)
    return model.file()
