"""cycles.py FIRN KIT: CPU time of firn and of Blender's Cycles for the same error; see README.md.

KIT is a folder with NAME.gltf, env.exr, truth/NAME.exr, mask/NAME.exr and kit/cycles_truth.py, the
program by which Blender builds and renders such a scene. Exits 77, with one line, where Blender or
the kit is missing.
"""
import argparse
import json
import math
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

SIZE = (512, 384)
FIRN_SAMPLES = {'rough': 16}  # of the error that is compared; 1 in other scenes
CYCLES_SAMPLES = (2, 32)
SETTINGS = ('Cycles, CPU: 64 bounces of each kind, caustics on, clamping off, filter glossy 0, no '
            'adaptive sampling, no denoising; firn: -r trace --plain; both: samples at pixel '
            'centres')


def skip(what):
    print(f'cycles.py: {what}, so there is nothing to compare with: see README.md beside it')
    sys.exit(77)


def cpu_seconds(command, **environment):
    """Runs a command and returns the CPU seconds of its process and threads."""
    process = subprocess.Popen(list(map(str, command)), stdout=subprocess.DEVNULL,
                               stderr=subprocess.PIPE, env={**os.environ, **environment})
    text = process.stderr.read()
    _, status, used = os.wait4(process.pid, 0)
    if status:
        sys.exit(f'cycles.py: {command[0]} failed: {text.decode(errors="replace")[-500:]}')
    return used.ru_utime + used.ru_stime


class Scene:
    def __init__(self, options, name, folder):
        self.firn, self.kit, self.name, self.folder = options.firn, options.kit, name, folder
        self.blender = options.blender

    def error(self, image):
        """Returns the mean absolute error on the pixels of refractive objects, clipped to 0..1."""
        text = subprocess.run(
            [self.firn, 'diff', self.kit / 'truth' / f'{self.name}.exr', image, '--mask',
             self.kit / 'mask' / f'{self.name}.exr', '--mask-channel', 'Y', '--json'],
            check=True, stdout=subprocess.PIPE).stdout
        return json.loads(text)['mae']

    def draw_firn(self, samples):
        image = self.folder / 'firn.exr'
        seconds = cpu_seconds(
            [self.firn, 'render', self.kit / f'{self.name}.gltf', '--env', self.kit / 'env.exr',
             '-r', 'trace', '--plain', '--pixel-filter', 'point', '--samples', samples,
             '--size', '%dx%d' % SIZE, '-q', '-o', image], GALLIVM_PERF='')
        return seconds, self.error(image)

    def draw_cycles(self, samples):
        image = self.folder / 'cycles.exr'
        seconds = cpu_seconds(
            [self.blender, '-b', '--factory-startup', '--python',
             self.kit / 'kit' / 'cycles_truth.py', '--', self.kit / f'{self.name}.gltf',
             '-o', image, '--spp', samples, '--seed', 7, '--size', *SIZE])
        return seconds, self.error(image)


def samples_for(error, measured):
    """Returns the number of samples with this error: interpolates in a log-log plot of the pairs
    (samples, error), or extrapolates by error ~ samples^-1/2."""
    for (n, e), (next_n, next_e) in zip(measured, measured[1:]):
        if e >= error >= next_e:
            part = math.log(e / error) / math.log(e / next_e)
            return n * (next_n / n) ** part
    n, e = measured[0] if error > measured[0][1] else measured[-1]
    return n * (e / error) ** 2


def slope(times):
    """Returns start-up seconds and seconds per sample from the first and the last pair."""
    (n, first), (m, last) = times[0], times[-1]
    each = (last - first) / (m - n)
    return first - n * each, each


def compare(scene):
    wanted = FIRN_SAMPLES.get(scene.name, 1)
    ours = {n: scene.draw_firn(n) for n in sorted({wanted, wanted + 4})}
    theirs = {n: scene.draw_cycles(n) for n in CYCLES_SAMPLES}
    error = ours[wanted][1]
    start, each = slope([(n, ours[n][0]) for n in sorted(ours)])
    their_start, their_each = slope([(n, theirs[n][0]) for n in CYCLES_SAMPLES])
    count = samples_for(error, [(n, theirs[n][1]) for n in CYCLES_SAMPLES])
    errors = ', '.join(f'{n}: {theirs[n][1]:.4f}' for n in CYCLES_SAMPLES)
    print(f'{scene.name:7} firn: {wanted} samples, error {error:.4f}, {each * wanted:.2f} CPU s, '
          f'start-up {start:.2f}   Cycles: {count:.0f} samples, {their_each * count:.2f} CPU s, '
          f'start-up {their_start:.2f} (errors {errors})   '
          f'ratio {their_each * count / (each * wanted):.1f}', flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('firn', type=pathlib.Path)
    parser.add_argument('kit', type=pathlib.Path)
    parser.add_argument('--scene', action='append', help='only this one; may be repeated')
    options = parser.parse_args()
    options.blender = shutil.which('blender')
    if not options.blender:
        skip('there is no blender')
    if not (options.kit / 'kit' / 'cycles_truth.py').is_file():
        skip(f'{options.kit} has no kit/cycles_truth.py')
    version = subprocess.run([options.blender, '--version'], capture_output=True, text=True)
    print(version.stdout.splitlines()[0] + '; ' + SETTINGS)
    with tempfile.TemporaryDirectory() as folder:
        for path in sorted(options.kit.glob('*.gltf')):
            if not options.scene or path.stem in options.scene:
                compare(Scene(options, path.stem, pathlib.Path(folder)))


main()
