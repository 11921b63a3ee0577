"""test_corpus.py: tests malformed input files. Usage: see case.py.

Each ends in a picture or in one line and exit code 65, without crash or hang. FIRN_SCENES in the
environment is the number of random scenes (12).
"""
import collections
import concurrent.futures
import math
import os
import pathlib
import re
import resource
import sys

sys.dont_write_bytecode = True  # the source tree stays clean
sys.path.append(str(pathlib.Path(__file__).parents[1] / 'corpus'))
from builders import ACCEPTED, DRAWN, EITHER, REFUSED  # noqa: E402
from case import CRACKED, DATA, PLAIN, TRY_AGAIN, Case, long, main  # noqa: E402
from exr_file import Exr  # noqa: E402
from make_corpus import (  # noqa: E402
    BASELINE, DIFF, ENVIRONMENT, MERGE, MODEL, PRESET, SURROUNDINGS, corpus, write)
from scenes import scene  # noqa: E402

HASTY = ('--load-seconds', '1', *PLAIN)  # some would take an hour
SCENES = int(os.environ.get('FIRN_SCENES', '12'))  # random ones
TINY = ('--size', '16x12', *PLAIN, '-q', '-o', 'a.exr')
# With a limit of memory on this process, it may be that one, and no longer the file's fault.
CODES = (DATA,) if resource.getrlimit(resource.RLIMIT_AS)[0] < 0 else (DATA, TRY_AGAIN)
# A sanitizer makes a program start four times as long.
STEP = 4 if os.environ.get('FAIL_SAMPLE') == '1' else 1
TEXT = pathlib.Path(__file__).parents[2] / 'docs' / 'explanation' / 'trust.md'


def summary():
    """Returns how many files are accepted, refused, or either."""
    count = collections.Counter(entry.wanted for entry in corpus())
    accepted = count[ACCEPTED] + count[DRAWN]
    return (f'of {len(corpus())} files, {accepted} are accepted, {count[REFUSED]} refused, and '
            f'{count[EITHER]} may be either')


def command(entry, path):
    """The cheapest one that reads the file, or draws what it accepts."""
    if entry.use == DIFF:
        return 'diff', path, path
    if entry.use == MERGE:
        return 'merge', path, '-q', '-o', 'a.exr'
    if entry.use == BASELINE:
        return 'profile', 'sphere', '--baseline', path
    if entry.use == PRESET:
        return 'graph', 'sphere', '--preset', path
    words = {MODEL: (path,), SURROUNDINGS: ('sphere', '--surroundings', path),
             ENVIRONMENT: ('sphere', '--env', path)}[entry.use]
    return ('render', *words, *TINY) if entry.wanted == DRAWN else ('graph', *words, *HASTY)


def panoramas():
    return [entry for entry in corpus() if entry.use == ENVIRONMENT]


