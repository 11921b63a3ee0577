"""window.py: HDR panorama of a room with warm walls and windows to the left and right."""
import math

from files import exr
from shapes import mix, noise, scale, smoothstep
from studio import HEIGHT, WIDTH, lamp

# Centre of each window: azimuth to the right of -Z and elevation, degrees; half width and half
# height of a pane as tangents of angles; panes across and up; radiance of the sky; colour
WINDOWS = (
    (-61, 34, 0.18, 0.24, 2, 3, 7.4, (1.04, 0.985, 0.91)),
    (70, 29, 0.21, 0.23, 1, 3, 4.6, (0.86, 0.93, 1.0)),
    (-163, 33, 0.22, 0.13, 1, 1, 1.7, (1.0, 0.96, 0.9)),
)
BAR = 0.012  # half width of a glazing bar
# Trees in the haze outside the windows: mean elevation of their tops and its variation, degrees;
# colours of shaded and sunlit leaves
TREES = (19, 7, (0.13, 0.15, 0.13), (0.5, 0.53, 0.46))
# Sun behind the left window: azimuth and elevation (see environment.h), radiance
SUN = (246, 33, 0.42, 0.36, 0.28)
GLOW = (-3, 9, (0.84, 0.69, 0.49))  # bright spot of the wall: azimuth, elevation, radiance

# Blurred, dappled patch of sunlight on the wall: azimuth and elevation of its centre, half width
# and half height, degrees; shear in azimuth per degree of elevation; brightness relative to GLOW
PATCH = (-13.5, 3.5, 5.2, 10.5, 0.34, 0.3)


def patch(azimuth, height):
    """Sunlight of PATCH, 0 to 1, with shadows of glazing bars and leaves."""
    middle, up, half, tall, lean, _ = PATCH
    x, y = (azimuth - middle - lean * (height - up)) / half, (height - up) / tall
    if max(abs(x), abs(y)) > 1.5:
        return 0.0
    share = smoothstep(1.25, 0.7, abs(x)) * smoothstep(1.1, 0.9, abs(y))
    bars = 1 - 0.5 * math.exp(-(x / 0.16) ** 2) - 0.35 * math.exp(-((y + 0.35) / 0.09) ** 2)
    leaves = smoothstep(-0.5, 0.45, noise((azimuth / 3.1, height / 2.3, 1.5), 11) +
                        0.4 * noise((azimuth / 1.5, height / 1.2, 2.5), 12))
    return share * max(bars, 0) * (0.35 + 0.65 * leaves)


def walls():
    """Rows of R, G and B lists: a bright wall ahead, a dim room, a dark floor."""
    azimuth, elevation, color = GLOW
    rows = []
    for y in range(HEIGHT):
        height = (0.5 - (y + 0.5) / HEIGHT) * 180
        low = smoothstep(-40, -12, height)
        room = mix((0.03, 0.024, 0.019), (0.046, 0.037, 0.028), low)
        room = mix(room, (0.1, 0.094, 0.086), smoothstep(30, 75, height))
        tall = math.exp(-((height - elevation) / 20) ** 2) * low
        row = [[], [], []]
        for x in range(WIDTH):
            aside = ((x + 0.5) / WIDTH * 360 - 180) - azimuth
            broad, narrow = (math.exp(-(aside / width) ** 2) for width in (27, 12))
            share = tall * (0.45 * broad + 0.55 * narrow)
            for channel, value in zip(row, room):
                channel.append(value)
            share += PATCH[-1] * patch(aside + azimuth, height)
            for channel, value in zip(row, scale(color, share)):
                channel[-1] += value
        rows.append(row)
    return rows


def outside(d):
    """Blurred view of sky and trees through the windows, relative to the radiance of the sky."""
    tops, uneven, shade, sun = TREES
    height = math.degrees(math.asin(d[1]))
    top = tops + uneven * (noise(scale(d, 5), 3) + 0.5 * noise(scale(d, 13), 4))
    leaves = smoothstep(-0.35, 0.45, noise(scale(d, 17), 5) + 0.5 * noise(scale(d, 37), 6))
    leaves = mix(mix(shade, sun, leaves), (0.82, 0.86, 0.88), 0.6)
    gaps = smoothstep(0.35, 0.6, noise(scale(d, 29), 7)) * smoothstep(12, 0, top - height)
    clouds = smoothstep(-0.3, 0.5, noise((4 * d[0], 11 * d[1], 4 * d[2]), 8))
    sky = mix((0.84, 0.93, 1.06), (1.08, 1.07, 1.05), max(clouds, smoothstep(50, 24, height)))
    return mix(sky, leaves, smoothstep(-2, 2, top - height) * (1 - 0.8 * gaps))


def panes(window):
    """Yields the panes of a window as soft boxes for studio.lamp()."""
    azimuth, elevation, across, up, columns, lines, radiance, color = window
    level = math.cos(math.radians(elevation))
    for i in range(columns):
        for j in range(lines):
            aside = (2 * i - columns + 1) * (across + BAR)
            high = (2 * j - lines + 1) * (up + BAR)
            yield (azimuth + math.degrees(math.atan(aside)) / level,
                   elevation + math.degrees(math.atan(high)), across, up, radiance, 0.9,
                   lambda d: tuple(a * b for a, b in zip(color, outside(d))))


def make():
    rows = walls()
    for window in WINDOWS:
        for box in panes(window):
            lamp(rows, box)
    return exr(rows, SUN)
