// Compressed glTF is decoded by glTF-Transform, with the decoders of meshoptimizer and Draco that their authors publish, and
// compared with the same world as floats: the same names, as many triangles, and no corner further from one of the original
// than the tolerance. The Khronos validator finds no error and no warning.
//   node decoded.mjs WRLKIT FOLDER METHOD
// METHOD table: profile cesium, with places in tables and merged meshes; names are not looked at then (tests/names_table.py does).
import assert from 'node:assert';
import fs from 'node:fs';
import path from 'node:path';
import validator from 'gltf-validator';
import {run} from './program.mjs';
import {own_worlds} from './worlds.mjs';

const [wrlkit, folder, method] = process.argv.slice(2);
const skipped = 77, tolerance = 1e-3, rounding = 1e-5, shared = 2e-4;  // shared: what the pass instance may move
const in_table = method === 'table';
const flags = in_table ? ['--profile', 'cesium', '-p', 'dedup,instance,merge{parts=true},merge{instanced=true}'] : ['--compress', method];

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

/// Largest distance of a point of `a` to the nearest of `b`, if it is below `reach`; otherwise infinite.
function distance(a, b, reach) {
  const cell = p => p.map(v => Math.floor(v / reach));
  const cells = new Map();
  for (const p of b) {
    const key = cell(p).join();
    cells.set(key, [...cells.get(key) ?? [], p]);
  }
  const near = [-1, 0, 1];
  const around = p => near.flatMap(x => near.flatMap(y => near.flatMap(z => cells.get([p[0] + x, p[1] + y, p[2] + z].join()) ?? [])));
  const unique = [...new Map(a.map(p => [p.join(), p])).values()];
  return unique.reduce((worst, p) => Math.max(worst, Math.min(Infinity, ...around(cell(p)).map(q => Math.hypot(...p.map((v, k) => v - q[k]))))), 0);
}

async function check_valid(file, name) {
  const report = await validator.validateBytes(new Uint8Array(fs.readFileSync(file)), {maxIssues: 0});
  assert.deepEqual(report.issues.messages.filter(m => m.severity <= 1), [], name);
}

async function compare(world, reader, number) {
  const out = name => path.join(folder, `${number}${name}.glb`);
  await run(wrlkit, ['convert', '-q', world.file, out('')]);
  await run(wrlkit, ['convert', '-q', world.file, out('small'), ...flags, '--tolerance', tolerance]);
  await check_valid(out('small'), world.name);
  const [plain, small] = [await reader.read(out('')), await reader.read(out('small'))];
  if (!in_table) assert.deepEqual(names(small), names(plain), world.name);
  const [a, b] = [drawn(plain), drawn(small)];
  if (!in_table) assert.equal(b.length, a.length, `${world.name}: primitives`);
  assert.equal(b.reduce((n, p) => n + p.corners.length, 0), a.reduce((n, p) => n + p.corners.length, 0), `${world.name}: corners`);
  const all = list => [...new Map(list.flatMap(p => p.corners).map(p => [p.join(), p])).values()];
  const worst = distance(all(b), all(a), 2 * tolerance);
  assert(worst <= tolerance + rounding + (in_table ? shared : 0), `${world.name}: a corner is ${worst} m away`);
  return {worst, bytes: fs.statSync(out('small')).size, before: fs.statSync(out('')).size};
}

async function main() {
  const reader = await make_reader().catch(error => console.log(`skipped: ${error.message} (script/bootstrap)`));
  if (!reader) return skipped;
  fs.rmSync(folder, {recursive: true, force: true});
  fs.mkdirSync(folder, {recursive: true});
  const chosen = own_worlds().filter(w => /corpus\/(plant|paper|features\/(animation|colour_per_vertex|def|inline|l|material|negative|texture_[rt]))/.test(w.name));
  assert(chosen.length > 15);
  const sum = {worst: 0, bytes: 0, before: 0};
  for (const [i, world] of chosen.entries()) {
    const one = await compare(world, reader, i);
    sum.worst = Math.max(sum.worst, one.worst), sum.bytes += one.bytes, sum.before += one.before;
  }
  console.log(`${chosen.length} worlds: ${sum.before} -> ${sum.bytes} bytes, no corner further than ${(sum.worst * 1e3).toFixed(3)} mm`);
  return 0;
}

process.exitCode = await main();
