"""stage.py: HDR panorama around the stage of model files: a blue-grey backdrop that is bright
at the horizon behind the object and dark above, soft boxes and strip lights for bright edges, and
black cards for dark ones. The shadow of the key light stays within the default view."""
import math

from files import exr
from shapes import mix, smoothstep
from studio import lamp

WIDTH, HEIGHT = 1024, 512
FACING = -30  # azimuth to the right of -Z that the default camera looks at, degrees
# Lights as in studio.py, but their azimuths are counted from FACING
BOXES = (
    (-62, 54, 0.36, 0.36, 5.0, 0.5, (1.0, 0.95, 0.88)),  # key light, left, behind
    (70, 33, 0.13, 0.50, 10.0, 0.5, (0.88, 0.95, 1.0)),  # strip light, right, behind
    (-116, 31, 0.09, 0.45, 7.0, 0.5, (0.92, 0.97, 1.0)),  # strip light, left
    (10, 78, 0.55, 0.35, 2.0, 0.6, (1.0, 1.0, 1.0)),  # above
    (148, 30, 0.45, 0.36, 0.9, 0.6, (1.0, 0.97, 0.93)),  # fill light, right of the camera
)
# Black cards: azimuth from FACING, half width, lowest and highest elevation, degrees
CARDS = ((42, 8, 2, 62), (98, 15, 2, 60), (-40, 7, 2, 62), (-92, 11, 2, 62), (-150, 22, 4, 50))
SUN = (-62, 54, 1.65, 1.57, 1.47)  # azimuth and elevation, radiance of a white surface


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
            pool = 0.2 + 0.8 * math.exp(-(turn / 60) ** 2)
            base = mix([pool * v for v in (0.250, 0.310, 0.390)], (0.014, 0.017, 0.022), sky)
            glow = (0.10 * math.exp(-(turn / 48) ** 2) * math.exp(-((up - 12) / 9) ** 2) *
                    smoothstep(0, 9, up))
            dark = 1
            for azimuth, half, low, high in CARDS:
                off = abs((turn - azimuth + 180) % 360 - 180)
                share = (smoothstep(half + 1.2, half - 1.2, off) *
                         smoothstep(low - 2, low + 2, up) * smoothstep(high + 3, high - 3, up))
                dark *= 1 - 0.93 * share
            line.append([(v + glow * c) * dark for v, c in zip(base, (0.8, 1.0, 1.3))])
        rows.append([[line[x][c] for x in range(WIDTH)] for c in range(3)])
    return rows


def make():
    rows = backdrop()
    for azimuth, *rest in BOXES:
        lamp(rows, (azimuth + FACING, *rest))
    return exr(rows, (180 - SUN[0] - FACING, *SUN[1:2], *SUN[2:]))
