"""plan_dumps.py: checks that the text, JSON and HTML dumps of a plan agree.

The JSON dump has all data. The expected text is derived from the JSON, and the HTML page is
checked against it, as a browser has drawn it.
"""
import decimal
import re
import xml.etree.ElementTree as ElementTree

XHTML, SVG = '{http://www.w3.org/1999/xhtml}', '{http://www.w3.org/2000/svg}'


# ---- text from JSON ----

def display_name(of):
    return f"{of['name']}[{of['repetition']}]" if 'repetition' in of else of['name']


def memory_of(resource):
    if resource['imported']:
        return 'imported'
    if resource['persistent']:
        return f"persistent size {resource['memory_size']}"
    if 'block' not in resource:
        return 'host'
    return (f"block {resource['block']} offset {resource['offset']}"
            f" size {resource['memory_size']}")


def lifetime(plan, resource):
    last = resource['last']
    return f"passes {resource['first']}-{'end' if last == len(plan['passes']) else last}"


def image_line(plan, image):
    counts = ''.join(f' {what} {image[what]}' for what in ('layers', 'mips', 'samples')
                     if image[what] > 1)
    depth = f"x{image['depth']}" if 'depth' in image else ''
    size = f"{image['width']}x{image['height']}{depth}"
    previous = f" previous {image['previous']}" if 'previous' in image else ''
    return (f"image {image['name']} {image['format']} {size}{counts}"
            f"{' cube' if image['cube'] else ''}{previous}, {memory_of(image)}, "
            f"{lifetime(plan, image)}")


def buffer_line(plan, buffer):
    memory = memory_of(buffer)
    return f"buffer {buffer['name']} {buffer['size']} bytes, {memory}, {lifetime(plan, buffer)}"


def memory_lines(plan):
    memory = plan['memory']
    for index, block in enumerate(plan['blocks']):
        yield f"block {index} {block['of']} size {block['size']}"
    yield (f"transient memory: used {memory['used']}, without aliasing"
           f" {memory['without_aliasing']}, bound {memory['bound']}")
    if memory['persistent']:
        yield f"persistent memory: {memory['persistent']}"
    yield f"barriers: {plan['barrier_count']} in {plan['batch_count']} batches"


def span(what, first, count, everything):
    if count == everything:
        return ''
    return f' {what} {first}' if count == 1 else f' {what}s {first}-{first + count - 1}'


def texels(plan, index, of):
    """Returns an image's name and the subresource range that a range, target or resolve selects."""
    image = plan['images'][index]
    text = image['name']
    if of.get('aspects', image['aspects']) != image['aspects']:
        text += ' ' + of['aspects'][-1]
    return (text + span('mip', of['mip'], of.get('mips', 1), image['mips'])
            + span('layer', of['layer'], of.get('layers', 1), image['layers']))


def scope(of):
    return '/'.join('|'.join(of[key]) or 'none' for key in ('stages', 'access'))


def barrier_line(plan, barrier, what='barrier'):
    if 'image' in barrier:
        text = (f"{texels(plan, barrier['image'], barrier['range'])}:"
                f" {barrier['old_layout']} -> {barrier['new_layout']}")
    else:
        text = plan['buffers'][barrier['buffer']]['name'] + ':'
    return f"  {what} {text}  {scope(barrier['src'])} -> {scope(barrier['dst'])}"


def pass_lines(plan, index):
    row = plan['passes'][index]
    yield (f"pass {index} {display_name(row)} {row['kind']} {row['width']}x{row['height']}"
           + (' conditional' if row['conditional'] else '')
           + (' multiview' if row.get('multiview') else ''))
    layers = {'layers': row.get('layers', 1)}
    for target in row['targets']:
        text = texels(plan, target['image'], target | layers)
        resolve = target.get('resolve')
        if resolve:
            resolve = ' resolve ' + texels(plan, resolve['image'], resolve | layers)
        yield f"  {target['access']} {text} {target['load']} {target['store']}{resolve or ''}"
    for use in row['uses']:
        name = (texels(plan, use['image'], use['range']) if 'image' in use
                else plan['buffers'][use['buffer']]['name'])
        binding = f" binding {use['binding']}" if 'binding' in use else ''
        element = f"[{use['element']}]" if use.get('element') else ''
        yield (f"  {use['access']} {name}{' texels' if use.get('texels') else ''}"
               f"{binding}{element}")
    if 'set' in row:
        yield f"  set {row['set']}"


