/* memory.js: plot of transient memory: address ranges of resources over the passes. */

const MEMORY = { axis: 84, least: 14, most: 96, height: 96, highest: 480, names: 190 };

/* Returns the colour class of a resource: that of the technique with which its name begins. */
function residentColor(resident) {
    return techniqueColors.get(resident.name.split('.')[0]) ?? 't8';
}

/* Adds two SVGs of equal height: fixed labels, and columns that scroll horizontally. */
function addMemoryRow(box, height, columns) {
    const row = add(box, 'div', { class: 'row' });
    return {
        names: addSvg(row, MEMORY.axis, height, { class: 'names', 'aria-hidden': 'true' }),
        plot: addSvg(row, columns.width * profile.pass_count + 1, height, { role: 'group' }),
    };
}

function drawMemoryPasses(box, columns) {
    const longest = Math.max(...profile.rows.map(row => rowName(row).length));
    const height = Math.min(7 * longest + 8, MEMORY.names);
    const { names, plot } = addMemoryRow(box, height, columns);
    plot.setAttribute('aria-hidden', 'true');
    add(names, 'text', { x: 6, y: height - 6 }, 'pass');
    profile.rows.slice(0, profile.pass_count).forEach((row, index) => {
        const x = index * columns.width, width = columns.width - 2;
        add(plot, 'rect', {
            class: `block ${colorOf(row)}`, x: x + 1, y: 1, width, height: height - 2,
        });
        const transform = `translate(${x + columns.width / 2 + 4} ${height - 6}) rotate(-90)`;
        add(plot, 'text', { class: 'on-color', transform }, rowName(row));
    });
}

function drawMemoryAxis(names, size, height) {
    for (let i = 0; i <= 4; i++) {
        const y = i * (height - 1) / 4, textY = i === 0 ? 10 : i === 4 ? y : y + 4;
        add(names, 'path', { class: 'edge', d: `M${MEMORY.axis - 6} ${y}h6` });
        add(names, 'text', { class: 'end', x: MEMORY.axis - 10, y: textY }, bytes(size / 4 * i));
    }
}

function drawResident(plot, resident, columns, y) {
    const { first_pass: first, last_pass: last, offset, size, name } = resident;
    const x = first * columns.width, width = (last - first + 1) * columns.width;
    const top = y(offset), height = y(offset + size) - top;
    const passes = [first, last].map(index => rowName(profile.rows[index]));
    const item = add(plot, 'g', { role: 'img', 'aria-label': name });
    add(item, 'rect', {
        class: `block ${residentColor(resident)}`, x, y: top, width, height: Math.max(height, .5),
    });
    if (height >= 12)
        addLabel(item, x, top, width, name);
    setTip(item, name, [
        ['size', bytes(size)],
        ['offset', bytes(offset)],
        ['first pass', passes[0]],
        ['last pass', passes[1]],
    ]);
    return item;
}

function drawMemoryBlock(box, block, columns) {
    const residents = profile.residents.filter(resident => resident.block === block);
    const size = Math.max(...residents.map(resident => resident.offset + resident.size));
    const height = Math.min(MEMORY.height + 40 * residents.length, MEMORY.highest);
    const y = scale(0, size, 0, height - 1);
    add(box, 'h3', {}, `Block ${block}: ${bytes(size)}, ${plural(residents.length, 'resource')}`);
    const { names, plot } = addMemoryRow(box, height, columns);
    plot.setAttribute('aria-label', `Block ${block}`);
    drawMemoryAxis(names, size, height);
    for (let i = 0; i <= profile.pass_count; i++)
        add(plot, 'path', { class: 'line', d: `M${i * columns.width + .5} 0v${height}` });
    rove(plot, residents.map(resident => drawResident(plot, resident, columns, y)));
}

function drawMemory() {
    const box = $('blocks');
    box.replaceChildren();
    box.hidden = !profile.residents.length;
    if (box.hidden)
        return;
    const room = (widthOf(box) - MEMORY.axis - 4) / profile.pass_count;
    const least = view.printing ? 1 : MEMORY.least;
    const columns = { width: Math.max(least, Math.min(MEMORY.most, Math.floor(room))) };
    drawMemoryPasses(box, columns);
    const blocks = new Set(profile.residents.map(resident => resident.block));
    for (const block of [...blocks].sort((a, b) => a - b))
        drawMemoryBlock(box, block, columns);
}

function startMemory() {
    const p = profile, saved = 1 - p.memory_used / p.memory_without_aliasing;
    const words = `Transient memory: ${bytes(p.memory_used)} used, ` +
        `${bytes(p.memory_without_aliasing)} without aliasing` +
        (saved > 0 ? ` (${percent(saved)} saved)` : '') + `, lower bound ${bytes(p.memory_bound)}.`;
    $('memory-summary').textContent = words +
        (p.memory_persistent ? ` Persistent memory: ${bytes(p.memory_persistent)}.` : '');
}
