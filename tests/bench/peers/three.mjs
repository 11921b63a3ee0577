/* three.mjs: an object in a landscape by three.js. */
import * as THREE from 'three';
import { BACKGROUND, FAR, FOV, IOR, NEAR, read, run, scene as given } from './page.mjs';

const ETA = 1.0003 / 1.3091;

function makeGeometry(text) {
    const geometry = new THREE.BufferGeometry();
    for (const [name, list] of Object.entries(read(text)))
        if (list.length)
            geometry.setAttribute(name, new THREE.Float32BufferAttribute(list, 3));
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
            transmission: 1, ior: IOR, thickness: 1, roughness: 0, metalness: 0 }) };
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

function open() {
    const { object, landscape, eye, material: name, size } = given;
    const renderer = new THREE.WebGLRenderer({ antialias: false });
    renderer.setSize(...size);
    document.body.appendChild(renderer.domElement);
    const scene = new THREE.Scene();
    scene.background = new THREE.Color().setRGB(...BACKGROUND, THREE.LinearSRGBColorSpace);
    const land = new THREE.Mesh(makeGeometry(landscape),
        new THREE.MeshBasicMaterial({ vertexColors: true, side: THREE.DoubleSide }));
    scene.add(land);
    const camera = new THREE.PerspectiveCamera(FOV, size[0] / size[1], NEAR, FAR);
    camera.position.set(...eye);
    camera.lookAt(0, 0, 0);
    camera.updateMatrixWorld();
    const target = new THREE.WebGLCubeRenderTarget(512, { type: THREE.HalfFloatType });
    const cube = new THREE.CubeCamera(NEAR, FAR, target);
    const { material, before, cube: reads } = materials[name](target, renderer, camera, size);
    const mesh = new THREE.Mesh(makeGeometry(object), material);
    scene.add(mesh);
    const draw = () => {
        if (reads) {
            mesh.visible = false;
            cube.update(renderer, scene);
            mesh.visible = true;
        }
        if (before)
            before(mesh);
        renderer.render(scene, camera);
    };
    return { gl: renderer.getContext(), draw, version: `three.js r${THREE.REVISION}` };
}

run(open);
