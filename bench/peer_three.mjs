// Worlds to GLB by three.js in one Node.js process: VRMLLoader, GLTFExporter. Prints what it has made, a line each.
//   node bench/peer_three.mjs LIST FOLDER    (in tests/browser, which has three)
import fs from 'node:fs';
import path from 'node:path';
import {GLTFExporter} from 'three/addons/exporters/GLTFExporter.js';
import {VRMLLoader} from 'three/addons/loaders/VRMLLoader.js';

const [list, folder] = process.argv.slice(2);
console.warn = console.error = () => {};
globalThis.FileReader = class {
  readAsArrayBuffer(blob) { blob.arrayBuffer().then(bytes => { this.result = bytes; this.onloadend(); }); }
};
let n = 0;
for (const file of fs.readFileSync(list, 'utf8').split('\n').filter(Boolean)) {
  try {
    const scene = new VRMLLoader().parse(fs.readFileSync(file, 'utf8'), path.dirname(file) + '/');
    const glb = await new GLTFExporter().parseAsync(scene, {binary: true});
    fs.writeFileSync(path.join(folder, `${n++}.glb`), Buffer.from(glb));
    console.log(file);
  } catch { /* it cannot be read by three.js: no line */ }
}
