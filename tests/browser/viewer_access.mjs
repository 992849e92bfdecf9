// The viewer page for everybody: axe-core finds no serious fault in any mode, light and dark, wide and narrow; keys do what buttons
// do; what is printed has the picture and its figures.
//   node viewer_access.mjs WRLKIT FOLDER
import assert from 'node:assert';
import fs from 'node:fs';
import path from 'node:path';
import {judge, open_page, start_chromium, wrlkit} from './viewer_page.mjs';
import {file_of} from './worlds.mjs';

const [program, folder] = process.argv.slice(2);
fs.mkdirSync(folder, {recursive: true});
const model = file_of('corpus/paper/ellipsoid_hole.wrl'), one = path.join(folder, 'one.html'), two = path.join(folder, 'two.html');
wrlkit(program, 'view', '-q', model, '-o', one, '-p', 'weld,lod');
wrlkit(program, 'view', '-q', model, file_of('corpus/features/lightmap.wrl'), '-o', two);

const browser = await start_chromium();
const all_faults = [];
async function with_page(file, options, work) {
  const {page, faults, close} = await open_page(browser, file, {width: 800, height: 560, ...options});
  await work(page);
  all_faults.push(...faults);
  await close();
}

try {
  let lesser = 0;
  for (const dark of [false, true]) {
    await with_page(one, {dark}, async page => {
      for (const tab of dark ? ['View'] : ['Figures', 'View', 'Levels', 'Materials']) {
        await page.getByRole('tab', {name: tab}).click();
        lesser += await judge(page, `${tab}, dark ${dark}`);
      }
      await page.getByRole('treeitem').last().click();
      lesser += await judge(page, `Part, dark ${dark}`);
      await page.getByRole('button', {name: 'Collapse', exact: true}).click();
      await page.waitForSelector('html[data-collapse]', {state: 'attached'});
      lesser += await judge(page, `Collapse, dark ${dark}`);
      await page.getByRole('button', {name: 'Help'}).click();
      lesser += await judge(page, `Help, dark ${dark}`);
    });
  }
  await with_page(two, {width: 390, height: 800}, async page => {
    await page.getByRole('button', {name: 'Panel', exact: true}).click();
    await page.getByRole('radio', {name: 'Deviation'}).check({force: true});
    lesser += await judge(page, 'Compare on a phone');
    assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 390);
  });

  // Keys.
  await with_page(one, {}, async page => {
    await page.keyboard.press('?');
    assert(await page.getByRole('dialog').isVisible());
    await page.keyboard.press('Escape');
    assert(!await page.getByRole('dialog').isVisible());
    await page.keyboard.press('/');
    await page.keyboard.type('IndexedFaceSet');
    await page.keyboard.press('Enter');
    assert.equal(await page.locator('.part[aria-selected=true]').count(), 1);
    await page.keyboard.press('Tab');
    await page.keyboard.press('t');
    assert.equal(await page.evaluate(() => document.documentElement.dataset.theme), 'dark');
    const camera = () => page.evaluate(() => window.viewer.mode.stage.camera.position.toArray().join());
    const before = await camera();
    await page.locator('.view canvas').focus();
    await page.keyboard.down('ArrowLeft');
    await page.waitForFunction(before => window.viewer.mode.stage.camera.position.toArray().join() !== before, before);
    await page.keyboard.up('ArrowLeft');
    await page.keyboard.press('2');
    await page.waitForSelector('html[data-collapse]', {state: 'attached'});
    assert.equal(await page.locator('.modes button[aria-pressed=true]').textContent(), 'Collapse');
  });

  // On paper: picture and figures, no tools.
  await with_page(one, {}, async page => {
    await page.emulateMedia({media: 'print'});
    assert(!await page.getByRole('button', {name: 'Print'}).isVisible());
    assert(await page.locator('.view canvas').isVisible() && await page.locator('#world-triangles').isVisible());
    assert(!await page.getByLabel('Search parts').isVisible());
  });
  // As it is on the screen, in the light colours; then the screen is as before.
  await with_page(one, {dark: true, fragment: '#mode=collapse&faces=200'}, async page => {
    await page.waitForSelector('html[data-collapse]', {state: 'attached'});
    const shape = () => page.evaluate(() => { const {canvas} = window.viewer.mode.stage, {width, height} = canvas.getBoundingClientRect(); return [canvas.width, canvas.height, Math.round(100 * width / height)]; });
    const before = await shape();
    await page.evaluate(() => window.dispatchEvent(new Event('beforeprint')));
    await page.emulateMedia({media: 'print'});
    assert.deepEqual(await shape(), before);
    assert.equal(await page.evaluate(() => document.documentElement.dataset.theme), 'light');
    assert(await page.getByText('At this moment').first().isVisible() && !await page.getByLabel('Three greys').isVisible());
    await page.emulateMedia({media: 'screen'});
    await page.evaluate(() => window.dispatchEvent(new Event('afterprint')));
    assert.equal(await page.evaluate(() => document.documentElement.dataset.theme), 'dark');
    assert.deepEqual(await shape(), before);
  });
  assert.deepEqual(all_faults, []);
  console.log(`no serious fault; ${lesser} lesser ones`);
} finally {
  await browser.close();
}
