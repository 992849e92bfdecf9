// Animations, played by three.js's AnimationMixer: pictures of the glTF at several times next to wrlkit's of the world as VRML
// has it then, which is computed here from the definition of the interpolators (ISO/IEC 14772-1, 4.6.8) and written down.
//   node three_animations.mjs WRLKIT FOLDER
// The rows of pictures are left in FOLDER/series.
import fs from 'node:fs';
import path from 'node:path';
import {Quaternion, Vector3} from 'three';
import {has_chromium, take_pictures} from './browser.mjs';
import {in_lanes, run} from './program.mjs';

const [wrlkit, folder] = process.argv.slice(2);
const size = {width: 200, height: 150};
const key = [0.85, 0.25, 0.65];
const skipped = 77, cycle = 4;
const times = [0.3, 1.1, 1.9, 2.7, 3.6];
const bound = {overlap: 0.98, difference: 0.005, coverage: 0.01};
const bound_of_made_normals = 0.01;  // between the keys they go evenly, and not with the faces

// ---- VRML ----------------------------------------------------------------------------------------------------------

const line = (a, b, t) => a.map((v, i) => v + t * (b[i] - v));
const quaternion = ([x, y, z, angle]) => new Quaternion().setFromAxisAngle(new Vector3(x, y, z).normalize(), angle);
function turn(a, b, t) {
  const q = quaternion(a).slerp(quaternion(b), t).normalize(), s = Math.hypot(q.x, q.y, q.z);
  return s > 0 ? [q.x / s, q.y / s, q.z / s, 2 * Math.atan2(s, q.w)] : [0, 0, 1, 0];
}

/// What an interpolator says at a fraction: of its values, those around the fraction and the way from one to the other.
function value_at({key, keyValue, between = line}, fraction) {
  if (fraction >= key.at(-1)) return keyValue.at(-1);
  const i = Math.max(0, key.findIndex(k => k > fraction) - 1);
  return fraction <= key[0] ? keyValue[0] : between(keyValue[i], keyValue[i + 1], (fraction - key[i]) / (key[i + 1] - key[i]));
}

// ---- worlds --------------------------------------------------------------------------------------------------------

const look = 'appearance Appearance { material Material { diffuseColor 0.2 0.7 0.4 } }';
const box = `Shape { ${look} geometry Box { size 1 1.5 0.5 } }`;
const frame = 'Shape { appearance Appearance { material Material { diffuseColor 0.8 0.8 0.3 } } geometry Box { size 4 0.2 0.2 } } Viewpoint { position 0 1 7 }';
const clock = `DEF C TimeSensor { cycleInterval ${cycle} loop TRUE }`;
const driven = (type, {key, keyValue}, event, name = 'I') =>
  `DEF ${name} ${type} { key [ ${key} ] keyValue [ ${keyValue.flat()} ] } ROUTE C.fraction_changed TO ${name}.set_fraction ROUTE ${name}.value_changed TO ${event}`;

const way = {key: [0, 0.3, 1], keyValue: [[-1.5, 0, 0], [1, 1.5, 0], [0, -1, 1]]};
const swing = {key: [0, 0.4, 1], keyValue: [[0, 0, 1, 0], [0, 0, 1, 3], [1, 0, 0, 1]], between: turn};
const growth = {key: [0, 0.5, 1], keyValue: [[1, 1, 1], [2, 0.5, 1], [0.5, 1.5, 1]]};
const cloth = (a, b) => [-2, -1, 0, 0, -1, a, 2, -1, 0, 2, 1, b, 0, 1, -a, -2, 1, 0].map((v, i) => i % 3 === 1 ? v * (1 + 0.3 * b) : v);
const waves = {key: [0, 0.35, 0.7, 1], keyValue: [cloth(0, 0), cloth(0.6, 0.4), cloth(-0.3, -0.2), cloth(0, 0)]};
const up = a => [0, 1, 2, 3, 4, 5].flatMap(() => [Math.sin(a), 0, Math.cos(a)]);
const sweep = {key: [0, 0.5, 1], keyValue: [up(0), up(0.6), up(-0.6)]};
const flag = (points, normals) => `Shape { ${look} geometry IndexedFaceSet { solid FALSE creaseAngle 0 coord DEF P Coordinate { point [ ${points} ] }
  ${normals ? `normal DEF N Normal { vector [ ${normals} ] }` : ''} coordIndex [ 0 1 4 -1 0 4 5 -1 1 2 3 -1 1 3 4 -1 ] } }`;
const ease = {key: [0, 0.5, 1], keyValue: [[0], [1], [0.2]]};
const chained = {...way, at: f => value_at(way, value_at(ease, f)[0])};
const proto = body => `PROTO Mover [ field SFVec3f from 0 0 0 ] { ${body} } Mover {}`;

