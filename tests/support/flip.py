"""flip.py: reference implementation of the image metric FLIP, with slow non-separable filters.

An independent check of src/lab/metric/flip.c, which uses separable filters and single precision.
Andersson et al.: FLIP: A Difference Evaluator for Alternating Images, HPG 2020; Visualizing Errors
in Rendered High Dynamic Range Images, Eurographics 2021. An image is a list of rows of linear
(red, green, blue).
"""
import math

PPD = 0.7 * 3840 / 0.7 * math.pi / 180
# Linear Rec.709 (D65) to CIE XYZ, as exact fractions.
XYZ = ((10135552 / 24577794, 8788810 / 24577794, 4435075 / 24577794),
       (2613072 / 12288897, 8788810 / 12288897, 887015 / 12288897),
       (1425312 / 73733382, 8788810 / 73733382, 70074185 / 73733382))
RGB = ((3.241003275, -1.537398934, -0.498615861),  # CIE XYZ to linear Rec.709
       (-0.969224334, 1.875930071, 0.041554224),
       (0.055639423, -0.204011202, 1.057148933))
WHITE = tuple(sum(row) for row in XYZ)


def decode(encoded):
    """Converts an sRGB-encoded value to linear."""
    return encoded / 12.92 if encoded <= 0.04045 else ((encoded + 0.055) / 1.055) ** 2.4


def multiply(matrix, vector):
    return tuple(sum(a * b for a, b in zip(row, vector)) for row in matrix)


def to_opponent(rgb):
    x, y, z = (value / white for value, white in zip(multiply(XYZ, rgb), WHITE))
    return 116 * y - 16, 500 * (x - y), 200 * (y - z)


def from_opponent(colour):
    y = (colour[0] + 16) / 116
    white = y + colour[1] / 500, y, y - colour[2] / 200
    return multiply(RGB, [value * of for value, of in zip(white, WHITE)])


def to_hunt(rgb):
    def root(t):
        return t ** (1 / 3) if t > (6 / 29) ** 3 else t / (3 * (6 / 29) ** 2) + 4 / 29
    x, y, z = (root(value / white) for value, white in zip(multiply(XYZ, rgb), WHITE))
    lightness = 116 * y - 16
    return lightness, 0.01 * lightness * 500 * (x - y), 0.01 * lightness * 200 * (y - z)


def hyab(a, b):
    return abs(a[0] - b[0]) + math.hypot(a[1] - b[1], a[2] - b[2])


MAX_COLOUR_ERROR = hyab(to_hunt((0, 1, 0)), to_hunt((0, 0, 1))) ** 0.7


def colour_error(distance):
    power, knee = distance ** 0.7, 0.4 * MAX_COLOUR_ERROR
    if power < knee:
        return 0.95 / knee * power
    return 0.95 + (power - knee) / (MAX_COLOUR_ERROR - knee) * 0.05


def square(radius, weight):
    """Returns a square filter kernel as {(x, y): weight}."""
    reach = range(-radius, radius + 1)
    return {(x, y): weight(x, y) for y in reach for x in reach}


def sensitivity(gaussians, ppd):
    def weight(x, y):
        z = (x / ppd) ** 2 + (y / ppd) ** 2
        return sum(a * math.sqrt(math.pi / b) * math.exp(-math.pi ** 2 * z / b)
                   for a, b in gaussians)
    kernel = square(math.ceil(3 * math.sqrt(0.04 / (2 * math.pi ** 2)) * ppd), weight)
    whole = sum(kernel.values())
    return {place: value / whole for place, value in kernel.items()}


def detector(factor, ppd):
    """Kernel of the edge or point detector: a Gaussian times factor(x, deviation), in pixels."""
    deviation = 0.5 * 0.082 * ppd
    kernel = square(math.ceil(3 * deviation), lambda x, y: factor(x, deviation) * math.exp(
        -(x * x + y * y) / (2 * deviation ** 2)))
    above = sum(value for value in kernel.values() if value > 0)
    below = -sum(value for value in kernel.values() if value < 0)
    return {place: value / (above if value > 0 else below) for place, value in kernel.items()}


