// A glTF file drawn by three.js, as its users see it, or lit as a VRML browser does.
//
// Light. wrlkit writes lights for three.js's physical units: a white face that looks at a light of intensity 1 returns 1
// (writers/gltf/lights.h). A file without lights gets what viewers give it, here VRML's headlight: white, along the view,
// pi lux; none when the file keeps a NavigationInfo that says so.
//
// lighting 'three': GLTFLoader's materials as they are, what people get. 'vrml': see vrml_light.mjs; close enough to a VRML
// browser that colours can be compared tightly.
import * as THREE from 'three';
import {MeshoptDecoder} from 'three/addons/libs/meshopt_decoder.module.js';
import {DRACOLoader} from 'three/addons/loaders/DRACOLoader.js';
import {GLTFLoader} from 'three/addons/loaders/GLTFLoader.js';
import {light_as_vrml} from './vrml_light.mjs';

const draco = new DRACOLoader().setDecoderPath('/node_modules/three/examples/jsm/libs/draco/gltf/');
const loader = new GLTFLoader().setMeshoptDecoder(MeshoptDecoder).setDRACOLoader(draco);
const renderers = new Map();  // by what they cannot change: a new one compiles every shader again
let renderer, before;

/// Draws job.glb and returns the canvas. job: {glb, time, width, height, camera, background, smooth, lighting}; camera is the
/// number or name of one in the file, or {eye, target, up}, seen with VRML's standard field of view; without a background it
/// is the colour of the sky at the horizon, if the file keeps one, or black.
export async function show(job) {
  const gltf = await loader.loadAsync(job.glb);
  const scene = gltf.scene;
  if (job.time !== undefined) play(gltf, job.time);
  const camera = make_camera(gltf, job);
  scene.add(camera);
  place_headlight(gltf, camera);
  start(job, job.background ?? sky(scene));
  sharpen_pictures(scene);
  if (job.lighting === 'vrml') light_as_vrml(scene);
  renderer.render(scene, camera);
  if (before) dispose(before);  // only now, so that shaders that both scenes need are kept
  before = scene;
  return renderer.domElement;
}

/// Gives back what the renderer holds of a scene.
function dispose(scene) {
  scene.traverse(o => {
    o.geometry?.dispose();
    o.dispose?.();
    for (const m of [o.material ?? []].flat()) {
      for (const value of Object.values(m)) if (value?.isTexture) value.dispose();
      m.dispose();
    }
  });
}

/// All animations, as they are that many seconds from their start.
function play({scene, animations}, time) {
  const mixer = new THREE.AnimationMixer(scene);
  for (const clip of animations) mixer.clipAction(clip).play();
  mixer.setTime(time);
}

function sky(scene) {
  const colors = [];
  scene.traverse(o => colors.push(o.userData.vrml97?.Background?.skyColor ?? []));
  return colors.find(c => c.length)?.slice(-3) ?? [0, 0, 0];
}

function start({width, height, smooth = false, lighting = 'three'}, background) {
  renderer = renderers.get(smooth) ?? new THREE.WebGLRenderer({antialias: smooth, alpha: false, preserveDrawingBuffer: true});
  renderers.set(smooth, renderer);
  renderer.outputColorSpace = lighting === 'vrml' ? THREE.LinearSRGBColorSpace : THREE.SRGBColorSpace;
  renderer.setSize(width, height, false);
  renderer.setClearColor(new THREE.Color().setRGB(...background, renderer.outputColorSpace), 1);
}

function make_camera(gltf, {camera: wanted, width, height}) {
  if (typeof wanted !== 'object') return take_camera(gltf, wanted, width / height);
  const field_of_view = THREE.MathUtils.radToDeg(0.785398);
  const distance = Math.hypot(...wanted.eye.map((v, i) => v - wanted.target[i]));
  const camera = new THREE.PerspectiveCamera(field_of_view, width / height, distance / 100, distance * 100);
  camera.up.fromArray(wanted.up);
  camera.position.fromArray(wanted.eye);
  camera.lookAt(...wanted.target);
  return camera;
}

/// A camera of the file, at its place, freed from the hierarchy.
function take_camera(gltf, wanted, aspect) {
  const camera = gltf.cameras[wanted] ?? gltf.cameras.find(c => wanted === c.name || wanted === c.parent?.name);
  if (!camera) throw new Error(`no camera '${wanted}' among ${gltf.cameras.map(c => c.name)}`);
  gltf.scene.updateMatrixWorld(true);
  camera.matrixWorld.decompose(camera.position, camera.quaternion, camera.scale);
  camera.scale.set(1, 1, 1);
  camera.aspect = aspect;
  camera.updateProjectionMatrix();
  return camera;
}

/// The headlight of the file stands where its first camera is; here it goes with the one that is used. A file without any
/// light gets what viewers give it.
function place_headlight(gltf, camera) {
  const lights = [];
  gltf.scene.traverse(o => { if (o.isLight) lights.push(o); });
  const wanted = gltf.scene.userData.vrml97?.NavigationInfo?.headlight ?? true;
  const mine = () => wanted && lights.length === 0 ? new THREE.DirectionalLight(0xffffff, Math.PI) : null;
  const headlight = lights.find(light => light.name === 'headlight') ?? mine();
  if (!headlight) return;
  headlight.position.set(0, 0, 0);
  headlight.target.position.set(0, 0, -1);
  camera.add(headlight, headlight.target);
}

/// Pictures that are seen at a slant, as sharp as wrlkit draws them.
function sharpen_pictures(scene) {
  const most = renderer.capabilities.getMaxAnisotropy();
  scene.traverse(o => { for (const m of [o.material ?? []].flat()) if (m.map) m.map.anisotropy = most; });
}
