// The package wrlkit-three (integrations/three) in Chromium, by its example page as people get it: compiled, next to three.js. Levels of detail change at
// the ranges that VRML has; baked light, with and without directions, looks as in `wrlkit render`; parts in tables have the names and groups
// that they have as nodes; colours, transparency, pictures and lamps are animated as the interpolators of VRML say.
//   node three_package.mjs WRLKIT FOLDER
import assert from 'node:assert';
import {execFileSync} from 'node:child_process';
import fs from 'node:fs';
import http from 'node:http';
import path from 'node:path';
import {serve_file} from './browser.mjs';
import {start_chromium, wrlkit} from './viewer_page.mjs';
import {file_of} from './worlds.mjs';

const [program, folder] = process.argv.slice(2);
const root = path.resolve(path.dirname(new URL(import.meta.url).pathname), '../..'), three = path.join(root, 'integrations/three'), modules = path.join(root, 'viewer/node_modules');
const size = {width: 400, height: 300};

fs.rmSync(folder, {recursive: true, force: true});
fs.mkdirSync(path.join(folder, 'worlds'), {recursive: true});
execFileSync(process.execPath, [path.join(modules, 'typescript/bin/tsc'), '-p', three, '--outDir', path.join(folder, 'dist')], {stdio: 'inherit'});
const shape = JSON.parse(fs.readFileSync(path.join(three, 'package.json'), 'utf8'));
for (const file of [shape.exports['.'].types, shape.exports['.'].import]) assert(fs.existsSync(path.join(folder, file)), file);
assert.deepEqual(Object.keys(shape.peerDependencies), ['three']);
assert.equal(shape.dependencies, undefined);

const convert = (world, name, ...options) => wrlkit(program, 'convert', '-q', world, path.join(folder, 'worlds', name), ...options);
const folders = {example: path.join(three, 'example'), dist: path.join(folder, 'dist'), worlds: path.join(folder, 'worlds'), node_modules: modules};
const server = http.createServer((request, response) => serve_file(folders, request.url, response));
await new Promise(done => server.listen(0, '127.0.0.1', done));
const address = `http://127.0.0.1:${server.address().port}`;
const browser = await start_chromium();

/// The example page with a world in it.
async function open(name, camera = 0) {
  const page = await browser.newPage({viewport: size}), faults = [];
  page.on('pageerror', error => faults.push(String(error)));
  page.on('console', message => { if (message.type() === 'error') faults.push(message.text()); });
  await page.route('**/favicon.ico', route => route.fulfill({status: 204}));
  await page.goto(`${address}/example/index.html?file=../worlds/${name}&camera=${camera}`);
  await page.waitForSelector('html[data-ready]', {state: 'attached', timeout: 60_000}).catch(() => assert.fail(faults.join('\n')));
  return {page, faults};
}

async function levels() {
  const world = file_of('corpus/paper/ellipsoid_hole.wrl'), vrml = path.join(folder, 'levels.wrl');
  wrlkit(program, 'convert', '-q', world, vrml, '-p', 'weld,lod');
  const text = fs.readFileSync(vrml, 'utf8'), range = text.match(/range\s*\[?([^\]a-z]*)/)[1].trim().split(/[\s,]+/).map(Number);
  const center = text.match(/LOD\s*\{[^}]*?center\s+([-\d. e]+)/)?.[1].trim().split(/\s+/).map(Number) ?? [0, 0, 0];
  convert(world, 'levels.glb', '-p', 'weld,lod');
  const {page, faults} = await open('levels.glb');
  for (let level = 0; level <= range.length; ++level) {
    for (const distance of [level ? range[level - 1] * 1.03 : range[0] / 2, level < range.length ? range[level] * 0.97 : range.at(-1) * 3]) {
      const shown = await page.evaluate(([center, distance]) => {
        const {camera, controls, levels, draw} = window.example;
        controls.enabled = false;
        camera.position.set(center[0], center[1], center[2] + distance);
        draw();
        return levels[0].levels.map(o => o.visible);
      }, [center, distance]);
      assert.deepEqual(shown, shown.map((_, k) => k === level), `level ${level} of ranges ${range} at ${distance} m`);
    }
  }
  assert.deepEqual(faults, []);
  await page.close();
  return range.length + 1;
}

