"""models.py: generates the models of the contact sheet of docs/gallery.md.

Usage: models.py [FOLDER]   writes goblet.ply, crystal.ply, bottle.ply, lens.ply, king.ply,
jellyfish.ply and ring.glb. Lengths are metres. It needs only Python's standard library.
"""
import math
import pathlib
import random
import sys

sys.dont_write_bytecode = True  # keep __pycache__ out of the source tree
ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / 'docs/recipes'), str(ROOT / 'assets/generate')]
import models as recipes  # noqa: E402
from files import Model  # noqa: E402
from shapes import (Mesh, cube_grid, lathe, rounded, smooth_normals, smoothstep,  # noqa: E402
                    tube, turned, with_normals)


def goblet():
    return lathe(recipes.curve((
        (0, .0008), (.030, .0004), (.036, .0006), (.0365, .0018), (.034, .0030), (.018, .0055),
        (.0075, .012), (.0055, .022), (.0075, .032), (.0110, .038), (.0075, .044), (.0055, .054),
        (.0062, .070), (.014, .080), (.030, .092), (.041, .112), (.044, .135), (.0415, .160),
        (.0385, .178), (.0378, .1792), (.0369, .178), (.0398, .160), (.0422, .135), (.0393, .113),
        (.0286, .0945), (.012, .0845), (0, .0825))), 96)


def prism(radius, height, tip, seed):
    """Irregular hexagonal prism with a pyramid on top."""
    rng = random.Random(seed)
    sides = [radius * rng.uniform(.82, 1.15) for _ in range(6)]
    low = [(r * math.cos(i * math.pi / 3), 0, -r * math.sin(i * math.pi / 3))
           for i, r in enumerate(sides)]
    top = [(.92 * x, height * rng.uniform(.93, 1.05), .92 * z) for x, _, z in low]
    apex = (radius * rng.uniform(-.2, .2), height + tip, radius * rng.uniform(-.2, .2))
    faces = []
    for i in range(6):
        j = (i + 1) % 6
        faces += [(i, j, 6 + j), (i, 6 + j, 6 + i), (6 + i, 6 + j, 12), (13, j, i)]
    return recipes.flat(Mesh(low + top + [apex, (0, 0, 0)], faces))


def crystal():
    """Cluster of overlapping prisms."""
    cluster = Mesh([], [], [])
    for size, turn, at in (((.011, .055, .016, 3), (10, 0, 4), (0, 0, 0)),
                           ((.007, .036, .010, 4), (40, 24, -10), (.009, .001, .006)),
                           ((.006, .030, .009, 5), (5, -20, 26), (-.010, .001, .003)),
                           ((.005, .024, .007, 6), (70, -26, -14), (.004, .001, -.010)),
                           ((.0045, .018, .006, 8), (20, 32, 12), (-.004, .001, .011))):
        cluster.join(prism(*size).placed(turned(*turn), at))
    return cluster


def bottle():
    return lathe(rounded((
        (0, .006, 0), (.024, .001, .004), (.036, .002, .005), (.037, .150, .025),
        (.0140, .200, .02), (.0135, .245, .001), (.0155, .246, .001), (.0155, .258, .002),
        (.0105, .259, .001), (.0105, .199, .02), (.0335, .148, .025), (.0330, .009, .006),
        (0, .014, 0)), 8), 96)


def lens():
    """Biconvex lens that stands on its rim."""
    radius, half, rim = .070, .030, .0015  # of the surfaces, of the lens; half thickness at the rim
    sagitta = radius - math.sqrt(radius * radius - half * half)
    angles = [math.asin(half / radius) * i / 24 for i in range(25)]
    front = [(radius * math.sin(a), -(rim + sagitta - radius * (1 - math.cos(a))), None)
             for a in angles]
    back = [(r, -y, None) for r, y, _ in front[::-1]]
    return lathe(with_normals(front + back), 128).placed(turned(28, 90), (0, half, 0))


def king():
    def bar(height, half):
        points, faces = cube_grid(2)
        points = [(x * half[0], height + y * half[1], z * half[2]) for x, y, z in points]
        return recipes.flat(Mesh(points, faces))
    body = lathe(recipes.curve((
        (0, .0003), (.0165, .0002), (.0185, .0012), (.0185, .005), (.0165, .008), (.0172, .0105),
        (.0150, .013), (.0110, .017), (.0082, .026), (.0068, .042), (.0072, .055), (.0120, .058),
        (.0123, .0605), (.0085, .062), (.0092, .0645), (.0080, .066), (.0092, .071),
        (.0122, .082), (.0118, .0835), (.0070, .0865), (.003, .0885), (0, .0888))), 72)
    return body.join(bar(.0945, (.0016, .0066, .0014))).join(bar(.0960, (.0050, .0016, .00139)))


def jellyfish():
    bell = lathe(recipes.curve((
        (0, .098), (.014, .097), (.028, .090), (.038, .077), (.042, .062), (.0405, .054),
        (.0385, .0535), (.0370, .061), (.0335, .074), (.024, .084), (.012, .0895), (0, .0905)),
        8), 96).inside_out()
    lobed = []
    for x, y, z in bell.points:
        radius, lobe = math.hypot(x, z), math.cos(8 * math.atan2(z, x))
        wide = 1 + .06 * lobe * smoothstep(.02, .042, radius)
        lobed.append((x * wide, y - .004 * lobe * smoothstep(.03, .042, radius), z * wide))
    bell.points, bell.normals = lobed, smooth_normals(lobed, bell.faces)
    rng = random.Random(2)
    for i in range(9):
        turn = 2 * math.pi * i / 9 + rng.uniform(-.2, .2)
        out, length = rng.uniform(.010, .030), rng.uniform(.075, .088)
        bend, phase = rng.uniform(.003, .006), rng.uniform(0, 6)
        top = .092 - (out / .042) ** 2 * .030
        path = [((out + .004 * t) * math.cos(turn) + bend * t * math.sin(5 * t + phase),
                 top - min(length, top - .002) * t,
                 (out + .004 * t) * math.sin(turn) + bend * t * math.cos(4.3 * t + phase))
                for t in (k / 40 for k in range(41))]
        bell.join(recipes.smooth(tube(path, lambda t: .0022 * (1 - .75 * t) + .0003, 12)))
    return bell


def ply(mesh):
    lines = ['ply', 'format ascii 1.0', f'element vertex {len(mesh.points)}',
             *(f'property float {name}' for name in ('x', 'y', 'z', 'nx', 'ny', 'nz')),
             f'element face {len(mesh.faces)}', 'property list uchar int vertex_indices',
             'end_header']
    lines += ['{:.7g} {:.7g} {:.7g} {:.4f} {:.4f} {:.4f}'.format(*point, *normal)
              for point, normal in zip(mesh.points, mesh.normals)]
    return '\n'.join(lines + ['3 {} {} {}'.format(*face) for face in mesh.faces]) + '\n'


def ring():
    model = Model()
    recipes.diamond_ring(model)
    model.json.pop('cameras')
    model.json['nodes'] = [node for node in model.json['nodes'] if 'camera' not in node]
    return model.file()


def main(folder='.'):
    folder = pathlib.Path(folder)
    for build in (goblet, crystal, bottle, lens, king, jellyfish):
        (folder / f'{build.__name__}.ply').write_text(ply(build()), 'ascii')
    (folder / 'ring.glb').write_bytes(ring())


if __name__ == '__main__':
    main(*sys.argv[1:2])