class Corpus(Case):
    def run_each(self, commands):
        """Pairs (file, what became of it); commands are functions of a file and its path."""
        commands = commands[::STEP]
        def run(numbered):
            number, (entry, words) = numbered
            folder = self.folder / str(number)
            return entry, self.firn(*words(entry, write(entry, folder / 'in')), cwd=folder), folder
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            yield from pool.map(run, enumerate(commands))

    def check_numbers(self, folder):
        picture = Exr((folder / 'a.exr').read_bytes())
        planes = picture.read_planes(['R', 'G', 'B']).values()
        self.assertTrue(all(map(math.isfinite, sum(planes, []))))

    def check(self, done, wanted):
        """The code, and one line if the file was refused."""
        words = done.stderr.decode()
        codes = {REFUSED: CODES, EITHER: (0, *CODES)}.get(wanted, (0,))
        self.assertIn(done.returncode, codes, words)
        warnings = re.findall(r'(?m)^firn: (?:warning|note): .*\n', words)
        self.assertEqual(len(words.splitlines()) - len(warnings), done.returncode != 0, words)
        if done.returncode:
            self.assertRegex(words, r'\Afirn: .{20,}\n\Z')
            self.assertFalse(done.stdout)

    def check_each(self, entries):
        for entry, done, folder in self.run_each([(entry, command) for entry in entries]):
            with self.subTest(kind=entry.kind, name=entry.name):
                self.check(done, entry.wanted)
                if entry.wanted == DRAWN:
                    self.check_numbers(folder)

    def test_every_sixth(self):
        self.check_each(corpus()[::6])

    @long
    def test_the_others(self):
        self.check_each([entry for i, entry in enumerate(corpus()) if i % 6])

    @long
    def test_pixels_of_extreme_scenes_are_numbers(self):
        def draw(seed):
            words, files = scene(seed)
            folder = self.folder / str(seed)
            folder.mkdir()
            for name, content in files.items():
                (folder / name).write_bytes(content)
            return seed, folder, self.firn('render', *words, '--size', '64x48', *CRACKED, '-q',
                                           '-o', 'a.exr', '-o', 'a.png', cwd=folder)
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            for seed, folder, done in pool.map(draw, range(0, SCENES, STEP)):
                with self.subTest(seed=seed, words=scene(seed)[0]):
                    self.check(done, DRAWN)
                    self.check_numbers(folder)

    def test_every_third_panorama_is_a_picture(self):
        self.check_pictures(panoramas()[::3])

    @long
    def test_the_other_panoramas_are_pictures(self):
        self.check_pictures([entry for i, entry in enumerate(panoramas()) if i % 3])

    def check_pictures(self, entries):
        """For firn diff, and files of EXR for firn merge, which refuses what is no tile."""
        whole = [(entry, lambda _, path: ('diff', path, path)) for entry in entries]
        tiles = [(entry, lambda _, path: ('merge', path, '-q')) for entry in entries
                 if entry.name.endswith('.exr')]
        for entry, done, _ in self.run_each(whole + tiles):
            with self.subTest(kind=entry.kind, name=entry.name, words=done.args[1]):
                self.check(done, REFUSED if done.args[1] == 'merge' else EITHER)

    def test_the_truth_of_a_ladder(self):
        names = 'bomb.png', 'bomb-cut.png', 'old-runs.hdr'
        found = [entry for entry in corpus() if entry.name in names]
        self.assertEqual(len(found), len(names))
        for entry in found:
            path = write(entry, self.folder / 'in')
            self.refuse(DATA, 'ladder', '--truth', path, names=[path.name])

    def test_files_to_resume_from(self):
        """Whatever is there is no frame, and drawn anew."""
        names = 'attribute-large.exr', 'largest.exr', 'levels.exr', 'texts.png'
        found = [entry for entry in corpus() if entry.name in names]
        self.assertEqual(len(found), len(names))
        for entry in found:
            with self.subTest(name=entry.name):
                path = write(entry, self.folder)
                self.succeed('render', 'sphere', *TINY[:-1], path, '--resume')
                self.assertNotEqual(path.read_bytes(), entry.content)

    def test_what_a_model_names_stays_in_its_folder(self):
        for number, entry in enumerate(corpus()):
            if entry.kind != 'URIs that lead elsewhere' or not entry.others or \
                    entry.wanted == DRAWN:
                continue
            path = write(entry, self.folder / str(number) / 'in')
            words = "within the model's folder"
            if entry.wanted == REFUSED:
                self.refuse(DATA, 'graph', path, names=[words])
            else:
                self.assertIn(words, self.succeed('graph', path).stderr.decode())

    def test_names_are_not_repeated(self):
        names = [(entry.kind, entry.name) for entry in corpus()]
        self.assertEqual(len(names), len(set(names)))
        self.assertGreater(len(names), 60)

    def test_the_manual_counts_them(self):
        self.assertIn(summary(), TEXT.read_text())


if __name__ == '__main__':
    main()
