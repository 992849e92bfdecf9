// Levels of detail in the viewer page: the slider shows each of them, and by distance they change where the file says.
//   node viewer_levels.mjs WRLKIT FOLDER
import assert from 'node:assert';
import fs from 'node:fs';
import path from 'node:path';
import {number_of, open_page, start_chromium, wrlkit} from './viewer_page.mjs';
import {file_of} from './worlds.mjs';

const [program, folder] = process.argv.slice(2);
fs.mkdirSync(folder, {recursive: true});
const model = file_of('corpus/paper/ellipsoid_hole.wrl'), html = path.join(folder, 'levels.html');
wrlkit(program, 'view', '-q', model, '-o', html, '-p', 'weld,lod', '--criteria', 'quadric');

/// The ranges and triangles that `lod` writes for VRML.
const vrml = path.join(folder, 'levels.wrl');
wrlkit(program, 'convert', '-q', model, vrml, '-p', 'weld,lod');
const lod = JSON.parse(wrlkit(program, 'info', '-q', '--json', vrml)), text = fs.readFileSync(vrml, 'utf8');
const range = text.match(/range\s*\[?([^\]a-z]*)/)[1].trim().split(/[\s,]+/).map(Number);
const center = text.match(/LOD\s*\{[^}]*?center\s+([-\d. e]+)/)?.[1].trim().split(/\s+/).map(Number) ?? [0, 0, 0];

const browser = await start_chromium();
try {
  const {page, faults} = await open_page(browser, html);
  await page.getByRole('tab', {name: 'Levels'}).click();
  const frame = () => page.evaluate(() => new Promise(done => { window.viewer.mode.stage.invalidate(); requestAnimationFrame(() => requestAnimationFrame(done)); }));
  const rows = async () => (await page.locator('#panel-levels tbody tr').allTextContents()).length;
  const shown = async () => {
    await frame();
    const cells = await page.locator('#panel-levels tbody tr td:nth-child(2)').allTextContents();
    return cells.map(number_of).findIndex(n => n > 0);
  };
  const triangles = async level => number_of(await page.locator('#panel-levels tbody tr').nth(level).locator('td').nth(2).textContent());
  await frame();
  const n = await rows();
  assert.equal(n, range.length + 1);

  // The slider: fewer triangles, level by level, beginning with all that there are.
  let before = Infinity;
  for (let level = 0; level < n; ++level) {
    await page.getByRole('slider', {name: 'Level'}).fill(String(level));
    assert.equal(await shown(), level);
    const now = await triangles(level);
    if (level === 0) assert.equal(now, lod.triangles);
    assert(now < before, `${now} triangles at level ${level}`);
    before = now;
  }

  // By distance: each level is shown between its ranges.
  await page.getByRole('radio', {name: 'By distance'}).check({force: true});
  for (let level = 0; level < n; ++level) {
    const distance = level === 0 ? range[0] * 0.97 : level === n - 1 ? range[level - 1] * 1.03 : (range[level - 1] + range[level]) / 2;
    await page.evaluate(([x, y, z, d]) => {
      const {stage} = window.viewer.mode;
      stage.camera.position.set(x, y, z + d);
      stage.camera.quaternion.set(0, 0, 0, 1);
    }, [...center, distance]);
    assert.equal(await shown(), level, `at ${distance} m of ranges ${range}`);
    if (level > 0) assert(number_of((await page.textContent('#pixel-error')).split(' ')[0]) < 1.05, 'no more than a pixel is seen');
  }
  // Popping: of each switch some pixels change, and none when nothing is switched.
  await page.getByRole('button', {name: 'Measure all switches'}).click();
  await page.waitForSelector('#pop-pixels', {timeout: 120_000});
  const [changed, covered] = (await page.textContent('#pop-pixels')).match(/[\d,]+/g).map(number_of);
  assert(changed > 0 && changed < covered, `${changed} of ${covered} pixels`);
  assert.equal(await page.locator('.pops canvas').count(), 3);
  const pops = await page.evaluate(n => Array.from({length: n - 1}, (_, level) => {
    const {mode, world} = window.viewer, object = world.levels[0];
    const pop = mode.popping({object, level}), coarser = object.levels[level + 1];
    object.levels[level + 1] = object.levels[level];
    const same = mode.popping({object, level});
    object.levels[level + 1] = coarser;
    return [pop.changed, pop.covered, pop.distance, same.changed, same.largest];
  }), n);
  pops.forEach(([some, all, distance, same, largest], level) => {
    assert(some > 0 && some < all && same === 0 && largest === 0, `level ${level}: ${some} of ${all}, ${same}`);
    assert(Math.abs(distance - range[level]) < 1e-3 * range[level], `it switches at ${distance}, not at ${range[level]}`);
  });
  await page.getByLabel('Tint by level').check();
  await frame();
  assert.deepEqual(faults, []);
  console.log(`${n} levels, ranges ${range}`);
} finally {
  await browser.close();
}
