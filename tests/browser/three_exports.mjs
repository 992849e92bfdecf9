// What three.js exports as .glb is read: names, triangles, lights, instances and animations, as many as were put in.
//   node three_exports.mjs WRLKIT FOLDER
import assert from 'node:assert';
import {spawnSync} from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';
import * as three from 'three';
import {GLTFExporter} from 'three/addons/exporters/GLTFExporter.js';

const [wrlkit, folder] = process.argv.slice(2);

// The exporter was written for browsers.
globalThis.FileReader = class {
  readAsArrayBuffer(blob) { blob.arrayBuffer().then(bytes => { this.result = bytes; this.onloadend(); }); }
};

function made() {
  const scene = new three.Scene();
  const material = new three.MeshStandardMaterial({color: 0x8040c0, roughness: 0.5, metalness: 0, name: 'Purple'});
  const box = new three.Mesh(new three.BoxGeometry(1, 2, 3), material);
  box.name = 'Box';
  box.position.set(1, 2, 3);
  const ball = new three.Mesh(new three.SphereGeometry(1, 8, 6), material);
  ball.name = 'Ball';
  ball.rotation.set(0.1, 0.2, 0.3);
  box.add(ball);
  const copies = new three.InstancedMesh(new three.BoxGeometry(), material, 3);
  for (let i = 0; i < 3; ++i) copies.setMatrixAt(i, new three.Matrix4().makeTranslation(i, 0, 0));
  const colored = new three.BufferGeometry();
  colored.setAttribute('position', new three.Float32BufferAttribute([0, 0, 0, 1, 0, 0, 0, 1, 0], 3));
  colored.setAttribute('color', new three.Float32BufferAttribute([1, 0, 0, 0, 1, 0, 0, 0, 1], 3));
  const lines = new three.LineSegments(colored, new three.LineBasicMaterial({vertexColors: true}));
  const eye = new three.PerspectiveCamera(40, 1.5, 0.1, 100);
  eye.name = 'Eye';
  scene.add(box, copies, new three.Mesh(colored, new three.MeshBasicMaterial({vertexColors: true})), lines, eye,
            new three.PointLight(0xffffff, 5), new three.DirectionalLight(0xffeedd, 1));
  const tracks = [new three.VectorKeyframeTrack('Box.position', [0, 1, 2], [0, 0, 0, 1, 1, 1, 0, 0, 0]),
                  new three.QuaternionKeyframeTrack('Ball.quaternion', [0, 2], [0, 0, 0, 1, 0, 0.6, 0, 0.8], three.InterpolateDiscrete)];
  return {scene, animations: [new three.AnimationClip('Move', 2, tracks)]};
}

const {scene, animations} = made();
const bytes = await new GLTFExporter().parseAsync(scene, {binary: true, animations});
fs.mkdirSync(folder, {recursive: true});
const file = path.join(folder, 'three.glb');
fs.writeFileSync(file, Buffer.from(bytes));
const run = spawnSync(wrlkit, ['info', file, '--json'], {encoding: 'utf8'});
assert.equal(run.status, 0, run.stderr);
const info = JSON.parse(run.stdout);
const triangles = 12 + (8 * 6 - 8) * 2 + 3 * 12 + 1;
assert.deepEqual([info.format, info.triangles, info.lights, info.viewpoints, info.animations], ['gltf', triangles, 2, 1, 2]);
const text = spawnSync(wrlkit, ['cat', '-q', file], {encoding: 'utf8'}).stdout;
for (const name of ['DEF Box Transform', 'DEF Ball Transform', 'DEF Eye Viewpoint', 'DEF Move TimeSensor', 'DEF Purple Appearance']) assert(text.includes(name), name);
console.log(`three.js ${three.REVISION}: ${bytes.byteLength} bytes, ${info.triangles} triangles`);
