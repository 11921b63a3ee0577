"""tabletop.py: random glass vessels with liquids on a table, as scenes for data sets."""
from __future__ import annotations

import numpy as np

from .device import Device, Material, Scene
from .errors import UsageError

SEGMENTS = 96   # of a surface of revolution
RINGS = 24      # of a vessel's wall
SQUARES = 24    # of the table's side
SQUARE = 0.06   # side of a square, metres
GAP = 0.0002    # of air between table and vessels, metres


def revolve(profile) -> tuple:
    """
    Returns positions (n, 3) and indices (m, 3) of a closed surface of revolution about +Y. `profile`
    (k, 2) lists radius and height, from the lower to the upper end of the axis, outside to the right.
    """
    profile = np.asarray(profile, dtype=float)
    angles = np.arange(SEGMENTS) * (2 * np.pi / SEGMENTS)
    inner = profile[1:-1]  # both ends are on the axis
    rings = np.stack([inner[:, :1] * np.sin(angles), np.repeat(inner[:, 1:], SEGMENTS, axis=1),
                      inner[:, :1] * np.cos(angles)], axis=-1).reshape(-1, 3)
    points = np.concatenate([rings, [(0, profile[0, 1], 0), (0, profile[-1, 1], 0)]])
    faces = []
    for ring in range(len(inner)):
        for i in range(SEGMENTS):
            a, b = ring * SEGMENTS + i, ring * SEGMENTS + (i + 1) % SEGMENTS
            if ring == 0:
                faces.append((len(rings), b, a))
            if ring == len(inner) - 1:
                faces.append((len(rings) + 1, a, b))
            else:
                faces += [(a, b, a + SEGMENTS), (b, b + SEGMENTS, a + SEGMENTS)]
    return points, np.array(faces)


def vessel(rng, wall: float, level: float) -> tuple:
    """
    Returns the profiles of a random vessel and of its liquid, or None, and the vessel's maximum
    radius. `wall` is in metres; `level` is the filled fraction of the inner height.
    """
    height, radius = rng.uniform(0.06, 0.16), rng.uniform(0.025, 0.04)
    bulge, mouth = rng.uniform(-0.15, 0.25), rng.uniform(0.7, 1.2)
    base = 2 * wall

    def outside(y):
        t = y / height
        return radius * (1 + (mouth - 1) * t + bulge * np.sin(np.pi * t))
    up = np.linspace(0, height, RINGS)
    down = np.linspace(height, base, RINGS)
    profile = [(0, 0), *zip(outside(up), up), *zip(outside(down) - wall, down), (0, base)]
    top = base + level * (height - base)
    filled = np.linspace(base, top, RINGS)
    # the liquid overlaps the glass, whose priority is higher
    liquid = [(0, base - wall / 2), *zip(outside(filled) - wall / 2, filled - wall / 2 * (
        filled == base)), (0, top)] if level > 0 else None
    return profile, liquid, float(max(outside(up)))


def _pose(rng, place, profile, liquid) -> np.ndarray:
    """Returns the matrix of a vessel at a place (x, z): upright or, if empty, sometimes lying."""
    turn = rng.uniform(0, 2 * np.pi)
    yaw = np.array([[np.cos(turn), 0, np.sin(turn)], [0, 1, 0], [-np.sin(turn), 0, np.cos(turn)]])
    rotation, lift = yaw, GAP
    if liquid is None and rng.uniform() < 0.3:
        rotation = yaw @ [[0, 1, 0], [-1, 0, 0], [0, 0, 1]]
        lift += max(radius for radius, _ in profile)
    return np.column_stack([rotation, (place[0], lift, place[1])])


def _drop(rng, count: int, radius: float) -> list:
    """Returns up to `count` places (x, z) whose discs do not overlap."""
    places = []
    for _ in range(50 * count):
        place = rng.uniform(-1, 1, 2) * min(radius * (1 + count), 0.4)
        if len(places) < count and all(np.hypot(*(place - other)) > 2 * radius for other in places):
            places.append(place)
    return places


def _add_table(scene: Scene, rng) -> None:
    """Adds a checkerboard of two random colours, whose surface is at height 0."""
    at = (np.arange(SQUARES) - SQUARES / 2) * SQUARE
    corners = np.array([(0, 0, 0), (0, 0, SQUARE), (SQUARE, 0, SQUARE), (SQUARE, 0, 0)])
    for parity, name in enumerate(('light squares', 'dark squares')):
        squares = [corners + (x, 0, z) for i, x in enumerate(at) for k, z in enumerate(at)
                   if (i + k) % 2 == parity]
        faces = np.array([(0, 1, 2), (0, 2, 3)])
        color = rng.uniform(*((0.5, 0.9) if parity == 0 else (0.05, 0.3)), 3)
        mesh = scene.add_mesh(np.concatenate(squares),
                              np.concatenate([faces + 4 * i for i in range(len(squares))]))
        scene.add(mesh, scene.add_material(Material(base_color=(*color, 1), metallic=0,
                                                    roughness=0.6)), name)


def tabletop(device: Device, rng, *, vessels=(1, 3), wall=(0.0015, 0.003), level=(0.0, 0.8),
             show: str = 'glass', **options) -> Scene:
    """
    Returns a scene of random vessels on a table. `vessels` is the range of their number, `wall` of
    the wall thickness in metres, and `level` of the filled fraction; below 0.1, a vessel is empty and
    may lie on its side. The scene depends only on `rng` and the ranges.

    `show` makes pairs from equal generators: 'glass'; 'opaque' for the same shapes, white and without
    liquids; 'background' for the table alone. `options` are those of Device.load().
    """
    if show not in ('glass', 'opaque', 'background'):
        raise UsageError(f"show: expected 'glass', 'opaque' or 'background', got {show!r}")
    scene = device.scene(**{'ground': 'none', **options})
    try:
        _add_table(scene, rng)
        shapes = []
        for _ in range(rng.integers(*vessels, endpoint=True)):
            filled = rng.uniform(*level)
            shapes.append(vessel(rng, rng.uniform(*wall), filled if filled >= 0.1 else 0))
        # a lying vessel reaches as far as its height
        reach = max(max(radius, profile[RINGS][1] if liquid is None else 0)
                    for profile, liquid, radius in shapes)
        opaque = Material(base_color=(0.8, 0.8, 0.8, 1), metallic=0, roughness=0.5)
        glass = opaque if show == 'opaque' else Material('glass', priority=2)
        water = Material('water', priority=1)
        for number, (place, (profile, liquid, _)) in enumerate(
                zip(_drop(rng, len(shapes), reach), shapes), 1):
            world = _pose(rng, place, profile, liquid)
            if show == 'background':
                continue
            scene.add(scene.add_mesh(*revolve(profile)), scene.add_material(glass),
                      f'vessel {number}', world)
            if liquid and show == 'glass':
                scene.add(scene.add_mesh(*revolve(liquid)), scene.add_material(water),
                          f'liquid {number}', world)
    except BaseException:
        scene.close()
        raise
    return scene
