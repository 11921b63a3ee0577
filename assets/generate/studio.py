"""studio.py: HDR panorama of a dark studio with soft boxes and strip lights."""
import math

from files import exr
from shapes import cross, dot, mix, scale, smoothstep, unit

WIDTH, HEIGHT = 1024, 512
# Azimuth to the right of -Z and elevation of the centre, degrees; half width and half height as
# tangents of angles; radiance at the centre; fraction of that radiance far from it; colour
BOXES = (
    (62, 28, 0.34, 0.52, 9.0, 0.35, (1.0, 0.96, 0.9)),  # key light, right, behind
    (-72, 18, 0.11, 0.75, 6.5, 0.3, (0.86, 0.94, 1.0)),  # strip light, left
    (-128, 34, 0.42, 0.3, 2.4, 0.5, (0.92, 0.97, 1.0)),  # a window, left of the camera
    (150, 22, 0.07, 0.6, 4.0, 0.3, (1.0, 0.97, 0.93)),  # strip light, right of the camera
    (8, 79, 0.55, 0.4, 3.6, 0.55, (1.0, 1.0, 1.0)),  # above
)


def direction(azimuth, elevation):
    c = math.cos(elevation)
    return (c * math.sin(azimuth), math.sin(elevation), -c * math.cos(azimuth))


def backdrop():
    """Rows of R, G and B lists without lights: dark floor, dark air and a glow on the far wall."""
    tall = [math.exp(-((0.5 - (y + 0.5) / HEIGHT) * math.pi - 0.16) ** 2 / 0.18)
            for y in range(HEIGHT)]
    wide = [math.exp(-((x + 0.5) / WIDTH * 2 - 1) ** 2 * math.pi ** 2 / 1.1) for x in range(WIDTH)]
    rows = []
    for y in range(HEIGHT):
        height = (0.5 - (y + 0.5) / HEIGHT) * 2
        above = smoothstep(-0.06, 0.05, height)
        low = mix((0.022, 0.023, 0.026), (0.05, 0.052, 0.058), smoothstep(-0.7, 0, height))
        high = mix((0.03, 0.034, 0.042), (0.012, 0.013, 0.016), smoothstep(0, 0.9, height))
        base = mix(low, high, above)
        glow = scale((0.15, 0.235, 0.34), tall[y] * (0.3 + 0.7 * above))
        rows.append([[b + g * w for w in wide] for b, g in zip(base, glow)])
    return rows


def lamp(rows, box, soft=0.012):
    """Draws a soft box into the rows. The colour of the box may be a function of the direction.
    `soft` is the width of the edges, tangent of an angle; by default two texels."""
    azimuth, elevation, half_width, half_height, radiance, ends, color = box
    middle = direction(math.radians(azimuth), math.radians(elevation))
    across = unit(cross(middle, (0, 1, 0)))
    up = cross(across, middle)
    reach = math.atan(math.hypot(half_width, half_height))
    nearest = math.cos(reach + 0.02)
    circle = [direction(((x + 0.5) / WIDTH * 2 - 1) * math.pi, 0) for x in range(WIDTH)]
    for y in range(HEIGHT):
        height = (0.5 - (y + 0.5) / HEIGHT) * math.pi
        if abs(height - math.radians(elevation)) > reach + 0.02:
            continue
        level, sine = math.cos(height), math.sin(height)
        for x, (east, _, south) in enumerate(circle):
            ahead = level * (east * middle[0] + south * middle[2]) + sine * middle[1]
            if ahead < nearest:
                continue
            d = (level * east, sine, level * south)
            u, v = dot(d, across) / ahead / half_width, dot(d, up) / ahead / half_height
            if abs(u) > 1 or abs(v) > 1:
                continue
            share = (smoothstep(1, 1 - soft / half_width, abs(u)) *
                     smoothstep(1, 1 - soft / half_height, abs(v)))
            light = radiance * (ends + (1 - ends) * math.exp(-1.4 * (u * u + v * v)))
            tint = color(d) if callable(color) else color
            for c in range(3):
                rows[y][c][x] += share * (light * tint[c] - rows[y][c][x])


def make():
    rows = backdrop()
    for box in BOXES:
        lamp(rows, box)
    return exr(rows)
