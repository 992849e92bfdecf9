// Has CesiumJS draw a tileset on the Earth in a browser: every tile is loaded, and the parts under 140 points of the picture have names of the
// world, the same ones at three errors.
//   node tileset_cesium.mjs WRLKIT FOLDER TRIANGLES WORLD      the pictures are left in FOLDER
import fs from 'node:fs';
import path from 'node:path';
import {has_chromium, take_pictures} from './browser.mjs';
import {run} from './program.mjs';
import {view_of} from './view.mjs';

const [wrlkit, folder, triangles, world] = process.argv.slice(2);
const skipped = 77, faults = [];
/// By pixels of error: the least share of points that show the part that they show at full refinement.
const bounds = [{pixels: 0.01, same: 1}, {pixels: 4, same: 0.9}, {pixels: 16, same: 0.75}];
const points = Array.from({length: 14}, (_, x) => Array.from({length: 10}, (_, y) => [0.3 + 0.4 * x / 14, 0.47 + 0.3 * y / 10])).flat();

function judge({levels, error}) {
  if (error) return faults.push(error);
  const full = levels[0].names;
  levels.forEach(({pixels, failed, names, picture}, k) => {
    fs.writeFileSync(path.join(folder, `${k}.png`), Buffer.from(picture.split(',')[1], 'base64'));
    const hits = names.flatMap((n, i) => n && full[i] ? [n === full[i]] : []), same = hits.filter(Boolean).length / hits.length;
    console.log(`${pixels} pixels: ${failed} tiles failed, ${new Set(names).size} names, ${(100 * same).toFixed(1)} % of ${hits.length} points show the same`);
    if (failed || hits.length < 120 || same < bounds[k].same) faults.push(`at ${pixels} pixels not within ${JSON.stringify(bounds[k])}`);
  });
  const known = fs.readFileSync(world, 'utf8');
  const strange = [...new Set(full)].filter(name => name && !known.includes(`DEF ${name.replace(/#\d+$/, '')} `) && !world.endsWith(name));
  if (strange.length) faults.push(`names that the world does not have: ${strange}`);
  if (new Set(full).size < 10) faults.push('fewer than ten parts are seen');
}

if (!has_chromium) process.exit(skipped);
fs.rmSync(folder, {recursive: true, force: true});
fs.mkdirSync(folder, {recursive: true});
const glb = path.join(folder, 'world.glb'), set = path.join(folder, 'set');
for (const args of [['tiles', '-q', world, '-o', set, '--triangles', triangles, '--at', '50.1,8.6,112,30', '--tileset-tiles', '8'], ['convert', '-q', world, glb]]) {
  const made = await run(wrlkit, args, 120);
  if (made.code !== 0) faults.push(`${args[0]} ends with ${made.code}: ${made.text}`);
}
const with_places = fs.readdirSync(set, {recursive: true}).filter(file => file.endsWith('.glb') && fs.readFileSync(path.join(set, file)).includes('EXT_instance_features'));
if (with_places.length === 0) faults.push('no surface is stored once for several places');
const {camera} = view_of(wrlkit, world, glb, false);
camera.eye = camera.eye.map((v, i) => camera.target[i] + 0.5 * (v - camera.target[i]));
// Of the root, near whose origin that of the world is.
const origin = JSON.parse(fs.readFileSync(path.join(set, 'tileset.json'))).root.transform;
let n = 0;
await take_pictures(folder, [{name: world, cesium: '/out/set/tileset.json', origin, camera, width: 640, height: 480, pixels: bounds.map(b => b.pixels), points}], result => { judge(result); ++n; }, 300);
console.log(faults.join('\n'));
process.exitCode = faults.length || n !== 1 ? 1 : 0;
