// A .glb of wrlkit with its levels of detail and baked light; the pointer shows the name of what is below it.
//   example/?file=world.glb&camera=0      camera: number of the Viewpoint to begin at
import {Box3, Color, DirectionalLight, PerspectiveCamera, Raycaster, Scene, Vector2, Vector3, WebGLRenderer} from 'three';
import {OrbitControls} from 'three/addons/controls/OrbitControls.js';
import {MeshoptDecoder} from 'three/addons/libs/meshopt_decoder.module.js';
import {GLTFLoader} from 'three/addons/loaders/GLTFLoader.js';
import {fieldOfView, levelsOf, partAt, updateLevels, WrlkitPlugin} from 'wrlkit-three';

const asked = new URLSearchParams(location.search);
const loader = new GLTFLoader().setMeshoptDecoder(MeshoptDecoder).register(parser => new WrlkitPlugin(parser));
const gltf = await loader.loadAsync(asked.get('file') ?? 'world.glb');

const renderer = new WebGLRenderer({antialias: true});
document.body.append(renderer.domElement);
const scene = new Scene();
scene.background = new Color(0);
scene.add(gltf.scene);

const box = new Box3().setFromObject(gltf.scene), middle = box.getCenter(new Vector3()), size = box.getSize(new Vector3()).length();
const camera = new PerspectiveCamera(fieldOfView, 1, size / 1000, size * 10);
const begin = gltf.cameras[Number(asked.get('camera') ?? 0)];
if (begin) begin.matrixWorld.decompose(camera.position, camera.quaternion, new Vector3());
else camera.position.copy(middle).add(new Vector3(0, 0, size));
const ahead = camera.getWorldDirection(new Vector3());
const controls = new OrbitControls(camera, renderer.domElement);  // which turns the camera to the origin
controls.target.copy(begin ? begin.getWorldPosition(new Vector3()).addScaledVector(ahead, camera.position.distanceTo(middle)) : middle);
controls.update();
let lights = false;
gltf.scene.traverse(o => { lights ||= o.isLight === true; });
if (!lights) camera.add(new DirectionalLight(0xffffff, Math.PI));
scene.add(camera);

const levels = levelsOf(gltf);
function draw() {
  camera.updateMatrixWorld();
  updateLevels(levels, camera);
  renderer.render(scene, camera);
}

function resize() {
  renderer.setSize(innerWidth, innerHeight);
  camera.aspect = innerWidth / innerHeight;
  camera.updateProjectionMatrix();
}
resize();
addEventListener('resize', resize);

const isShown = o => !o || (o.visible && isShown(o.parent));

/// The part at a place of the window, both from -1 to 1; null where there is none.
function pick(x, y) {
  const rays = new Raycaster();
  rays.setFromCamera(new Vector2(x, y), camera);
  const hit = rays.intersectObject(gltf.scene).find(h => isShown(h.object));
  return hit ? partAt(hit) : null;
}

const label = document.getElementById('name');
label.textContent = '';
renderer.domElement.addEventListener('pointermove', e => {
  label.textContent = pick(2 * e.clientX / innerWidth - 1, 1 - 2 * e.clientY / innerHeight)?.path.join(' / ') ?? '';
});
renderer.setAnimationLoop(draw);
window.example = {gltf, camera, controls, levels, renderer, draw, pick};  // for the console of the browser
document.documentElement.dataset.ready = '';
