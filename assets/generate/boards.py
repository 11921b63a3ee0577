"""boards.py: procedural wood: mesh and texture of the table of drink.py."""
import math
import random

import surroundings as around
from files import png
from shapes import Mesh, sheet, smoothstep


def lamplit(x, z):
    """Baked light on the table, which falls off from a window at the back left."""
    return (1 - 0.6 * smoothstep(-0.16, 0.2, x + 0.4 * z)) * (
        1 - 0.35 * smoothstep(0.06, 0.3, math.hypot(x + 0.02, z)))


BOARD = 0.085  # width of a board, metres
GRAIN = (1024, (176, 176, 208, 272, 352))  # texels along and across the boards
LONG = 0.62  # period of the texture along the boards, metres


def board(seed, width, height):
    """
    Returns rows of shades, 0 to 47, of a board cut along a log: a procedural solid texture. Growth
    rings are cylinders around the pith, which is tilted against the board, so that the rings appear
    as arches. They are deflected around knots.
    """
    rng = random.Random(seed)
    pith = rng.uniform(-0.02, 0.02) if seed % 3 else rng.uniform(0.05, 0.08)
    deep, lean = rng.uniform(0.012, 0.03), rng.uniform(0.02, 0.09) * rng.choice((-1, 1))
    fibres = [around.row_noise(width, rng.randrange(9, 70), seed + 10 + k) for k in range(61)]
    wander = [around.row_noise(width, cells, seed + k) for k, cells in enumerate((3, 7, 17))]
    bands = [rng.uniform(0.55, 1.25) for _ in range(64)]  # darkness of each ring's late wood
    tone = rng.uniform(4, 15)
    rows = []
    for j in range(height):
        z = BOARD * ((j + 0.5) / height - 0.5)
        fine = [fibres[k] for k in ((j * 7) % 61, (j // 2 * 5 + 11) % 61, (j // 5 * 13 + 3) % 61)]
        edge = min(j + 0.5, height - 0.5 - j) * BOARD / height  # distance to the joint, metres
        row = bytearray()
        for i in range(width):
            x = LONG * (i + 0.5) / width
            sway = (0.008 * (wander[0][i] - 0.5) + 0.003 * (wander[1][i] - 0.5))
            below = deep + lean * (x - LONG / 2) + 0.012 * (wander[0][i] - 0.5)
            r = math.hypot(z - pith + sway, below) + 0.0006 * wander[2][i]
            dark = 0.0
            for kx, kz, size in KNOTS.get(seed, ()):
                away = math.hypot((x - kx) / 2.1, z - kz) / size
                if away < 6:
                    r += 0.012 * math.exp(-0.5 * away * away) + 0.001 * math.exp(-away / 3)
                    dark += 20 * smoothstep(1.15, 0.7, away)
            year = r / YEAR
            whole = int(year)
            t = year - whole
            late = smoothstep(0.25, 0.93, t) if t < 0.93 else (1 - t) / 0.07
            shade = (tone + 9 * late * bands[whole % 64] + dark + 6 * fine[0][i] + 6 * fine[1][i] +
                     7 * fine[2][i] - 5)
            if edge < 0.00045:
                shade = 47
            row.append(int(min(max(shade, 0), 47)))
        rows.append(row)
    return rows


# Knots of each board by its seed: positions along and across the board, size; metres.
KNOTS = {43: ((0.425, 0.014, 0.0042),), 41: ((0.17, -0.01, 0.005),)}
YEAR = 0.0034  # thickness of a growth ring, metres


def texture():
    """PNG with five boards, each with its own grain."""
    width, heights = GRAIN
    rows = [row for k, height in enumerate(heights) for row in board(40 + k, width, height)]
    return png(rows, around.ramp([(.66, .48, .315), (.54, .375, .235), (.41, .27, .16),
                                  (.28, .175, .1), (.12, .07, .04)], 48))


def table():
    """Ten boards at height 0 that run from left to right; each of five textures is used twice."""
    width, heights = GRAIN
    ends = [sum(heights[:k]) / sum(heights) for k in range(6)]
    mesh = Mesh([], [], [])
    for i in range(10):
        z = (i - 4.5) * BOARD
        wood = sheet((-0.55, 0, z + BOARD), (1.1, 0, 0), (0, 0, -BOARD), 12, 1)
        top, bottom = ends[i % 5], ends[i % 5 + 1]
        wood.uvs = [((u - 0.5) * 1.1 / LONG + 0.5 + i // 5 * 0.37, bottom + (top - bottom) * v)
                    for u, v in wood.uvs]
        mesh.join(wood)
    return mesh.painted(lambda p, n: (lamplit(p[0], p[2]),) * 3)
