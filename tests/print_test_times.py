"""print_test_times.py: prints the run times of the tests, from meson's logs.

Usage: print_test_times.py [BUILD...]   BUILD: a build folder (all `build*` in the source tree)
Prints the total time of each build folder, then the slowest tests of all.
"""
import collections
import json
import pathlib
import signal
import sys

ROOT = pathlib.Path(__file__).parents[1]
SLOWEST = 30


def read(build):
    """Returns the log entries of the last test run of a build folder."""
    log = build / 'meson-logs' / 'testlog.json'
    if not log.exists():
        return []
    return [json.loads(line) for line in log.read_text(encoding='utf-8').splitlines()]


def span(rows):
    """Returns the wall-clock seconds from the first test's start to the last one's end."""
    return max(row['starttime'] + row['duration'] for row in rows) - min(
        row['starttime'] for row in rows)


def suite_of(row):
    """Returns a test's suite: front for "firn:front / front-view"."""
    return row['name'].partition(' / ')[0].rpartition(':')[2]


def main(arguments):
    builds = [pathlib.Path(name) for name in arguments] or sorted(ROOT.glob('build*'))
    parts = {build.name: rows for build in builds if (rows := read(build))}
    if not parts:
        print(f'no meson-logs/testlog.json in {" ".join(map(str, builds)) or ROOT}: run ./run test',
              file=sys.stderr)
        return 1
    suites = sorted({suite_of(row) for rows in parts.values() for row in rows})
    print(f'{"part":20} {"tests":>6} {"seconds":>8} {"added up":>9}   of which',
          *(f'{suite:>9}' for suite in suites))
    tests = collections.defaultdict(dict)
    for name, rows in parts.items():
        seconds = collections.Counter()
        for row in rows:
            seconds[suite_of(row)] += row['duration']
            tests[row['name'].rpartition(' / ')[2]][name] = row['duration']
        print(f'{name:20} {len(rows):6} {span(rows):8.1f} {seconds.total():9.1f}           ',
              *(f'{seconds[suite]:9.1f}' for suite in suites))
    print(f'\n{"test, seconds in":32}', *(f'{name:>20}' for name in parts))
    slowest = sorted(tests.items(), key=lambda item: -max(item[1].values()))[:SLOWEST]
    for name, times in slowest:
        print(f'{name:32}', *(f'{times[part]:20.1f}' if part in times else f'{"-":>20}'
                              for part in parts))
    return 0


if __name__ == '__main__':
    signal.signal(signal.SIGPIPE, signal.SIG_DFL)  # quiet with `| head`
    sys.exit(main(sys.argv[1:]))
