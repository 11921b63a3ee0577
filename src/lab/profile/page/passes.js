/* passes.js: bars and table of the rows, merged by name or not, in the selected order. */

const profile = JSON.parse($('profile').textContent);

const FRAME_MEAN = profile.frame.summary.mean;
const IS_PASS = { raster: true, compute: true, transfer: true };
const COLOR_COUNT = 8; /* t0 to t7; t8 is for all other techniques */

function makeColors() {
    const totals = new Map();
    for (const row of profile.rows) {
        if (IS_PASS[row.kind])
            totals.set(row.technique, (totals.get(row.technique) ?? 0) + row.summary.mean);
    }
    const byCost = [...totals].sort((a, b) => b[1] - a[1]).map(([technique]) => technique);
    return new Map([...totals.keys()].map(
        technique => [technique, `t${Math.min(byCost.indexOf(technique), COLOR_COUNT)}`]));
}

const techniqueColors = makeColors();

/* Returns the CSS class for the colour of a row. */
function colorOf(row) {
    return IS_PASS[row.kind] ? techniqueColors.get(row.technique) : row.kind;
}

function rowName(row) {
    return row.repetition_count > 1 ? `${row.name}[${row.repetition}]` : row.name;
}

/* Adds up samples of several rows, run by run. */
function addSamples(rows, key) {
    return rows[0][key].map((_, run) => sum(rows.map(row => row[key][run])));
}

/* Aggregates a row, or all repetitions of a row, into one line of bars and table. */
function makeEntry(rows) {
    const [first] = rows;
    const total = key => sum(rows.map(row => row[key]));
    const samples = addSamples(rows, 'ms');
    const summary = summarize(samples);
    return {
        name: rows.length > 1 ? `${first.name} \u00d7${rows.length}` : rowName(first),
        kind: first.kind,
        color: colorOf(first),
        size: first.width ? `${first.width}\u00d7${first.height}` : '',
        samples,
        summary,
        share: summary.mean / FRAME_MEAN,
        record: summarize(addSamples(rows, 'record_ms')).median,
        vertices: total('vertices'),
        triangles: total('triangles'),
        fragments: total('fragments'),
        invocations: total('invocations'),
        covered: total('covered'),
        target_bytes: total('target_bytes'),
    };
}

function entries() {
    const groups = new Map();
    profile.rows.forEach((row, index) => {
        const key = view.each ? index : JSON.stringify([row.kind, row.technique, row.name]);
        groups.set(key, [...groups.get(key) ?? [], row]);
    });
    const found = [...groups.values()].map(makeEntry);
    if (view.order === 'time')
        found.sort((a, b) => b.summary.median - a.summary.median);
    return found;
}

function runNames(runs) {
    return runs.map(run => `run ${run}`).join(', ');
}

/* Returns the lines of an entry's tooltip. */
function entryTip(entry) {
    const { summary: s } = entry, lines = [
        ['median', ms(s.median)],
        ['mean \u00b1 \u03c3', `${digits(s.mean)} \u00b1 ${ms(s.sigma)}`],
        ['min, p95, max', `${digits(s.min)}, ${digits(s.p95)}, ${ms(s.max)}`],
        ['of the frame', percent(entry.share)],
        ['outliers', runNames(s.outliers) || 'none'],
    ];
    if (IS_PASS[entry.kind]) {
        lines.push(['kind', entry.kind], ['recording', ms(entry.record)]);
        if (entry.size)
            lines.push(['targets', `${entry.size}, ${bytes(entry.target_bytes)}`]);
    }
    for (const { name, key } of counts()) {
        if (entry[key])
            lines.push([name, grouped(entry[key])]);
    }
    return lines;
}

/* Returns the pipeline statistics that are above 0 in at least one row. */
function counts() {
    const fragments = profile.fragments_are_exact ? 'fragments' : 'fragments (whole blocks)';
    return profile.has_statistics ? [
        { name: 'vertices', key: 'vertices' },
        { name: 'triangles', key: 'triangles' },
        { name: fragments, key: 'fragments' },
        { name: 'covered samples', key: 'covered' },
        { name: 'invocations', key: 'invocations' },
    ].filter(({ key }) => profile.rows.some(row => row[key])) : [];
}

/* ---- bars ---- */

