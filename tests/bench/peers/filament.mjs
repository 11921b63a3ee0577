/*
 * filament.mjs: an object in a landscape by Filament, whose filament.js the page has loaded.
 *
 * Both come as glTF, made here, and get the materials that are inside filament.wasm: the landscape
 * KHR_materials_unlit, the object transmission, volume and ior, for which Filament looks up, in its
 * picture of what is behind, where the refracted ray ends on the screen. What is reflected stands
 * still: it has no cube that could be drawn anew.
 */
import { BACKGROUND, FAR, FOV, IOR, NEAR, flatNormals, makeCanvas, read, run, scene as given }
    from './page.mjs';

let Filament = window.Filament;

const ICE = {
    pbrMetallicRoughness: { metallicFactor: 0, roughnessFactor: 0 },
    extensions: {
        KHR_materials_transmission: { transmissionFactor: 1 },
        KHR_materials_volume: { thicknessFactor: 1 },
        KHR_materials_ior: { ior: IOR },
    },
};
const LAND = { doubleSided: true, extensions: { KHR_materials_unlit: {} } };

/* A .glb file of one mesh: a header, the description padded with blanks, the numbers. */
function makeGlb(text, material) {
    const { position, normal, color } = read(text);
    const lists = { POSITION: position, NORMAL: normal.length ? normal : flatNormals(position) };
    if (color.length)
        lists.COLOR_0 = color;
    const size = 4 * position.length, count = position.length / 3;
    const bounds = (f) => [0, 1, 2].map((k) => position.reduce(
        (all, x, i) => i % 3 === k ? f(all, x) : all, position[k]));
    const names = Object.keys(lists);
    const description = JSON.stringify({
        asset: { version: '2.0' },
        extensionsUsed: Object.keys(material.extensions),
        scene: 0,
        scenes: [{ nodes: [0] }],
        nodes: [{ mesh: 0 }],
        meshes: [{ primitives: [{ material: 0,
            attributes: Object.fromEntries(names.map((name, i) => [name, i])) }] }],
        materials: [material],
        buffers: [{ byteLength: names.length * size }],
        bufferViews: names.map((_, i) => ({ buffer: 0, byteOffset: i * size, byteLength: size })),
        accessors: names.map((_, i) => ({ bufferView: i, componentType: 5126, count, type: 'VEC3',
            ...(i === 0 && { min: bounds(Math.min), max: bounds(Math.max) }) })),
    });
    const words = new TextEncoder().encode(description.padEnd(Math.ceil(description.length / 4) * 4));
    const bytes = new Uint8Array(28 + words.length + names.length * size);
    const view = new DataView(bytes.buffer);
    [0x46546c67, 2, bytes.length, words.length, 0x4e4f534a].forEach(
        (x, i) => view.setUint32(4 * i, x, true));
    bytes.set(words, 20);
    const at = 20 + words.length;
    view.setUint32(at, names.length * size, true);
    view.setUint32(at + 4, 0x004e4942, true);
    bytes.set(new Uint8Array(new Float32Array(names.flatMap((name) => lists[name])).buffer), at + 8);
    return bytes;
}

/* Sky above, earth below: what is reflected. */
function makeLight(engine) {
    const SIDE = 64;
    const dirs = [(u, v) => [1, -v, -u], (u, v) => [-1, -v, u], (u, v) => [u, 1, v],
        (u, v) => [u, -1, -v], (u, v) => [u, -v, 1], (u, v) => [-u, -v, -1]];
    const texels = new Uint8Array(6 * SIDE * SIDE * 4);
    for (let i = 0; i < 6 * SIDE * SIDE; i++) {
        const dir = dirs[Math.floor(i / SIDE / SIDE)](
            (i % SIDE + 0.5) / SIDE * 2 - 1, (Math.floor(i / SIDE) % SIDE + 0.5) / SIDE * 2 - 1);
        const up = dir[1] / Math.hypot(...dir);
        const color = up > 0 ? BACKGROUND.map((x, k) => x - [0.6, 0.5, 0.15][k] * up) : [0.1, 0.3, 0.1];
        texels.set([...color.map((x) => 255 * x), 255], 4 * i);
    }
    const texture = Filament.Texture.Builder().width(SIDE).height(SIDE).levels(7)
        .sampler(Filament.Texture$Sampler.SAMPLER_CUBEMAP)
        .format(Filament.Texture$InternalFormat.RGBA8).build(engine);
    texture.setImageCube(engine, 0, Filament.PixelBuffer(texels, Filament.PixelDataFormat.RGBA,
        Filament.PixelDataType.UBYTE));
    texture.generateMipmaps(engine);
    const even = new Array(27).fill(0);
    even.splice(0, 3, 0.45, 0.52, 0.5);
    return Filament.IndirectLight.Builder().reflections(texture).irradianceSh(3, even)
        .intensity(38400).build(engine);
}

function makeView(engine, scene) {
    const [width, height] = given.size;
    const camera = engine.createCamera(Filament.EntityManager.get().create());
    camera.setProjectionFov(FOV, width / height, NEAR, FAR, Filament.Camera$Fov.VERTICAL);
    camera.lookAt(given.eye, [0, 0, 0], [0, 1, 0]);
    camera.setExposure(16, 1 / 125, 100);
    const view = engine.createView();
    view.setCamera(camera);
    view.setScene(scene);
    view.setViewport([0, 0, width, height]);
    view.setAntiAliasing(Filament.View$AntiAliasing.NONE);
    view.setColorGrading(Filament.ColorGrading.Builder()
        .toneMapping(Filament.ColorGrading$ToneMapping.LINEAR).build(engine));
    return view;
}

async function open() {
    const canvas = makeCanvas();
    await new Promise((done) => Filament.init([], done));
    Filament = window.Filament; // it is another one now
    const engine = Filament.Engine.create(canvas);
    const scene = engine.createScene(), chain = engine.createSwapChain();
    const renderer = engine.createRenderer();
    renderer.setClearOptions({ clearColor: [...BACKGROUND, 1], clear: true });
    const view = makeView(engine, scene);
    const loader = engine.createAssetLoader();
    for (const glb of [makeGlb(given.landscape, LAND), makeGlb(given.object, ICE)]) {
        const asset = loader.createAsset(glb);
        await new Promise((done) => asset.loadResources(done, null, '', 1));
        scene.addEntities(asset.getEntities());
    }
    scene.setIndirectLight(makeLight(engine));
    const draw = () => {
        /* false: the engine would rather leave this frame out */
        for (let tries = 0; !renderer.beginFrame(chain) && tries < 50; tries++)
            engine.execute();
        renderer.renderView(view);
        renderer.endFrame();
        engine.execute();
    };
    return { gl: canvas.getContext('webgl2'), draw, version: 'Filament' };
}

run(open);
