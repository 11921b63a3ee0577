/*
 * three.mjs: draws an object in a landscape with three.js and times whole frames.
 *
 * The page has set window.SCENE = { object, landscape (texts of .obj files), eye, material, size }.
 * What comes of it is written into the document, as JSON.
 */
import * as THREE from 'three';

const ETA = 1.0003 / 1.3091;
const WARM = 6, RUNS = 30;

/* Triangles of an .obj file as firn writes them: v (with colours, or not), vn, f. */
function read(text) {
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
    const geometry = new THREE.BufferGeometry();
    const add = (name, list) => list.length &&
        geometry.setAttribute(name, new THREE.Float32BufferAttribute(list, 3));
    add('position', position);
    add('normal', normal);
    add('color', color);
    return geometry;
}

const PAPER_VERTEX = `
varying vec3 n_f, e;
varying float share;
void main() {
    vec4 point = modelMatrix * vec4(position, 1.0);
    n_f = mat3(modelMatrix) * normal;
    e = point.xyz - cameraPosition;
    share = pow(1.0 - abs(dot(normalize(e), normalize(n_f))), 3.0);
    gl_Position = projectionMatrix * viewMatrix * point;
}`;
const PAPER_FRAGMENT = `
uniform samplerCube around;
uniform sampler2D back;
uniform float eta;
varying vec3 n_f, e;
varying float share;
void main() {
    vec3 n = normalize(n_f), dir = normalize(e);
    vec3 n_b = texelFetch(back, ivec2(gl_FragCoord.xy), 0).xyz;
    vec3 n_r = normalize(0.67 * n - 0.33 * n_b);
    vec3 refracted = textureCube(around, refract(dir, n_r, eta)).rgb;
    vec3 reflected = textureCube(around, reflect(dir, n)).rgb;
    gl_FragColor = vec4(mix(refracted, reflected, share), 1.0);
    #include <colorspace_fragment>
}`;
const BACK_VERTEX = `
varying vec3 n;
void main() {
    n = mat3(modelMatrix) * normal;
    gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}`;
const BACK_FRAGMENT = 'varying vec3 n; void main() { gl_FragColor = vec4(normalize(n), 1.0); }';

/* What each material needs drawn before the picture: { material, before(), cube } */
const materials = {
    envmap(cube) {
        cube.texture.mapping = THREE.CubeRefractionMapping;
        return { material: new THREE.MeshBasicMaterial({
            envMap: cube.texture, refractionRatio: ETA }), cube: true };
    },
    physical() {
        return { material: new THREE.MeshPhysicalMaterial({
            transmission: 1, ior: 1.31, thickness: 1, roughness: 0, metalness: 0 }) };
    },
    paper(cube, renderer, camera, [width, height]) {
        const back = new THREE.WebGLRenderTarget(width, height, {
            type: THREE.FloatType, minFilter: THREE.NearestFilter, magFilter: THREE.NearestFilter });
        const normals = new THREE.ShaderMaterial({
            side: THREE.BackSide, vertexShader: BACK_VERTEX, fragmentShader: BACK_FRAGMENT });
        const material = new THREE.ShaderMaterial({
            uniforms: { around: { value: cube.texture }, back: { value: back.texture },
                eta: { value: ETA } },
            vertexShader: PAPER_VERTEX, fragmentShader: PAPER_FRAGMENT });
        const before = (mesh) => {
            renderer.setRenderTarget(back);
            renderer.clear();
            mesh.material = normals;
            renderer.render(mesh, camera);
            mesh.material = material;
            renderer.setRenderTarget(null);
        };
        return { material, before, cube: true };
    },
};

function run() {
    const { object, landscape, eye, material: name, size } = window.SCENE;
    const renderer = new THREE.WebGLRenderer({ antialias: false });
    renderer.setSize(...size);
    document.body.appendChild(renderer.domElement);
    const scene = new THREE.Scene();
    scene.background = new THREE.Color().setRGB(0.75, 0.8, 0.88, THREE.LinearSRGBColorSpace);
    const land = new THREE.Mesh(read(landscape),
        new THREE.MeshBasicMaterial({ vertexColors: true, side: THREE.DoubleSide }));
    scene.add(land);
    const camera = new THREE.PerspectiveCamera(45, size[0] / size[1], 0.05, 200);
    camera.position.set(...eye);
    camera.lookAt(0, 0, 0);
    camera.updateMatrixWorld();
    const target = new THREE.WebGLCubeRenderTarget(512, { type: THREE.HalfFloatType });
    const cube = new THREE.CubeCamera(0.05, 200, target);
    const { material, before, cube: reads } = materials[name](target, renderer, camera, size);
    const mesh = new THREE.Mesh(read(object), material);
    scene.add(mesh);
    const gl = renderer.getContext(), pixel = new Uint8Array(4);
    const times = [];
    for (let i = 0; i < WARM + RUNS; i++) {
        const start = performance.now();
        if (reads) {
            mesh.visible = false;
            cube.update(renderer, scene);
            mesh.visible = true;
        }
        if (before)
            before(mesh);
        renderer.render(scene, camera);
        gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel); // waits
        if (i >= WARM)
            times.push(performance.now() - start);
    }
    const info = gl.getExtension('WEBGL_debug_renderer_info');
    return { times, renderer: info ? gl.getParameter(info.UNMASKED_RENDERER_WEBGL) : '',
        version: THREE.REVISION };
}

let result;
try {
    result = run();
} catch (error) {
    result = { error: String(error) };
}
document.body.textContent = JSON.stringify(result);
