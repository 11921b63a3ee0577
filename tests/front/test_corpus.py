"""test_corpus.py: tests malformed input files. Usage: see case.py.

Each ends in a picture or in one line and exit code 65, without crash or hang. `--table` prints the
table of docs/trust.md.
"""
import collections
import math
import pathlib
import resource
import sys

sys.dont_write_bytecode = True  # the source tree stays clean
sys.path.append(str(pathlib.Path(__file__).parents[1] / 'corpus'))
from case import DATA, PLAIN, TRY_AGAIN, Case, main  # noqa: E402
from exr_file import Exr  # noqa: E402
from make_corpus import DRAWN, KINDS, REFUSED, corpus, write  # noqa: E402

PANORAMAS = ('.exr', '.hdr')
HASTY = ('--load-seconds', '1', *PLAIN)  # some would take an hour
# With a limit of memory on this process, it may be that one, and no longer the file's fault.
CODES = (DATA,) if resource.getrlimit(resource.RLIMIT_AS)[0] < 0 else (DATA, TRY_AGAIN)
TEXT = pathlib.Path(__file__).parents[2] / 'docs' / 'trust.md'


def row(kind, entries):
    count = collections.Counter(entry.wanted for entry in entries)
    return (f'| {kind} | {len(entries)} | {count[DRAWN]} | {count[REFUSED]} | '
            f'{len(entries) - count[DRAWN] - count[REFUSED]} |')


def table():
    """Files of each kind: all, drawn, refused, either."""
    by_kind = {kind: [entry for entry in corpus() if entry.kind == kind] for kind in KINDS}
    rows = [row(kind, entries) for kind, entries in by_kind.items()]
    return '\n'.join((*rows, row('together', list(corpus()))))


class Corpus(Case):
    def run_on(self, number, entry):
        path = write(entry, self.folder / str(number) / 'in')
        scene = ('sphere', '--env', path) if path.suffix in PANORAMAS else (path,)
        if entry.wanted != DRAWN:
            return self.firn('graph', *scene, *HASTY)
        done = self.firn('render', *scene, '--size', '16x12', *PLAIN, '-q', '-o', 'a.exr')
        if done.returncode == 0:
            picture = Exr((self.folder / 'a.exr').read_bytes())
            values = picture.read_planes(['R', 'G', 'B']).values()
            self.assertTrue(all(math.isfinite(value) for plane in values for value in plane))
        return done

    def test_each(self):
        for number, entry in enumerate(corpus()):
            with self.subTest(kind=entry.kind, name=entry.name):
                done = self.run_on(number, entry)
                words = done.stderr.decode()
                self.assertIn(done.returncode, {DRAWN: (0,), REFUSED: CODES}.get(
                    entry.wanted, (0, *CODES)), words)
                self.assertEqual(len(words.splitlines()), done.returncode != 0, words)
                if words:
                    self.assertRegex(words, r'\Afirn: .{20,}\n\Z')
                    self.assertFalse(done.stdout)

    def test_what_a_model_names_stays_in_its_folder(self):
        for number, entry in enumerate(corpus()):
            if entry.kind == 'URIs that lead elsewhere' and entry.others and \
                    entry.wanted == REFUSED:
                path = write(entry, self.folder / str(number) / 'in')
                self.refuse(DATA, 'graph', path, names=["within the model's folder"])

    def test_names_are_not_repeated(self):
        names = [(entry.kind, entry.name) for entry in corpus()]
        self.assertEqual(len(names), len(set(names)))
        self.assertGreater(len(names), 60)

    def test_the_manual_counts_them(self):
        self.assertIn(table(), TEXT.read_text())


if __name__ == '__main__':
    if sys.argv[1:] == ['--table']:
        print(table())
    else:
        main()
