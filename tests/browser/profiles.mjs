// What docs/profiles.md says of CesiumJS and Babylon.js: they load worlds that are optimised for them without a warning and without asking a
// network, draw them as `wrlkit render` does, and have their levels, copies and names.
//   node profiles.mjs WRLKIT FOLDER      prints a table; pictures are left in FOLDER
import fs from 'node:fs';
import path from 'node:path';
import {bundle_babylon, has_babylon} from './babylon.mjs';
import {has_chromium, take_pictures} from './browser.mjs';
import {ahead, run} from './program.mjs';
import {view_of} from './view.mjs';
import {file_of} from './worlds.mjs';

const [wrlkit, folder] = process.argv.slice(2);
const skipped = 77, key = [0.85, 0.25, 0.65], size = {width: 320, height: 240};
const plant = 'plant/pump_room_faces', pictures = 'features/material_texture', levels = 'paper/ellipsoid_hole';
const all = [plant, pictures, levels];
const ways = [
  {engine: 'babylon', profile: 'portable', worlds: all},
  {engine: 'babylon', profile: 'three', worlds: all},
  {engine: 'babylon', profile: 'three', worlds: [plant], flags: ['--compress', 'draco']},
  {engine: 'babylon', profile: 'three', worlds: [plant], flags: ['--gpu-instancing']},
  {engine: 'cesium_model', profile: 'cesium', worlds: all},
];
/// Of the channels where both are covered: physically based light is another than VRML's, and CesiumJS ignores the lights of a file.
const most = {babylon: 0.11, cesium_model: 0.14};

async function prepare({engine, profile, flags = []}, world, number) {
  const out = ending => path.join(folder, `${number}${ending}`), file = file_of(`corpus/${world}.wrl`);
  const made = await run(wrlkit, ['optimize', '-q', file, out('.glb'), '--profile', profile, ...flags, ...world === levels ? ['-p', 'weld,lod'] : []]);
  const view = view_of(wrlkit, file, out('.glb'), false);
  const drawn = await run(wrlkit, ['render', '-q', file, out('.png'), '--width', size.width, '--height', size.height, '--samples', 1, '--background', key, ...view.flags]);
  for (const r of [made, drawn]) if (r.code !== 0) throw new Error(r.text);
  return {name: `${engine} ${[profile, ...flags].join(' ')} ${world}`, [engine]: true, glb: `/out/${number}.glb`, camera: view.camera, ...size, background: key, key,
    reference: `/out/${number}.png`};
}

/// Names of parts that are shown by several draws have a number.
const plain = name => name.replace(/(#\d+|_primitive\d+)$/, '');

/// What is wrong with what an engine shows; empty when nothing is.
function judge({name, error, overlap, difference, faults, names, draws, copies, levels: loaded}) {
  if (error) return [error];
  const engine = name.split(' ')[0], world = name.split(' ').at(-1), wrong = [...faults];
  const known = new Set([...fs.readFileSync(file_of(`corpus/${world}.wrl`), 'utf8').matchAll(/DEF (\S+) (Transform|Group|Shape)/g)].map(found => found[1]));
  const found = new Set(names.map(plain)), lost = [...known].filter(part => !found.has(part));
  if (overlap < 0.99) wrong.push(`overlap ${overlap}`);
  if (difference > most[engine]) wrong.push(`difference ${difference}`);
  // What stands in a table of places has no node of its own.
  if (engine === 'babylon' && lost.length && !name.includes('--gpu-instancing')) wrong.push(`no ${lost}`);
  if (engine === 'cesium_model' && world === plant && [...found].filter(part => known.has(part)).length < 20) wrong.push(`only ${[...found]}`);
  if (name.includes('--gpu-instancing') && !(draws < 0.6 * copies)) wrong.push(`${draws} draws of ${copies} copies`);
  if (engine === 'babylon' && world === levels && loaded < 3) wrong.push(`${loaded} levels`);
  return wrong;
}

const percent = x => (100 * (x ?? NaN)).toFixed(2).padStart(7);

function report(result) {
  const {name, sheet, overlap, difference, names = [], draws = '', copies = '', levels: loaded = ''} = result, wrong = judge(result);
  if (sheet) fs.writeFileSync(path.join(folder, `${name.replace(/\W+/g, '_')}.png`), Buffer.from(sheet.split(',')[1], 'base64'));
  console.log(`${percent(overlap)} ${percent(difference)} ${names.length} ${draws} ${copies} ${loaded}  ${name}${wrong.length ? `: ${wrong.join('; ')}` : ''}`);
  return wrong.length === 0;
}

async function main() {
  if (!has_chromium || !has_babylon) return console.log('skipped: there is no Chromium, Babylon.js or esbuild'), skipped;
  fs.rmSync(folder, {recursive: true, force: true});
  fs.mkdirSync(folder, {recursive: true});
  bundle_babylon(folder);
  const jobs = ways.flatMap(way => way.worlds.map(world => ({way, world})));
  const prepared = ahead(jobs.entries(), 1, ([i, {way, world}]) => prepare(way, world, i));
  let good = 0;
  console.log('overlap, mean difference in %; names, draws, copies, levels');
  await take_pictures(folder, prepared, result => { good += report(result) ? 1 : 0; }, 300);
  return good === jobs.length ? 0 : 1;
}

process.exitCode = await main();
