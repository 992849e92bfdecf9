// Compressed glTF is decoded by glTF-Transform, with the decoders of meshoptimizer and Draco that their authors publish, and
// compared with the same world as floats: the same names, as many triangles, and no corner further from one of the original
// than the tolerance. The Khronos validator finds no error and no warning.
//   node decoded.mjs WRLKIT FOLDER MADE     MADE: what tests/convert_worlds.py has made, without compression
import assert from 'node:assert';
import fs from 'node:fs';
import path from 'node:path';
import validator from 'gltf-validator';
import {converted_in} from './converted.mjs';
import {run} from './program.mjs';
import {own_worlds} from './worlds.mjs';

const [wrlkit, folder, made] = process.argv.slice(2);
const skipped = 77, tolerance = 1e-3, rounding = 1e-5, shared = 2e-4;  // shared: what the pass instance may move
// Of the table names are not looked at (tests/names_table.py does that), nor are pictures.
const methods = [
  ...['quantize', 'meshopt', 'draco'].map(name => ({name, flags: ['--compress', name], reach: tolerance + rounding})),
  {name: 'table', in_table: true, reach: tolerance + rounding + shared,
    flags: ['--profile', 'cesium', '--texture-format', 'keep', '-p', 'dedup,instance,merge{parts=true},merge{instanced=true}']},
];

async function make_reader() {
  const {NodeIO} = await import('@gltf-transform/core');
  const {ALL_EXTENSIONS} = await import('@gltf-transform/extensions');
  const {MeshoptDecoder} = await import('meshoptimizer');
  const {default: draco} = await import('draco3dgltf');
  await MeshoptDecoder.ready;
  return new NodeIO().registerExtensions(ALL_EXTENSIONS)
    .registerDependencies({'meshopt.decoder': MeshoptDecoder, 'draco3d.decoder': await draco.createDecoderModule()});
}

/// A point by a column-major matrix.
const moved = (m, [x, y, z]) => [0, 1, 2].map(r => m[r] * x + m[4 + r] * y + m[8 + r] * z + m[12 + r]);

/// Turns a point by a quaternion.
function turned([x, y, z, w], p) {
  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const t = cross([x, y, z], p).map(v => 2 * v), u = cross([x, y, z], t);
  return p.map((v, k) => v + w * t[k] + u[k]);
}

/// What a node does to its mesh before its own matrix: one function for each place of EXT_mesh_gpu_instancing.
function places(node) {
  const table = node.getExtension('EXT_mesh_gpu_instancing');
  if (!table) return [p => p];
  const [t, r, s] = ['TRANSLATION', 'ROTATION', 'SCALE'].map(name => table.getAttribute(name));
  const unit = q => q.map(v => v / Math.hypot(...q));
  const place = i => p => {
    const scaled = s ? s.getElement(i, []).map((v, k) => v * p[k]) : p, at = t ? t.getElement(i, []) : [0, 0, 0];
    return (r ? turned(unit(r.getElement(i, [])), scaled) : scaled).map((v, k) => v + at[k]);
  };
  return Array.from({length: (t ?? r ?? s).getCount()}, (_, i) => place(i));
}

/// {name, corners} of every drawn primitive, in the order of the file; corners in the world.
function drawn(document) {
  const out = [];
  for (const node of document.getRoot().listNodes()) {
    for (const primitive of node.getMesh()?.listPrimitives() ?? []) {
      const position = primitive.getAttribute('POSITION'), index = primitive.getIndices();
      const n = index ? index.getCount() : position.getCount();
      for (const place of places(node)) out.push({corners: Array.from({length: n}, (_, i) => moved(node.getWorldMatrix(), place(position.getElement(index ? index.getScalar(i) : i, []))))});
    }
  }
  return out;
}

const names = document => document.getRoot().listNodes().map(node => node.getName()).filter(Boolean).sort();

const unique = points => [...new Map(points.map(p => [p.join(), p])).values()];

/// Distance of a point to the nearest of those, if it is below `reach`; otherwise infinite.
function distance_to(points, reach) {
  const cell = p => p.map(v => Math.floor(v / reach));
  const cells = new Map();
  for (const p of points) {
    const key = cell(p).join(), in_cell = cells.get(key);
    if (in_cell) in_cell.push(p);
    else cells.set(key, [p]);
  }
  const near = [-1, 0, 1];
  const around = p => near.flatMap(x => near.flatMap(y => near.flatMap(z => cells.get([p[0] + x, p[1] + y, p[2] + z].join()) ?? [])));
  return p => Math.min(Infinity, ...around(cell(p)).map(q => Math.hypot(...p.map((v, k) => v - q[k]))));
}

async function check_valid(file, name) {
  const report = await validator.validateBytes(new Uint8Array(fs.readFileSync(file)), {maxIssues: 0});
  assert.deepEqual(report.issues.messages.filter(m => m.severity <= 1), [], name);
}

/// The world as floats: {names, n_primitives, n_corners, distance}.
function original(document) {
  const primitives = drawn(document), corners = primitives.flatMap(p => p.corners);
  return {names: names(document), n_primitives: primitives.length, n_corners: corners.length, distance: distance_to(unique(corners), 2 * tolerance)};
}

/// How far the farthest corner of what a method makes is from those of the original.
function farthest({in_table, reach}, small, plain, what) {
  const primitives = drawn(small), corners = primitives.flatMap(p => p.corners);
  if (!in_table) assert.deepEqual(names(small), plain.names, what);
  if (!in_table) assert.equal(primitives.length, plain.n_primitives, `${what}: primitives`);
  assert.equal(corners.length, plain.n_corners, `${what}: corners`);
  const worst = unique(corners).reduce((most, p) => Math.max(most, plain.distance(p)), 0);
  assert(worst <= reach, `${what}: a corner is ${worst} m away`);
  return worst;
}

async function main() {
  const reader = await make_reader().catch(error => console.log(`skipped: ${error.message} (script/bootstrap)`));
  if (!reader) return skipped;
  fs.rmSync(folder, {recursive: true, force: true});
  fs.mkdirSync(folder, {recursive: true});
  const chosen = own_worlds().filter(w => /corpus\/(plant|paper|features\/(animation|colour_per_vertex|def|inline|l|material|negative|texture_[rt]))/.test(w.name));
  assert(chosen.length > 15);
  const before = converted_in(made), sums = methods.map(() => ({worst: 0, bytes: 0}));
  let bytes = 0;
  for (const world of chosen) {
    const {file} = before.get(world.file), plain = original(await reader.read(file));
    bytes += fs.statSync(file).size;
    for (const [i, method] of methods.entries()) {
      const out = path.join(folder, `${method.name}.glb`);
      await run(wrlkit, ['convert', '-q', world.file, out, ...method.flags, '--tolerance', tolerance]);
      await check_valid(out, `${world.name}, ${method.name}`);
      const worst = farthest(method, await reader.read(out), plain, `${world.name}, ${method.name}`);
      sums[i] = {worst: Math.max(sums[i].worst, worst), bytes: sums[i].bytes + fs.statSync(out).size};
    }
  }
  for (const [i, {name}] of methods.entries())
    console.log(`${name}: ${chosen.length} worlds: ${bytes} -> ${sums[i].bytes} bytes, no corner further than ${(sums[i].worst * 1e3).toFixed(3)} mm`);
  return 0;
}

process.exitCode = await main();