function drawBar(list, entry, x, step) {
    const line = add(list, 'li', { class: 'bar-row' });
    add(line, 'span', { class: 'bar-name' }, entry.name);
    const track = add(line, 'div', { class: 'track' });
    track.style.setProperty('--step', `${step}%`);
    const place = (style, from, to) => {
        const mark = add(track, 'div', { class: style });
        mark.style.left = `${x(from)}%`;
        mark.style.width = `${Math.max(x(to) - x(from), 0)}%`;
    };
    const { summary: s } = entry;
    place(`bar ${entry.color}`, Math.min(s.median, 0), Math.max(s.median, 0));
    place('whisker', s.min, s.p95);
    add(line, 'span', { class: 'bar-time' }, ms(s.median));
    add(line, 'span', { class: 'bar-share' }, percent(entry.share));
    setTip(line, entry.name, entryTip(entry));
    return line;
}

function drawBars(found) {
    const list = $('bars'), axis = $('bars-axis');
    list.replaceChildren();
    axis.replaceChildren();
    const high = Math.max(...found.map(entry => entry.summary.p95), 1e-6) * 1.02;
    const least = Math.min(...found.map(entry => entry.summary.min), 0);
    const { step } = ticks(0, high, 6);
    /* Slightly negative times are clipped at 0; the number beside the bar shows them. */
    const low = least < -.02 * high ? Math.floor(least / step) * step : 0;
    const x = value => Math.max(0, scale(low, high, 0, 100)(value));
    for (const at of ticks(low, high, (high - low) / step).at) {
        const tick = add(axis, 'span', {}, tickText(at, step));
        tick.style.left = `${x(at)}%`;
    }
    const lines = found.map(entry => drawBar(list, entry, x, step / (high - low) * 100));
    rove(list, lines);
}

function drawLegend() {
    const legend = $('legend');
    for (const [technique, color] of techniqueColors)
        add(legend, 'span', { class: color }, technique);
    add(legend, 'span', { class: 'host' }, 'host');
    add(legend, 'span', { class: 'rest' }, 'unattributed');
}

/* ---- table of all numbers ---- */

function tableColumns() {
    const number = value => digits(value, 4);
    const time = key => ({ name: key, text: entry => number(entry.summary[key]) });
    const columns = [
        { name: 'kind', text: entry => entry.kind },
        { name: 'size', text: entry => entry.size },
        time('median'),
        time('mean'),
        { name: '\u03c3', text: entry => number(entry.summary.sigma) },
        time('min'),
        time('p95'),
        time('max'),
        { name: 'share', text: entry => percent(entry.share) },
        { name: 'record', text: entry => IS_PASS[entry.kind] ? number(entry.record) : '' },
    ];
    for (const { name, key } of counts())
        columns.push({ name, text: entry => IS_PASS[entry.kind] ? grouped(entry[key]) : '' });
    const targets = entry => entry.target_bytes ? bytes(entry.target_bytes) : '';
    columns.push({ name: 'targets', text: targets });
    return columns;
}

/* Returns table lines for the frame, the frame without measurement, and the wait. */
function frameEntries() {
    return [
        ['frame', 'frame: sum of the rows'],
        ['plain', 'plain: without measurement'],
        ['wait', 'wait: within the frame'],
    ].map(([key, name]) => {
        const summary = summarize(profile[key].ms);
        const share = summary.mean / FRAME_MEAN;
        return { name, kind: '', size: '', summary, share, target_bytes: 0 };
    });
}

function drawTable(found) {
    const table = $('numbers-table'), columns = tableColumns();
    table.replaceChildren();
    const head = add(add(table, 'thead'), 'tr'), body = add(table, 'tbody');
    add(head, 'th', { scope: 'col' }, 'row');
    for (const { name } of columns)
        add(head, 'th', { scope: 'col' }, name);
    [...found, ...frameEntries()].forEach((entry, index) => {
        const line = add(body, 'tr', index === found.length ? { class: 'sum' } : {});
        add(line, 'th', { scope: 'row' }, entry.name);
        for (const { text } of columns)
            add(line, 'td', {}, text(entry));
    });
}

function drawRows() {
    const found = entries();
    drawBars(found);
    drawTable(found);
}

function startRows() {
    const controls = $('rows-controls');
    addChoice(controls, 'Order', 'order', [['plan', 'execution'], ['time', 'by time']],
              view.order, value => { view.order = value; drawRows(); });
    if (profile.rows.some(row => row.repetition_count > 1)) {
        addChoice(controls, 'Repetitions', 'each', [[false, 'added up'], [true, 'separate']],
                  view.each, value => { view.each = value; drawRows(); });
    }
    const counted = profile.has_statistics ? 'Counts are pipeline statistics of one frame.' :
                                             'This device has no pipeline statistics.';
    $('numbers-note').textContent = `Times in ms; rows in the order chosen above. ${counted}`;
    drawLegend();
}
