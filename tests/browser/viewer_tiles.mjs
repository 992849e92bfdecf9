// The page of a tileset, as `wrlkit view DIR --serve` shows it and next to the tiles on any web server: tiles come, parts have their names at
// three errors, the search finds them, tints change the picture, and no more memory is taken than is allowed.
//   node viewer_tiles.mjs WRLKIT FOLDER
import assert from 'node:assert';
import {spawn} from 'node:child_process';
import fs from 'node:fs';
import http from 'node:http';
import path from 'node:path';
import {judge, number_of, open_page, start_chromium, wrlkit} from './viewer_page.mjs';
import {file_of} from './worlds.mjs';

const [program, folder] = process.argv.slice(2);
fs.rmSync(folder, {recursive: true, force: true});
fs.mkdirSync(folder, {recursive: true});
const world = file_of('corpus/plant/pump_room_primitives.wrl'), set = path.join(folder, 'set');
for (const [out, ...more] of [['set', '--tileset-tiles', '8'], ['draco', '--compress', 'draco'], ['earth', '--at', '50.1,8.6,112,30']]) wrlkit(program, 'tiles', '-q', world, '-o', path.join(folder, out), '--triangles', '3000', ...more);

// Bolts that are one surface: a tile stores it once, with a table of places.
const bolts = Array.from({length: 24}, (_, i) => ({name: `Bolt_${i}`, at: [3 * i, i % 4, 5 * (i % 3)]}));
const bolt = ({name, at}, i) => `DEF ${name} Transform { translation ${at.join(' ')} rotation 1 0 0 ${i % 5} children USE Bolt }`;
fs.writeFileSync(path.join(folder, 'bolts.wrl'), `#VRML V2.0 utf8
Switch { choice DEF Bolt Shape { appearance Appearance { material Material { diffuseColor 0.7 0.5 0.2 } } geometry Cylinder { radius 0.5 height 2 } } }
DEF Rack Group { children [ ${bolts.map(bolt).join('\n')} ] }
`);
wrlkit(program, 'tiles', '-q', path.join(folder, 'bolts.wrl'), '-o', path.join(folder, 'bolts'));

/// {address, stop} of what --serve says.
async function serve(tileset) {
  const server = spawn(program, ['view', '-q', tileset, '--serve'], {stdio: ['ignore', 'pipe', 'inherit']});
  const address = await new Promise((resolve, reject) => {
    server.stdout.setEncoding('utf8').once('data', text => resolve(text.trim()));
    server.once('exit', code => reject(new Error(`it ended with ${code}`)));
  });
  return {address, stop: () => server.kill()};
}

function code_of(address, file, host) {
  const {hostname, port} = new URL(address);
  return new Promise((resolve, reject) => http.get({hostname, port, path: file, headers: host ? {Host: host} : {}}, response => resolve(response.resume().statusCode)).on('error', reject));
}

/// Any web server for plain files.
async function plain_server() {
  const server = http.createServer((request, response) => fs.createReadStream(path.join(folder, new URL(request.url, 'http://x').pathname)).on('error', () => response.writeHead(404).end()).pipe(response));
  await new Promise(done => server.listen(0, '127.0.0.1', done));
  return server;
}

/// What the page shows when nothing is loaded any more.
const settle = page => page.evaluate(async () => {
  const {mode} = window.viewer, wait = () => new Promise(done => setTimeout(done, 30));
  for (let quiet = 0, i = 0; quiet < 6; ++i) {
    if (i > 2000) throw new Error('tiles are still being loaded');
    mode.stage.invalidate();
    await wait();
    quiet = mode.set.loading || mode.set.shown.length === 0 ? 0 : quiet + 1;
  }
  const {figures} = mode.stage;
  return {tiles: mode.set.shown.length, triangles: figures.triangles, error: mode.set.error, kept: mode.set.kept, failed: mode.failed};
});
const picture = page => page.evaluate(() => document.querySelector('.view canvas').toDataURL());
const set_error = (page, i) => page.getByRole('slider', {name: 'Error in pixels'}).fill(String(i));
const tab = (page, name) => page.getByRole('tab', {name}).click();

/// The paths under some points of the picture, by clicks of the mouse.
async function names_at(page, points) {
  const box = await page.locator('.view canvas').boundingBox(), out = [];
  for (const [x, y] of points) {
    await page.mouse.click(box.x + x * box.width, box.y + y * box.height);
    out.push(await page.evaluate(() => { const part = window.viewer.mode.selected, names = []; for (let p = part; p; p = p.parent) names.unshift(p.name); return names.join('/'); }));
  }
  return out;
}

