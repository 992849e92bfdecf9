// Converts worlds to glTF, has three.js draw them in a browser, and compares with wrlkit's own picture of the source, from
// the same place: what is covered must be the same, and the colours alike.
//
// Both pictures are taken with one ray in the middle of each pixel, so that edges do not blur the comparison, before a
// background that no world shows. Each is judged twice (page/show.mjs): lit by three.js, where only a loose bound can hold
// because physically based light is another than VRML's, and lit as VRML does, where colours are the same but for a few
// levels. Where a bound cannot hold, expectations.mjs says why.
//   node three_pictures.mjs WRLKIT FOLDER [PART-OF-A-NAME | --all] [FLAGS-OF-CONVERT... | converted MADE]
//   node three_pictures.mjs WRLKIT FOLDER ways     few worlds, in each way to write them small, see `ways`
// PART-OF-A-NAME is a regular expression. Without one, or with -, all worlds are compared, but of found plants and worlds with baked light some: " with light"
// compares all of those (for people: ten minutes). Pictures of worlds that fail are left in FOLDER.
// MADE: what tests/convert_worlds.py has converted is taken from there. --all: the whole found corpus, too; for people, no bounds are known there.
import fs from 'node:fs';
import path from 'node:path';
import {has_chromium, take_pictures} from './browser.mjs';
import {converted_in} from './converted.mjs';
import {expected, is_compared} from './expectations.mjs';
import {ahead, run} from './program.mjs';
import {view_of} from './view.mjs';
import {file_of, found_worlds, has_shared, own_worlds, plants_and_worlds} from './worlds.mjs';

const [wrlkit, folder, name_part = '-', ...words] = process.argv.slice(2);
const part = name_part === '-' ? '' : name_part;
const made = words[0] === 'converted' ? converted_in(words[1]) : new Map();
const size = {width: 320, height: 240};
const key = [0.85, 0.25, 0.65];
const skipped = 77, patience = 200;
const asked = new Map();  // how alike pictures must be, by what they are called
const has_webp = flags => ['webp', 'cesium', 'three'].some(word => flags.includes(word));  // these profiles store pictures so

/// {names, flags}: what makes files small, and what few worlds show of it.
const ways = [
  {names: 'plant/pump_room_faces|features/fog_linear', flags: ['-p', 'dedup,instance', '--extras', 'facts', '--gpu-instancing']},
  ...['quantize', 'meshopt', 'draco'].map(method => ({names: 'plant/pump_room_faces|features/(texture_repeat|lod)', flags: ['--compress', method]})),
  {names: 'plant/pump_room_faces|features/(texture_repeat|lod|mirror)',
    flags: ['--profile', 'cesium', '--tolerance', '1mm', '-p', 'dedup,instance,merge{parts=true},merge{instanced=true}']},
  {names: 'features/(texture|material_texture)', flags: ['--texture-format', 'webp']},
];

/// Worlds of which three.js draws what `wrlkit simplify` makes of them, with all levels: the finest must show.
const with_levels = ['corpus/paper/ellipsoid_hole.wrl']
  .map(name => ({name: `${name} with levels`, file: file_of(name), levels: true}));

/// Worlds whose light is baked: three.js draws the glTF that the pass makes, wrlkit the VRML.
const bake = ['-p', 'lightmap{quality=draft,max-size=128}'], bake_all_of_it = ['-p', 'expand,lightmap{quality=draft,max-size=128}'];
const baked = ({name, file}) => ({name: `${name} with light`, file, baked: true});
const own_with_light = ['paper/stairs_room', 'paper/pipes', 'features/light_spot', 'features/use_nested', 'features/transparency', 'features/material_texture',
  'vrml1/PointLight'].map(name => `corpus/${name}.wrl`).map(name => baked({name, file: file_of(name)}));
const found_with_light = plants_and_worlds().map(baked);

/// Pictures of found worlds lie next to the folder of the world.
const beside = file => ['--allow-path', path.dirname(path.dirname(file))];

/// The file that is drawn: the world, or the one with its levels of detail or its light.
async function source_of({file, levels, baked}, to) {
  if (baked) return await run(wrlkit, ['convert', '-q', file, `${to}.wrl`, ...beside(file), ...bake_all_of_it], patience), `${to}.wrl`;
  if (!levels) return file;
  await run(wrlkit, ['simplify', '-q', file, '--ratios', '0.5,0.25', '-o', to]);
  return path.join(to, `${path.basename(file, '.wrl')}_lod.wrl`);
}

/// One small file of ten, so that the test takes a minute; all when worlds are asked for by name.
const some_of = list => part ? list : list.filter((w, i) => i % 10 === 0 && fs.statSync(w.file).size < 100e3);

