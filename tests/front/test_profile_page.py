"""test_profile_page.py: tests the page of a profile in a browser, by keyboard alone.

Usage: test_profile_page.py PRINT_PROFILE_PAGE CHROMIUM [TEST...]
"""
import copy
import json
import pathlib
import random
import re
import resource
import statistics
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True  # the source tree stays clean
from browser import Browser  # noqa: E402

HOSTILE = '</script><script>window.broken = 1</script><!--<img src=x>"\'&amp;'
FRAME_PASSES = (('env_cube.sky', 6), ('env_cube.surroundings', 6), ('ice_depth.front', 1),
                ('ice_interval.next', 7), ('refract_paper.color', 1), ('air.planes', 1),
                ('bubbles.over', 1), ('cracks.color', 1), ('frost.over', 1), ('surface.color', 1),
                ('tonemap.color', 1),
                ('a_technique.whose_name_is_longer_than_any_column_has_room_for', 1),
                ('ice_normal.back', 12))
SWEEP = ('frame.mode=a,b', 'sphere.triangles=0,960,14400,100000')

program = chromium = ''  # set by main()


def quantile(samples, part):
    """Type 7 of Hyndman and Fan."""
    if len(samples) == 1:
        return samples[0]
    return statistics.quantiles(samples, n=100, method='inclusive')[round(part * 100) - 1]


def added(rows, key='ms'):
    return [sum(values) for values in zip(*(row[key] for row in rows))]


def print_page(folder, name, *arguments):
    path = folder / f'{name}.html'
    with path.open('wb') as file:
        subprocess.run([program, *arguments], check=True, stdout=file)
    return path


def data_of(path, place='profile'):
    text = re.search(rf'id="{place}">(.*?)</script>', path.read_text('utf-8'), re.S)[1]
    return json.loads(text)


def write_json(folder, name, data):
    path = folder / f'{name}.json'
    path.write_text(json.dumps(data), 'utf-8')
    return path