/// still(fraction): the world as it is then. moving: the world with what moves it.
const worlds = [
  {name: 'position', still: f => `Transform { translation ${value_at(way, f).join(' ')} children ${box} }`,
    moving: `DEF M Transform { children ${box} } ${clock} ${driven('PositionInterpolator', way, 'M.set_translation')}`},
  {name: 'orientation', still: f => `Transform { center 0.5 0.5 0 rotation ${value_at(swing, f).join(' ')} children ${box} }`,
    moving: `DEF M Transform { center 0.5 0.5 0 children ${box} } ${clock} ${driven('OrientationInterpolator', swing, 'M.set_rotation')}`},
  {name: 'scale', still: f => `Transform { scale ${value_at(growth, f).join(' ')} scaleOrientation 0 0 1 0.5 children ${box} }`,
    moving: `DEF M Transform { scaleOrientation 0 0 1 0.5 children ${box} } ${clock} ${driven('PositionInterpolator', growth, 'M.scale')}`},
  {name: 'coordinates', still: f => flag(value_at(waves, f)),
    moving: `${flag(cloth(0, 0))} ${clock} ${driven('CoordinateInterpolator', waves, 'P.set_point')}`},
  {name: 'normals', still: f => flag(cloth(0, 0), value_at(sweep, f)),
    moving: `${flag(cloth(0, 0), up(0))} ${clock} ${driven('NormalInterpolator', sweep, 'N.set_vector')}`},
  {name: 'both', still: f => flag(value_at(waves, f), value_at(sweep, f)),
    moving: `${flag(cloth(0, 0), up(0))} ${clock} ${driven('CoordinateInterpolator', waves, 'P.point')} ${driven('NormalInterpolator', sweep, 'N.vector', 'J')}`},
  {name: 'behind_one_another', still: f => `Transform { translation ${chained.at(f).join(' ')} children ${box} }`,
    moving: `DEF M Transform { children ${box} } ${clock} DEF E ScalarInterpolator { key [ ${ease.key} ] keyValue [ ${ease.keyValue.flat()} ] }
      DEF I PositionInterpolator { key [ ${way.key} ] keyValue [ ${way.keyValue.flat()} ] }
      ROUTE C.fraction_changed TO E.set_fraction ROUTE E.value_changed TO I.set_fraction ROUTE I.value_changed TO M.set_translation`},
  {name: 'in_a_prototype', still: f => `Transform { translation ${value_at(way, f).join(' ')} children ${box} }`,
    moving: proto(`Group { children [ DEF M Transform { translation IS from children ${box} } ] } ${clock} ${driven('PositionInterpolator', way, 'M.translation')}`)},
];

// ---- pictures ------------------------------------------------------------------------------------------------------

const write = (name, body) => fs.writeFileSync(path.join(folder, name), `#VRML V2.0 utf8\n${frame}\n${body}\n`);

async function prepare({name, still, moving}) {
  const at = file => path.join(folder, file);
  write(`${name}.wrl`, moving);
  const runs = [await run(wrlkit, ['convert', '-q', at(`${name}.wrl`), at(`${name}.glb`)])];
  const frames = [];
  for (const [i, time] of times.entries()) {
    write(`${name}_${i}.wrl`, still(time / cycle));
    runs.push(await run(wrlkit, ['render', '-q', at(`${name}_${i}.wrl`), at(`${name}_${i}.png`), '--width', size.width, '--height', size.height, '--samples', 1, '--background', key]));
    frames.push({time, url: `/out/${name}_${i}.png`});
  }
  const bad = runs.find(r => r.code !== 0);
  if (bad) throw new Error(`${name}: exit code ${bad.code}: ${bad.text.trim()}`);
  return {name, glb: `/out/${name}.glb`, camera: 0, ...size, background: key, key, reach: 0, lighting: 'vrml', frames};
}

function report({name, overlap, difference, coverage, sheet, error}) {
  const good = !error && overlap >= bound.overlap && difference <= (name === 'coordinates' ? bound_of_made_normals : bound.difference) && coverage >= bound.coverage;
  console.log(error ?? `${[overlap, difference, coverage].map(v => v.toFixed(4)).join('  ')}  ${name}${good ? '' : ': beyond the bounds'}`);
  if (sheet) fs.writeFileSync(path.join(folder, 'series', `${name}.png`), Buffer.from(sheet.split(',')[1], 'base64'));
  return good;
}

async function main() {
  if (!has_chromium) return console.log('skipped: there is no Chromium (WRLKIT_CHROMIUM)'), skipped;
  fs.rmSync(folder, {recursive: true, force: true});
  fs.mkdirSync(path.join(folder, 'series'), {recursive: true});
  const jobs = [];
  await in_lanes(worlds.entries(), 2, async ([i, world]) => { jobs[i] = await prepare(world); });
  let failed = 0;
  console.log(`overlap, mean difference, coverage: the worst of ${times.length} times`);
  await take_pictures(folder, jobs, result => { failed += report(result) ? 0 : 1; });
  return failed ? 1 : 0;
}

process.exitCode = await main();
