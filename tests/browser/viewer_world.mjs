// The viewer page of a world: what it counts is what `wrlkit info` counts, parts are selected by click and by search, and
// nothing is said on the console or asked of a network.
//   node viewer_world.mjs WRLKIT FOLDER
import assert from 'node:assert';
import fs from 'node:fs';
import path from 'node:path';
import {open_page, number_of, start_chromium, wrlkit} from './viewer_page.mjs';
import {file_of} from './worlds.mjs';

const [program, folder] = process.argv.slice(2);
fs.mkdirSync(folder, {recursive: true});
const browser = await start_chromium();

const world = file_of('corpus/plant/pump_room_faces.wrl'), html = path.join(folder, 'world.html');
wrlkit(program, 'view', '-q', world, '-o', html, '--criteria', 'quadric');
const info = JSON.parse(wrlkit(program, 'info', '-q', '--json', world));

async function figures_and_selection() {
  const {page, faults, close} = await open_page(browser, html);
  assert.equal(number_of(await page.textContent('#world-triangles')), info.triangles);
  const unique = number_of(await page.textContent('#world-unique'));
  assert(unique > 0 && unique <= info.triangles);
  assert.equal(await page.title(), 'pump_room_faces.wrl: wrlkit');

  // The heaviest part is the first of the table, and one click away.
  const first = page.locator('table tbody tr').first();
  const heaviest = {name: await first.locator('td').nth(0).textContent(), triangles: await first.locator('td').nth(2).textContent()};
  await first.getByRole('button').click();
  assert.equal(await page.textContent('#part-triangles'), heaviest.triangles);
  assert.equal(await page.locator('.part[aria-selected=true] .name').textContent(), heaviest.name);

  // By search. It is looked at then, so a click into the middle of the picture meets it, or what stands before it.
  await page.getByRole('searchbox').fill('Receiver_shell');
  await page.getByRole('searchbox').press('Enter');
  assert.equal(await page.locator('#panel-part h2').first().textContent(), 'Receiver_shell');
  await page.locator('canvas').first().focus();
  await page.keyboard.press('Escape');
  assert.equal(await page.locator('.part[aria-selected=true]').count(), 0);
  const box = await page.locator('.view canvas').boundingBox();
  await page.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
  assert.equal(await page.locator('.part[aria-selected=true]').count(), 1);
  assert(number_of(await page.textContent('#part-triangles')) > 0);

  // Its 623 shapes are drawn in few calls, and each can be hidden all the same.
  const figures = () => page.evaluate(() => new Promise(done => { window.viewer.mode.stage.invalidate(); requestAnimationFrame(() => requestAnimationFrame(() => done(window.viewer.mode.stage.figures))); }));
  await page.keyboard.press('f');
  const before = await figures();
  assert(before.draws < 60, `${before.draws} draws`);
  await page.getByRole('button', {name: 'Show only this'}).click();
  assert((await figures()).triangles < before.triangles);
  await page.getByRole('button', {name: 'Show all'}).click();
  assert.equal((await figures()).triangles, before.triangles);

  // The address keeps it.
  const selected = await page.locator('#panel-part h2').first().textContent();
  await page.waitForFunction(() => location.hash.includes('select='));
  const fragment = new URL(page.url()).hash;
  const other = await open_page(browser, html, {fragment: `${fragment}&edges=1`});
  assert(await other.page.getByLabel('Edges (hidden lines removed)').isChecked());
  assert.equal(await other.page.locator('#panel-part h2').first().textContent(), selected);
  assert.deepEqual([...faults, ...other.faults], []);
  await close(), await other.close();
}

/// A picture of the canvas as bytes, to be told from another.
const picture = page => page.locator('.view canvas').screenshot();

async function display() {
  const {page, faults, close} = await open_page(browser, html);
  await page.getByRole('tab', {name: 'View'}).click();
  const plain = await picture(page);
  const seen = [plain];
  // The last picture taken, as soon as it is as wanted, or after five seconds.
  const shows = async (wanted, what) => {
    let now = await picture(page);
    for (let i = 0; i < 25 && !wanted(now); ++i) {
      await page.waitForTimeout(200);
      now = await picture(page);
    }
    assert(wanted(now), what);
    return now;
  };
  // Each of them shows what none before has shown.
  const differs = async what => { seen.push(await shows(now => !seen.some(other => other.equals(now)), what)); };
  for (const label of ['Edges (hidden lines removed)', 'Bounding boxes', 'Sky of the world']) {
    await page.getByLabel(label).check();
    await differs(label);
    await page.getByLabel(label).uncheck();
    await shows(now => !now.equals(seen.at(-1)), `${label}, taken back`);
  }
  await page.getByLabel('Off', {exact: true}).check({force: true});
  await differs('light off');
  await page.getByRole('button', {name: 'Platform'}).click();
  await differs('viewpoint');
  assert.deepEqual(faults, []);
  await close();
}

