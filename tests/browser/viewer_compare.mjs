// Two worlds in the viewer page: the deviation is what `wrlkit diff` measures, the coloured surface has it where it is said to be,
// and every way to compare shows a picture of its own.
//   node viewer_compare.mjs WRLKIT FOLDER
import assert from 'node:assert';
import fs from 'node:fs';
import path from 'node:path';
import {number_of, open_page, start_chromium, wrlkit} from './viewer_page.mjs';
import {file_of} from './worlds.mjs';

const [program, folder] = process.argv.slice(2);
fs.mkdirSync(folder, {recursive: true});
const model = file_of('corpus/paper/ellipsoid_hole.wrl'), html = path.join(folder, 'compare.html');
wrlkit(program, 'simplify', '-q', model, '--counts', '120', '-o', folder);
const simple = path.join(folder, fs.readdirSync(folder).find(name => /_\d+\.wrl$/.test(name)));
const contents = JSON.parse(wrlkit(program, 'view', '-q', '--json', model, simple, '-o', html));
const {surface, triangles} = JSON.parse(wrlkit(program, 'diff', '-q', '--json', model, simple));
const near = (a, b, part) => assert(Math.abs(a - b) <= part * Math.abs(b), `${a} is not ${b}`);

assert.deepEqual(contents, {file: html, bytes: fs.statSync(html).size, worlds: [model, simple].map(file => path.basename(file)), criteria: [], deviation: surface.max});

const browser = await start_chromium();
try {
  const {page, faults} = await open_page(browser, html);
  const picture = () => page.evaluate(() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(() => done(document.querySelector('.view canvas').toDataURL())))));
  near(number_of((await page.textContent('#largest-deviation')).replace(' mm', '')), surface.max * 1000, 0.006);
  const cells = await page.locator('tbody tr').first().locator('td').allTextContents();
  assert.deepEqual(cells.slice(1, 3).map(number_of), triangles);

  const pictures = new Set([await picture()]);
  for (const layout of ['Side by side', 'Difference', 'Deviation']) {
    await page.getByLabel(layout, {exact: true}).check({force: true});
    await page.waitForTimeout(300);
    pictures.add(await picture());
  }
  assert.equal(pictures.size, 4, 'every way has a picture of its own');
  await page.getByRole('radio', {name: 'Divider'}).check({force: true});
  await page.getByRole('slider', {name: 'Divider'}).press('ArrowLeft');
  assert.equal(await page.getByRole('slider', {name: 'Divider'}).getAttribute('aria-valuenow'), '48');
  pictures.add(await picture());
  assert.equal(pictures.size, 5, 'the divider moves');

  // The worst place is one click away: in the middle of the picture, and the surface has its largest distance there.
  await page.getByRole('button', {name: 'Go to the worst place'}).click();
  await page.waitForFunction(() => window.viewer.compare.heat[window.viewer.compare.side]);
  const {largest, away, where, pivot} = await page.evaluate(() => {
    const {heat, side, apart, stage} = window.viewer.compare;
    const {geometry, position} = heat[side].mesh, d = geometry.attributes.distance.array, p = geometry.attributes.position.array;
    const at = d.indexOf(d.reduce((a, b) => Math.max(a, b), 0));
    const place = [0, 1, 2].map(k => p[3 * at + k] + position.toArray()[k]);
    return {largest: d[at], away: Math.hypot(...place.map((x, k) => x - apart.where[k])), where: apart.where, pivot: stage.navigator.pivot.toArray()};
  });
  near(largest, surface.max, 0.1);
  assert(away < 0.3, `the largest distance of the surface is ${away} m from the worst place`);
  pivot.forEach((x, k) => near(x, where[k], 1e-6));
  assert.deepEqual(faults, []);
  console.log(`largest deviation ${surface.max} m; of the coloured surface ${largest} m, ${away.toPrecision(2)} m from there`);
} finally {
  await browser.close();
}