async function check_page(page, browser_faults) {
  const first = await settle(page), counts = [];
  assert(first.tiles > 0 && first.triangles > 100 && !first.failed, JSON.stringify(first));
  // Three errors: fewer tiles and triangles, and the same names under the mouse.
  const points = [0.35, 0.45, 0.55, 0.65].flatMap(x => [0.4, 0.5, 0.6].map(y => [x, y])), names = [];
  for (const [slider, pixels] of [[0, 0], [4, 8], [7, 64]]) {
    await tab(page, 'Figures');
    await set_error(page, slider);
    counts.push(await settle(page));
    assert(counts.at(-1).error <= Math.max(pixels, 1e-9), `error of ${counts.at(-1).error} pixels instead of ${pixels}`);
    names.push(await names_at(page, points));
  }
  assert(counts[0].triangles > counts[1].triangles && counts[1].triangles >= counts[2].triangles && counts[0].tiles > counts[2].tiles, JSON.stringify(counts));
  const hit = points.map((_, i) => i).filter(i => names.every(n => n[i]));
  assert(hit.length >= 5, `${hit.length} points meet a part at all errors`);
  assert(names[0].filter(Boolean).every(n => n.includes('/')), names[0].join(', '));
  const same = hit.filter(i => names[1][i] === names[0][i]).length / hit.length, coarse = hit.filter(i => names[2][i] === names[0][i]).length / hit.length;
  assert(same >= 0.9 && coarse >= 0.6, `${same} and ${coarse} of the points show the same part`);
  assert.deepEqual(browser_faults, []);
  return {counts, names: names[0]};
}

async function check_tints(page) {
  await tab(page, 'Figures');
  await set_error(page, 4);
  await page.keyboard.press('Escape');
  await settle(page);
  const pictures = [await picture(page)];
  await tab(page, 'View');
  for (const name of ['By level', 'By tile']) {
    await page.getByRole('radio', {name}).check({force: true});
    await settle(page);
    pictures.push(await picture(page));
  }
  await page.getByLabel('Boxes of tiles').check();
  await settle(page);
  pictures.push(await picture(page));
  assert.equal(new Set(pictures).size, pictures.length, 'tints and boxes change the picture');
  await page.screenshot({path: path.join(folder, 'tint.png')});
  await page.getByLabel('Boxes of tiles').uncheck();
  await page.getByRole('radio', {name: 'Own'}).check({force: true});
  await settle(page);
  assert.equal(await picture(page), pictures[0], 'and back');
}

async function check_search(page, path_of_part) {
  const name = path_of_part.split('/').at(-1);
  await page.getByRole('searchbox').fill(name);
  await page.getByRole('searchbox').press('Enter');
  await settle(page);
  assert.equal((await page.textContent('#part-path')).split('/').at(-1), name);
  assert((await page.locator('.rows .part').allTextContents()).some(row => row.startsWith(name)));
  await page.screenshot({path: path.join(folder, 'search.png')});
  await page.getByRole('searchbox').fill('');
}

/// With a budget that is smaller than the set, no more is kept than it and the tiles of one picture.
async function check_memory(page) {
  await tab(page, 'Figures');
  await set_error(page, 0);
  const all = (await settle(page)).kept, budget = Math.round(all / 3);
  await page.evaluate(budget => window.viewer.mode.setBudget(budget), budget);
  const kept = await page.evaluate(async () => {
    const {mode} = window.viewer, most = [];
    for (let i = 0; i < 60; ++i) {
      const size = mode.box.max.clone().sub(mode.box.min);
      mode.stage.navigator.take(mode.box.min.clone().addScaledVector(size, (i % 20) / 20), mode.stage.camera.quaternion, size.length() / 8);
      mode.stage.invalidate();
      await new Promise(done => setTimeout(done, 60));
      if (i > 10) most.push(mode.set.kept);
    }
    return Math.max(...most);
  });
  assert(kept <= 1.25 * budget, `${kept} bytes are kept, ${budget} are allowed, ${all} are all of it`);
  return {all, budget, kept};
}

