// Ways to write baked light (--lightmap-as) by viewers: the table of docs/lighting.md. Each cell is a picture, and the mean difference of its channels, in
// 255ths, from what `wrlkit render` shows of base-color. For people: it takes minutes.
//   node lit_matrix.mjs WRLKIT FOLDER [WORLD]      prints the table; pictures are left in FOLDER
import fs from 'node:fs';
import path from 'node:path';
import {bundle_babylon, has_babylon} from './babylon.mjs';
import {has_chromium, take_pictures} from './browser.mjs';
import {ahead, run} from './program.mjs';
import {view_of} from './view.mjs';
import {file_of} from './worlds.mjs';

const [wrlkit, folder, world = file_of('corpus/paper/stairs_room.wrl')] = process.argv.slice(2);
const skipped = 77, key = [0.85, 0.25, 0.65], size = {width: 320, height: 240};
const ways = ['base-color', 'emissive', 'occlusion', 'moz', 'extras'];
/// Which words of a job have the page draw it with what.
const viewers = {'three.js': {lighting: 'three'}, 'Babylon.js': {babylon: true}, CesiumJS: {cesium_model: true}};
const out = name => path.join(folder, name);

async function must(args) {
  const done = await run(wrlkit, args, 300);
  if (done.code !== 0 && done.code !== 1) throw new Error(`${args.join(' ')}: ${done.text}`);
}

const draw = (file, picture, view) => must(['render', '-q', file, picture, '--width', size.width, '--height', size.height, '--samples', 1, '--background', ...key, ...view.flags]);

/// The file of a way, and what `wrlkit render` shows of it.
async function prepare(way) {
  const glb = out(`${way}.glb`);
  await must(['convert', '-q', world, glb, '-p', 'lightmap{quality=draft}', '--lightmap-as', way]);
  const view = view_of(wrlkit, world, glb, false);
  await draw(glb, out(`${way}.png`), view);
  return {way, camera: view.camera};
}

/// A job of the page: viewers differ in how they are given the picture to compare with.
function job_of({way, camera}, viewer, reference) {
  const url = `/out/${reference}.png`, words = viewers[viewer];
  return {name: `${viewer}|${way}`, ...words, glb: `/out/${way}.glb`, camera, ...size, background: key, key, reference: words.lighting ? [{label: 'wrlkit render', url}] : url};
}

const levels = difference => (255 * difference).toFixed(1);

async function main() {
  if (!has_chromium || !has_babylon) return console.log('skipped: there is no Chromium, Babylon.js or esbuild'), skipped;
  fs.rmSync(folder, {recursive: true, force: true});
  fs.mkdirSync(folder, {recursive: true});
  bundle_babylon(folder);
  const cells = new Map();
  const made = [];
  for await (const file of ahead(ways, 1, prepare)) made.push(file);
  const jobs = made.flatMap(file => Object.keys(viewers).map(viewer => job_of(file, viewer, 'base-color')));
  await take_pictures(folder, jobs, ({name, difference, error, sheet}) => {
    cells.set(name, error ? `failed: ${error.slice(0, 60)}` : levels(difference));
    if (sheet) fs.writeFileSync(out(`${name.replace(/\W+/g, '_')}.png`), Buffer.from(sheet.split(',')[1], 'base64'));
  }, 300);
  console.log(`| | ${ways.join(' | ')} |\n|${'---|'.repeat(ways.length + 1)}`);
  for (const viewer of Object.keys(viewers)) console.log(`| ${viewer} | ${ways.map(way => cells.get(`${viewer}|${way}`)).join(' | ')} |`);
  return 0;
}

process.exitCode = await main();