def as_large_as_a_frame(sample):
    """Forty passes whose times vary much, and residents in two blocks."""
    p, like, noise = copy.deepcopy(sample), sample['rows'][2], random.Random(1)
    rows, begin = [], [0] * p['run_count']
    for name, count in FRAME_PASSES:
        for repetition in range(count):
            ms = [(1 + len(rows) * 5 % 11) / 20 * noise.lognormvariate(0, .3) for _ in like['ms']]
            rows.append({**like, 'name': name, 'technique': name.split('.')[0], 'ms': ms,
                         'repetition': repetition, 'repetition_count': count, 'begin_ms': begin})
            begin = [a + b for a, b in zip(begin, ms)]
    p['rows'] = rows + p['rows'][p['pass_count']:]
    p['pass_count'] = len(rows)
    p['frame']['ms'] = added(p['rows'])
    p['wait']['ms'] = begin
    p['residents'] = [
        {'name': f'{FRAME_PASSES[i % 12][0].split(".")[0]}.image', 'first_pass': 2 * i,
         'last_pass': 2 * i + 5, 'block': i % 2, 'offset': (i // 2 % 4) << 20, 'size': 1 << 20}
        for i in range(16)]
    return p


def hostile(sample):
    p = copy.deepcopy(sample)
    p['command'] = p['scene'] = p['settings'][0]['value'] = p['residents'][0]['name'] = HOSTILE
    p['rows'][2].update(name=HOSTILE, technique='__proto__')
    p['rows'][3]['technique'] = 'constructor'
    return p


def least(sample):
    """One run of one pass, on a device that counts nothing."""
    p = copy.deepcopy(sample)
    p.update(run_count=1, pass_count=1, has_statistics=False, settings=[], residents=[],
             clock='submits')
    p['rows'] = p['rows'][2:3] + p['rows'][5:]
    for series in (p['frame'], p['plain'], p['wait'], *p['rows']):
        for key in ('ms', 'begin_ms', 'record_ms'):
            if key in series:
                series[key] = series[key][:1]
    p['frame']['ms'] = added(p['rows'])
    return p


def setUpModule():
    """The pages, and one browser for all of them."""
    temporary = tempfile.TemporaryDirectory(prefix='firn ', ignore_cleanup_errors=True)
    unittest.addModuleCleanup(temporary.cleanup)
    folder = pathlib.Path(temporary.name)
    sample = print_page(folder, 'sample')
    Page.sample = data_of(sample)
    Page.pages = {'sample': sample}
    for make in (as_large_as_a_frame, hostile, least):
        path = write_json(folder, make.__name__, make(Page.sample))
        Page.pages[make.__name__] = print_page(folder, make.__name__, path)
    path = write_json(folder, 'sample', Page.sample)
    for name, parameters in (('sweep1', SWEEP[1:]), ('sweep2', SWEEP)):
        Page.pages[name] = print_page(folder, name, path, *parameters)
    (folder / 'browser').mkdir()
    Page.browser = Browser(chromium, folder / 'browser')
    unittest.addModuleCleanup(Page.browser.close)


class Page(unittest.TestCase):
    sample = pages = browser = None  # set by setUpModule()

    def open(self, name, **how):
        self.browser.open(self.pages[name], **how)
        self.browser.settle()
        return data_of(self.pages[name])

    def run_js(self, expression):
        return self.browser.run(expression)

    def press(self, *keys):
        self.browser.press(*keys)

    def boxes(self, selector):
        """(x, y, width, height) of each."""
        return self.run_js(f'[...document.querySelectorAll({json.dumps(selector)})].map(e => {{'
                           'const r = e.getBoundingClientRect();'
                           'return [r.x, r.y, r.width, r.height]; })')

    def texts(self, selector):
        return self.run_js(f'[...document.querySelectorAll({json.dumps(selector)})]'
                           '.map(e => e.textContent)')

    def tip(self):
        return self.run_js("document.getElementById('tip').hidden ? null : "
                           "document.getElementById('tip').innerText")

    def focus(self, selector):
        self.run_js(f'document.querySelector({json.dumps(selector)}).focus({{focusVisible: true}})')

    def tearDown(self):
        self.assertEqual(self.browser.complaints(), [])


class Loads(Page):
    def test_is_quiet_and_alone(self):
        for width, dark in ((400, False), (1200, True), (1600, False)):
            for name, path in self.pages.items():
                with self.subTest(page=name, width=width, dark=dark):
                    self.open(name, width=width, dark=dark)
                    self.assertEqual(self.browser.complaints(), [])
                    self.assertEqual(self.browser.requests(), [path.as_uri()])
                    self.assertLessEqual(self.run_js('document.documentElement.scrollWidth'), width)
                    self.assertTrue(self.texts('#summary')[0])
        for path in self.pages.values():
            self.assertNotRegex(path.read_text('utf-8'),
                                r'(?i)https?:|//[a-z]+\.[a-z]|@import|url\((?!#)')

    def test_names_are_only_words(self):
        self.open('hostile')
        self.assertIsNone(self.run_js('window.broken'))
        self.assertEqual(self.run_js('document.images.length'), 0)
        self.assertEqual(self.texts('#title'), [f'firn profile: {HOSTILE}'])
        self.assertEqual(self.texts('#command'), [HOSTILE])
        self.assertEqual(self.texts('#settings td')[0], HOSTILE)
        self.assertIn(HOSTILE, self.texts('.bar-name'))
        self.assertIn(HOSTILE, self.texts('#numbers-table th'))
        self.assertEqual(self.texts('#legend span'),
                         ['env_cube', '__proto__', 'constructor', 'readback', 'host',
                          'unattributed'])

    def test_least(self):
        self.open('least')
        self.assertEqual(len(self.boxes('.bar')), 4)
        self.assertEqual(self.texts('#settings summary'), ['Settings (0)'])
        self.assertTrue(self.run_js("document.getElementById('blocks').hidden"))
        self.assertNotIn('vertices', self.texts('#numbers-table th'))
        self.assertIn('submitted alone', self.texts('#timeline-note')[0])

    def test_head(self):
        p = self.open('sample')
        facts = ' '.join(self.texts('#facts dd'))
        for key in ('rung', 'material', 'device', 'driver', 'host', 'clock', 'clock_reason'):
            self.assertIn(p[key], facts)
        self.assertEqual(self.texts('#command'), [p['command']])
        self.assertEqual(self.texts('#settings tbody tr'),
                         ['refract.ior1.3091', 'tonemap.curveneutral'])
        self.focus('#copy')
        self.press('Enter')
        self.assertRegex(self.texts('#copied')[0], 'Copied|Selected')

    def test_prints(self):
        self.open('as_large_as_a_frame', width=400)
        self.assertTrue(self.browser.pdf().startswith(b'%PDF'))
        self.assertEqual(self.run_js('view.printing'), False)
        self.assertLess(max(box[2] for box in self.boxes('#strip svg')), 400)


class Numbers(Page):
    def groups(self, p, each):
        """[name, rows] as the page shows them, in the plan's order."""
        found = {}
        for index, row in enumerate(p['rows']):
            found.setdefault(index if each else row['name'], []).append(row)
        return list(found.values())

    def check_bars(self, groups):
        bars, tracks, whiskers = (self.boxes(f'#bars .{name}')
                                  for name in ('bar', 'track', 'whisker'))
        self.assertEqual(len(bars), len(groups))
        medians = [statistics.median(added(rows)) for rows in groups]
        pixels = max(box[2] for box in bars) / max(medians)  # a millisecond
        self.assertGreater(pixels * max(medians), 100)
        for rows, median, bar, track, whisker in zip(groups, medians, bars, tracks, whiskers):
            with self.subTest(row=rows[0]['name']):
                samples = added(rows)
                self.assertAlmostEqual(bar[0], track[0], delta=0.5)
                self.assertAlmostEqual(bar[2], median * pixels, delta=2.1)  # two edges at least
                self.assertAlmostEqual(whisker[0] - track[0], min(samples) * pixels, delta=1)
                width = (quantile(samples, .95) - min(samples)) * pixels
                self.assertAlmostEqual(whisker[2], width, delta=2.1)
                self.assertLessEqual(whisker[0] + whisker[2], track[0] + track[2] + 1)

    def test_bars(self):
        for name in ('sample', 'as_large_as_a_frame'):
            for width in (400, 1600):
                with self.subTest(page=name, width=width):
                    p = self.open(name, width=width)
                    self.check_bars(self.groups(p, each=False))
                    self.focus('input[name=each]')
                    self.press('ArrowRight')
                    each = self.groups(p, each=True)
                    self.check_bars(each)
                    self.focus('input[name=order]')
                    self.press('ArrowRight')
                    self.check_bars(sorted(each, reverse=True,
                                           key=lambda rows: statistics.median(rows[0]['ms'])))

    def test_statistics(self):
        """The page's agree with those of the JSON."""
        for name in ('as_large_as_a_frame', 'least', 'sample'):
            p = self.open(name)
            all_series = (p['frame'], p['plain'], p['wait'], *p['rows'])
            samples = json.dumps([series['ms'] for series in all_series])
            summaries = self.run_js(f'{samples}.map(ms => summarize(ms))')
            for got, want in zip(summaries, (series['summary'] for series in all_series),
                                 strict=True):
                self.assertEqual(got['outliers'], want['outliers'])
                for key in ('mean', 'sigma', 'min', 'median', 'p95', 'max'):
                    self.assertAlmostEqual(got[key], want[key], delta=1e-9, msg=key)

    def test_outliers(self):
        p = self.open('sample')
        self.assertEqual(p['frame']['summary']['outliers'], [7])
        self.assertIn('run 7', self.texts('#outliers')[0])
        self.assertIn('refract_paper.color', self.texts('#outliers')[0])

    def test_table(self):
        p = self.open('sample')
        head = self.texts('#numbers-table thead th')
        lines = [self.texts(f'#numbers-table tbody tr:nth-child({i}) > *') for i in range(1, 11)]
        first, frame = dict(zip(head, lines[0])), dict(zip(head, lines[7]))
        self.assertEqual(first['row'], 'env_cube.objects \u00d72')
        self.assertEqual((first['vertices'], first['triangles']), ('5\u202f760', '1\u202f920'))
        self.assertEqual(first['targets'], '6.0 MiB')
        self.assertEqual(frame['share'], '100.0 %')
        shares = [float(dict(zip(head, line))['share'].removesuffix(' %')) for line in lines[:7]]
        self.assertAlmostEqual(sum(shares), 100, delta=0.35)
        self.assertEqual(float(frame['median']), round(p['frame']['summary']['median'], 2))

    def test_words(self):
        self.open('sample')
        numbers = '[0, 1234.6, 99.96, 8.0049, 0.012345, 1e-9, -0.5]'
        self.assertEqual(self.run_js(f'{numbers}.map(v => digits(v))'),
                         ['0', '1\u202f235', '100', '8.00', '0.0123', '1.0e-9', '\u22120.500'])
        self.assertEqual(self.run_js('[0, 1023, 1024, 66060288].map(bytes)'),
                         ['0 B', '1023 B', '1.0 KiB', '63.0 MiB'])
        self.assertEqual(self.run_js('[.3, 1, 1.1, 3, 70].map(niceStep).map(v => +v.toFixed(9))'),
                         [.5, 1, 2, 5, 100])


class Drawings(Page):
    def test_histogram_counts_every_frame(self):
        for name in ('sample', 'as_large_as_a_frame', 'least'):
            p = self.open(name)
            counts = self.run_js("[...document.querySelectorAll('#histogram g')]"
                                 '.map(g => tips.get(g).rows.map(row => parseInt(row[1])))')
            self.assertEqual([sum(column) for column in zip(*counts)], [p['run_count']] * 2)
            for series, column in (('measured', 0), ('plain', 1)):
                bars = self.boxes(f'#histogram .{series}')
                tallest = max(bar[3] for bar in bars)
                most = max(max(count) for count in counts)
                for bar, count in zip(bars, counts):
                    self.assertAlmostEqual(bar[3], count[column] / most * 88, delta=0.6)
                self.assertGreater(tallest, 0)

    def test_histogram_has_room_beside_an_outlier(self):
        self.open('sample')
        bins = self.run_js("[...document.querySelectorAll('#histogram g')]"
                           ".map(g => [g.getAttribute('aria-label'), tips.get(g).rows])")
        label, counts = bins[-1]
        self.assertTrue(label.endswith('and more'), label)
        self.assertEqual(counts, [['measured', '1 frame'], ['plain', '1 frame']])
        self.assertGreater(len(bins), 5)

    def test_timeline(self):
        p = self.open('sample')
        lane = self.boxes('#lanes svg')[0]
        for run in (0, 7):
            self.run_js(f'chooseRun({run})')
            blocks = self.boxes('#lanes svg > g > rect')
            ms = [row['ms'][run] for row in p['rows'][:5]]
            ms += [row['ms'][run] for row in p['rows'][5:7]] + [p['wait']['ms'][run]]
            ms += [row['record_ms'][run] for row in p['rows'][:5]]
            self.assertEqual(len(blocks), len(ms))
            pixels = (lane[2] - 9) / p['frame']['ms'][run]
            for block, value in zip(blocks, ms):
                self.assertAlmostEqual(block[2], value * pixels, delta=1.1)
            begin = sum(row['ms'][run] for row in p['rows'][5:7])
            for block, row in zip(blocks, p['rows'][:5]):
                x = lane[0] + 1 + (begin + row['begin_ms'][run]) * pixels
                self.assertAlmostEqual(block[0], x, delta=1)
            self.assertLess(blocks[-1][0] + blocks[-1][2], lane[0] + lane[2])

    def test_memory(self):
        p = self.open('as_large_as_a_frame')
        for block in (0, 1):
            residents = [r for r in p['residents'] if r['block'] == block]
            plot = f'#blocks svg[aria-label="Block {block}"]'
            area, rects = self.boxes(plot)[0], self.boxes(f'{plot} > g > rect')
            size = max(r['offset'] + r['size'] for r in residents)
            column = (area[2] - 1) / p['pass_count']
            self.assertEqual(len(rects), len(residents))
            for resident, (x, y, width, height) in zip(residents, rects):
                count = resident['last_pass'] - resident['first_pass'] + 1
                self.assertAlmostEqual(x - area[0], resident['first_pass'] * column, delta=1.1)
                self.assertAlmostEqual(width, count * column, delta=2)
                self.assertAlmostEqual(y - area[1], resident['offset'] / size * area[3], delta=2)
                self.assertAlmostEqual(height, resident['size'] / size * area[3], delta=3)

    def test_figures(self):
        """A curve through the dots of each series; bars as high as their frame rates."""
        self.open('sweep1')
        self.assertTrue(self.run_js("document.getElementById('figures').hidden"))
        points = data_of(self.pages['sweep2'], 'sweep-data')['points']
        self.open('sweep2')
        self.assertEqual(self.texts('#figures h3'), ['Figure 6', 'Figure 7'])
        self.assertEqual(len(self.boxes('#figures .series')), 2)
        dots = self.boxes('#figures circle')
        self.assertEqual(len(dots), 4)
        self.assertAlmostEqual(dots[0][1], dots[3][1], delta=0.5)  # one point, in both series
        rates = [1000 / point['profile']['plain']['summary']['median'] for point in points[:2]]
        heights = [box[3] for box in self.boxes('#figures rect.block')]
        self.assertAlmostEqual(heights[0] / heights[1], rates[0] / rates[1], delta=0.02)
        self.assertEqual(self.texts('#contrasts tbody th'), ['figure 6'])
        self.assertIn('may be noise', self.texts('#contrasts td')[3])

    def test_sweep(self):
        self.open('sample')
        self.assertTrue(self.run_js("document.getElementById('sweep').hidden"))
        self.open('sweep1')
        self.assertFalse(self.run_js("document.getElementById('sweep').hidden"))
        dots = self.run_js("[...document.querySelectorAll('#sweep-plot g')]"
                           ".filter(g => g.getAttribute('aria-label').startsWith('refract'))"
                           ".map(g => g.lastElementChild).map(c => [+c.getAttribute('cx'),"
                           " +c.getAttribute('cy')])")
        self.assertEqual(len(dots), 4)
        (_, _), (x0, y0), (x1, y1), (x2, y2) = dots  # the first is at 0, in a place of its own
        self.assertLess(dots[0][0], x0)
        self.assertAlmostEqual((y1 - y0) / (x1 - x0), (y2 - y1) / (x2 - x1), delta=0.01)
        fits = self.run_js("[...document.querySelectorAll('#sweep-plot .fit')]"
                           ".map(path => path.getAttribute('d').match(/[\\d.]+/g).map(Number))")
        self.assertTrue(any(all(abs(got - want) < 0.5 for got, want in zip(fit, (x0, y0, x2, y2)))
                            for fit in fits), fits)
        self.assertIn('refract_paper.color: exponent 0.50', self.texts('#sweep-series span'))

    def test_sweep_series_and_axis(self):
        self.open('sweep2')
        self.assertEqual(len(self.boxes('#sweep-plot .fit')), 0)
        count = len(self.boxes('#sweep-plot .dot'))
        self.focus('#sweep-series input')
        self.press(' ')
        self.assertEqual(len(self.boxes('#sweep-plot .dot')), count - 8)
        self.focus('input[name=parameter]')
        self.press('ArrowRight')
        self.assertIn('sphere.triangles', self.texts('#sweep-plot text'))
        self.assertIn('14400', self.texts('#sweep-plot text'))
        self.run_js('sweepView.shown.clear(); drawSweep()')  # nothing to show is no error


class Keyboard(Page):
    def focused(self):
        return self.run_js('(e => e.id || e.getAttribute("href") || (e.closest("[id]") || e).id)'
                           '(document.activeElement)')

    def test_tab_goes_everywhere(self):
        self.open('as_large_as_a_frame')
        self.press('Tab')
        self.assertEqual(self.run_js('document.activeElement.className'), 'skip')
        self.assertGreaterEqual(self.boxes('.skip')[0][0], 0)
        seen = []
        for _ in range(40):
            self.press('Tab')
            seen.append(self.focused())
        for stop in ('dark', 'command', 'copy', 'settings', '#passes', '#numbers', 'bars',
                     'histogram', 'strip', 'run', 'zoom-out', 'zoom-in', 'lanes', 'blocks'):
            self.assertIn(stop, seen)
        # Round once: a drawing is one stop, however many things it shows.
        self.assertLess(seen.index('#main'), 26, seen)

    def test_skip(self):
        self.open('sample')
        self.press('Tab', 'Enter')
        self.assertEqual(self.focused(), 'main')

    def test_focus_can_be_seen(self):
        self.open('sample')
        for selector in ('#dark', '#copy', '.bar-row[tabindex="0"]', '#run', 'input[name=order]'):
            self.focus(selector)
            outline = self.run_js('getComputedStyle(document.activeElement).outlineStyle')
            self.assertEqual(outline, 'solid', selector)
        for drawing in ('#histogram', '#strip', '#lanes', '#blocks'):
            self.focus(f'{drawing} g[tabindex="0"]')
            width = self.run_js('getComputedStyle(document.activeElement.querySelector("rect"))'
                                '.strokeWidth')
            self.assertEqual(width, '3px', drawing)

    def test_arrows_and_tips(self):
        self.open('sample')
        self.focus('.bar-row[tabindex="0"]')
        self.assertIn('env_cube.objects', self.tip())
        self.press('ArrowDown')
        self.assertIn('refract_paper.color', self.tip())
        self.assertIn('run 7', self.tip())
        self.press('End')
        self.assertIn('unattributed', self.tip())
        self.press('ArrowDown', 'Home')
        self.assertIn('env_cube.objects', self.tip())
        self.press('Escape')
        self.assertIsNone(self.tip())

    def test_runs(self):
        self.open('sample')
        self.focus('#run')
        self.press('ArrowRight', 'ArrowRight')
        self.assertEqual(self.run_js('view.run'), 2)
        self.assertIn('run 2', self.texts('#run-name')[0])
        self.focus('#lanes g[tabindex="0"]')
        self.press('ArrowRight', 'PageDown', 'PageDown', 'PageUp')
        self.assertEqual(self.run_js('view.run'), 3)
        label = self.run_js('document.activeElement.getAttribute("aria-label")')
        self.assertIn('env_cube.objects[1]', label)
        self.press(*['PageDown'] * 30)
        self.assertEqual(self.run_js('view.run'), self.sample['run_count'] - 1)
        self.focus('#strip g[data-run="19"]')
        self.press(*['ArrowLeft'] * 12, 'Enter')
        self.assertIn('run 7', self.texts('#run-name')[0])
        self.assertIn('outlier', self.texts('#run-name')[0])

    def test_zoom(self):
        self.open('sample')
        width = self.boxes('#lanes svg')[0][2]
        self.focus('#lanes')
        self.press('+', '+')
        self.assertAlmostEqual(self.boxes('#lanes svg')[0][2], 4 * width, delta=4)
        self.press('-')
        self.focus('#zoom-out')
        self.press('Enter')
        self.assertAlmostEqual(self.boxes('#lanes svg')[0][2], width, delta=1)

    def test_everything_has_a_name(self):
        self.open('sweep2')
        for node in self.browser.call('Accessibility.getFullAXTree')['nodes']:
            flags = {item['name']: item['value'].get('value')
                     for item in node.get('properties', ())}
            role = node.get('role', {}).get('value')
            if flags.get('focusable') and role not in ('RootWebArea', 'main', 'listitem'):
                self.assertTrue(node.get('name', {}).get('value'), node)


class Schemes(Page):
    def contrast(self, selector):
        """WCAG 2: of the words of an element and the page behind it."""
        def luminance(color):
            parts = [float(v) / 255 for v in re.findall(r'[\d.]+', color)[:3]]
            linear = [v / 12.92 if v <= .04045 else ((v + .055) / 1.055) ** 2.4 for v in parts]
            return .2126 * linear[0] + .7152 * linear[1] + .0722 * linear[2]
        words = self.run_js(f'getComputedStyle(document.querySelector("{selector}")).color')
        back = self.run_js('getComputedStyle(document.body).backgroundColor')
        low, high = sorted((luminance(words), luminance(back)))
        return (high + .05) / (low + .05), luminance(back)

    def check(self, dark):
        for selector in ('#title', 'dt', '.bar-name', '.bar-share', '#outliers', 'th'):
            ratio, back = self.contrast(selector)
            self.assertGreater(ratio, 4.5, selector)
            self.assertEqual(back < .2, dark)
        self.assertEqual(self.run_js('document.getElementById("dark").ariaPressed'),
                         'true' if dark else 'false')

    def test_follow_the_system_and_the_button(self):
        for dark in (False, True):
            self.open('sample', dark=dark)
            self.check(dark)
            self.focus('#dark')
            self.press('Enter')
            self.check(not dark)
            self.press('Enter')
            self.check(dark)


def main():
    global program, chromium
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    program, chromium = sys.argv.pop(1), sys.argv.pop(1)
    if resource.getrlimit(resource.RLIMIT_AS)[0] != resource.RLIM_INFINITY:
        print('skipped: Chromium needs terabytes of addresses, which `ulimit -v` forbids')
        sys.exit(77)
    unittest.main()


if __name__ == '__main__':
    main()