async function phone() {
  const {page, faults, close} = await open_page(browser, html, {width: 390, height: 800, touch: true});
  assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 390);
  await page.getByRole('button', {name: 'Parts', exact: true}).tap();
  await page.getByRole('treeitem', {name: /Building/}).tap();
  await page.getByRole('button', {name: 'Panel', exact: true}).tap();
  assert.equal(await page.locator('#panel-part h2').first().textContent(), 'Building');

  // Fingers: one turns, two come nearer and do not select; a tap does, and the picture says what.
  await page.getByRole('button', {name: 'Picture', exact: true}).tap();
  const cdp = await page.context().newCDPSession(page);
  const touch = (type, ...at) => cdp.send('Input.dispatchTouchEvent', {type, touchPoints: at.map(([x, y], id) => ({x, y, id}))});
  const place = () => page.evaluate(() => { const {camera, navigator} = window.viewer.mode.stage; return {eye: camera.position.toArray(), distance: navigator.distance}; });
  const before = await place();
  await touch('touchStart', [200, 400]);
  for (let i = 1; i < 6; ++i) await touch('touchMove', [200 + 20 * i, 400]);
  await touch('touchEnd');
  const turned = await place();
  assert(Math.abs(turned.distance - before.distance) < 1e-9 && Math.abs(turned.eye[0] - before.eye[0]) > 0.1);
  await touch('touchStart', [150, 400], [250, 400]);
  for (let i = 1; i < 6; ++i) await touch('touchMove', [150 - 10 * i, 400], [250 + 10 * i, 400]);
  await touch('touchEnd');
  assert(Math.abs((await place()).distance / turned.distance - 0.5) < 0.01);
  await page.evaluate(() => window.viewer.mode.select(null));
  await touch('touchStart', [150, 400], [250, 400]);
  await touch('touchEnd');
  assert.equal(await page.evaluate(() => window.viewer.mode.selected), null);
  await page.touchscreen.tap(200, 420);
  const name = await page.evaluate(() => window.viewer.mode.selected.name);
  await page.waitForFunction(name => document.querySelector('.status').textContent.startsWith(`${name} · `), name);
  assert.deepEqual(faults, []);
  await close();
}

/// What `recognise` found, as `info` counts it, each kind in its colour; a world that says nothing of it has no such look.
async function forms() {
  const plain = await open_page(browser, html);
  assert.equal(await plain.page.getByLabel('By form').count(), 0);
  await plain.close();
  const recognised = path.join(folder, 'recognised.html');
  wrlkit(program, 'view', '-q', world, '-o', recognised, '-p', 'join,recognise,dedup');
  const {kinds} = JSON.parse(wrlkit(program, 'info', '-q', '--json', '--recognise', world)).forms;
  const {page, faults, close} = await open_page(browser, recognised, {fragment: '#panel=view'});
  const before = await picture(page);
  assert(!await page.locator('#forms').isVisible());
  await page.getByLabel('By form').check({force: true});
  await page.waitForTimeout(500);
  assert(!(await picture(page)).equals(before));
  assert(await page.locator('#forms').isVisible());
  const rows = Object.fromEntries(await page.locator('#forms li').evaluateAll(all => all.map(row => [row.childNodes[1].textContent.trim(), Number(row.querySelector('.soft').textContent)])));
  assert.equal(rows.cylinder, kinds.cylinder);
  assert.equal(rows.box, kinds.box);
  assert.equal(rows.elbow, kinds.torus);
  assert.deepEqual(faults, []);
  await close();
}

function bundle_is_small() {
  const bytes = fs.statSync(path.join(path.dirname(program), 'viewer/index.html')).size;
  assert(bytes < 1e6, `the page without a world has ${bytes} bytes`);
}

try {
  await figures_and_selection();
  await display();
  await phone();
  await forms();
  bundle_is_small();
  console.log(`${info.triangles} triangles, ${fs.statSync(html).size} bytes`);
} finally {
  await browser.close();
}