/// Each place of a surface is a part: its name is under the mouse, its box where it stands, and it alone is lit up.
async function check_places(page) {
  const {places, parts} = await page.evaluate(() => {
    const {mode} = window.viewer;
    let places = 0;
    mode.set.tiles.group.traverse(o => { if (o.isInstancedMesh) places += o.count; });
    const described = part => {
      const middle = part.box.getCenter(part.box.min.clone()), at = middle.clone().project(mode.stage.camera);
      return {name: part.name, middle: [...middle], x: (at.x + 1) / 2, y: (1 - at.y) / 2};
    };
    return {places, parts: mode.names.parts.filter(part => part.name.startsWith('Bolt_')).map(described)};
  });
  assert.equal(places, bolts.length);
  assert.equal(parts.length, bolts.length);
  const [first] = parts, start = bolts.find(b => b.name === first.name);
  for (const part of parts) {
    const wanted = bolts.find(b => b.name === part.name).at;
    part.middle.forEach((x, k) => assert(Math.abs(x - first.middle[k] - (wanted[k] - start.at[k])) < 0.01, `${part.name} is at ${part.middle}`));
  }
  const found = await names_at(page, parts.map(({x, y}) => [x, y]));
  const right = found.filter((name, i) => name === `bolts.wrl/Rack/${parts[i].name}/Bolt`).length;
  assert(right >= 20 && found.every(name => !name || name.startsWith('bolts.wrl/Rack/Bolt_')), `${right} of ${bolts.length} bolts are picked by their names: ${found}`);
  const lit = [];
  for (const {name} of parts.slice(0, 3)) lit.push(await page.evaluate(name => { const {mode} = window.viewer; mode.select(mode.names.parts.find(part => part.name === name)); return mode.highlight.triangles; }, name));
  const all = await page.evaluate(() => { const {mode} = window.viewer; mode.select(mode.names.roots[0]); return mode.highlight.triangles; });
  assert(lit[0] > 10 && lit.every(n => n === lit[0]) && all === lit[0] * bolts.length, `${lit} triangles are lit up, ${all} of all`);
  console.log(`${places} places of one surface, ${right} of them picked`);
}

const browser = await start_chromium();
const first = await serve(set), others = [];
try {
  for (const file of ['/../set/tileset.json', '/%2e%2e/set/tileset.json', '//etc/passwd', '/.', '/tiles', '/nothing.glb']) assert.equal(await code_of(first.address, file), 404, file);
  fs.writeFileSync(path.join(folder, 'secret.json'), '{}');
  fs.symlinkSync('../secret.json', path.join(set, 'link.json'));
  fs.writeFileSync(path.join(set, 'notes.txt'), 'x');
  for (const file of ['/link.json', '/notes.txt']) assert.equal(await code_of(first.address, file), 404, file);
  assert.equal(await code_of(first.address, '/tileset.json'), 200);
  assert.equal(await code_of(first.address, '/tileset.json', `evil.example:${new URL(first.address).port}`), 404);
  const begin = performance.now();
  const {page, faults, close} = await open_page(browser, first.address);
  await page.waitForFunction(() => window.viewer?.mode.set.shown.length > 0 && window.viewer.mode.stage.figures.triangles > 0);
  const seconds = (performance.now() - begin) / 1000;
  await settle(page);
  await page.screenshot({path: path.join(folder, 'first.png')});
  const seen = await check_page(page, faults);
  await check_search(page, seen.names.find(Boolean));
  await check_tints(page);
  await judge(page, 'the page of a tileset');
  const memory = await check_memory(page);
  assert.deepEqual(faults, []);
  assert(number_of((await page.textContent('#tiles-loaded'))) > 0);
  await close();
  console.log(`first picture after ${seconds.toFixed(2)} s`, seen.counts.map(c => `${c.tiles} tiles, ${c.triangles} triangles, ${c.error.toFixed(2)} px`), memory);

  // A view that is shared: its part is selected when its tile has come.
  const shared = await open_page(browser, first.address, {fragment: `#select=${encodeURIComponent(seen.names.find(Boolean))}&tint=level`, dark: true});
  await settle(shared.page);
  assert.equal(await shared.page.textContent('#part-path'), seen.names.find(Boolean));
  await shared.page.screenshot({path: path.join(folder, 'dark.png')});
  await shared.close();

  // The plain page next to the tiles, with Draco; on the Earth it stands upright at the origin.
  const server = await plain_server();
  others.push(() => server.close());
  for (const name of ['draco', 'earth', 'bolts']) {
    wrlkit(program, 'view', '-q', path.join(folder, name, 'tileset.json'), '-o', path.join(folder, name, 'index.html'));
    const opened = await open_page(browser, `http://127.0.0.1:${server.address().port}/${name}/index.html`);
    const figures = await settle(opened.page);
    assert(figures.triangles > 100 && !figures.failed, `${name}: ${JSON.stringify(figures)}`);
    await opened.page.screenshot({path: path.join(folder, `${name}.png`)});
    const box = await opened.page.evaluate(() => [...window.viewer.mode.box.min, ...window.viewer.mode.box.max]);
    assert(box.every(x => Math.abs(x) < 1000), `${name}: ${box}`);
    if (name === 'bolts') await check_places(opened.page);
    assert.deepEqual(opened.faults, [], name);
    await opened.close();
  }
} finally {
  for (const stop of others) stop();
  first.stop();
  await browser.close();
}
