/* page.js: fills the header of the page and starts all sections. */

function addFact(word, text) {
    const fact = add($('facts'), 'div');
    add(fact, 'dt', {}, word);
    add(fact, 'dd', {}, text);
}

function startFacts() {
    const p = profile, { median, sigma } = p.frame.summary, summary = $('summary');
    document.title = `firn profile: ${p.scene}`;
    $('title').textContent = document.title;
    add(summary, 'b', {}, ms(median));
    summary.append(` a frame (median of ${plural(p.run_count, 'run')}, \u03c3 ${ms(sigma)}); ` +
        `${ms(p.plain.summary.median)} without measurement`);
    addFact('image', `${p.width}\u00d7${p.height}, ${p.rung}, ${p.material}`);
    addFact('device', p.device);
    addFact('driver', p.driver);
    addFact('host', p.host);
    addFact('clock', `${p.clock}: ${p.clock_reason}`);
    if (p.clock === 'submits')
        addFact('submit', `${ms(p.submit_cost)} when empty, included in every pass`);
    addFact('runs', `${p.run_count}, after ${plural(p.warmup, 'warm-up run')}`);
    addFact('scene time', `${p.time} s, step ${p.time_step} s per run`);
    addFact('setup', `upload ${ms(p.upload)}, graph ${ms(p.compile)}, objects ${ms(p.realise)}, ` +
        `first frame ${ms(p.first_frame)}`);
    if (p.tree_triangles)
        addFact('BVH', `${p.tree_triangles} triangles, ${ms(p.tree)}, ` +
            `${(p.tree_size / 2 ** 20).toFixed(1)} MiB`);
    if (p.rays_size)
        addFact('acceleration structures', `${ms(p.rays)}, ` +
            `${(p.rays_size / 2 ** 20).toFixed(1)} MiB`);
    $('command').textContent = p.command;
}

function startSettings() {
    const box = $('settings'), body = box.querySelector('tbody');
    box.querySelector('summary').textContent = `Settings (${profile.settings.length})`;
    for (const { name, value } of profile.settings) {
        const line = add(body, 'tr');
        add(line, 'th', { scope: 'row' }, name);
        add(line, 'td', {}, value);
    }
}

async function copyCommand() {
    let words = 'Copied';
    try {
        await navigator.clipboard.writeText(profile.command);
    } catch { /* the browser denies access to the clipboard */
        getSelection().selectAllChildren($('command'));
        words = 'Selected: copy it with Ctrl+C';
    }
    $('copied').textContent = words;
}

/* Follows the system's colour scheme until the user clicks the button. */
function startDark() {
    const system = matchMedia('(prefers-color-scheme: dark)'), button = $('dark');
    let chosen = null;
    const show = () => {
        const dark = chosen ?? system.matches;
        document.documentElement.style.colorScheme = dark ? 'dark' : 'light';
        button.setAttribute('aria-pressed', dark);
    };
    button.addEventListener('click', () => {
        chosen = !(chosen ?? system.matches);
        show();
    });
    system.addEventListener('change', show);
    show();
}

/* Draws everything whose size depends on the window width. */
function drawAll() {
    drawFrames();
    drawTimeline(focusedBlock());
    drawMemory();
    drawFigures();
    drawSweep();
}

function startPrinting() {
    let wasOpen, zoom;
    addEventListener('beforeprint', () => {
        wasOpen = $('settings').open;
        zoom = view.zoom;
        $('settings').open = view.printing = true;
        view.zoom = 1;
        drawAll();
    });
    addEventListener('afterprint', () => {
        $('settings').open = wasOpen;
        view.printing = false;
        view.zoom = zoom;
        drawAll();
    });
}

function startResizing() {
    let width = innerWidth;
    addEventListener('resize', () => {
        if (innerWidth !== width)
            drawAll();
        width = innerWidth;
    });
}

startDark();
startFacts();
startSettings();
$('copy').addEventListener('click', copyCommand);
startRows();
startFrames();
startTimeline();
startMemory();
startSweep();
startFigures();
drawRows();
drawAll();
listenForTips();
startPrinting();
startResizing();
