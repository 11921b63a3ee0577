/* sweep.js: log-log plot of time over the parameter of a sweep. */

const SWEEP = { height: 360, left: 56, right: 12, top: 12, bottom: 40, zero: 64, names: 170 };
const sweep = JSON.parse($('sweep-data').textContent); /* null without a sweep */

const sweepView = { parameter: 0, shown: new Set(['frame']) };

/* Returns the median time of a point: of the frame, or of a pass with all repetitions. */
function pointTime(point, name) {
    if (name === 'frame')
        return point.profile.frame.summary.median;
    return sum(point.profile.rows.filter(row => row.name === name)
        .map(row => row.summary.median));
}

/* Returns "frame" and the names of all passes, the most expensive first. */
function seriesNames() {
    const names = new Set(sweep.points.flatMap(point => point.profile.rows
        .filter(row => IS_PASS[row.kind]).map(row => row.name)));
    const most = name => Math.max(...sweep.points.map(point => pointTime(point, name)));
    return ['frame', ...[...names].sort((a, b) => most(b) - most(a))];
}

function seriesColor(name) {
    const rows = sweep.points.flatMap(point => point.profile.rows);
    return name === 'frame' ? 'whole' :
        techniqueColors.get(rows.find(row => row.name === name).technique) ?? 't8';
}

/* Returns the right end of the curves, which leaves room for series names if possible. */
function sweepRight(width) {
    return width - (width > 600 ? SWEEP.names : SWEEP.right + 12);
}

function fitOf(name) {
    return sweep.fits.find(fit => fit.name === name);
}

/* Groups points into curves: points of a curve differ only in the parameter of the axis. */
function curves() {
    const found = new Map();
    for (const point of sweep.points) {
        const others = point.values.filter((_, index) => index !== sweepView.parameter);
        const key = JSON.stringify(others);
        found.set(key, [...found.get(key) ?? [], point]);
    }
    return [...found.values()];
}

/* Returns the logarithmic x axis, with separate positions for values that it cannot show. */
function sweepX(width) {
    const values = sweep.points.map(point => point.numbers[sweepView.parameter]);
    const positive = values.filter(value => value > 0), right = sweepRight(width);
    if (values.includes(null)) {
        const words = [...new Set(sweep.points.map(point => point.values[sweepView.parameter]))];
        const x = scale(-.5, words.length - .5, SWEEP.left, right);
        return {
            of: point => x(words.indexOf(point.values[sweepView.parameter])),
            isOnAxis: () => true,
            marks: words.map((text, index) => ({ x: x(index), text })),
        };
    }
    const left = SWEEP.left + (positive.length < values.length ? SWEEP.zero : 20);
    const low = Math.log(Math.min(...positive)), high = Math.log(Math.max(...positive));
    const x = scale(low, high, left, low < high ? right : 2 * right - left);
    const at = value => value > 0 ? x(Math.log(value)) : SWEEP.left + 14;
    return {
        of: point => at(point.numbers[sweepView.parameter]),
        isOnAxis: point => point.numbers[sweepView.parameter] > 0,
        ofNumber: at,
        range: [Math.exp(low), Math.exp(high)],
        marks: [...new Map(sweep.points.map(point => [
            point.numbers[sweepView.parameter], point.values[sweepView.parameter],
        ]))].map(([value, text]) => ({ x: at(value), text })),
    };
}

/* Draws the series names at the ends of their curves, moved down where they would overlap. */
function drawSweepNames(svg, shown, width, x, y) {
    const at = sweepRight(width);
    if (at > width - SWEEP.names)
        return;
    const last = curves()[0].reduce((a, b) => x.of(a) > x.of(b) ? a : b);
    const ends = shown.filter(name => pointTime(last, name) > 0)
        .map(name => ({ name, y: y.of(pointTime(last, name)) })).sort((a, b) => a.y - b.y);
    let free = 0;
    for (const end of ends) {
        free = Math.max(end.y, free + 13);
        addLabel(svg, at + 8, free - 8, width - at - 8, end.name, '');
    }
}

/* Returns ticks at 1, 2 and 5 times powers of ten; linear ticks if there are too few. */
function timeMarks(low, high) {
    const found = [];
    for (let power = Math.floor(Math.log10(low)); 10 ** power <= high; power++)
        found.push(...(high / low < 1000 ? [1, 2, 5] : [1]).map(factor => factor * 10 ** power));
    const inside = found.filter(value => value >= low && value <= high);
    return inside.length > 1 ? inside : ticks(low, high, 4).at;
}

/* Returns the logarithmic y axis, which omits times of 0. */
function sweepY(names) {
    const all = sweep.points.flatMap(point => names.map(name => pointTime(point, name)))
        .filter(value => value > 0);
    const [low, high] = all.length ? [Math.min(...all) * .8, Math.max(...all) * 1.25] : [1, 10];
    const y = scale(Math.log(low), Math.log(high), SWEEP.height - SWEEP.bottom, SWEEP.top);
    const of = value => y(Math.log(value));
    const marks = timeMarks(low, high).map(value => ({
        y: of(value), text: String(Number(value.toPrecision(2))),
    }));
    return { of, marks };
}