def convolve(plane, kernel):
    height, width = len(plane), len(plane[0])
    return [[sum(weight * plane[min(max(y + dy, 0), height - 1)][min(max(x + dx, 0), width - 1)]
                 for (dx, dy), weight in kernel.items())
             for x in range(width)] for y in range(height)]


def features(luminance, kernel):
    turned = {(y, x): weight for (x, y), weight in kernel.items()}
    across, down = convolve(luminance, kernel), convolve(luminance, turned)
    return [[math.hypot(a, b) for a, b in zip(*rows)] for rows in zip(across, down)]


def prepare(image, ppd):
    """Returns (Hunt-adjusted colours after the CSF filters, edge features, point features)."""
    colours = [[to_opponent(pixel) for pixel in row] for row in image]
    kernels = (sensitivity([(1, 0.0047)], ppd), sensitivity([(1, 0.0053)], ppd),
               sensitivity([(34.1, 0.04), (13.5, 0.025)], ppd))
    planes = [convolve([[pixel[c] for pixel in row] for row in colours], kernels[c])
              for c in range(3)]
    perceived = [[to_hunt([min(max(value, 0), 1) for value in from_opponent(pixel)])
                  for pixel in zip(*rows)] for rows in zip(*planes)]
    luminance = [[(pixel[0] + 16) / 116 for pixel in row] for row in colours]
    edge = detector(lambda x, deviation: -x, ppd)
    point = detector(lambda x, deviation: x * x / deviation ** 2 - 1, ppd)
    return perceived, features(luminance, edge), features(luminance, point)


def ldr(reference, test, ppd=PPD):
    """Returns rows of LDR-FLIP errors of two images with values from 0 to 1."""
    a, b = prepare(reference, ppd), prepare(test, ppd)

    def error(y, x):
        feature = max(abs(a[1][y][x] - b[1][y][x]), abs(a[2][y][x] - b[2][y][x]))
        colour = colour_error(hyab(a[0][y][x], b[0][y][x]))
        return colour ** (1 - math.sqrt(feature / math.sqrt(2)))
    return [[error(y, x) for x in range(len(row))] for y, row in enumerate(reference)]


def aces(x):
    x *= 0.6
    return x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14)


def hable(x):
    def curve(t):
        return ((t * (0.15 * t + 0.1 * 0.5) + 0.2 * 0.02) /
                (t * (0.15 * t + 0.5) + 0.2 * 0.3)) - 0.02 / 0.3
    return curve(2 * x) / curve(11.2)


def luminance_of(pixel):
    return 0.2126 * pixel[0] + 0.7152 * pixel[1] + 0.0722 * pixel[2]


def tone(pixel, curve):
    if curve == 'reinhard':
        shown = [value / (1 + luminance_of(pixel)) for value in pixel]
    else:
        shown = [{'aces': aces, 'hable': hable}[curve](value) for value in pixel]
    return [min(max(value, 0), 1) for value in shown]


def bright(curve):
    """Returns the luminance that the tone curve maps to 0.85, by bisection."""
    low, high = 0.0, 100.0
    for _ in range(100):
        middle = (low + high) / 2
        if tone([middle] * 3, curve)[0] < 0.85:
            low = middle
        else:
            high = middle
    return low


def exposures(reference, curve):
    values = sorted(luminance_of(pixel) for row in reference for pixel in row)
    median = (values[(len(values) - 1) // 2] + values[len(values) // 2]) / 2
    first, last = math.log2(bright(curve) / values[-1]), math.log2(bright(curve) / median)
    count = max(2, math.ceil(last - first))
    return [first + i * (last - first) / (count - 1) for i in range(count)]


def hdr(reference, test, curve='aces', ppd=PPD):
    """Returns rows of HDR-FLIP errors: the maximum LDR-FLIP error over all exposures."""
    maps = []
    for stops in exposures(reference, curve):
        shown = [[[tone([2 ** stops * max(value, 0) for value in pixel], curve) for pixel in row]
                  for row in image] for image in (reference, test)]
        maps.append(ldr(*shown, ppd))
    return [[max(errors) for errors in zip(*rows)] for rows in zip(*maps)]


def mean(errors):
    return sum(map(sum, errors)) / (len(errors) * len(errors[0]))
