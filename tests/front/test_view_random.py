"""test_view_random.py: hands that do anything, in any order. Usage: see case.py.

All keys of the table in docs/reference/keys.md are pressed equally often, one at a time, and the
mouse does all that is in it equally often between them, by a seed that FIRN_RANDOM_SEED changes.
Where a line of text or a panel has the keys, Esc mostly gives them back before: else few would do
what they are there for.

FIRN_RANDOM_SECONDS=3600 goes on for an hour, FIRN_RANDOM_ROUNDS=100 until each has been pressed so
often; then it says how much memory there was in each quarter, which must not grow in all of them,
and by how much it grew in the last half: the slope of the least squares, with its standard error.
With -Db_sanitize=address it finds what is used after it is gone. FIRN_RANDOM_VALIDATE=off leaves
out the validation layer, which keeps memory of its own.
"""
import math
import os
import pathlib
import random
import re
import statistics
import subprocess
import sys
import time

sys.dont_write_bytecode = True  # the source tree stays clean
from case import SMALL, main  # noqa: E402
from desktop import PATIENCE, wait_until  # noqa: E402
from test_view import CHECKED, TRIANGLES  # noqa: E402
from test_view_panels import PanelsCase  # noqa: E402

SECONDS = float(os.environ.get('FIRN_RANDOM_SECONDS', 0))
SEED = int(os.environ.get('FIRN_RANDOM_SEED', 1))
ROUNDS = int(os.environ.get('FIRN_RANDOM_ROUNDS', 1))  # of all keys, at least
TYPED = 0.2  # of the keys go where they happen to
LONG = 1200  # seconds; before, caches fill
PAUSE = 0.04  # seconds between two things that a hand does, in a long run
MORE = 2048  # KiB in a quarter
SIGNS = {'+': 'plus', '-': 'minus', '[': 'bracketleft', ']': 'bracketright', '/': 'slash',
         '?': 'question', 'full stop': 'period', 'comma': 'comma', 'Esc': 'Escape',
         'Space': 'space', 'Page Down': 'Next', 'Page Up': 'Prior'}
LAST = ('Q', 'Ctrl Q')
NO_KEYS = ('drag', 'right drag', 'Ctrl drag', 'Ctrl Shift drag', 'wheel', 'double click',
           'drop a file')


def keys():
    """As xdotool names them."""
    text = (pathlib.Path(__file__).parents[2] / 'docs' / 'reference' / 'keys.md').read_text()
    table = text.partition('## Mouse and keyboard')[2].partition('\n\n')[2].partition('\n\n')[0]
    found = []
    for line in table.splitlines()[2:]:
        name = line.split('|')[1].strip()
        if name in NO_KEYS:
            continue
        for word in name.split(', '):
            if word not in LAST:
                *held, key = [word] if word in SIGNS else word.split()
                key = SIGNS.get(key, key.lower() if len(key) == 1 else key)
                found.append('+'.join([*map(str.lower, held), key]))
    return found


def slope(points):
    """(y for each x, its standard error), of the straight line with the least squares."""
    count, x_mean, y_mean = len(points), *map(statistics.fmean, zip(*points))
    spread = sum((x - x_mean) ** 2 for x, _ in points)
    rise = sum((x - x_mean) * (y - y_mean) for x, y in points) / spread
    rest = sum((y - y_mean - rise * (x - x_mean)) ** 2 for x, y in points)
    return rise, math.sqrt(rest / (count - 2) / spread)


