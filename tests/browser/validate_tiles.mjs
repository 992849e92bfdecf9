// Has the official Khronos validator look at every tile of sets of 3D Tiles: it must find no error and no warning.
//   node validate_tiles.mjs WRLKIT FOLDER WORLD...      each world by each way of compression; FOLDER is for what is made
import fs from 'node:fs';
import path from 'node:path';
import validator from 'gltf-validator';
import {run} from './program.mjs';

const [wrlkit, folder, ...worlds] = process.argv.slice(2);
const faults = [];
let tiles = 0, with_places = 0;

async function check_tile(name, file) {
  const report = await validator.validateBytes(new Uint8Array(fs.readFileSync(file)), {maxIssues: 0});
  for (const issue of report.issues.messages.filter(m => m.severity <= 1)) faults.push(`${name}: ${issue.code} ${issue.pointer ?? ''}: ${issue.message}`);
  if (report.info.drawCallCount === 0) faults.push(`${name}: nothing is drawn`);
  ++tiles;
  with_places += report.info.extensionsUsed.includes('EXT_mesh_gpu_instancing') ? 1 : 0;
}

async function check(world, compress, draws) {
  const out = path.join(folder, `${path.basename(world)}-${compress}-${draws}`);
  const made = await run(wrlkit, ['tiles', world, '-o', out, '--triangles', '2000', '--tile-draws', draws, '--compress', compress], 120);
  if (made.code !== 0) return faults.push(`${world} ${compress}: exit code ${made.code}: ${made.text}`);
  const uris = tile => [tile.content.uri, ...(tile.children ?? []).flatMap(uris)];
  for (const uri of uris(JSON.parse(fs.readFileSync(path.join(out, 'tileset.json'))).root)) await check_tile(`${world} ${compress} ${uri}`, path.join(out, uri));
}

fs.rmSync(folder, {recursive: true, force: true});
fs.mkdirSync(folder, {recursive: true});
for (const world of worlds)
  for (const compress of ['none', 'quantize', 'meshopt', 'draco'])
    for (const draws of ['2', '16']) await check(world, compress, draws);
console.log(faults.slice(0, 40).join('\n'));
console.log(`${tiles} tiles, ${with_places} of them with tables of places, ${faults.length} faults`);
process.exitCode = faults.length || with_places === 0 ? 1 : 0;
