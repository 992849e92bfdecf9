// A tileset on the Earth drawn by CesiumJS, without the Earth, and which parts are under some of its pixels.
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
