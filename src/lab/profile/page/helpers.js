/* helpers.js: shared helpers: elements, number formatting, statistics, axes, tooltips, keyboard. */
'use strict';

const $ = id => document.getElementById(id);
const HTML_SPACE = document.documentElement.namespaceURI;
const SVG_SPACE = $('marks').namespaceURI;

/* View state that the user controls. */
const view = { order: 'plan', each: false, run: 0, zoom: 1, printing: false };

/* ---- elements: text is only set as textContent, since names may contain markup ---- */

function add(parent, name, attributes = {}, text = '') {
    const isSvg = name === 'svg' || parent instanceof SVGElement;
    const element = document.createElementNS(isSvg ? SVG_SPACE : HTML_SPACE, name);
    for (const [key, value] of Object.entries(attributes))
        element.setAttribute(key, value);
    element.textContent = text;
    parent.append(element);
    return element;
}

function addSvg(parent, width, height, attributes = {}) {
    return add(parent, 'svg', { width, height, viewBox: `0 0 ${width} ${height}`, ...attributes });
}

/* Adds text that is clipped to a box. */
function addLabel(parent, x, y, width, text, style = 'on-color') {
    if (width < 24)
        return;
    const box = add(parent, 'svg', { x, y, width: width - 2, height: 16 });
    add(box, 'text', { x: 4, y: 12, class: style }, text);
}

/* Adds a group of radio buttons; `options` are pairs [value, label]. */
function addChoice(parent, words, name, options, chosen, change) {
    const set = add(parent, 'fieldset');
    add(set, 'legend', {}, words);
    for (const [value, label] of options) {
        const line = add(set, 'label');
        const button = add(line, 'input', { type: 'radio', name, value });
        button.checked = value === chosen;
        button.addEventListener('change', () => change(value));
        line.append(` ${label}`);
    }
}

/* In print a fixed width is used, since clientWidth is still that of the screen. */
const widthOf = box => view.printing ? 940 : Math.max(box.clientWidth, 200);

/* ---- number formatting ---- */

function grouped(value) {
    return String(value).replace(/\B(?=(\d{3})+$)/g, '\u202f');
}

function digits(value, count = 3) {
    if (value === 0)
        return '0';
    const size = Math.abs(value);
    const text = size >= 10 ** (count - 1) ? grouped(Math.round(size)) :
                 size < 1e-6 ? size.toExponential(1) : size.toPrecision(count);
    return (value < 0 ? '\u2212' : '') + text;
}

const ms = value => `${digits(value)} ms`;
const percent = share => `${share < 0 ? '\u2212' : ''}${Math.abs(share * 100).toFixed(1)} %`;
const times = factor => `${digits(factor)}\u00d7`;

function bytes(size) {
    const units = ['B', 'KiB', 'MiB', 'GiB', 'TiB'];
    let unit = 0;
    for (; size >= 1024 && unit < units.length - 1; unit++)
        size /= 1024;
    return `${unit ? (Math.floor(size * 10) / 10).toFixed(1) : size} ${units[unit]}`;
}

function plural(count, word) {
    return `${grouped(count)} ${word}${count === 1 ? '' : 's'}`;
}

/* ---- statistics, as defined in docs/profile.md ---- */

const sum = values => values.reduce((total, value) => total + value, 0);

function quantile(sorted, part) {
    const at = part * (sorted.length - 1), below = Math.floor(at);
    const above = Math.min(below + 1, sorted.length - 1);
    return sorted[below] + (sorted[above] - sorted[below]) * (at - below);
}

function summarize(samples) {
    const sorted = [...samples].sort((a, b) => a - b), count = sorted.length;
    const mean = sum(samples) / count;
    const squares = sum(samples.map(value => (value - mean) ** 2));
    const low = quantile(sorted, .25), high = quantile(sorted, .75), fence = 1.5 * (high - low);
    const outliers = [];
    samples.forEach((value, run) => {
        if (value < low - fence || value > high + fence)
            outliers.push(run);
    });
    return {
        mean,
        sigma: count > 1 ? Math.sqrt(squares / (count - 1)) : 0,
        min: sorted[0],
        median: quantile(sorted, .5),
        p95: quantile(sorted, .95),
        max: sorted[count - 1],
        outliers,
    };
}

