// Has the official Khronos validator look at the glTF that is made of worlds of VRML97, VRML 1.0 and X3D: it must find no error and no
// warning. Damaged files must only end by themselves, with an exit code that is documented and, when something is
// missing, a message.
//   node validate_gltf.mjs WRLKIT FOLDER converted MADE...     what tests/convert_worlds.py has made, in one folder or several
//   node validate_gltf.mjs WRLKIT FOLDER ways                  what few worlds show, see `ways`
//   node validate_gltf.mjs WRLKIT FOLDER NAMES VERB [FLAG...]  for people; NAMES: a regular expression, VERB: convert, optimize
import fs from 'node:fs';
import path from 'node:path';
import validator from 'gltf-validator';
import {converted_in} from './converted.mjs';
import {in_lanes, run} from './program.mjs';
import {found_to_draw, found_worlds, has_shared, own_worlds, every_format} from './worlds.mjs';

const [wrlkit, folder, what, ...words] = process.argv.slice(2);
const lanes = 2, skipped = 77;
const to_draw = found_to_draw();
const faults = [];
const counts = {worlds: 0, broken: 0, valid: 0, bytes: 0};

/// Ways to write glTF, and the worlds in which they show.
const ways = [
  ...['emissive', 'occlusion', 'moz', 'extras'].map(as => ({names: 'features/lightmap', words: ['convert', '--lightmap-as', as]})),
  {names: 'plant/pump_room', words: ['convert', '-p', 'dedup,instance', '--extras', 'facts', '--gpu-instancing']},
  {names: 'plant/', words: ['optimize', '--profile', 'cesium', '--recognise']},
];

const fault = (world, kind, detail = '') => faults.push({name: world.name, kind, detail});

// glTF lets the viewer make tangents for a normal map (3.7.2.1); the materials of X3D 4.0 have such maps and no tangents.
const accepted = ['MESH_PRIMITIVE_GENERATED_TANGENT_SPACE'];

/// Errors and warnings that the validator finds in a .glb.
async function findings(bytes) {
  const report = await validator.validateBytes(new Uint8Array(bytes), {maxIssues: 0});
  return {meshes: report.info.totalTriangleCount + report.info.drawCallCount, issues: report.issues.messages.filter(m => m.severity <= 1 && !accepted.includes(m.code))};
}

async function check_result(world, result, out) {
  if (!fs.existsSync(out)) return fault(world, `exit code ${result.code} without output`, result.text.slice(0, 300));
  const bytes = fs.readFileSync(out);
  counts.bytes += bytes.length;
  if (bytes.length === 0) return fault(world, 'empty output');
  const {meshes, issues} = await findings(bytes);
  for (const issue of issues) fault(world, issue.code, `${issue.pointer ?? `byte ${issue.offset}`}: ${issue.message}`);
  if (issues.length === 0) ++counts.valid;
  if (meshes === 0 && result.code === 0 && to_draw.has(world.name)) fault(world, 'nothing to see, exit code 0');
}

function check_end(world, result, out) {
  const expected = world.broken ? [0, 1, 3] : [0, 1];
  if (!expected.includes(result.code)) return fault(world, `exit code ${result.code}`, result.text.slice(0, 300)), false;
  if (result.code !== 0 && !/ error: /.test(result.text)) fault(world, `exit code ${result.code} without a message`, result.text.slice(0, 300));
  if (result.code === 3 && fs.existsSync(out)) fault(world, 'exit code 3 with output');
  return result.code !== 3;
}

async function check(world, [verb, ...flags]) {
  const out = path.join(folder, `${counts.worlds++}.glb`);
  const result = await run(wrlkit, [verb, world.file, out, ...flags], 60);
  if (world.broken) ++counts.broken;
  if (check_end(world, result, out)) await check_result(world, result, out);
  fs.rmSync(out, {force: true});
}

/// How it ended has been judged by tests/convert_worlds.py.
async function check_converted(world, made) {
  ++counts.worlds;
  if (world.broken) ++counts.broken;
  if (made.code !== 3) await check_result(world, made, made.file);
  else if (fs.existsSync(made.file)) fault(world, 'exit code 3 with output');
}

/// One line a kind of fault, with the first files that show it.
function print_faults() {
  const kinds = new Map();
  for (const f of faults) kinds.set(f.kind, [...kinds.get(f.kind) ?? [], f]);
  for (const [kind, all] of kinds) print_kind(kind, all);
}

function print_kind(kind, all) {
  console.log(`\n${kind}: ${all.length} in ${new Set(all.map(f => f.name)).size} files`);
  for (const f of all.slice(0, 40)) console.log(`  ${f.name}: ${f.detail.trim()}`);
}

fs.rmSync(folder, {recursive: true, force: true});
fs.mkdirSync(folder, {recursive: true});
if (!has_shared) console.log('the found corpus is not there (WRLKIT_SHARED): only worlds of this project');
const all = [...own_worlds(every_format), ...found_worlds(every_format)];
if (what === 'converted') {
  for (const made of words.map(converted_in))
    for (const world of all.filter(w => made.has(w.file))) await check_converted(world, made.get(world.file));
} else {
  for (const way of what === 'ways' ? ways : [{names: what, words}])
    await in_lanes(all.filter(w => new RegExp(way.names).test(w.name)), lanes, world => check(world, way.words));
}
print_faults();
console.log(`${counts.worlds} worlds, ${counts.broken} of them damaged; ${counts.valid} results without error or warning, ${(counts.bytes / 1e6).toFixed(1)} MB`);
process.exitCode = counts.worlds === 0 && !has_shared ? skipped : faults.length || counts.worlds === 0 ? 1 : 0;
