// Has 3d-tiles-renderer draw sets of 3D Tiles in a browser, and compares with the whole file in three.js, from the same place in
// the same light: at full refinement the same picture, at some pixels of error nearly so. The parts under 1,200 points have their names
// at each level.
//   node tileset_pictures.mjs WRLKIT FOLDER TRIANGLES WORLD...      the sheet of pictures of each world is left in FOLDER
import fs from 'node:fs';
import path from 'node:path';
import {has_chromium, take_pictures} from './browser.mjs';
import {run} from './program.mjs';
import {view_of} from './view.mjs';

const [wrlkit, folder, triangles, ...worlds] = process.argv.slice(2);
const few = '3', many = '12';  // draws of a tile: hardly enough for its materials; some are left for surfaces that repeat
const skipped = 77, key = [0.85, 0.25, 0.65];
/// By pixels of error: the largest mean difference, from 0 to 1, and the least share of points that show the same part.
const bounds = [{pixels: 0, difference: 1 / 255, overlap: 0.995, names: 0.98}, {pixels: 4, difference: 3 / 255, overlap: 0.97, names: 0.9}, {pixels: 16, difference: 4 / 255, overlap: 0.9, names: 0.75}];
const faults = [];

/// So that the world fills the picture.
const nearer = c => ({...c, eye: c.eye.map((v, i) => c.target[i] + 0.5 * (v - c.target[i]))});

async function job_of(world, draws, i, passes = []) {
  const set = path.join(folder, `set${i}`), glb = path.join(folder, `${i}.glb`);
  for (const args of [['tiles', '-q', world, '-o', set, '--triangles', triangles, '--tile-draws', draws, '--tileset-tiles', '8', ...passes], ['convert', '-q', world, glb, ...passes]]) {
    const made = await run(wrlkit, args, 120);
    if (made.code !== 0) faults.push(`${world}: ${args[0]} ends with ${made.code}: ${made.text}`);
  }
  const camera = nearer(view_of(wrlkit, world, glb, false).camera);
  return {name: `${world}, ${draws} draws${passes.length > 0 ? ', lit' : ''}`, draws, tileset: `/out/set${i}/tileset.json`, glb: `/out/${i}.glb`, pixels: bounds.map(b => b.pixels), width: 640, height: 480, camera, key};
}

function judge({name, levels, sheet, error}, i) {
  const {draws} = jobs[i];
  if (error) return faults.push(`${name}: ${error}`);
  fs.writeFileSync(path.join(folder, `${i}.png`), Buffer.from(sheet.split(',')[1], 'base64'));
  const full = levels[0].names;
  levels.forEach((level, k) => {
    const hits = level.names.flatMap((n, p) => n && full[p] ? [n === full[p]] : []);
    const same = hits.filter(Boolean).length / hits.length;
    console.log(`${path.basename(name)}: ${level.pixels} pixels: ${level.tiles} tiles, ${level.triangles} triangles, ${level.places} places of others, differs by ${(255 * level.difference).toFixed(2)}/255, overlap ${level.overlap.toFixed(4)}, ${new Set(level.names).size} parts, ${(100 * same).toFixed(1)} % of points show the same`);
    const b = bounds[k];
    if (level.difference > b.difference || level.overlap < b.overlap || same < b.names || !(hits.length > 100)) faults.push(`${name}: at ${b.pixels} pixels not within ${JSON.stringify(b)}`);
  });
  if (levels[0].tiles < 4 || levels.at(-1).triangles >= levels[0].triangles) faults.push(`${name}: levels do not differ`);
  if (draws === many && !(levels[0].places > 0)) faults.push(`${name}: no surface is stored once for several places`);
}

if (!has_chromium) process.exit(skipped);
fs.rmSync(folder, {recursive: true, force: true});
fs.mkdirSync(folder, {recursive: true});
const jobs = [];
for (const world of worlds)
  for (const draws of [few, many]) jobs.push(await job_of(world, draws, jobs.length));
// Baked light: all parts have places of their own on a page or two, and are one draw for each.
jobs.push(await job_of(worlds[0], few, jobs.length, ['-p', 'lightmap{quality=draft}']));
let n = 0;
await take_pictures(folder, jobs, result => judge(result, n++), 200);
console.log(faults.join('\n'));
process.exitCode = faults.length || n !== jobs.length ? 1 : 0;
