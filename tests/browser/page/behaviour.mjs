// A graph of KHR_interactivity run by Babylon.js: the page clicks, waits and walks, and notes after each step what is seen.
import {FreeCamera} from '@babylonjs/core/Cameras/freeCamera.js';
import {Engine} from '@babylonjs/core/Engines/engine.js';
import {AppendSceneAsync} from '@babylonjs/core/Loading/sceneLoader.js';
import {Color4} from '@babylonjs/core/Maths/math.color.js';
import {SceneLoaderFlags} from '@babylonjs/core/Loading/sceneLoaderFlags.js';
import {Matrix, Vector3} from '@babylonjs/core/Maths/math.vector.js';
import {Logger} from '@babylonjs/core/Misc/logger.js';
import {Scene} from '@babylonjs/core/scene.js';
import '@babylonjs/core/Culling/ray.js';
import '@babylonjs/core/Materials/standardMaterial.js';
import '@babylonjs/loaders/glTF/2.0/index.js';
import {GetKHRInteractivityImportResults} from '@babylonjs/loaders/glTF/2.0/Extensions/KHR_interactivity.js';
import {picture_of} from './pictures.mjs';

const step_seconds = 0.016;  // of every frame, however long it takes here
const others = () => new Promise(done => { setTimeout(done); });

SceneLoaderFlags.ShowLoadingScreen = false;
let engine;

/// A file in a scene of its own, and what Babylon.js warned of.
async function load({glb, width, height}) {
  if (!engine) {
    const canvas = document.createElement('canvas');
    Object.assign(canvas, {width, height});
    Object.assign(canvas.style, {position: 'absolute', left: 0, top: 0});
    document.body.append(canvas);
    engine = new Engine(canvas, false, {preserveDrawingBuffer: true});
  }
  const scene = new Scene(engine), faults = [], before = [Logger.Warn, Logger.Error];
  Logger.Warn = Logger.Error = message => faults.push(String(message));
  scene.useRightHandedSystem = true;
  try {
    await AppendSceneAsync(glb, scene);
    await scene.whenReadyAsync();
  } finally {
    [Logger.Warn, Logger.Error] = before;
  }
  return {scene, faults};
}

function look(scene, {eye, target}) {
  const camera = scene.activeCamera?.name === 'view' ? scene.activeCamera : new FreeCamera('view', Vector3.Zero(), scene);
  camera.position.copyFromFloats(...eye);
  camera.setTarget(Vector3.FromArray(target));
  [camera.fov, camera.minZ, camera.maxZ] = [0.785398, 0.01, 1000];
  scene.activeCamera = camera;
}

/// Where a point of the world is in the picture, in pixels.
function pixel_of(scene, point) {
  const [width, height] = [engine.getRenderWidth(), engine.getRenderHeight()];
  const at = Vector3.Project(Vector3.FromArray(point), Matrix.Identity(), scene.getTransformMatrix(), scene.activeCamera.viewport.toGlobal(width, height));
  return [Math.round(at.x), Math.round(at.y)];
}

function press(scene, canvas, types, point) {
  const box = canvas.getBoundingClientRect(), [x, y] = pixel_of(scene, point);
  for (const type of types)
    canvas.dispatchEvent(new PointerEvent(type, {clientX: box.left + x, clientY: box.top + y, pointerId: 1, pointerType: 'mouse', button: type === 'pointermove' ? -1 : 0, buttons: type === 'pointerdown' ? 1 : 0, bubbles: true}));
}

/// Colours of the picture at points of the world.
function seen(scene, canvas, points) {
  const pen = picture_of(canvas).getContext('2d');
  return points.map(point => [...pen.getImageData(...pixel_of(scene, point), 1, 1).data].slice(0, 3));
}

/// job: {glb, width, height, camera of {eye, target}, steps, points, nodes, events}. A step is {click}, {over} at a point of the world,
/// {camera} or {wait} of seconds. Gives for each, and for the beginning, colours at `points`, places of `nodes`, and the events sent so far.
export async function behave(job) {
  const {scene, faults} = await load(job);
  const canvas = engine.getRenderingCanvas();
  scene.attachControl(true, true, true);
  scene.clearColor = new Color4(0, 0, 0, 1);
  look(scene, job.camera);
  const sent = [], diagnostics = [];
  for (const {graphs} of GetKHRInteractivityImportResults(scene))
    for (const graph of graphs) {
      diagnostics.push(...graph.diagnostics.map(d => `${d.path}: ${d.message}`));
      for (const id of job.events ?? []) graph.coordinator?.getCustomEventObservable(id).add(() => sent.push(id));
    }
  const real = engine.getDeltaTime;
  scene.useConstantAnimationDeltaTime = true;
  engine.getDeltaTime = () => 1000 * step_seconds;
  const run = async seconds => {
    for (let i = 0; i < Math.ceil(seconds / step_seconds); ++i) {
      scene.render();
      await others();
    }
  };
  const state = () => ({colors: seen(scene, canvas, job.points ?? []), sent: [...sent], picture: picture_of(canvas).toDataURL(),
    places: (job.nodes ?? []).map(name => scene.getNodeByName(name)?.getAbsolutePosition().asArray() ?? null)});
  await run(0.1);
  const states = [state()];
  for (const step of job.steps) {
    if (step.camera) look(scene, step.camera);
    if (step.click) press(scene, canvas, ['pointermove', 'pointerdown', 'pointerup'], step.click);
    if (step.over) press(scene, canvas, ['pointermove'], step.over);
    await run(step.wait ?? 0.1);
    states.push(state());
  }
  engine.getDeltaTime = real;
  scene.dispose();
  return {states, faults, diagnostics};
}
