// Ways to write baked light (--lightmap-as) by viewers: the table of docs/lighting.md. Each cell is a picture, and the mean difference of its channels, in
// 255ths, from what `wrlkit render` shows of base-color. For people: it takes minutes.
//   node lit_matrix.mjs WRLKIT FOLDER [WORLD]      prints the table; pictures are left in FOLDER
import fs from 'node:fs';
import path from 'node:path';
import {bundle_babylon, has_babylon} from './babylon.mjs';
import {has_chromium, take_pictures} from './browser.mjs';
import {ahead, run} from './program.mjs';
import {view_of} from './view.mjs';
import {open_page, start_chromium} from './viewer_page.mjs';
import {file_of} from './worlds.mjs';

const [wrlkit, folder, world = file_of('corpus/paper/stairs_room.wrl')] = process.argv.slice(2);
const skipped = 77, key = [0.85, 0.25, 0.65], size = {width: 320, height: 240};
const ways = ['base-color', 'emissive', 'occlusion', 'moz', 'extras'];
/// Which words of a job have the page draw it with what.
const viewers = {'three.js': {lighting: 'three'}, 'Babylon.js': {babylon: true}, CesiumJS: {cesium_model: true}};
const out = name => path.join(folder, name);

async function must(args) {
  const done = await run(wrlkit, args, 300);
  if (done.code !== 0 && done.code !== 1) throw new Error(`${args.join(' ')}: ${done.text}`);
}

const draw = (file, picture, view) => must(['render', '-q', file, picture, '--width', size.width, '--height', size.height, '--samples', 1, '--background', ...key, ...view.flags]);

/// The file of a way, and what `wrlkit render` shows of it.
async function prepare(way) {
  const glb = out(`${way}.glb`);
  await must(['convert', '-q', world, glb, '-p', 'lightmap{quality=draft}', '--lightmap-as', way]);
  const view = view_of(wrlkit, world, glb, false);
  await draw(glb, out(`${way}.png`), view);
  return {way, camera: view.camera};
}

/// A job of the page: viewers differ in how they are given the picture to compare with.
function job_of({way, camera}, viewer, reference) {
  const url = `/out/${reference}.png`, words = viewers[viewer];
  return {name: `${viewer}|${way}`, ...words, glb: `/out/${way}.glb`, camera, ...size, background: key, key, reference: words.lighting ? [{label: 'wrlkit render', url}] : url};
}

/// In the page of `wrlkit view`: the mean difference, from 0 to 1, of what it shows from there and a picture.
async function seen({camera, size, key, reference}) {
  const {mode} = window.viewer, {renderer, camera: eye} = mode.stage;
  mode.stage.invalidate = () => undefined;
  renderer.setPixelRatio(1);
  renderer.setSize(size.width, size.height, false);
  renderer.setClearColor(key.reduce((all, v) => 256 * all + Math.round(255 * v), 0), 1);
  Object.assign(eye, {aspect: size.width / size.height, fov: 45, near: 0.05, far: 1000});
  eye.position.fromArray(camera.eye);
  eye.up.fromArray(camera.up);
  eye.lookAt(...camera.target);
  eye.updateProjectionMatrix();
  eye.updateMatrixWorld();
  mode.draw({renderer, camera: eye, height: size.height});
  const picture = new Image();
  picture.src = reference;
  await picture.decode();
  const [own, other] = [mode.stage.canvas, picture].map(source => {
    const pen = Object.assign(document.createElement('canvas'), size).getContext('2d');
    pen.drawImage(source, 0, 0);
    return pen.getImageData(0, 0, size.width, size.height).data;
  });
  let sum = 0;
  for (let i = 0; i < own.length; ++i) if (i % 4 < 3) sum += Math.abs(own[i] - other[i]);
  return {difference: sum / (255 * 3 * size.width * size.height), picture: mode.stage.canvas.toDataURL()};
}

async function in_the_page(browser, {way, camera}) {
  const html = out(`${way}.html`), reference = `data:image/png;base64,${fs.readFileSync(out('base-color.png')).toString('base64')}`;
  await must(['view', '-q', out(`${way}.glb`), '-o', html, '--criteria', 'quadric']);
  const {page, close} = await open_page(browser, html);
  const {difference, picture} = await page.evaluate(seen, {camera, size, key, reference});
  fs.writeFileSync(out(`wrlkit_view_${way}.png`), Buffer.from(picture.split(',')[1], 'base64'));
  await close();
  return levels(difference);
}

const levels = difference => (255 * difference).toFixed(1);

async function main() {
  if (!has_chromium || !has_babylon) return console.log('skipped: there is no Chromium, Babylon.js or esbuild'), skipped;
  fs.rmSync(folder, {recursive: true, force: true});
  fs.mkdirSync(folder, {recursive: true});
  bundle_babylon(folder);
  const cells = new Map();
  const made = [];
  for await (const file of ahead(ways, 1, prepare)) made.push(file);
  const jobs = made.flatMap(file => Object.keys(viewers).map(viewer => job_of(file, viewer, 'base-color')));
  await take_pictures(folder, jobs, ({name, difference, error, sheet}) => {
    cells.set(name, error ? `failed: ${error.slice(0, 60)}` : levels(difference));
    if (sheet) fs.writeFileSync(out(`${name.replace(/\W+/g, '_')}.png`), Buffer.from(sheet.split(',')[1], 'base64'));
  }, 300);
  const browser = await start_chromium();
  for (const file of made) cells.set(`\`wrlkit view\`|${file.way}`, await in_the_page(browser, file));
  await browser.close();
  console.log(`| | ${ways.join(' | ')} |\n|${'---|'.repeat(ways.length + 1)}`);
  for (const viewer of ['`wrlkit view`', ...Object.keys(viewers)]) console.log(`| ${viewer} | ${ways.map(way => cells.get(`${viewer}|${way}`)).join(' | ')} |`);
  return 0;
}

process.exitCode = await main();
