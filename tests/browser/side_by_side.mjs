// For people: each world as view3dscene (Castle Game Engine) shows the source, as wrlkit renders it, and as three.js shows
// the glTF, next to each other in one PNG. Without view3dscene (Debian package of that name, and xvfb) the others alone.
//   node side_by_side.mjs WRLKIT FOLDER WORLD...
// A WORLD is corpus/plant/pump_room_faces.wrl, a path in the found corpus, or any file. It is seen from its first Viewpoint,
// with --all-of-it from where all of it is seen.
import fs from 'node:fs';
import path from 'node:path';
import * as THREE from 'three';
import {take_pictures} from './browser.mjs';
import {run} from './program.mjs';
import {view_of} from './view.mjs';
import {file_of} from './worlds.mjs';

const all_of_it = process.argv.includes('--all-of-it');
const [wrlkit, folder, ...names] = process.argv.slice(2).filter(word => word !== '--all-of-it');
const size = {width: 480, height: 360};

/// A world that shows another one from a place.
function wrapper({eye, target, up}, file) {
  const q = new THREE.Quaternion().setFromRotationMatrix(new THREE.Matrix4().lookAt(...[eye, target, up].map(v => new THREE.Vector3(...v))));
  const angle = 2 * Math.acos(Math.min(1, q.w)), length = Math.hypot(q.x, q.y, q.z);
  const axis = length > 1e-9 ? [q.x, q.y, q.z].map(v => v / length) : [0, 0, 1];
  return `#VRML V2.0 utf8\nViewpoint { position ${eye.join(' ')} orientation ${axis.join(' ')} ${angle} }\nInline { url "file://${path.resolve(file)}" }\n`;
}

async function by_view3dscene(file, camera, out) {
  fs.rmSync(out, {force: true});  // of an earlier run
  let source = file;
  if (typeof camera === 'object') fs.writeFileSync(source = `${out}.wrl`, wrapper(camera, file));
  await run('xvfb-run', ['-a', '-s', '-screen 0 1280x1024x24', 'view3dscene', '--hide-extras', '--hide-menu', '--no-sound',
    '--geometry', `${size.width}x${size.height}`, '--anti-alias', '2', source, '--screenshot', '0', out], 60);
  return fs.existsSync(out);
}

async function prepare(name, number) {
  const file = file_of(name) ?? name;
  const out = suffix => path.join(folder, `${number}${suffix}`);
  await run(wrlkit, ['convert', '-q', file, out('.glb')]);
  const {camera, flags} = view_of(wrlkit, file, out('.glb'), !all_of_it);
  await run(wrlkit, ['render', '-q', file, out('.png'), '--width', size.width, '--height', size.height, ...flags]);
  const reference = [{label: `${name}: wrlkit render`, url: `/out/${number}.png`}];
  if (await by_view3dscene(file, camera, out('.v3d.png'))) reference.unshift({label: 'view3dscene', url: `/out/${number}.v3d.png`});
  return {name, glb: `/out/${number}.glb`, camera, ...size, smooth: true, key: [0, 0, 0], lighting: 'three', reference};
}

fs.mkdirSync(folder, {recursive: true});
const jobs = [];
for (const [number, name] of names.entries()) jobs.push(await prepare(name, number));
await take_pictures(folder, jobs, ({name, error, sheet}) => {
  if (error) return console.log(`${name}: ${error}`);
  const file = path.join(folder, `${name.replaceAll('/', '_')}.png`);
  fs.writeFileSync(file, Buffer.from(sheet.split(',')[1], 'base64'));
  console.log(file);
});
