// A set of 3D Tiles drawn by 3d-tiles-renderer, as its users see it, and which parts are under some of its pixels.
import * as THREE from 'three';
import {TilesRenderer} from '3d-tiles-renderer';
import {GLTFExtensionsPlugin} from '3d-tiles-renderer/plugins';
import {MeshoptDecoder} from 'three/addons/libs/meshopt_decoder.module.js';
import {DRACOLoader} from 'three/addons/loaders/DRACOLoader.js';
import {GLTFLoader} from 'three/addons/loaders/GLTFLoader.js';
import {compare, picture_of, sheet} from './pictures.mjs';

const across = 40, down = 30;  // points at which parts are picked
const no_row = 0xffffffff;

/// What looks at a world that is y up: the same lights for tiles and for the file that they were made of.
class Stage {
  constructor({width, height, camera}) {
    this.renderer = new THREE.WebGLRenderer({antialias: false, preserveDrawingBuffer: true});
    this.renderer.setSize(width, height, false);
    const distance = Math.hypot(...camera.eye.map((v, i) => v - camera.target[i]));
    this.camera = new THREE.PerspectiveCamera(45, width / height, distance / 100, distance * 100);
    this.camera.up.fromArray(camera.up);
    this.camera.position.fromArray(camera.eye);
    this.camera.lookAt(...camera.target);
    const light = new THREE.DirectionalLight(0xffffff, Math.PI);
    light.position.set(0, 0, 0);
    light.target.position.set(0, 0, -1);
    this.camera.add(light, light.target);
    this.camera.updateMatrixWorld(true);
  }

  draw(what, key) {
    const scene = new THREE.Scene();
    scene.add(this.camera, what);
    this.renderer.setClearColor(new THREE.Color().setRGB(...key, THREE.SRGBColorSpace), 1);
    this.renderer.render(scene, this.camera);
    return picture_of(this.renderer.domElement);
  }

  dispose() { this.renderer.dispose(); }
}

async function whole(url, loaders) {
  const loader = new GLTFLoader().setMeshoptDecoder(loaders.meshoptDecoder).setDRACOLoader(loaders.dracoLoader);
  const {scene} = await loader.loadAsync(url);
  const lights = [];
  scene.traverse(o => { if (o.isLight) lights.push(o); });
  for (const light of lights) light.removeFromParent();
  return scene;
}

const turn = () => new Promise(resolve => setTimeout(resolve, 20));

/// Until nothing is loaded any more.
async function settle(tiles) {
  const begin = performance.now();
  for (let quiet = 0; quiet < 5;) {
    if (performance.now() - begin > 60000) throw new Error(`tiles are still being loaded: ${JSON.stringify(tiles.stats)}`);
    tiles.update();
    await turn();
    const {queued, downloading, parsing, failed} = tiles.stats;
    if (failed) throw new Error(`${failed} tiles cannot be loaded`);
    quiet = tiles.root && queued + downloading + parsing === 0 ? quiet + 1 : 0;
  }
}

/// The row of the part that a ray meets, in a table. Of surfaces that stand in several places each place is of a part; 3d-tiles-renderer
/// leaves their feature ids as GLTFLoader has read them.
function row_at(hit) {
  const {meshFeatures, gltfExtensions} = hit.object.userData;
  if (hit.instanceId !== undefined) {
    const [{attribute, propertyTable}] = gltfExtensions.EXT_instance_features.featureIds;
    return [hit.object.geometry.getAttribute(`_FEATURE_ID_${attribute}`).getX(hit.instanceId), propertyTable];
  }
  const p = hit.object.geometry.attributes.position, at = k => new THREE.Vector3().fromBufferAttribute(p, [hit.face.a, hit.face.b, hit.face.c][k]);
  const local = hit.object.worldToLocal(hit.point.clone());
  const barycentric = THREE.Triangle.getBarycoord(local, at(0), at(1), at(2), new THREE.Vector3());
  const [row] = meshFeatures.getFeatures(hit.faceIndex, barycentric), [{propertyTable}] = meshFeatures.getFeatureInfo();
  return [row, propertyTable];
}

/// The path of names of the part that a ray meets first.
function name_at(hit) {
  const {structuralMetadata} = hit.object.userData, [row, table] = row_at(hit), names = [];
  for (let r = row; r !== no_row;) {
    const {name, parent} = structuralMetadata.getPropertyTableData(table, r);
    names.unshift(name);
    r = parent;
  }
  return names.join('/');
}

function pick(tiles, camera) {
  const ray = new THREE.Raycaster(), out = [];
  for (let y = 0; y < down; ++y)
    for (let x = 0; x < across; ++x) {
      ray.setFromCamera(new THREE.Vector2((x + 0.5) / across * 2 - 1, 1 - (y + 0.5) / down * 2), camera);
      const hit = ray.intersectObject(tiles.group, true)[0];
      out.push(hit ? name_at(hit) : '');
    }
  return out;
}

/// job: {tileset, glb, pixels, width, height, camera, key}. For each error in pixels: how its picture differs from that of
/// the file, what was loaded, and the parts under some pixels. All pictures in one.
export async function draw_tileset(job) {
  const loaders = {meshoptDecoder: MeshoptDecoder, dracoLoader: new DRACOLoader().setDecoderPath('/node_modules/three/examples/jsm/libs/draco/gltf/'), autoDispose: false};
  const stage = new Stage(job);
  const reference = stage.draw(await whole(job.glb, loaders), job.key);
  const pictures = [reference], levels = [];
  for (const pixels of job.pixels) {
    const tiles = new TilesRenderer(job.tileset);
    tiles.registerPlugin(new GLTFExtensionsPlugin(loaders));
    tiles.errorTarget = pixels;
    tiles.group.rotation.x = -Math.PI / 2;  // z up to y up
    tiles.group.updateMatrixWorld(true);
    tiles.setCamera(stage.camera);
    tiles.setResolutionFromRenderer(stage.camera, stage.renderer);
    await settle(tiles);
    pictures.push(stage.draw(tiles.group, job.key));
    let triangles = 0, places = 0;
    tiles.group.traverse(o => {
      if (!o.isMesh) return;
      triangles += (o.geometry.index ?? o.geometry.attributes.position).count / 3 * (o.count ?? 1);
      places += o.isInstancedMesh ? o.count : 0;
    });
    levels.push({pixels, tiles: tiles.visibleTiles.size, triangles, places, names: pick(tiles, stage.camera), ...compare(reference, pictures.at(-1), job)});
    tiles.dispose();
  }
  stage.dispose();
  return {levels, sheet: sheet(pictures, ['the whole file', ...job.pixels.map(p => `tiles, error of ${p} pixels`)]).toDataURL()};
}
