/*
 * babylon.mjs: an object in a landscape by Babylon.js.
 *
 * `refraction` is the engine's planar RefractionTexture, with a reflection from a cube that is
 * drawn anew in every frame; `transmission` is its physical material with a picture of what is
 * behind, as its loader of glTF sets it up for KHR_materials_transmission, with such a cube too.
 */
import { FreeCamera } from '@babylonjs/core/Cameras/freeCamera.js';
import { Constants } from '@babylonjs/core/Engines/constants.js';
import { Engine } from '@babylonjs/core/Engines/engine.js';
import { FresnelParameters } from '@babylonjs/core/Materials/fresnelParameters.js';
import { PBRMaterial } from '@babylonjs/core/Materials/PBR/pbrMaterial.js';
import { StandardMaterial } from '@babylonjs/core/Materials/standardMaterial.js';
import { RefractionTexture } from '@babylonjs/core/Materials/Textures/refractionTexture.js';
import { RenderTargetTexture } from '@babylonjs/core/Materials/Textures/renderTargetTexture.js';
import { Color3, Color4 } from '@babylonjs/core/Maths/math.color.js';
import { Plane } from '@babylonjs/core/Maths/math.plane.js';
import { Vector3 } from '@babylonjs/core/Maths/math.vector.js';
import { Mesh } from '@babylonjs/core/Meshes/mesh.js';
import { VertexData } from '@babylonjs/core/Meshes/mesh.vertexData.js';
import { ReflectionProbe } from '@babylonjs/core/Probes/reflectionProbe.js';
import { Scene } from '@babylonjs/core/scene.js';
import { BACKGROUND, FAR, FOV, IOR, NEAR, makeCanvas, read, run, scene as given } from './page.mjs';

/* The engine is left-handed: all of the scene is mirrored in z, which a picture does not show. */
const mirrored = (list) => list.map((x, i) => i % 3 === 2 ? -x : x);

function makeMesh(name, text, scene) {
    const { position, normal, color } = read(text);
    const mesh = new Mesh(name, scene), data = new VertexData();
    data.positions = mirrored(position);
    data.indices = position.slice(0, position.length / 3).map((_, i) => i);
    if (normal.length)
        data.normals = mirrored(normal);
    if (color.length)
        data.colors = color.flatMap((x, i) => i % 3 === 2 ? [x, 1] : [x]);
    data.applyToMesh(mesh);
    mesh.alwaysSelectAsActiveMesh = true;
    return mesh;
}

function fresnel(from, to) {
    const parameters = new FresnelParameters();
    parameters.leftColor = from;
    parameters.rightColor = to;
    parameters.bias = 0.02;
    parameters.power = 3;
    return parameters;
}

const materials = {
    refraction(scene, land, cube) {
        const behind = new RefractionTexture('behind', 1024, scene, false);
        behind.renderList.push(land);
        behind.refractionPlane = new Plane(0, 0, -1, 1);
        behind.depth = 1;
        const material = new StandardMaterial('ice', scene);
        material.disableLighting = true;
        material.diffuseColor = material.specularColor = Color3.Black();
        material.refractionTexture = behind;
        material.indexOfRefraction = 1 / IOR;
        material.reflectionTexture = cube;
        material.reflectionFresnelParameters = fresnel(Color3.White(), Color3.Black());
        material.refractionFresnelParameters = fresnel(Color3.Black(), Color3.White());
        return material;
    },
    transmission(scene, land, cube) {
        const behind = new RenderTargetTexture('behind', 1024, scene, true, undefined,
            Constants.TEXTURETYPE_HALF_FLOAT);
        behind.renderList = [land];
        behind.clearColor = scene.clearColor;
        behind.ignoreCameraViewport = true;
        behind.gammaSpace = false;
        behind.lodGenerationScale = 1;
        behind.lodGenerationOffset = -4;
        behind.samples = 4;
        const processing = scene.imageProcessingConfiguration;
        behind.onBeforeRenderObservable.add(() => { processing.applyByPostProcess = true; });
        behind.onAfterRenderObservable.add(() => { processing.applyByPostProcess = false; });
        scene.customRenderTargets.push(behind);
        const material = new PBRMaterial('ice', scene);
        material.metallic = material.roughness = 0;
        material.albedoColor = Color3.White();
        material.indexOfRefraction = IOR;
        material.reflectionTexture = cube;
        const inside = material.subSurface;
        inside.isRefractionEnabled = true;
        inside.refractionIntensity = 1;
        inside.refractionTexture = behind;
        inside.indexOfRefraction = inside.volumeIndexOfRefraction = IOR;
        inside.minimumThickness = 0;
        inside.maximumThickness = 1;
        inside.useThicknessAsDepth = true;
        return material;
    },
};

async function open() {
    const canvas = makeCanvas();
    const engine = new Engine(canvas, false, { alpha: false, stencil: false }, false);
    engine.setSize(...given.size);
    const scene = new Scene(engine);
    scene.clearColor = new Color4(...BACKGROUND, 1);
    const camera = new FreeCamera('camera', new Vector3(...mirrored(given.eye)), scene);
    camera.fov = FOV * Math.PI / 180;
    camera.minZ = NEAR;
    camera.maxZ = FAR;
    camera.setTarget(Vector3.Zero());
    const land = makeMesh('landscape', given.landscape, scene);
    land.material = new PBRMaterial('landscape', scene);
    land.material.unlit = true;
    land.material.backFaceCulling = false;
    /* the older material counts in what the screen shows */
    const linear = given.material !== 'refraction';
    const probe = new ReflectionProbe('probe', 512, scene, true, linear, linear);
    probe.renderList.push(land);
    probe.refreshRate = RenderTargetTexture.REFRESHRATE_RENDER_ONEVERYFRAME;
    probe.cubeTexture.clearColor = scene.clearColor;
    const mesh = makeMesh('object', given.object, scene);
    mesh.material = materials[given.material](scene, land, probe.cubeTexture);
    mesh.material.sideOrientation = 1; /* mirrored, triangles turn the other way */
    await scene.whenReadyAsync(true);
    const draw = () => {
        engine.beginFrame();
        scene.render();
        engine.endFrame();
    };
    return { gl: canvas.getContext('webgl2'), draw, version: `Babylon.js ${Engine.Version}` };
}

run(open);