/// Mean difference of a page and `wrlkit render`, of 255 levels, where there is something to be seen.
async function apart(name, world, viewpoint = []) {
  const {page, faults} = await open(name);
  const png = path.join(folder, `${name}.png`);
  wrlkit(program, 'render', '-q', world, png, '--width', size.width, '--height', size.height, ...viewpoint);
  const levels = await page.evaluate(async url => {
    const image = new Image();
    image.src = url;
    await image.decode();
    const {renderer, draw} = window.example;
    const pixels = source => {
      const canvas = new OffscreenCanvas(image.width, image.height), context = canvas.getContext('2d');
      context.drawImage(source, 0, 0);
      return context.getImageData(0, 0, image.width, image.height).data;
    };
    const own = pixels(image);
    draw();
    const shown = pixels(renderer.domElement);
    let sum = 0, n = 0;
    for (let i = 0; i < own.length; i += 4) {
      if (own[i] + own[i + 1] + own[i + 2] === 0) continue;
      for (let k = 0; k < 3; ++k, ++n) sum += Math.abs(own[i + k] - shown[i + k]);
    }
    return n > 3000 ? sum / n : NaN;
  }, `data:image/png;base64,${fs.readFileSync(png).toString('base64')}`);
  assert.deepEqual(faults, []);
  if (process.env.WRLKIT_SHOTS) await page.screenshot({path: path.join(folder, `${name}.three.png`)});
  await page.close();
  return levels;
}

async function light() {
  const world = file_of('corpus/features/lightmap.wrl'), ball = path.join(folder, 'ball.wrl'), directed = path.join(folder, 'directed.wrl');
  fs.writeFileSync(ball, `#VRML V2.0 utf8
Viewpoint { position 1.2 0 1.2 orientation 0 1 0 0.7854 }
NavigationInfo { headlight FALSE }
PointLight { location 2 2 3 }
DEF Ball Shape { appearance Appearance { material Material { diffuseColor 0.5 0.5 0.6 specularColor 0.9 0.8 0.7 shininess 0.3 } } geometry Sphere { } }
`);
  wrlkit(program, 'convert', '-q', ball, directed, '--dump', '-p', 'lightmap{quality=draft,max-size=128,directional=true}');
  for (const as of ['moz', 'extras']) {
    convert(world, `${as}.glb`, '--lightmap-as', as);
    convert(directed, `ball_${as}.glb`, '--lightmap-as', as);
  }
  const glow = path.join(folder, 'glow.wrl'), glowing = path.join(folder, 'glowing.wrl');
  fs.writeFileSync(glow, `#VRML V2.0 utf8
Viewpoint { position 0 0 5 }
NavigationInfo { headlight FALSE }
PointLight { location 2 2 3 }
Shape { appearance Appearance { material Material { diffuseColor 0.2 0.2 0.2 emissiveColor 0.9 0.6 0.1 } } geometry Box { } }
`);
  wrlkit(program, 'convert', '-q', glow, glowing, '--dump', '-p', 'lightmap{quality=draft,max-size=64}');
  convert(glowing, 'glow.glb', '--lightmap-as', 'moz');
  const found = {glow: await apart('glow.glb', glowing), moz: await apart('moz.glb', world), extras: await apart('extras.glb', world), directed: await apart('ball_extras.glb', directed), flat: await apart('ball_moz.glb', directed)};
  // Pictures on the floor are filtered in another way.
  assert(found.moz < 4 && found.extras < 4 && found.directed < 1 && found.glow < 2, JSON.stringify(found));
  assert(found.flat > 5, `without directions the highlight is missing: ${JSON.stringify(found)}`);
  return found;
}

