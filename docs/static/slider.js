/* slider.js: turns a table of two images of equal size into one image with a draggable divider. */
document.addEventListener('DOMContentLoaded', () => {
    for (const table of document.querySelectorAll('table')) {
        const images = [...table.querySelectorAll('tbody img')];
        const cells = table.querySelectorAll('tbody td');
        const titles = [...table.querySelectorAll('thead th')].map(cell => cell.textContent);
        if (images.length !== 2 || cells.length !== 2)
            continue;
        const box = document.createElement('div');
        box.className = 'slider';
        box.innerHTML = `<div class="right"></div><div class="left"></div>
            <input type="range" min="0" max="100" value="50" aria-label="divider">
            <span>${titles[0]}</span><span>${titles[1]}</span>`;
        box.children[1].append(images[0]);
        box.children[0].append(images[1]);
        box.children[2].oninput = event => box.style.setProperty('--at', `${event.target.value}%`);
        (table.closest('.table-wrapper') || table).replaceWith(box);
    }
});