/* ---- axes ---- */

/* Rounds `least` up to 1, 2 or 5 times a power of ten. */
function niceStep(least) {
    const power = 10 ** Math.floor(Math.log10(least));
    return [1, 2, 5, 10].map(factor => factor * power).find(step => step >= least * .999999);
}

/* Returns about `count` ticks between two numbers, at multiples of a round step. */
function ticks(low, high, count) {
    const step = niceStep((high - low) / count), found = [];
    for (let i = Math.ceil(low / step - 1e-9); i * step <= high + step * 1e-9; i++)
        found.push(i * step);
    return { step, at: found };
}

/* Formats a tick with as many decimals as the step needs, equal for the whole axis. */
function tickText(value, step) {
    const places = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
    return places > 6 ? value.toExponential(1) : value.toFixed(places).replace('-', '\u2212');
}

function scale(low, high, from, to) {
    return value => from + (value - low) / (high - low || 1) * (to - from);
}

/* ---- tooltips: shown on hover and on keyboard focus; Escape hides them ---- */

const tips = new WeakMap();
let tipOwner = null, tipX = null;

/* Sets the tooltip of an element; `rows` are pairs [label, value]. */
function setTip(element, title, rows) {
    element.dataset.tip = '';
    tips.set(element, { title, rows });
}

function positionTip() {
    if (!tipOwner)
        return;
    const box = $('tip'), at = tipOwner.getBoundingClientRect(), gap = 8;
    const { width, height } = box.getBoundingClientRect();
    const room = document.documentElement.clientWidth - width - gap;
    const x = tipX === null ? at.left + Math.min(at.width / 2, 120) : tipX;
    const below = at.bottom + gap + height <= innerHeight;
    box.style.left = `${Math.max(gap, Math.min(x, room))}px`;
    box.style.top = `${Math.max(gap, below ? at.bottom + gap : at.top - gap - height)}px`;
}

function hideTip() {
    $('tip').hidden = true;
    tipOwner?.removeAttribute('aria-describedby');
    tipOwner = null;
}

function showTip(owner, x) {
    hideTip();
    const { title, rows } = tips.get(owner), box = $('tip');
    box.replaceChildren();
    add(box, 'b', {}, title);
    const list = add(box, 'dl');
    for (const [word, number] of rows) {
        add(list, 'dt', {}, word);
        add(list, 'dd', {}, number);
    }
    box.hidden = false;
    tipOwner = owner;
    tipX = x;
    owner.setAttribute('aria-describedby', 'tip');
    positionTip();
}

function listenForTips() {
    const ownerOf = event => event.target.closest?.('[data-tip]');
    document.addEventListener('pointerover', event => {
        const owner = ownerOf(event);
        if (owner)
            showTip(owner, event.clientX);
        else
            hideTip();
    });
    document.addEventListener('focusin', event => {
        const owner = ownerOf(event);
        if (owner && owner.matches(':focus-visible'))
            showTip(owner, null);
        else
            hideTip();
    });
    document.addEventListener('focusout', hideTip);
    document.addEventListener('keydown', event => {
        if (event.key === 'Escape')
            hideTip();
    });
    document.addEventListener('scroll', positionTip, true);
}

/* ---- roving tabindex: a plot is one tab stop, arrow keys move within it ---- */

function rove(box, items, first = 0) {
    const steps = {
        ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1, Home: -Infinity, End: Infinity,
    };
    const last = items.length - 1;
    items.forEach((item, i) => { item.tabIndex = i === Math.min(first, last) ? 0 : -1; });
    box.onkeydown = event => {
        const at = items.indexOf(document.activeElement), step = steps[event.key];
        if (at < 0 || step === undefined || event.ctrlKey || event.altKey || event.metaKey)
            return;
        const next = items[Math.max(0, Math.min(last, at + step))];
        event.preventDefault();
        items.forEach(item => { item.tabIndex = item === next ? 0 : -1; });
        next.focus();
    };
}