async function names() {
  const world = file_of('corpus/plant/pump_room_faces.wrl');
  convert(world, 'nodes.glb');
  convert(world, 'table.glb', '--names', 'table', '--compress', 'meshopt', '-p', 'dedup,instance,merge{parts=true},merge{instanced=true,max-draws=30}');
  const table = fs.readFileSync(path.join(folder, 'worlds/table.glb'), 'latin1');
  assert(table.includes('EXT_mesh_features') && table.includes('EXT_instance_features'));
  const rays = Array.from({length: 600}, (_, i) => [((i * 0.618034) % 1) * 1.9 - 0.95, i / 300 - 1]);
  const seen = [], calls = [];
  for (const name of ['nodes.glb', 'table.glb']) {
    const {page, faults} = await open(name, 0);
    seen.push(await page.evaluate(rays => {
      window.example.draw();
      return rays.map(([x, y]) => window.example.pick(x, y)?.path.join('/') ?? null);
    }, rays));
    calls.push(await page.evaluate(() => window.example.renderer.info.render.calls));
    assert.deepEqual(faults, []);
    await page.close();
  }
  assert(calls[1] < calls[0] / 3, `${calls} draw calls: parts of the table are not drawn together`);
  seen[1] = seen[1].map(n => n?.replace(/#\d+$/, '') ?? null);  // merge tells parts of one name apart
  const both = seen[0].flatMap((n, i) => n !== null && seen[1][i] !== null ? [n === seen[1][i]] : []), same = both.filter(Boolean).length;
  const wrong = seen[0].flatMap((n, i) => n !== seen[1][i] ? [`${n} is ${seen[1][i]}`] : []).slice(0, 5).join('\n');
  assert(both.length > 300 && same >= 0.98 * both.length && new Set(seen[1]).size > 40, `${same} of ${both.length}, ${new Set(seen[1]).size} parts:\n${wrong}`);
  return {same, of: both.length, parts: new Set(seen[1]).size, calls};
}

async function properties() {
  const world = path.join(folder, 'properties.wrl'), cycle = 4, fraction = 0.25;
  const drive = (name, type, values, event) => `DEF ${name} ${type} { key [ 0 1 ] keyValue [ ${values} ] } ROUTE C.fraction_changed TO ${name}.set_fraction ROUTE ${name}.value_changed TO ${event}\n`;
  fs.writeFileSync(world, `#VRML V2.0 utf8
Viewpoint { position 0 0 6 }
DEF Lamp PointLight { location 0 0 3 attenuation 0 0 1 }
Shape { appearance Appearance {
  material DEF M Material { diffuseColor 1 0 0 emissiveColor 0 0 1 transparency 0 }
  texture PixelTexture { image 2 1 1 255 128 } textureTransform DEF T TextureTransform { } }
  geometry Box { } }
DEF C TimeSensor { cycleInterval ${cycle} loop TRUE }
${drive('Red', 'ColorInterpolator', '1 0 0, 0 1 0', 'M.diffuseColor')}${drive('Glow', 'ColorInterpolator', '0 0 1, 0 0 0.2', 'M.emissiveColor')}
${drive('Fade', 'ScalarInterpolator', '0 0.8', 'M.transparency')}${drive('Dim', 'ScalarInterpolator', '1 0', 'Lamp.intensity')}
${drive('Slide', 'PositionInterpolator2D', '0 0, 1 0', 'T.translation')}${drive('Turn', 'ScalarInterpolator', '0 0.0001', 'T.rotation')}`);
  convert(world, 'properties.glb', '--animation-pointer');
  const {page, faults} = await open('properties.glb');
  const seen = await page.evaluate(async time => {
    const {AnimationMixer} = await import('three'), {gltf} = window.example, mixer = new AnimationMixer(gltf.scene);
    let material, lamp;
    gltf.scene.traverse(o => { material ??= o.material; lamp ??= o.isPointLight ? o : undefined; });
    const full = lamp.intensity, placeOf = map => { if (map.matrixAutoUpdate) map.updateMatrix(); return map.matrix.elements.slice(6, 8); };
    for (const clip of gltf.animations) mixer.clipAction(clip).play();
    mixer.setTime(time);
    return {color: material.color.toArray(), emissive: material.emissive.toArray(), opacity: material.opacity, transparent: material.transparent, map: placeOf(material.map), dimmed: lamp.intensity / full};
  }, fraction * cycle);
  assert.deepEqual(faults, []);
  await page.close();
  const linear = v => v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4;
  const close = (found, expected, what) => [found].flat().forEach((v, i) => assert(Math.abs(v - [expected].flat()[i]) < 0.01, `${what}: ${found} instead of ${expected}`));
  close(seen.color, [1, 2 * fraction, 0].map(linear), 'diffuseColor');  // by way of yellow: in HSV
  close(seen.emissive, [0, 0, 1 - 0.8 * fraction].map(linear), 'emissiveColor');
  close(seen.opacity, 1 - 0.8 * fraction, 'transparency');
  assert(seen.transparent);
  close(seen.map, [fraction, 0], 'translation of the picture');
  close(seen.dimmed, 1 - fraction, 'intensity');
  return seen;
}

try {
  console.log('properties:', await properties());
  console.log(`levels: ${await levels()}`);
  console.log('light:', await light());
  console.log('names:', await names());
} finally {
  await browser.close();
  server.close();
}
