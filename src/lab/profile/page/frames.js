/* frames.js: histogram of the frame times, and a plot of the frame time of each run. */

const HISTOGRAM = { height: 88, top: 18, axis: 20, side: 4 };
const STRIP = { height: 150, top: 12, bottom: 22, left: 48, right: 12 };

/*
 * Returns the histogram bins of both series: { from, to, measured, plain }. Slow outliers share
 * one last bin, since a single one would stretch the axis and compress all other bins.
 */
function makeBins(width) {
    const both = [...profile.frame.ms, ...profile.plain.ms], low = Math.min(...both);
    const most = Math.max(...both);
    const high = Math.max(...[profile.frame, profile.plain].map(
        ({ ms: samples, summary }) => Math.max(...samples.filter(
            (value, run) => value <= summary.median || !summary.outliers.includes(run)))));
    const wanted = Math.max(6, Math.min(2 * Math.sqrt(profile.run_count), width / 16));
    const step = niceStep(Math.max((high - low) / wanted, high * 1e-3, 1e-6));
    const first = Math.floor(low / step), count = Math.floor(high / step) - first + 1;
    const bins = Array.from({ length: count }, (_, i) => ({
        from: (first + i) * step, to: (first + i + 1) * step, measured: 0, plain: 0,
    }));
    if (most >= bins.at(-1).to)
        bins.push({ from: bins.at(-1).to, to: most, measured: 0, plain: 0, isRest: true });
    const binOf = value => bins.find(bin => value < bin.to) ?? bins.at(-1);
    profile.frame.ms.forEach(value => { binOf(value).measured++; });
    profile.plain.ms.forEach(value => { binOf(value).plain++; });
    return { bins, step };
}

function binName({ from, to, isRest }, step) {
    return isRest ? `${tickText(from, step)} ms and more` :
                    `${tickText(from, step)} to ${tickText(to, step)} ms`;
}

function drawBin(svg, bin, name, at, wide, most) {
    const { height, top, axis } = HISTOGRAM, up = top + height;
    const item = add(svg, 'g', { role: 'img', 'aria-label': name });
    const bar = (style, count, isUp) => add(item, 'rect', {
        class: style, x: at + 1, width: Math.max(wide - 2, 1), height: count / most * height,
        y: isUp ? up - count / most * height : up + axis,
    });
    add(item, 'rect', { class: 'hit', x: at, y: top, width: wide, height: 2 * height + axis });
    bar('measured', bin.measured, true);
    bar('plain', bin.plain, false);
    setTip(item, name, [
        ['measured', plural(bin.measured, 'frame')], ['plain', plural(bin.plain, 'frame')],
    ]);
    return item;
}

function drawHistogramAxis(svg, bins, x, end) {
    const { height, top, axis } = HISTOGRAM, y = top + height + 14;
    const rest = bins.find(bin => bin.isRest), last = (rest ?? bins.at(-1))[rest ? 'from' : 'to'];
    const marks = ticks(bins[0].from, last, end / 90);
    for (const at of [top + height, top + height + axis])
        add(svg, 'path', { class: 'edge', d: `M${x(bins[0].from)} ${at}H${x(last)}` });
    for (const at of marks.at) {
        const style = x(at) < 14 ? 'soft' : x(at) > end - 14 ? 'end soft' : 'middle soft';
        add(svg, 'text', { x: x(at), y, class: style }, tickText(at, marks.step));
    }
    if (rest)
        add(svg, 'text', { x: end, y, class: 'end soft' }, 'slower');
}

/* Draws bars of measured frames upwards and of frames without measurement downwards. */
function drawHistogram() {
    const box = $('histogram'), width = widthOf(box), { height, top, axis, side } = HISTOGRAM;
    const { bins, step } = makeBins(width), hasRest = bins.at(-1).isRest, gap = hasRest ? 24 : 0;
    const wide = (width - 2 * side - gap) / bins.length, low = bins[0].from;
    const x = value => side + (value - low) / step * wide;
    const most = Math.max(...bins.flatMap(bin => [bin.measured, bin.plain]));
    box.replaceChildren();
    const svg = addSvg(box, width, 2 * (top + height) + axis, {
        role: 'group', 'aria-label': 'Histogram of frame times',
    });
    ['frame', 'plain'].forEach((series, i) => {
        const { median } = profile[series].summary, words = i ? 'plain' : 'measured';
        const from = top + i * (height + axis), y = i ? from + height + 14 : 12;
        add(svg, 'text', { x: side, y }, `${words}, in ms: median ${digits(median)}`);
        add(svg, 'path', { class: 'median', d: `M${x(median)} ${from}v${height}` });
    });
    drawHistogramAxis(svg, bins, x, width - side);
    rove(svg, bins.map(bin => drawBin(svg, bin, binName(bin, step),
                                      x(bin.from) + (bin.isRest ? gap : 0), wide, most)));
    svg.append(...svg.querySelectorAll('.median'));
}

