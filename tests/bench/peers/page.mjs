/*
 * page.mjs: what the pages of all peers share.
 *
 * window.SCENE = { object, landscape (texts of .obj files), eye, size, material, modules, picture }.
 * What comes of a page is posted: /first once its first image is finished, /result at the end.
 */
const WARM = 6, RUNS = 30;

export const scene = window.SCENE;
export const BACKGROUND = [0.75, 0.8, 0.88]; // linear
export const FOV = 45, NEAR = 0.05, FAR = 200, IOR = 1.31;

/* Triangles of an .obj file as firn writes them: v (with colours, or not), vn, f. */
export function read(text) {
    const points = [], normals = [], position = [], normal = [], color = [];
    for (const line of text.split('\n')) {
        const [kind, ...words] = line.trim().split(/\s+/);
        if (kind === 'v')
            points.push(words.map(Number));
        else if (kind === 'vn')
            normals.push(words.map(Number));
        else if (kind === 'f')
            for (const corner of words) {
                const [v, , n] = corner.split('/');
                const point = points[v - 1];
                position.push(...point.slice(0, 3));
                if (point.length > 3)
                    color.push(...point.slice(3, 6));
                if (n)
                    normal.push(...normals[n - 1]);
            }
    }
    return { position, normal, color };
}

/* Flat ones, where a file has none. */
export function flatNormals(position) {
    const normal = [];
    for (let i = 0; i < position.length; i += 9) {
        const [a, b, c] = [0, 3, 6].map((k) => position.slice(i + k, i + k + 3));
        const u = b.map((x, k) => x - a[k]), v = c.map((x, k) => x - a[k]);
        const n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
        const length = Math.hypot(...n) || 1;
        for (let k = 0; k < 3; k++)
            normal.push(...n.map((x) => x / length));
    }
    return normal;
}

export function makeCanvas() {
    const canvas = document.createElement('canvas');
    [canvas.width, canvas.height] = scene.size;
    document.body.appendChild(canvas);
    return canvas;
}

const post = (path, body) => fetch(path, { method: 'POST', body: JSON.stringify(body) });

/* A frame ends when a pixel of it has been read back. draw() may leave nothing to be drawn later. */
async function time({ gl, draw, version }) {
    const pixel = new Uint8Array(4);
    const times = [];
    let picture = null;
    for (let i = 0; i < WARM + RUNS; i++) {
        const start = performance.now();
        draw();
        gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel); // waits
        if (i >= WARM)
            times.push(performance.now() - start);
        if (i === WARM && scene.picture)
            picture = gl.canvas.toDataURL('image/png');
        if (i === 0)
            await post('/first', {});
    }
    const info = gl.getExtension('WEBGL_debug_renderer_info');
    return { times, picture, version,
        renderer: info ? gl.getParameter(info.UNMASKED_RENDERER_WEBGL) : '' };
}

/* `open` gives { gl, draw, version }, perhaps later. */
export async function run(open) {
    let result;
    try {
        result = await time(await open());
    } catch (error) {
        result = { error: String(error) };
    }
    await post('/result', result);
}