def text_lines(plan):
    """Yields the lines that rg_dump() should write."""
    if plan['faults']:
        yield from (f"fault: {fault['text']}" for fault in plan['faults'])
        return
    yield f"view {plan['view']['width']}x{plan['view']['height']}"
    yield from (image_line(plan, image) for image in plan['images'])
    yield from (buffer_line(plan, buffer) for buffer in plan['buffers'])
    yield from memory_lines(plan)
    yield from (barrier_line(plan, barrier, 'initial barrier')
                for barrier in plan['initial_barriers'])
    for index, row in enumerate(plan['passes']):
        yield from (barrier_line(plan, barrier) for barrier in row['barriers'])
        yield from pass_lines(plan, index)
    yield from (barrier_line(plan, barrier) for barrier in plan['final_barriers'])
    for index, submission in enumerate(plan['submissions']):
        after = ''.join(f' after {i}' for i in submission['after'])
        yield (f"submission {index} {submission['queue']} first {submission['first_pass']}"
               f" count {submission['pass_count']}{after}")
    yield from (f'culled {display_name(culled)}' for culled in plan['culled'])


# ---- HTML page ----

def embedded(html):
    """Returns the JSON dump in a page."""
    return re.search(r'<script type="application/json" id="plan">(.*?)</script>', html,
                     re.DOTALL)[1]


def visible(text):
    """Returns a name as the page displays it: control and non-XML characters are replaced."""
    return ''.join('\ufffd' if ord(c) < 32 or 127 <= ord(c) < 160 or c in '\ufffe\uffff' else c
                   for c in text)


def batches(plan):
    """Returns (column, barriers) of each barrier batch."""
    rows = [*(row['barriers'] for row in plan['passes']), plan['final_barriers']]
    return [(column, barriers) for column, barriers in enumerate(rows) if barriers]


