"""stage.py: HDR panorama around the stage of model files: a pool of light on a blue-grey backdrop
behind the object, which fades to the sides and above, and large soft boxes whose light fades
towards soft edges. The rest is dark, so that light draws the edges of clear objects. The key light
is warm and the others are cool. Its shadow stays within the default view."""
import math

from files import exr
from shapes import mix
from studio import lamp

WIDTH, HEIGHT = 1024, 512
FACING = -30  # azimuth to the right of -Z that the default camera looks at, degrees
SOFT = 0.14  # width of the boxes' edges, tangent of an angle
# Lights as in studio.py, but their azimuths are counted from FACING
BOXES = (
    (-66, 40, 0.50, 0.62, 4.2, 0.10, (1.0, 0.90, 0.76)),  # key light, left, behind
    (66, 36, 0.26, 0.75, 7.5, 0.15, (0.84, 0.93, 1.0)),  # strip light, right, behind
    (-128, 34, 0.30, 0.60, 3.0, 0.15, (0.90, 0.95, 1.0)),  # window, left of the camera
    (0, 82, 0.75, 0.50, 2.2, 0.30, (1.0, 1.0, 1.0)),  # above
    (140, 34, 0.60, 0.45, 0.9, 0.30, (1.0, 0.95, 0.88)),  # fill light, right of the camera
)
SUN = (-62, 54, 1.95, 1.68, 1.36)  # azimuth and elevation, radiance of a white surface


def backdrop():
    """Rows of R, G and B lists: light at the horizon behind the object, dark above."""
    rows = []
    for y in range(HEIGHT):
        up = max(math.degrees((0.5 - (y + 0.5) / HEIGHT) * math.pi), 0)
        low = math.exp(-(up / 22) ** 2)
        line = []
        for x in range(WIDTH):
            turn = (((x + 0.5) / WIDTH - 0.5) * 360 - FACING + 180) % 360 - 180
            pool = 0.06 + 0.94 * math.exp(-(turn / 18) ** 2)
            line.append(mix((0.010, 0.013, 0.018),
                            [pool * v for v in (0.40, 0.61, 0.84)], low))
        rows.append([[line[x][c] for x in range(WIDTH)] for c in range(3)])
    return rows


def make():
    rows = backdrop()
    for azimuth, *rest in BOXES:
        lamp(rows, (azimuth + FACING, *rest), SOFT)
    return exr(rows, (180 - SUN[0] - FACING, *SUN[1:2], *SUN[2:]))
