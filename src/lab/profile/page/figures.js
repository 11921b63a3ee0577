/* figures.js: charts of frame rates as in the paper, and a table that tests its claims. */

const FIGURE = { height: 220, left: 48, right: 12, top: 14, bottom: 40 };

const frameRate = index => 1000 / sweep.points[index].profile.plain.summary.median;

function drawFigureAxes(svg, figure, width, at, y) {
    const { height, left, right, bottom } = FIGURE, baseline = height - bottom, marks = y.marks;
    for (const value of marks.at) {
        add(svg, 'path', { class: 'line', d: `M${left} ${y.of(value)}H${width - right}` });
        add(svg, 'text', { class: 'end soft', x: left - 6, y: y.of(value) + 4 },
            tickText(value, marks.step));
    }
    figure.columns.forEach((name, column) => add(svg, 'text', {
        class: 'middle soft', x: at(column), y: baseline + 15,
    }, name));
    add(svg, 'text', { class: 'middle soft', x: (left + width - right) / 2, y: height - 6 },
        `${figure.axis}; vertical: frames/s`);
}

/* Draws one value of a series as bar or dot, labelled with its frame rate. */
function drawRate(svg, figure, series, column, position) {
    const { x, y, wide, baseline } = position, rate = frameRate(series.points[column]);
    const name = `${series.name}, ${figure.columns[column]}`;
    const item = add(svg, 'g', { role: 'img', 'aria-label': `${name}: ${digits(rate)} frames/s` });
    const style = `block t${figure.series.indexOf(series)}`;
    if (figure.is_bars)
        add(item, 'rect', { class: style, x: x - wide / 2, y, width: wide, height: baseline - y });
    else
        add(item, 'circle', { class: style, cx: x, cy: y, r: 5 });
    add(item, 'text', { class: 'middle', x, y: y - 8 }, digits(rate));
    setTip(item, name, [['frames/s', digits(rate)], ['frame', ms(1000 / rate)]]);
    return item;
}

function drawFigure(box, figure) {
    const { height, left, right, top, bottom } = FIGURE, baseline = height - bottom;
    const width = Math.min(widthOf(box), 560);
    const slot = (width - left - right) / figure.columns.length;
    const most = Math.max(...figure.series.flatMap(series => series.points.map(frameRate)));
    const up = scale(0, most * 1.15, baseline, top), at = column => left + (column + .5) * slot;
    add(box, 'h3', {}, figure.title);
    const legend = add(box, 'p', { class: 'figure-legend' });
    figure.series.forEach((series, index) => {
        add(legend, 'i', { class: `t${index}` });
        legend.append(` ${series.name} `);
    });
    const svg = addSvg(box, width, height, { role: 'group', 'aria-label': figure.title });
    drawFigureAxes(svg, figure, width, at, { of: up, marks: ticks(0, most * 1.15, 4) });
    const wide = Math.min(slot / (figure.series.length + 1), 60), items = [];
    figure.series.forEach((series, index) => {
        const aside = figure.is_bars ? (index - (figure.series.length - 1) / 2) * wide : 0;
        const positions = series.points.map((point, column) => ({
            x: at(column) + aside, y: up(frameRate(point)), wide: wide - 4, baseline,
        }));
        if (!figure.is_bars)
            add(svg, 'path', {
                class: `series t${index}`,
                d: positions.map(({ x, y }, i) => `${i ? 'L' : 'M'}${x} ${y}`).join(''),
            });
        items.push(...positions.map(
            (position, column) => drawRate(svg, figure, series, column, position)));
    });
    rove(svg, items);
}

function drawContrasts(table) {
    const head = add(add(table, 'thead'), 'tr'), body = add(table, 'tbody');
    const signed = rate => percent(rate - 1);
    for (const word of ['in the paper', 'frame rate with', 'firn', '99 % interval', 'p', 'claim'])
        add(head, 'th', { scope: 'col' }, word);
    for (const { where, what, said, rate, low, high, p } of sweep.contrasts) {
        const line = add(body, 'tr');
        add(line, 'th', { scope: 'row' }, where);
        for (const word of [what, signed(rate), `${signed(low)} to ${signed(high)}`,
                            p > .01 ? `${digits(p, 1)}: may be noise` : digits(p, 1), said])
            add(line, 'td', {}, word);
    }
}

function drawFigures() {
    if (!sweep?.figures.length)
        return;
    $('figure-plots').replaceChildren();
    for (const figure of sweep.figures)
        drawFigure(add($('figure-plots'), 'div', { class: 'plot' }), figure);
}

function startFigures() {
    if (!sweep?.figures.length)
        return;
    $('figures').hidden = document.querySelector('nav [href="#figures"]').hidden = false;
    drawContrasts($('contrasts'));
}