class Page:
    """Compares a page's elements with its plan; `faults` lists the differences as text."""

    def __init__(self, document, plan):
        self.root = ElementTree.fromstring(document)  # serialised by XMLSerializer
        self.plan, self.faults = plan, []
        for element in self.root.iter():  # tags without namespaces, as in HTML
            element.tag = element.tag.removeprefix(XHTML).removeprefix(SVG)
        self.check_alone()
        if plan['faults']:
            self.expect('faults', [item.text for item in self.root.iter('li')],
                        [visible(fault['text']) for fault in plan['faults']])
            return
        self.check_summary()
        self.check_passes()
        self.check_batches()
        for block in range(len(plan['blocks'])):
            self.check_block(block)
        self.check_everything_is_there()

    def expect(self, what, found, wanted):
        if found != wanted:
            self.faults.append(f'{what}: {found!r} instead of {wanted!r}')

    def having(self, attribute):
        return [element for element in self.root.iter() if attribute in element.attrib]

    def title(self, group):
        return group.find('title').text.rstrip('\n').split('\n')

    def check_alone(self):
        """Checks that nothing external is loaded and that names were escaped."""
        for element in self.root.iter():
            if element.tag in ('link', 'img', 'iframe', 'object', 'image', 'use', 'a', 'base'):
                self.faults.append(f'<{element.tag}>')
            for name in element.attrib:
                if name.startswith('on') or name.rpartition('}')[2] in ('src', 'href'):
                    self.faults.append(f'<{element.tag} {name}>')
        style = ''.join(element.text for element in self.root.iter('style'))
        for word in ('@import', 'http:', 'https:'):
            if word in style:
                self.faults.append(f'{word} in the style')
        self.expect('urls', style.count('url('), 0)
        self.expect('scripts', len(list(self.root.iter('script'))), 2)  # one is the JSON

    def check_summary(self):
        summary = next(e for e in self.root.iter('p') if e.get('id') == 'summary').text
        plan = self.plan
        for words in (f"{len(plan['passes'])} passes", f"{len(plan['culled'])} culled",
                      f"{plan['barrier_count']} barriers in {plan['batch_count']} batches"):
            if words not in summary:
                self.faults.append(f'{words!r} is not in the summary')
        culled = [e.text for e in self.root.iter('p') if e.get('id') == 'culled']
        names = ', '.join(visible(display_name(of)) for of in plan['culled'])
        self.expect('culled', culled, [f'culled: {names}'] if names else [])

    def check_passes(self):
        groups = self.having('data-pass')
        self.expect('passes', len(groups), len(self.plan['passes']))
        for index, group in enumerate(groups):
            row = self.plan['passes'][index]
            self.expect('pass', group.find('text').text, visible(display_name(row)))
            self.expect('pass', self.title(group),
                        [visible(line) for line in pass_lines(self.plan, index)])
            self.expect('conditional', 'when' in group.get('class').split(), row['conditional'])

    def check_batches(self):
        marks = [group for group in self.root.iter('g')
                 if group.get('class') == 'batch' and 'data-initial' not in group.attrib]
        found = [(int(mark.find('circle').get('cx')), self.title(mark)) for mark in marks]
        wanted = [(column * self.column(), [visible(barrier_line(self.plan, barrier))
                                            for barrier in barriers])
                  for column, barriers in batches(self.plan)]
        self.expect('batches', found, wanted)
        self.expect('batches', len(marks), self.plan['batch_count'])
        initial = [visible(barrier_line(self.plan, barrier, 'barrier before the first frame'))
                   for barrier in self.plan['initial_barriers']]
        self.expect('initial', [self.title(mark) for mark in self.having('data-initial')],
                    [initial] if initial else [])

    def column(self):
        """Returns the width of a pass's column in pixels."""
        return int(next(self.root.iter('main')).get('data-column'))

    def resource(self, group):
        kind = 'images' if 'data-image' in group.attrib else 'buffers'
        return self.plan[kind][int(group.get('data-image') or group.get('data-buffer'))]

    def check_block(self, block):
        plot = next(e for e in self.having('data-block') if e.get('data-block') == str(block))
        scale = int(plot.get('height')) / self.plan['blocks'][block]['size']
        column, boxes = self.column(), []
        for group in plot.findall('g'):
            of = self.resource(group)
            box = {key: decimal.Decimal(group.find('rect').get(key))
                   for key in ('x', 'width', 'y', 'height')}
            wanted = {
                'x': of['first'] * column, 'width': (of['last'] - of['first'] + 1) * column,
                'y': of['offset'] * scale, 'height': of['memory_size'] * scale,
            }
            if of['block'] != block or any(abs(float(box[key]) - wanted[key]) > 0.0011
                                           for key in box):
                self.faults.append(f"{of['name']}: {box} instead of {wanted}")
            boxes.append(box)
        wanted = sum(of.get('block') == block
                     for of in self.plan['images'] + self.plan['buffers'])
        self.expect(f'block {block}', len(boxes), wanted)
        for i, a in enumerate(boxes):
            for b in boxes[:i]:
                if all(a[low] < b[low] + b[size] and b[low] < a[low] + a[size]
                       for low, size in (('x', 'width'), ('y', 'height'))):
                    self.faults.append(f'block {block}: {a} lies on {b}')

    def check_everything_is_there(self):
        """Checks that each resource is drawn once, with the expected tooltip and bar."""
        for kind, line in (('image', image_line), ('buffer', buffer_line)):
            groups = {group.get(f'data-{kind}'): group for group in self.having(f'data-{kind}')}
            resources = self.plan[f'{kind}s']
            self.expect(kind, sorted(groups, key=int), [str(i) for i in range(len(resources))])
            for index, of in enumerate(resources):
                group = groups[str(index)]
                bar = group.findall('rect')[-1]
                self.expect(kind, self.title(group)[0], visible(line(self.plan, of)))
                self.expect(of['name'], (int(bar.get('x')), int(bar.get('width'))),
                            (of['first'] * self.column(),
                             (of['last'] - of['first'] + 1) * self.column()))
