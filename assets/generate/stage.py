"""stage.py: HDR panorama around the stage of model files: a blue backdrop with a pool of light
behind the object that fades to the sides and above, soft boxes and strip lights for bright edges,
and black cards for dark ones. The key light is warm and the strip lights are cool. The shadow of
the key light stays within the default view."""
import math

from files import exr
from shapes import mix, smoothstep
from studio import lamp

WIDTH, HEIGHT = 1024, 512
FACING = -30  # azimuth to the right of -Z that the default camera looks at, degrees
# Lights as in studio.py, but their azimuths are counted from FACING
BOXES = (
    (-62, 54, 0.36, 0.36, 6.5, 0.5, (1.0, 0.88, 0.72)),  # key light, left, behind
    (70, 33, 0.13, 0.50, 12.0, 0.5, (0.80, 0.92, 1.0)),  # strip light, right, behind
    (-116, 31, 0.09, 0.45, 9.0, 0.5, (0.86, 0.95, 1.0)),  # strip light, left
    (10, 78, 0.55, 0.35, 2.4, 0.6, (1.0, 1.0, 1.0)),  # above
    (148, 30, 0.45, 0.36, 1.0, 0.6, (1.0, 0.93, 0.84)),  # fill light, right of the camera
)
# Black cards: azimuth from FACING, half width, lowest and highest elevation, degrees
CARDS = ((42, 8, 2, 62), (98, 15, 2, 60), (-40, 7, 2, 62), (-92, 11, 2, 62), (-150, 22, 4, 50))
SUN = (-62, 54, 1.95, 1.68, 1.36)  # azimuth and elevation, radiance of a white surface


def backdrop():
    """Rows of R, G and B lists: light at the horizon and behind the object, dark above."""
    rows = []
    for y in range(HEIGHT):
        height = math.degrees((0.5 - (y + 0.5) / HEIGHT) * math.pi)
        up = max(height, 0)
        sky = smoothstep(0, 50, up)
        line = []
        for x in range(WIDTH):
            turn = (((x + 0.5) / WIDTH - 0.5) * 360 - FACING + 180) % 360 - 180
            pool = 0.08 + 0.92 * math.exp(-(turn / 38) ** 2)
            base = mix([pool * v for v in (0.150, 0.285, 0.450)], (0.008, 0.013, 0.022), sky)
            glow = (0.30 * math.exp(-(turn / 27) ** 2) * math.exp(-((up - 3) / 9) ** 2) *
                    smoothstep(-4, 4, height))
            dark = 1
            for azimuth, half, low, high in CARDS:
                off = abs((turn - azimuth + 180) % 360 - 180)
                share = (smoothstep(half + 1.2, half - 1.2, off) *
                         smoothstep(low - 2, low + 2, up) * smoothstep(high + 3, high - 3, up))
                dark *= 1 - 0.93 * share
            line.append([(v + glow * c) * dark for v, c in zip(base, (0.62, 1.0, 1.38))])
        rows.append([[line[x][c] for x in range(WIDTH)] for c in range(3)])
    return rows


def make():
    rows = backdrop()
    for azimuth, *rest in BOXES:
        lamp(rows, (azimuth + FACING, *rest))
    return exr(rows, (180 - SUN[0] - FACING, *SUN[1:2], *SUN[2:]))
