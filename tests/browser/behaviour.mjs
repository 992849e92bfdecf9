// What worlds do as graphs of KHR_interactivity: Babylon.js runs each, is clicked and walked about, and must show what VRML means.
//   node behaviour.mjs WRLKIT FOLDER [NAME]
import assert from 'node:assert';
import {execFileSync, spawnSync} from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';
import {has_chromium, take_pictures} from './browser.mjs';
import {is_color, worlds} from './behaviour_worlds.mjs';

const [wrlkit, folder, only = ''] = process.argv.slice(2);
const here = path.dirname(new URL(import.meta.url).pathname), bundler = path.join(here, '../../viewer/node_modules/.bin/esbuild');
if (!has_chromium || !fs.existsSync(bundler)) process.exit(77);
fs.mkdirSync(folder, {recursive: true});
// Its packages have thousands of modules.
execFileSync(bundler, [path.join(here, 'page/behaviour.mjs'), '--bundle', '--splitting', '--format=esm', '--log-level=warning', `--outdir=${path.join(folder, 'babylon')}`]);

function job_of(world) {
  const file = path.join(folder, `${world.name}.x3dv`), glb = path.join(folder, `${world.name}.glb`);
  fs.writeFileSync(file, world.world);
  const run = spawnSync(wrlkit, ['convert', '-q', '--behaviour', 'interactivity', file, glb], {encoding: 'utf8'});
  assert.equal(run.status, 0, run.stderr);
  const {points, nodes, events, steps, name} = world;
  return {name, behaviour: true, glb: `/out/${name}.glb`, width: 320, height: 240, camera: {eye: [0, 0, 10], target: [0, 0, 0]}, points, nodes, events, steps};
}

const near = (a, b) => a && a.every((v, i) => Math.abs(v - b[i]) < 0.02);
const differs = (a, b) => a.some((v, i) => Math.abs(v - b[i]) > 1e-4);

function judge(world, {states, faults, diagnostics, error}) {
  assert(!error, `${world.name}: ${error}`);
  assert.deepEqual([faults, diagnostics], [[], []], world.name);
  world.expect.forEach((letters, step) => [...letters ?? ''].forEach((letter, i) => {
    const color = states[step].colors[i];
    assert(is_color(color, letter), `${world.name}, step ${step}, point ${i}: ${color} is not '${letter}'`);
  }));
  world.sent?.forEach((sent, step) => assert.deepEqual(states[step].sent, sent, `${world.name}, step ${step}`));
  world.places?.forEach((place, step) => { if (place) assert(near(states[step].places[0], place), `${world.name}, step ${step}: ${states[step].places[0]}`); });
  world.moves?.forEach((moves, step) => {
    if (moves !== null && step > 0) assert.equal(differs(states[step].places[0], states[step - 1].places[0]), moves, `${world.name}, step ${step}: moves`);
  });
}

const patience = 400;  // seconds: the first one loads Babylon.js
const chosen = worlds.filter(world => world.name.includes(only)), failed = [];
await take_pictures(folder, chosen.map(job_of), result => {
  result.states?.forEach(({picture}, i) => fs.writeFileSync(path.join(folder, `${result.name}_${i}.png`), Buffer.from(picture.split(',')[1], 'base64')));
  try {
    judge(chosen.find(world => world.name === result.name), result);
  } catch (fault) {
    failed.push(fault.message);
  }
}, patience);
assert.deepEqual(failed, []);
console.log(`${chosen.length} worlds`);
