/* timeline.js: timeline of one run: GPU passes, and recording, submit and wait on the CPU. */

const LANE = { height: 34, gap: 8, axis: 24, right: 8 };
const MAX_ZOOM = 64;

/* Returns the three lanes of a run; their blocks are { name, from, ms, style }. */
function makeLanes(run) {
    const passes = profile.rows.slice(0, profile.pass_count);
    const hostRow = name => profile.rows.slice(profile.pass_count).find(row => row.name === name);
    const record = hostRow('record').ms[run], submit = hostRow('submit').ms[run];
    const start = record + submit, frame = profile.frame.ms[run], wait = profile.wait.ms[run];
    const waiting = Math.max(start, frame - wait);
    let recorded = 0;
    return [{
        name: 'device',
        blocks: passes.map(row => ({
            name: rowName(row), from: start + row.begin_ms[run], ms: row.ms[run],
            style: `block ${colorOf(row)}`,
        })),
    }, {
        name: 'host',
        blocks: [
            { name: 'record', from: 0, ms: record, style: 'block host', text: '' },
            { name: 'submit', from: record, ms: submit, style: 'block host', text: '' },
            { name: 'wait', from: waiting, ms: wait, style: 'wait', text: '' },
        ],
    }, {
        name: 'recording',
        blocks: passes.map(row => {
            recorded += row.record_ms[run];
            return {
                name: `recording ${rowName(row)}`, from: recorded - row.record_ms[run],
                ms: row.record_ms[run], style: `block ${colorOf(row)}`, label: rowName(row),
            };
        }),
    }];
}

function drawBlock(svg, block, x, y) {
    const from = x(block.from), width = Math.max(x(block.from + block.ms) - from, .5);
    const item = add(svg, 'g', { role: 'img', 'aria-label': `${block.name}, ${ms(block.ms)}` });
    const thin = width < 4 ? ' thin' : '';
    add(item, 'rect', { class: block.style + thin, x: from, y, width, height: LANE.height });
    addLabel(item, from, y + 9, width, block.label ?? block.name, block.text ?? 'on-color');
    setTip(item, block.name, [
        ['duration', ms(block.ms)],
        ['start', ms(block.from)],
        ['end', ms(block.from + block.ms)],
        ['of the frame', percent(block.ms / profile.frame.ms[view.run])],
    ]);
    return item;
}

function drawTimelineAxis(svg, width, end, x, y) {
    const marks = ticks(0, end, width / 90);
    for (const at of marks.at) {
        add(svg, 'path', { class: 'line', d: `M${x(at)} 0V${y}` });
        add(svg, 'text', { x: Math.max(x(at), 12), y: y + 15, class: 'middle soft' },
            tickText(at, marks.step));
    }
}

/* Draws the timeline; `focused` is the index of the block that gets the focus back. */
function drawTimeline(focused = -1) {
    const box = $('lanes'), lanes = makeLanes(view.run);
    const width = Math.round(widthOf(box) * view.zoom), frame = profile.frame.ms[view.run];
    const end = Math.max(frame, ...lanes.flatMap(
        ({ blocks }) => blocks.map(block => block.from + block.ms)));
    const pitch = LANE.height + LANE.gap, bottom = lanes.length * pitch;
    const x = scale(0, end, 1, width - LANE.right);
    box.replaceChildren();
    const svg = addSvg(box, width, bottom + LANE.axis, {
        role: 'group', 'aria-label': `Run ${view.run}`,
    });
    drawTimelineAxis(svg, width, end, x, bottom);
    add(svg, 'path', { class: 'median', d: `M${x(frame)} 0v${bottom}` });
    const items = lanes.flatMap(({ blocks }, lane) => blocks
        .filter(block => block.ms > 0)
        .map(block => drawBlock(svg, block, x, lane * pitch + LANE.gap / 2)));
    rove(svg, items, Math.max(focused, 0));
    if (focused >= 0)
        items[Math.min(focused, items.length - 1)]?.focus();
}

function focusedBlock() {
    return [...$('lanes').querySelectorAll('g[tabindex]')].indexOf(document.activeElement);
}

function describeRun() {
    const frame = profile.frame.ms[view.run], { median, outliers } = profile.frame.summary;
    const outlier = outliers.includes(view.run) ? ', an outlier' : '';
    const words = `run ${view.run}: ${ms(frame)}, ${times(frame / median)} the median${outlier}`;
    $('run-name').textContent = words;
    $('run').setAttribute('aria-valuetext', words);
}

function chooseRun(run) {
    const focused = focusedBlock();
    view.run = Math.max(0, Math.min(profile.run_count - 1, run));
    $('run').value = view.run;
    $('strip').querySelectorAll('g[data-run]').forEach(item => {
        item.classList.toggle('chosen', Number(item.dataset.run) === view.run);
    });
    describeRun();
    drawTimeline(focused);
}

/* Changes the zoom and keeps the centre of the visible range fixed. */
function zoomTo(zoom) {
    const box = $('lanes'), focused = focusedBlock();
    const middle = (box.scrollLeft + box.clientWidth / 2) / box.scrollWidth;
    view.zoom = Math.max(1, Math.min(MAX_ZOOM, zoom));
    drawTimeline(focused);
    if (focused < 0)
        box.scrollLeft = middle * box.scrollWidth - box.clientWidth / 2;
    $('zoom').textContent = view.zoom > 1 ? `${view.zoom}\u00d7` : '';
}

function startTimeline() {
    const keys = {
        PageUp: () => chooseRun(view.run - 1),
        PageDown: () => chooseRun(view.run + 1),
        '+': () => zoomTo(view.zoom * 2),
        '=': () => zoomTo(view.zoom * 2),
        '-': () => zoomTo(view.zoom / 2),
    };
    for (const { name } of makeLanes(0)) {
        const label = add($('lane-names'), 'div', {}, name);
        label.style.height = `${LANE.height + LANE.gap}px`;
    }
    add($('lane-names'), 'div', {}, 'ms');
    $('run').max = profile.run_count - 1;
    $('run').addEventListener('input', event => chooseRun(Number(event.target.value)));
    $('zoom-in').addEventListener('click', () => zoomTo(view.zoom * 2));
    $('zoom-out').addEventListener('click', () => zoomTo(view.zoom / 2));
    $('lanes').addEventListener('keydown', event => {
        if (keys[event.key] && !event.ctrlKey && !event.altKey && !event.metaKey) {
            event.preventDefault();
            keys[event.key]();
        }
    });
    if (profile.clock === 'submits') {
        $('timeline-note').textContent =
            'Each pass was submitted alone and finished before the next one: the lanes are drawn ' +
            'as if the CPU had recorded and submitted all passes first.';
    }
    describeRun();
}