/// The glTF of a world, as it was made before, or made now.
async function convert(world, source, glb, flags) {
  const before = made.get(source);
  if (before && !world.baked) return fs.copyFileSync(before.file, glb), before;
  return await run(wrlkit, ['convert', '-q', world.baked ? world.file : source, glb, ...flags, ...beside(world.file), ...world.baked ? bake : []], patience);
}

/// Converts a world, draws it, and says what the page has to do; null when nothing was made.
async function prepare({world, flags}, number) {
  const out = name => path.join(folder, `${number}${name}`);
  const source = await source_of(world, out(''));
  const converted = await convert(world, source, out('.glb'), flags);
  const view = view_of(wrlkit, world.file, out('.glb'), world.name.startsWith('corpus/'));
  const drawn = await run(wrlkit, ['render', '-q', world.baked ? source : world.file, out('.png'), '--width', size.width, '--height', size.height,
    '--samples', 1, '--background', key, ...beside(world.file), ...view.flags]);
  const bad = [converted, drawn].find(r => r.code !== 0 && r.code !== 1);
  if (bad) return console.log(`${world.name}: exit code ${bad.code}: ${bad.text.trim()}`), null;
  const name = [world.name, ...flags].join(' ');
  asked.set(name, expected(world.name, has_webp(flags)));
  return {name, glb: `/out/${number}.glb`, camera: view.camera, ...size, background: key, key, reach: asked.get(name).reach,
    reference: [{label: 'wrlkit render', url: `/out/${number}.png`}]};
}

/// What is wrong with a pair of pictures; empty when nothing is.
function judge({name, lighting, overlap, difference, coverage, error}) {
  if (error) return `failed: ${error}`;
  const {least_overlap, most, least_coverage} = asked.get(name);
  const faults = [];
  if (overlap < least_overlap) faults.push(`overlap ${overlap.toFixed(4)} < ${least_overlap}`);
  if (difference > most[lighting]) faults.push(`difference ${difference.toFixed(4)} > ${most[lighting]} (lit by ${lighting})`);
  if (coverage < least_coverage) faults.push(`only ${coverage.toFixed(4)} of the picture is covered`);
  return faults.join(', ');
}

const percent = x => (100 * (x ?? NaN)).toFixed(2).padStart(7);

function report(result) {
  const fault = judge(result);
  console.log(`${percent(result.overlap)} ${percent(result.difference)} ${percent(result.worst)} ${percent(result.coverage)}  ${result.lighting.padEnd(5)} ${result.name}${fault && `: ${fault}`}`);
  if (fault) keep_picture(result);
  return !fault;
}

function keep_picture({name, lighting, sheet}) {
  if (!sheet) return;
  const file = path.join(folder, 'failed', `${name.replaceAll('/', '_')}.${lighting}.png`);
  fs.mkdirSync(path.dirname(file), {recursive: true});
  fs.writeFileSync(file, Buffer.from(sheet.split(',')[1], 'base64'));
}

/// {world, flags} of every pair of pictures.
function tasks() {
  const with_flags = flags => world => ({world, flags});
  if (part === '--all') return [...own_worlds(), ...found_worlds().filter(w => !w.broken)].map(with_flags([]));
  const compared = [...own_worlds(), ...with_levels, ...own_with_light, ...some_of(found_with_light.filter(w => is_compared(w.name)))].filter(w => is_compared(w.name));
  const chosen = part === 'ways' ? ways : [{names: part, flags: made.size ? [] : words}];
  return chosen.flatMap(({names, flags}) => compared.filter(w => new RegExp(names).test(w.name)).map(with_flags(flags)));
}

async function main() {
  if (!has_chromium) return console.log('skipped: there is no Chromium (WRLKIT_CHROMIUM)'), skipped;
  if (!has_shared) console.log('the found corpus is not there (WRLKIT_SHARED): only worlds of this project');
  fs.rmSync(folder, {recursive: true, force: true});
  fs.mkdirSync(folder, {recursive: true});
  const list = tasks();
  let failed = 0;
  async function* pictures() {
    for await (const job of ahead(list.entries(), 2, ([i, task]) => prepare(task, i))) {
      if (!job) ++failed;
      else for (const lighting of ['vrml', 'three']) yield {...job, lighting};
    }
  }
  console.log('overlap, mean difference, that of the worst tenth, coverage in %; lit by');
  await take_pictures(folder, pictures(), result => { failed += report(result) ? 0 : 1; });
  console.log(`${list.length} worlds, ${failed} failures${failed ? `; see ${folder}/failed` : ''}`);
  return failed ? 1 : 0;
}

process.exitCode = await main();