class Random(PanelsCase):
    CHECKED = CHECKED[1:] if os.environ.get('FIRN_RANDOM_VALIDATE') == 'off' else CHECKED
    DROPPED = ('shape.obj', 'around.exr', 'flat.png', 'lines.txt', 'broken.firn')
    GESTURES = ('click', 'drag', 'right drag', 'Ctrl drag', 'Ctrl Shift drag', 'wheel',
                'double click', 'rest')

    def act(self, rng, window, gesture):
        """Something that is done with a mouse, as words for xdotool."""
        def place():
            return 'mousemove', '--window', window, rng.randrange(305), rng.randrange(201)
        button = 3 if gesture == 'right drag' else 1
        held = {'Ctrl drag': ('ctrl',), 'Ctrl Shift drag': ('ctrl', 'shift')}.get(gesture, ())
        if gesture == 'rest':
            return place()
        if gesture == 'click':
            return *place(), 'click', 1
        if gesture == 'double click':
            return *place(), 'click', '--repeat', 2, '--delay', 20, 1
        if gesture == 'wheel':
            return *place(), 'click', rng.choice((4, 5))
        return (*(word for key in held for word in ('keydown', key)), *place(), 'mousedown', button,
                *place(), *place(), 'mouseup', button,
                *(word for key in held for word in ('keyup', key)))

    def save(self, window):
        if self.said('.*, stopped; Esc continues'):  # then no image will come
            self.press(window, 'Escape')
        self.press(window, 'p')

    def write_files(self):
        """To be dropped: one of each kind, and one that is refused."""
        (self.folder / 'shape.obj').write_text(TRIANGLES)
        (self.folder / 'lines.txt').write_text('cracks.count=3\n')
        (self.folder / 'broken.firn').write_text('nothing')
        self.render('around.exr', '--size', '32x16')
        self.succeed('render', 'sphere', *SMALL, '-o', 'drawn.png')
        subprocess.run(['convert', self.folder / 'drawn.png', '-strip', self.folder / 'flat.png'],
                       check=True)

    def size(self):
        """KiB of it, while it runs."""
        status = pathlib.Path(f'/proc/{self.process.pid}/status')
        found = self.process.poll() is None and re.search(r'RssAnon:\s*(\d+)', status.read_text())
        if not found:  # it has ended, perhaps only now
            self.process.wait(timeout=PATIENCE)
            self.fail(f'seed {SEED}\n{self.words()}')
        return int(found[1])

    def test_anything(self):
        table, rng, gestures = keys(), random.Random(SEED), []
        self.assertGreater(len(table), 40)
        self.assertIn('ctrl+shift+z', table)
        self.write_files()
        window = self.start_with_panels('--samples', 2, plain=('--plain', '--set',
                                                               'env_cube.size=64'))
        begin, rounds, sizes = time.monotonic(), 0, []
        pause = ('sleep', PAUSE if SECONDS or ROUNDS > 1 else 0)
        while rounds < ROUNDS or time.monotonic() < begin + SECONDS:
            order = rng.sample(table, len(table))
            for first in range(0, len(order), 12):
                words = []
                for key in order[first:first + 12]:
                    gestures = gestures or rng.sample(self.GESTURES, len(self.GESTURES))
                    escapes = 0 if rng.random() < TYPED else 2
                    words += ['key', 'Escape', *pause] * escapes
                    words += ['key', key, *pause, *self.act(rng, window, gestures.pop()), *pause]
                try:
                    self.desktop.do('windowfocus', '--sync', window, *words)
                except subprocess.CalledProcessError:  # the window is gone
                    self.process.wait(timeout=PATIENCE)
                sizes.append((time.monotonic() - begin, self.size()))
            for path in self.folder.glob('firn-*'):
                path.unlink()
            name = self.DROPPED[rounds % len(self.DROPPED)]
            self.desktop.drop(window, self.folder / name)
            rounds += 1
        self.desktop.do('keyup', 'shift', 'keyup', 'ctrl', 'key', 'Escape', 'key', 'Escape')
        if 'firn-' not in self.words():  # on a busy machine, text fields may have taken each P
            wait_until('a saved image', lambda: 'firn-' in self.words(), self.words,
                       patience=3 * PATIENCE, act=lambda: self.save(window))
        self.press_to_end(window, 'ctrl+q')
        self.assertNotIn('ERROR', self.words())
        for action in ('firn render ', 'drop a file'):  # of C and F1
            self.assertIn(action, self.printed())
        if SECONDS or ROUNDS > 1:
            end = sizes[-1][0]
            most = [max(size for when, size in sizes if q - 1 <= 4 * when / end <= q)
                    for q in (1, 2, 3, 4)]
            print(f'{rounds} times each of {len(table)} keys, in {end:.0f} s')
            print(f'{most} KiB in each quarter')
            rise, error = slope([(when / 60, size) for when, size in sizes if when > end / 2])
            print(f'in the last half {rise:.0f} +- {error:.0f} KiB more a minute')
            if end >= LONG:
                self.assertLess(min(b - a for a, b in zip(most, most[1:])), MORE)


if __name__ == '__main__':
    main()