function drawRunMarks(item, run, x, y) {
    for (const [series, style] of [['plain', 'plain'], ['frame', 'measured']]) {
        const { ms: samples, summary } = profile[series], cy = y(samples[run]);
        add(item, 'circle', { class: style, cx: x, cy, r: 3.2 });
        if (summary.outliers.includes(run))
            add(item, 'circle', { class: 'marked', cx: x, cy, r: 7 });
    }
}

function runTip(run) {
    const measured = profile.frame.ms[run], usual = profile.frame.summary.median;
    return [
        ['measured', ms(measured)],
        ['relative to median', times(measured / usual)],
        ['plain', ms(profile.plain.ms[run])],
        ['outlier', profile.frame.summary.outliers.includes(run) ? 'yes' : 'no'],
    ];
}

function drawStripAxis(svg, width, low, high, y) {
    const { left, right, height, bottom } = STRIP, marks = ticks(low, high, 4);
    for (const at of marks.at) {
        add(svg, 'path', { class: 'line', d: `M${left} ${y(at)}H${width - right}` });
        const place = { x: left - 6, y: y(at) + 4, class: 'end soft' };
        add(svg, 'text', place, tickText(at, marks.step));
    }
    add(svg, 'text', { x: left - 6, y: height - 6, class: 'end soft' }, 'ms');
}

function drawStrip() {
    const box = $('strip'), width = widthOf(box), { height, top, bottom, left, right } = STRIP;
    const both = [...profile.frame.ms, ...profile.plain.ms], count = profile.run_count;
    const high = Math.max(...both), margin = (high - Math.min(...both)) * .08 || high * .1 || 1;
    const low = Math.max(0, Math.min(...both) - margin);
    const y = scale(low, high + margin, height - bottom, top);
    const slot = (width - left - right) / count, x = run => left + (run + .5) * slot;
    box.replaceChildren();
    const svg = addSvg(box, width, height, {
        role: 'group', 'aria-label': 'Frame time of each run; Enter shows the run in the timeline',
    });
    drawStripAxis(svg, width, low, high + margin, y);
    const items = profile.frame.ms.map((_, run) => {
        const item = add(svg, 'g', {
            role: 'button', 'aria-label': `run ${run}`, 'data-run': run,
            class: run === view.run ? 'chosen' : '',
        });
        add(item, 'rect', {
            class: 'hit', x: x(run) - slot / 2, y: top / 2, width: slot, height: height - bottom,
        });
        drawRunMarks(item, run, x(run), y);
        item.addEventListener('click', () => chooseRun(run));
        item.addEventListener('keydown', event => {
            if (event.key === 'Enter' || event.key === ' ') {
                event.preventDefault();
                chooseRun(run);
            }
        });
        setTip(item, `run ${run}`, runTip(run));
        return item;
    });
    const every = Math.max(1, niceStep(36 / slot));
    for (let run = 0; run < count; run += Math.ceil(every))
        add(svg, 'text', { x: x(run), y: height - 6, class: 'middle soft' }, String(run));
    rove(svg, items, view.run);
}

/* Describes each outlier: its frame time, and the row that exceeds its own median the most. */
function outlierTexts() {
    const lines = [];
    for (const run of profile.frame.summary.outliers) {
        const slowest = profile.rows.filter(row => row.summary.outliers.includes(run))
            .map(row => ({ row, over: row.ms[run] - row.summary.median }))
            .filter(({ over }) => over > 0).sort((a, b) => b.over - a.over)[0];
        const ratio = profile.frame.ms[run] / profile.frame.summary.median;
        let words = `run ${run}: ${ms(profile.frame.ms[run])}, ${times(ratio)} the median`;
        if (ratio > 1 && slowest)
            words += `, of which ${rowName(slowest.row)} ${ms(slowest.row.ms[run])}`;
        lines.push(words);
    }
    return lines;
}

function drawFrames() {
    drawHistogram();
    drawStrip();
}

function startFrames() {
    const words = outlierTexts(), shown = words.slice(0, 12);
    if (words.length > shown.length)
        shown.push(`and ${plural(words.length - shown.length, 'more run')}`);
    $('outliers').textContent = 'Outliers, more than 1.5 interquartile ranges outside the ' +
        `quartiles, are circled. Among measured frames: ${shown.join('; ') || 'none'}.`;
    $('overhead').textContent = `Measurement overhead: ${percent(profile.overhead)}.`;
}
