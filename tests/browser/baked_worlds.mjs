// Bakes every world of a folder of the found corpus at draft quality, and judges the results: the Khronos validator must find
// no error and no warning in the glTF, and the figures of the pass must say that no lamp and no surface shines through closed walls, that
// no dark specks are amid the light, and that smooth surfaces show no jumps where they were cut. Texels that no light reaches at all
// (black) are shown and not judged: the under side of what is on a floor is dark, and so is the back of a world with one lamp.
//   node baked_worlds.mjs WRLKIT FOLDER [PART-OF-A-NAME] [SECONDS-A-WORLD]
// A PART is plant/ or worlds/; without one both are baked, and corpus/plant and corpus/paper. For people: it takes long.
import fs from 'node:fs';
import path from 'node:path';
import validator from 'gltf-validator';
import {in_lanes, run} from './program.mjs';
import {every_format, found_worlds, has_shared, own_worlds} from './worlds.mjs';

const [wrlkit, folder, part = '', seconds = '120'] = process.argv.slice(2);
const most = {leaks: 0.001, holes: 0.001, jumps: 0.02};  // of the texels, and of the places along seams

// Where a bound cannot hold, and why; by the pass at other sizes of a page.
const exceptions = [
  {worlds: /wythoff_snub/, most: {holes: 0.006}},  // shadows of rods thinner than a texel: 0.41 % here
];

/// What the passes counted, by name; 'lightmap.texels' and so on.
function figures(text) {
  return Object.fromEntries([...text.matchAll(/^\s*(\d+)\s+(lightmap\.\S+)$/gm)].map(([, n, name]) => [name.slice('lightmap.'.length), Number(n)]));
}

async function validate(file) {
  const report = await validator.validateBytes(new Uint8Array(fs.readFileSync(file)), {maxIssues: 0});
  return report.issues.messages.filter(m => m.severity <= 1).map(m => `${m.code} ${m.pointer ?? ''}: ${m.message}`);
}

/// Parts of one that the bounds are for.
function shares({leaks = 0, holes = 0, black = 0, jumps = 0, texels = 0, 'seam-places': places = 0}) {
  return {leaks: leaks / Math.max(1, texels), holes: holes / Math.max(1, texels), black: black / Math.max(1, texels), jumps: jumps / Math.max(1, places)};
}

async function judge(world, result, out) {
  if (result.code !== 0 && result.code !== 1) return [`exit code ${result.code}: ${result.text.slice(0, 300)}`];
  const bounds = exceptions.filter(e => e.worlds.test(world.name)).reduce((sum, e) => ({...sum, ...e.most}), most);
  const found = Object.entries(shares(figures(result.text))).filter(([name, share]) => share > bounds[name]);
  return [...await validate(out), ...found.map(([name, share]) => `${name}: ${(100 * share).toFixed(2)} % > ${100 * bounds[name]} %`)];
}

const chosen = world => !world.broken && /(^|\/)(plant|worlds|paper)\//.test(world.name) && world.name.includes(part);
const worlds = [...own_worlds(every_format), ...found_worlds(every_format)].filter(chosen);
let n_faulty = 0, n_lit = 0, all_seconds = 0;

async function bake(world, number) {
  const out = path.join(folder, `${number}.glb`);
  const result = await run(wrlkit, ['convert', world.file, out, '-p', 'lightmap{quality=draft}', '--stats'], Number(seconds));
  const faults = await judge(world, result, out);
  const f = figures(result.text), s = shares(f);
  const percent = name => (100 * s[name]).toFixed(2).padStart(6);
  console.log(`${result.seconds.toFixed(1).padStart(6)} s ${String(f.texels ?? 0).padStart(8)} ${String(f.inside ?? 0).padStart(7)} ${percent('leaks')} ${percent('holes')} ${percent('black')} ${percent('jumps')}  ${world.name}`);
  for (const fault of faults) console.log(`         ${fault}`);
  n_faulty += faults.length > 0, n_lit += (f.texels ?? 0) > 0, all_seconds += result.seconds;
  fs.rmSync(out, {force: true});
}

fs.mkdirSync(folder, {recursive: true});
if (!has_shared) console.log('skipped: the found corpus is not there (WRLKIT_SHARED)');
console.log('  time    texels  inside  leaks  holes  black  jumps in %');
await in_lanes(worlds.entries(), 1, async ([i, world]) => bake(world, i));
console.log(`${worlds.length} worlds, ${n_lit} with surfaces to light, ${n_faulty} with faults; ${all_seconds.toFixed(0)} s`);
process.exitCode = n_faulty ? 1 : 0;
