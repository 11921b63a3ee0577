"""bounce_options.py: error and cost of options of `bounce`, beside `trace`.

Usage: bounce_options.py [FIRN [FOLDER [SCENE...]]]   (build/firn, out/bounce-options, all scenes)
Prints, for each scene, MAE and FLIP against the reference on the object's pixels, and user CPU time
as ratios to that of `bounce`: of a whole `firn render` of 8 samples, and of 7 further samples
alone, without start-up. Options that do not change the image are left out.
"""
import json
import pathlib
import resource
import statistics
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.append(str(HERE / '../../tests/front'))
from gltf_file import balls, glass  # noqa: E402

RUNS = 5  # alternating runs
COMMON = '--plain', '-q', '--set', 'ground.light=open'
MODELS = {'bounce': ('-r', 'bounce'), 'trace': ('-r', 'trace')}
MODELS.update({option: ('-r', 'bounce', '--set', f'refract_bounce.{option}')
               for option in ('nested=off', 'nested=all', 'exits=1', 'margin=off')})
SCENES = {
    'teapot': ('teapot',),
    'teapot, close': ('teapot', '--orbit', '28,9,1.4'),
    'torus': ('torus.obj', '--orbit', '28,10,4'),
    'hollow ball': ('ball.gltf', '--eye', '0.5,1,5', '--target', '0,0,0'),
    'nested balls': ('nested.gltf', '--eye', '2,1,6', '--target', '1,0,0'),
    'nested balls, close': ('nested.gltf', '--eye', '0.4,0.3,2', '--target', '0,0,0'),
    'hollow': ('hollow',),
    'amber': ('amber',),
    'drink': ('drink',),
    'slate': ('slate',),
    'valley': ('valley',),
    'valley, close': ('valley', '--orbit', '28,9,1.7'),
    'sphere': ('sphere',),
    'room': ('room',),
    'room, close': ('room', '--orbit', '28,9,1.7'),
    'ice-cube': ('ice-cube',),
}


def write_models(folder):
    subprocess.run([sys.executable, str(HERE / 'ladder_scenes.py'), str(folder)], check=True)
    outer = glass(1.5), [0, 0, 0], 1
    (folder / 'ball.gltf').write_text(balls(0.75, outer))
    (folder / 'nested.gltf').write_text(balls(
        0.75, outer, (glass(1.3), [0.1, 0, 0], 0.4),
        (glass(1.3), [3, 0.2, -3], 1), (glass(1.6), [3, 0.2, -3], 0.5)))


def errors(firn, folder, words):
    """Returns {model: (MAE, FLIP)} of the models whose images differ from that of `bounce`."""
    found = {}
    render = [firn, 'render', *words, *COMMON, '--size', '320x240', '--pixel-filter', 'point']
    subprocess.run([*render, '-r', 'reference', '--samples', '4', '--aov', 'path', '-o',
                    'truth.exr'], cwd=folder, check=True, stderr=subprocess.DEVNULL)
    for model, options in MODELS.items():
        subprocess.run([*render, *options, '--samples', '1', '-o', f'{model}.exr'], cwd=folder,
                       check=True, stderr=subprocess.DEVNULL)

        def diff(first, *more):
            out = subprocess.run([firn, 'diff', first, f'{model}.exr', *more, '--json'],
                                 cwd=folder, check=True, stdout=subprocess.PIPE)
            return json.loads(out.stdout)
        said = diff('truth.exr', '--mask', 'truth.exr', '--mask-channel', 'path.Z')
        if model in ('bounce', 'trace') or diff('bounce.exr')['mae'] > 0:
            found[model] = said['mae'], said['flip']['mean']
    return found


def cpu_seconds(command, folder):
    """Returns the user CPU time of a command."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    subprocess.run(command, cwd=folder, check=True, stderr=subprocess.DEVNULL)
    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before


def costs(firn, folder, words, models):
    """Returns {(model, samples): median user CPU time in seconds} of alternating runs."""
    times = {(model, samples): [] for model in models for samples in ('1', '8')}
    for _ in range(RUNS):
        for model, samples in times:
            times[model, samples].append(cpu_seconds(
                [firn, 'render', *words, *COMMON, *MODELS[model], '--size', '640x480',
                 '--samples', samples, '-o', 'cost.png'], folder))
    return {run: statistics.median(all_of) for run, all_of in times.items()}


def main(firn='build/firn', folder='out/bounce-options', *names):
    firn, folder = str(pathlib.Path(firn).resolve()), pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    write_models(folder)
    for name in names or SCENES:
        found = errors(firn, folder, SCENES[name])
        times = costs(firn, folder, SCENES[name], found)
        whole = {model: times[model, '8'] for model in found}
        more = {model: times[model, '8'] - times[model, '1'] for model in found}
        for model, (mae, flip) in found.items():
            print(f'{name:20} {model:12} {mae:.4f} {flip:.3f} '
                  f'{whole[model] / whole["bounce"]:.2f} {more[model] / more["bounce"]:.2f}',
                  flush=True)


main(*sys.argv[1:])
