// The collapse in the viewer page: forward and back, by button, key and click; and at interaction points the faces that are
// shown are those of the files that `wrlkit simplify` writes.
//   node viewer_collapse.mjs WRLKIT FOLDER
import assert from 'node:assert';
import fs from 'node:fs';
import path from 'node:path';
import {number_of, open_page, start_chromium, wrlkit} from './viewer_page.mjs';
import {file_of} from './worlds.mjs';

const [program, folder] = process.argv.slice(2);
fs.mkdirSync(folder, {recursive: true});
const model = file_of('corpus/paper/ellipsoid_hole_fine.wrl'), html = path.join(folder, 'collapse.html');
const criteria = ['length-normal', 'melax', 'lindstrom-turk'];
wrlkit(program, 'view', '-q', model, '-o', html);

/// Nine numbers a triangle, of the one IndexedFaceSet of triangles in a file.
function triangles_of(file) {
  const text = fs.readFileSync(file, 'utf8');
  const list = name => text.match(new RegExp(`${name}\\s*\\[([^\\]]*)\\]`))[1].trim().split(/[\s,]+/).map(Number);
  const point = list('point'), index = list('coordIndex');
  return index.filter(i => i >= 0).flatMap(i => point.slice(3 * i, 3 * i + 3));
}

/// How many triangles of the one list have no counterpart in the other, with each corner no farther away than `reach`.
function differing(list, other, reach) {
  const triangles = numbers => Array.from({length: numbers.length / 9}, (_, t) => numbers.slice(9 * t, 9 * t + 9));
  const middle = t => t[0] + t[3] + t[6];
  const rows = triangles(other).sort((a, b) => middle(a) - middle(b));
  const alike = (a, b, turn) => a.every((x, k) => Math.abs(x - b[(k + 3 * turn) % 9]) <= reach);
  const found = t => {
    let low = 0, high = rows.length;
    while (low < high) {
      const at = (low + high) >> 1;
      if (middle(rows[at]) < middle(t) - 3 * reach) low = at + 1;
      else high = at;
    }
    for (; low < rows.length && middle(rows[low]) <= middle(t) + 3 * reach; ++low) if ([0, 1, 2].some(turn => alike(t, rows[low], turn))) return true;
    return false;
  };
  return triangles(list).filter(t => !found(t)).length;
}

