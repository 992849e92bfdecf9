// A tileset on the Earth drawn by CesiumJS, without the Earth, and which parts are under some of its pixels.
import {compared, from_elsewhere} from './models.mjs';
import {picture_of} from './pictures.mjs';

const base = '/node_modules/cesium/Build/Cesium/';
window.CESIUM_BASE_URL = base;
const Cesium = await import(`${base}index.js`);

/// A place or a direction of the world, y up, in coordinates of the tileset.
const point = (matrix, [x, y, z]) => Cesium.Matrix4.multiplyByPoint(matrix, new Cesium.Cartesian3(x, -z, y), new Cesium.Cartesian3());
const direction = (matrix, [x, y, z]) => Cesium.Cartesian3.normalize(Cesium.Matrix4.multiplyByPointAsVector(matrix, new Cesium.Cartesian3(x, -z, y), new Cesium.Cartesian3()), new Cesium.Cartesian3());

function make_scene({width, height}) {
  const canvas = document.createElement('canvas');
  Object.assign(canvas.style, {width: `${width}px`, height: `${height}px`, display: 'block'});
  document.body.append(canvas);
  [canvas.width, canvas.height] = [width, height];
  const scene = new Cesium.Scene({canvas, contextOptions: {webgl: {preserveDrawingBuffer: true, antialias: false}}, msaaSamples: 1});
  scene.globe = undefined;
  for (const part of ['skyBox', 'skyAtmosphere', 'sun', 'moon']) scene[part] = undefined;
  scene.fog.enabled = false;
  return scene;
}

function look(scene, matrix, {eye, target, up}, aspect) {
  const ahead = target.map((v, i) => v - eye[i]);
  scene.camera.frustum.fov = 2 * Math.atan(Math.tan(Math.PI / 8) * Math.max(1, aspect));
  scene.camera.setView({destination: point(matrix, eye), orientation: {direction: direction(matrix, ahead), up: direction(matrix, up)}});
  scene.light = new Cesium.DirectionalLight({direction: direction(matrix, ahead), intensity: 3});
}

async function settle(scene, tileset) {
  const begin = performance.now();
  for (let quiet = 0; quiet < 5;) {
    if (performance.now() - begin > 90000) throw new Error('tiles are still being loaded');
    scene.initializeFrame();
    scene.render();
    await new Promise(done => setTimeout(done, 20));
    quiet = tileset.tilesLoaded ? quiet + 1 : 0;
  }
}

/// job: {cesium: address of tileset.json, origin: the matrix of its world, camera, width, height, pixels, points}. For each error in
/// pixels: the names under the points, and how many tiles failed.
export async function draw_with_cesium(job) {
  const scene = make_scene(job), matrix = Cesium.Matrix4.unpack(job.origin), levels = [];
  look(scene, matrix, job.camera, job.width / job.height);
  for (const pixels of job.pixels) {
    const tileset = scene.primitives.add(await Cesium.Cesium3DTileset.fromUrl(job.cesium, {maximumScreenSpaceError: pixels, dynamicScreenSpaceError: false}));
    let failed = 0;
    tileset.tileFailed.addEventListener(() => { ++failed; });
    await settle(scene, tileset);
    const picture = picture_of(scene.canvas).toDataURL();
    const names = job.points.map(([x, y]) => scene.pick(new Cesium.Cartesian2(x * job.width, y * job.height))?.getProperty?.('name') ?? '');
    levels.push({pixels, failed, names, picture});
    scene.primitives.remove(tileset);
  }
  return {levels};
}

/// One file, lit along the view: see draw_with_babylon() of babylon.mjs for the job and what comes back.
export async function draw_model(job) {
  const scene = make_scene(job), faults = [], warn = console.warn;
  const matrix = Cesium.Transforms.eastNorthUpToFixedFrame(Cesium.Cartesian3.fromDegrees(8.6, 50.1, 112));
  console.warn = message => faults.push(String(message));
  try {
    const imageBasedLighting = new Cesium.ImageBasedLighting({imageBasedLightingFactor: Cesium.Cartesian2.ZERO});
    const model = scene.primitives.add(await Cesium.Model.fromGltfAsync({url: job.glb, modelMatrix: matrix, forwardAxis: Cesium.Axis.X, imageBasedLighting, incrementallyLoadTextures: false}));
    model.errorEvent.addEventListener(error => faults.push(String(error)));
    look(scene, matrix, job.camera, job.width / job.height);
    scene.backgroundColor = new Cesium.Color(...job.background, 1);
    await until_drawn(scene, model);
    return compared('CesiumJS', scene.canvas, job, {faults: [...faults, ...from_elsewhere()], ...found_in(scene, job)});
  } finally {
    console.warn = warn;
    scene.destroy();
  }
}

async function until_drawn(scene, model) {
  for (let more = 3, begin = performance.now(); more > 0; model.ready && --more) {
    if (performance.now() - begin > 60000) throw new Error('the model is still being loaded');
    scene.initializeFrame();
    scene.render();
    await new Promise(done => setTimeout(done, 20));
  }
}

/// Names of the parts under a grid of points.
function found_in(scene, {width, height}) {
  const names = new Set();
  for (let y = 4; y < height; y += 8) for (let x = 4; x < width; x += 8) {
    const picked = scene.pick(new Cesium.Cartesian2(x, y)), name = picked?.getProperty?.('name') ?? picked?.detail?.node?.name;
    if (name) names.add(name);
  }
  return {names: [...names]};
}