function drawSweepAxes(svg, width, x, y) {
    const { left, right, top, bottom, height } = SWEEP, foot = height - bottom;
    for (const mark of y.marks) {
        add(svg, 'path', { class: 'line', d: `M${left} ${mark.y}H${width - right}` });
        add(svg, 'text', { class: 'end soft', x: left - 6, y: mark.y + 4 }, mark.text);
    }
    let free = 0;
    for (const mark of [...x.marks].sort((a, b) => a.x - b.x)) {
        add(svg, 'path', { class: 'edge', d: `M${mark.x} ${foot}v4` });
        const half = mark.text.length * 3.5 + 4;
        if (mark.x - half < free)
            continue;
        free = mark.x + half;
        add(svg, 'text', { class: 'middle soft', x: mark.x, y: foot + 16 }, mark.text);
    }
    add(svg, 'path', { class: 'edge', d: `M${left} ${top}V${foot}H${width - right}` });
    add(svg, 'text', { class: 'end soft', x: left - 6, y: height - 8 }, 'ms');
    add(svg, 'text', { class: 'end', x: width - right, y: height - 8 },
        sweep.parameters[sweepView.parameter]);
}

function sweepTip(point, name) {
    const { summary } = point.profile.frame;
    const lines = sweep.parameters.map((parameter, i) => [parameter, point.values[i]]);
    lines.push(['median', ms(pointTime(point, name))]);
    if (name === 'frame')
        lines.push(['mean \u00b1 \u03c3', `${digits(summary.mean)} \u00b1 ${ms(summary.sigma)}`]);
    else
        lines.push(['of the frame', percent(pointTime(point, name) / summary.median)]);
    return lines;
}

function drawFit(svg, name, x, y) {
    const fit = fitOf(name);
    if (!fit || !x.range)
        return;
    const time = value => fit.factor * value ** fit.exponent;
    const ends = x.range.map(value => [x.ofNumber(value), y.of(time(value))]);
    add(svg, 'path', { class: 'fit', d: `M${ends.join('L')}` });
}

function drawSeries(svg, name, color, x, y) {
    const items = [];
    for (const curve of curves()) {
        const points = curve.filter(point => pointTime(point, name) > 0)
            .sort((a, b) => x.of(a) - x.of(b));
        const path = points.map(point => [x.of(point), y.of(pointTime(point, name))]);
        const line = path.filter((_, index) => x.isOnAxis(points[index]));
        const d = line.length ? `M${line.join('L')}` : '';
        for (const style of ['casing', 'series'])
            add(svg, 'path', { class: `${style} ${color}`, d });
        points.forEach((point, index) => {
            const [cx, cy] = path[index];
            const title = `${name}, ${point.values.join(', ')}`;
            const item = add(svg, 'g', { role: 'img', 'aria-label': title });
            add(item, 'circle', { class: 'hit', cx, cy, r: 9 });
            add(item, 'circle', { class: `dot ${color}`, cx, cy, r: 4.5 });
            setTip(item, title, sweepTip(point, name));
            items.push(item);
        });
    }
    drawFit(svg, name, x, y);
    return items;
}

function drawSweepTable(names) {
    const table = $('sweep-table');
    table.replaceChildren();
    const head = add(add(table, 'thead'), 'tr');
    const body = add(table, 'tbody');
    for (const name of [...sweep.parameters, ...names])
        add(head, 'th', { scope: 'col' }, name);
    for (const point of sweep.points) {
        const line = add(body, 'tr');
        point.values.forEach((value, i) =>
            add(line, i ? 'td' : 'th', i ? {} : { scope: 'row' }, value));
        for (const name of names)
            add(line, 'td', {}, digits(pointTime(point, name), 4));
    }
    const addFit = (words, text) => {
        const line = add(body, 'tr', { class: 'sum' });
        add(line, 'th', { scope: 'row' }, words);
        for (const name of names)
            add(line, 'td', {}, fitOf(name) ? text(fitOf(name)) : '');
    };
    if (names.some(fitOf)) {
        addFit('exponent', fit => fit.exponent.toFixed(3).replace('-', '\u2212'));
        addFit('R\u00b2', fit => fit.r2.toFixed(4));
    }
}

function drawSweep() {
    if (!sweep)
        return;
    const box = $('sweep-plot'), width = widthOf(box), names = seriesNames();
    const shown = names.filter(name => sweepView.shown.has(name));
    const x = sweepX(width), y = sweepY(shown);
    box.replaceChildren();
    const svg = addSvg(box, width, SWEEP.height, {
        role: 'group', 'aria-label': `Time against ${sweep.parameters[sweepView.parameter]}`,
    });
    drawSweepAxes(svg, width, x, y);
    rove(svg, shown.flatMap(name => drawSeries(svg, name, seriesColor(name), x, y)));
    drawSweepNames(svg, shown, width, x, y);
    drawSweepTable(shown);
}

function fitText(name) {
    const fit = fitOf(name);
    return fit ? `${name}: exponent ${fit.exponent.toFixed(2).replace('-', '\u2212')}` : name;
}

function startSweepSeries(names) {
    const box = $('sweep-series');
    names.forEach(name => {
        const label = add(box, 'label');
        const check = add(label, 'input', { type: 'checkbox', value: name });
        check.checked = sweepView.shown.has(name);
        add(label, 'i', { class: seriesColor(name) });
        add(label, 'span', {}, fitText(name));
        check.addEventListener('change', () => {
            sweepView.shown[check.checked ? 'add' : 'delete'](name);
            drawSweep();
        });
    });
}

function startSweep() {
    if (!sweep)
        return;
    const names = seriesNames();
    $('sweep').hidden = false;
    document.querySelector('a[href="#sweep"]').hidden = false;
    names.slice(1, 4).forEach(name => sweepView.shown.add(name));
    if (sweep.parameters.length > 1) {
        addChoice($('sweep-axis'), 'Across', 'parameter',
                  sweep.parameters.map((name, index) => [index, name]), 0, index => {
                      sweepView.parameter = index;
                      drawSweep();
                  });
    }
    startSweepSeries(names);
}
