// The address of a viewer page keeps what is seen: a page that is opened with it shows the same picture.
//   node viewer_address.mjs WRLKIT FOLDER
import assert from 'node:assert';
import fs from 'node:fs';
import path from 'node:path';
import {open_page, picture_of, start_chromium, wrlkit} from './viewer_page.mjs';
import {file_of} from './worlds.mjs';

const [program, folder] = process.argv.slice(2);
fs.mkdirSync(folder, {recursive: true});
const page_of = (name, ...args) => {
  const file = path.join(folder, `${name}.html`);
  wrlkit(program, 'view', '-q', ...args, '-o', file);
  return file;
};
const model = file_of('corpus/paper/ellipsoid_hole.wrl'), room = file_of('corpus/paper/stairs_room.wrl');
const levels = page_of('levels', model, '-p', 'weld,lod', '--criteria', 'quadric'), one = page_of('room', room, '--criteria', 'melax');
wrlkit(program, 'simplify', '-q', model, '--counts', '200', '-o', folder);
const two = page_of('two', model, path.join(folder, 'ellipsoid_hole_200.wrl'), '--criteria', 'melax');
const baked = page_of('baked', file_of('corpus/features/lightmap.wrl'), '--criteria', 'melax');

const radio = (page, name, within = '') => page.locator(`${within} label`).filter({hasText: new RegExp(`^${name}$`)}).locator('input').check({force: true});
const tab = (page, name) => page.getByRole('tab', {name}).click();
const slide = (page, name, value) => page.getByRole('slider', {name}).fill(String(value));

const collapses = page => page.waitForSelector('html[data-collapse]', {state: 'attached'});
const deviation = page => page.waitForFunction(() => window.viewer.compare.heat[window.viewer.compare.side]);

/// The page; what is done to it; keys that the address has to have then; what is waited for when it is opened again.
const views = {
  camera: [one, async page => {
    await tab(page, 'View');
    await page.getByRole('button', {name: 'All of it', exact: true}).click();
    await page.evaluate(() => { window.viewer.mode.stage.fieldOfView = 70; });
  }, ['camera']],
  grey: [one, async page => { await tab(page, 'View'); await radio(page, 'Grey'); await radio(page, 'Headlight'); await page.getByLabel('Edges').check(); await page.getByLabel('Bounding boxes').check(); }, ['look', 'light', 'edges', 'boxes']],
  unlit: [one, async page => { await tab(page, 'View'); await radio(page, 'Grey'); await radio(page, 'Off'); }, ['look', 'light']],
  hidden: [one, async page => {
    await page.evaluate(() => {
      const {mode, world} = window.viewer;
      mode.select(world.parts.reduce((a, b) => b.mesh !== null && b.triangles > a.triangles ? b : a));
    });
    await page.getByRole('button', {name: 'Hide', exact: true}).click();
  }, ['hidden']],
  selected: [one, page => page.getByRole('treeitem').filter({hasText: 'Staircase'}).click(), ['select', 'panel']],
  level: [levels, async page => { await tab(page, 'Levels'); await slide(page, 'Level', 2); await page.getByLabel('Tint by level').check(); }, ['level', 'tint']],
  texels: [baked, async page => { await tab(page, 'View'); await radio(page, 'Texels'); }, ['look']],
  difference: [two, async page => { await radio(page, 'Difference'); await slide(page, 'Difference, times', 5); }, ['layout', 'gain']],
  worst: [two, async page => { await page.getByRole('button', {name: 'Go to the worst place'}).click(); await deviation(page); await page.getByLabel('Edges').check(); }, ['layout', 'side', 'worst'], deviation],
  other: [two, async page => { await radio(page, 'Deviation'); await deviation(page); await radio(page, 'first'); await slide(page, 'End of the scale', -0.5); await deviation(page); }, ['layout', 'side', 'scale'], deviation],
  lens: [levels, async page => {
    await page.getByRole('button', {name: 'Collapse', exact: true}).click();
    await collapses(page);
    await page.getByRole('button', {name: 'All of it', exact: true}).click();
    await page.getByRole('button', {name: '100', exact: true}).click();
    await radio(page, 'In a lens');
    const {x, y, width, height} = await page.locator('.view canvas').boundingBox();
    await page.mouse.move(x + 0.4 * width, y + 0.55 * height);
  }, ['mode', 'faces', 'detail', 'lens'], collapses],
  divider: [two, async page => { await page.evaluate(() => window.viewer.compare.setDivider(0.3)); }, ['divider']],
};

/// The picture when it no longer changes: on a busy machine textures come late.
async function settled(page) {
  let last = '', now = await picture_of(page);
  while (now !== last) {
    await page.waitForTimeout(200);
    [last, now] = [now, await picture_of(page)];
  }
  return now;
}

const browser = await start_chromium();
try {
  for (const [name, [file, act, keys, opened = () => undefined]] of Object.entries(views)) {
    const first = await open_page(browser, file);
    const plain = await settled(first.page);
    await act(first.page);
    const wanted = await settled(first.page);
    await first.page.waitForTimeout(300);  // the address follows
    const fragment = await first.page.evaluate(() => location.hash);
    assert(wanted !== plain, `${name}: nothing is seen of it`);
    for (const key of keys) assert(new URLSearchParams(fragment.slice(1)).has(key), `${name}: '${key}' is not in ${fragment}`);
    const again = await open_page(browser, file, {fragment});
    await opened(again.page);
    assert(await settled(again.page) === wanted, `${name}: another picture by ${fragment}`);
    assert.deepEqual([...first.faults, ...again.faults], [], name);
    await first.close();
    await again.close();
  }
  console.log(`${Object.keys(views).length} views come back by their address`);
} finally {
  await browser.close();
}