const browser = await start_chromium();
try {
  const {page, faults} = await open_page(browser, html, {fragment: '#mode=collapse'});
  await page.waitForSelector('html[data-collapse]', {state: 'attached'});
  const faces = async () => number_of((await page.locator('.label output').first().textContent()).replace(' faces', ''));
  const picture = () => page.evaluate(() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(() => done(document.querySelector('.view canvas').toDataURL())))));
  const all = JSON.parse(wrlkit(program, 'info', '-q', '--json', model)).triangles;
  assert.equal(await faces(), all);

  // One edge takes two faces; back is where it was.
  const begin = await picture();
  await page.getByRole('button', {name: 'Collapse edge'}).click();
  assert.equal(await faces(), all - 2);
  await page.locator('.view canvas').focus();
  await page.keyboard.press('Space');
  assert.equal(await faces(), all - 4);
  const box = await page.locator('.view canvas').boundingBox();
  await page.mouse.click(box.x + 40, box.y + box.height / 2);
  assert.equal(await faces(), all - 6);
  assert.notEqual(await picture(), begin);
  for (let i = 0; i < 3; ++i) await page.getByRole('button', {name: 'Back'}).click();
  assert.equal(await faces(), all);
  assert(await picture() === begin, 'the picture after three steps and back');

  // Every interaction point against the files of simplify: reached by single steps from above and, from 40 steps below, back.
  const points = (await page.getByRole('group', {name: 'Interaction points'}).getByRole('button').allTextContents()).map(number_of);
  assert(points.length > 15);
  const shown = (i, step) => page.evaluate(([i, step]) => {
    const {run} = window.viewer.collapse.lanes[i];
    const at = step => {
      while (run.at !== Math.min(step, run.steps)) run.goTo(run.at + Math.sign(step - run.at));
      return Array.from(run.shown());
    };
    const down = at(step);
    at(step + 40);
    return {down, is_back: at(step).every((x, k) => x === down[k])};
  }, [i, step]);
  const step_of = (i, faces) => page.evaluate(([i, faces]) => window.viewer.collapse.lanes[i].run.stepOf(faces), [i, faces]);
  let compared = 0;
  for (const [i, criterion] of criteria.entries()) {
    const out = path.join(folder, criterion);
    fs.rmSync(out, {recursive: true, force: true});
    wrlkit(program, 'simplify', '-q', model, '--counts', points.join(), '--criterion', criterion, '-o', out);
    const files = fs.readdirSync(out);
    for (const n of points) {
      const {down, is_back} = await shown(i, await step_of(i, n));
      assert(is_back, `${criterion}: ${n} faces on the way back`);
      const file = files.find(name => Number(name.match(/_(\d+)\.wrl$/)?.[1]) === down.length / 9);
      assert(file, `${criterion}: no file of ${down.length / 9} faces`);
      const expected = triangles_of(path.join(out, file));
      assert.equal(down.length, expected.length);
      // The formulas leave vertices where they were measured; positions in between are rounded to the digits of the file, here four.
      const wrong = differing(down, expected, criterion === 'lindstrom-turk' ? 1e-4 : 1e-7);
      assert.equal(wrong, 0, `${criterion} at ${n} faces: ${wrong} triangles differ`);
      ++compared;
    }
  }

  // The picture, too: shaded, with the triangles of the page and with those of the file.
  await page.getByLabel('Shaded').check({force: true});
  await page.getByLabel('Mark the next edge').uncheck();
  for (const n of [1000, 200, 50]) {
    await page.getByRole('button', {name: n.toLocaleString('en'), exact: true}).click();
    const files = criteria.map(criterion => path.join(folder, criterion, `ellipsoid_hole_fine_${n}.wrl`)).map(triangles_of);
    const differ = await page.evaluate(async files => {
      const {collapse} = window.viewer, {renderer, canvas} = collapse.stage, gl = renderer.getContext();
      const picture = async () => {
        collapse.stage.invalidate();
        for (let i = 0; i < 2; ++i) await new Promise(done => requestAnimationFrame(done));
        const bytes = new Uint8Array(4 * canvas.width * canvas.height);
        gl.readPixels(0, 0, canvas.width, canvas.height, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
        return bytes;
      };
      const own = await picture(), blank = own.slice(0, 3), kept = [];
      collapse.lanes.forEach(({run}, i) => {
        const {geometry, center} = run.steppers[0], place = geometry.getAttribute('position'), middle = center.toArray();
        kept.push(place.array.slice());
        files[i].forEach((x, k) => { place.array[k] = x - middle[k % 3]; });
        place.clearUpdateRanges();
        place.needsUpdate = true;
      });
      const other = await picture();
      collapse.lanes.forEach(({run}, i) => {
        const place = run.steppers[0].geometry.getAttribute('position');
        place.array.set(kept[i]);
        place.needsUpdate = true;
      });
      await picture();
      const apart = (a, b) => { let n = 0; for (let i = 0; i < a.length; i += 4) n += [0, 1, 2].some(k => Math.abs(a[i + k] - b[i + k]) > 8); return n; };
      let seen = 0;
      for (let i = 0; i < own.length; i += 4) seen += [0, 1, 2].some(k => own[i + k] !== blank[k]);
      return {seen, apart: apart(own, other)};
    }, files);
    assert(differ.seen > 10_000, 'the picture is empty');
    assert(differ.apart < differ.seen * 0.0005, `${n} faces: ${differ.apart} of ${differ.seen} pixels differ from the picture of the file`);
  }
  await page.getByLabel('Three greys').check({force: true});
  await page.getByLabel('Mark the next edge').check();

  // View-dependent: what the clock says where the lens is not, more in it; near the eye more than far away.
  await page.getByRole('button', {name: '200', exact: true}).click();
  await page.getByLabel('In a lens').check({force: true});
  const drawn = (x, y) => page.evaluate(([x, y]) => new Promise(done => {
    const {collapse} = window.viewer;
    Object.assign(collapse.lens, {x, y});
    collapse.stage.invalidate();
    requestAnimationFrame(() => requestAnimationFrame(() => done(collapse.lanes.map(lane => lane.drawn))));
  }), [x, y]);
  assert.deepEqual(await drawn(9, 9), [200, 200, 200]);
  for (const n of await drawn(0.5, 0.5)) assert(n > 400 && n < all / 2, `${n} faces with a lens`);
  await page.getByLabel('Near the eye').check({force: true});
  for (const n of await drawn(0, 0)) assert(n > 50 && n < 1000, `${n} faces near the eye`);
  await page.getByLabel('Everywhere').check({force: true});
  assert.deepEqual(await drawn(0, 0), [200, 200, 200]);

  // By itself, until few are left; then it asks.
  await page.getByLabel('Ask for a click only below so many faces').fill('150');
  await page.keyboard.press('Enter');
  await page.getByRole('button', {name: '200', exact: true}).click();
  await page.getByRole('button', {name: 'Play'}).click();
  await page.waitForFunction(() => document.querySelector('.label output').textContent.startsWith('150 '), null, {timeout: 8000});
  await page.getByRole('button', {name: 'Play'}).waitFor();
  await page.getByRole('button', {name: 'Original'}).click();
  assert.equal(await faces(), all);
  assert.deepEqual(faults, []);
  console.log(`${criteria.length} criteria, ${compared} interaction points, down and back: the same triangles and pictures as those of wrlkit simplify`);
} finally {
  await browser.close();
}
