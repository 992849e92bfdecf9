// A glTF file drawn by Babylon.js. Bundled by ../babylon.mjs; decoders come from the npm package, never from Babylon's own servers.
import {AppendSceneAsync, Color4, DirectionalLight, DracoDecoder, Engine, FreeCamera, Logger, MeshoptCompression, Scene, SceneLoader, Vector3} from '@babylonjs/core/index.js';
import '@babylonjs/loaders/glTF/2.0/index.js';
import {compared, from_elsewhere} from './models.mjs';

const assets = `${location.origin}/node_modules/@babylonjs/core/assets`;
MeshoptCompression.Configuration = {decoder: {url: `${assets}/meshopt/meshopt_decoder.js`}};
DracoDecoder.DefaultConfiguration = {wasmUrl: `${assets}/Draco/draco_wasm_wrapper_gltf.js`, wasmBinaryUrl: `${assets}/Draco/draco_decoder_gltf.wasm`,
  fallbackUrl: `${assets}/Draco/draco_decoder_gltf.js`};

let engine;

function start({width, height}) {
  const canvas = engine?.getRenderingCanvas() ?? document.createElement('canvas');
  [canvas.width, canvas.height] = [width, height];
  engine ??= new Engine(canvas, false, {preserveDrawingBuffer: true});
  engine.resize();
  return engine;
}

/// A file in a scene of its own: {scene, faults, levels}. `faults`: warnings and errors that Babylon.js logged, and addresses outside that it asked for.
/// `levels`: how many levels of MSFT_lod it went through. job: {glb, width, height}; the caller disposes the scene.
export async function load(job) {
  const scene = new Scene(start(job)), faults = [], before = [Logger.Warn, Logger.Error];
  Logger.Warn = Logger.Error = message => faults.push(String(message));
  scene.useRightHandedSystem = true;
  let levels = 0, loader;
  SceneLoader.OnPluginActivatedObservable.addOnce(plugin => {
    loader = plugin;
    loader.onExtensionLoadedObservable.add(extension => extension.onNodeLODsLoadedObservable?.add(() => { ++levels; }));
  });
  try {
    await AppendSceneAsync(job.glb, scene);
    await loader.whenCompleteAsync();  // before, only the coarsest levels are there
    await scene.whenReadyAsync();
  } finally {
    [Logger.Warn, Logger.Error] = before;
  }
  return {scene, faults: [...faults, ...from_elsewhere()], levels};
}

/// VRML's field of view, and the light that viewers give to a file without any: along the view.
function look(scene, {eye, target, up}) {
  const [from, to] = [eye, target].map(v => Vector3.FromArray(v)), distance = Vector3.Distance(from, to);
  const camera = new FreeCamera('view', from, scene);
  camera.upVector = Vector3.FromArray(up);
  camera.setTarget(to);
  [camera.fov, camera.minZ, camera.maxZ] = [0.785398, distance / 100, distance * 100];
  scene.activeCamera = camera;
  if (scene.lights.length === 0) new DirectionalLight('headlight', to.subtract(from).normalize(), scene).intensity = Math.PI;
}

/// What a program finds in the scene: names of parts, draws, triangles, copies drawn of one mesh.
function census(scene) {
  const meshes = scene.meshes.filter(mesh => mesh.getTotalVertices() > 0 && mesh.isEnabled());
  const copies = mesh => mesh.thinInstanceCount || 1;
  return {names: [...new Set(scene.getNodes().map(node => node.name))], draws: meshes.length, copies: meshes.reduce((sum, mesh) => sum + copies(mesh), 0),
    triangles: meshes.reduce((sum, mesh) => sum + copies(mesh) * mesh.getTotalIndices() / 3, 0)};
}

/// job: that of load(), with {camera: {eye, target, up}, background, key, reference}: a picture compared with those of `reference`, and a census.
export async function draw_with_babylon(job) {
  const {scene, faults, levels} = await load(job);
  look(scene, job.camera);
  scene.clearColor = new Color4(...job.background, 1);
  scene.render();
  const result = await compared('Babylon.js', engine.getRenderingCanvas(), job, {...census(scene), faults, levels});
  scene.dispose();
  return result;
}
