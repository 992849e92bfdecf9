// For people: the pictures of docs/viewer.md, made again.
//   node viewer_pictures.mjs WRLKIT docs/pictures
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import {open_page, start_chromium, wrlkit} from './viewer_page.mjs';
import {file_of} from './worlds.mjs';

const [program, out] = process.argv.slice(2);
const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'wrlkit-pictures-'));
const room = file_of('corpus/plant/pump_room_faces.wrl'), ellipsoid = file_of('corpus/paper/ellipsoid_hole_fine.wrl');
const browser = await start_chromium();

async function picture(name, args, size, work) {
  const html = path.join(folder, `${name}.html`);
  wrlkit(program, 'view', '-q', ...args, '-o', html);
  const {page, close} = await open_page(browser, html, size);
  await work(page);
  await page.mouse.move(0, 0);
  await page.waitForTimeout(500);
  await page.screenshot({path: path.join(out, `viewer_${name}.png`)});
  await close();
}

const to_top = page => page.locator('.right > .panel').evaluate(panel => { panel.scrollTop = 0; });

try {
  await picture('heaviest', [room, '--criteria', 'quadric'], {width: 1200, height: 720}, async page => {
    await page.locator('tbody').first().getByRole('button', {name: 'Tank_shell'}).hover();
  });
  await picture('forms', [room, '-p', 'join,recognise,dedup'], {width: 1200, height: 720, fragment: '#look=form&panel=view'}, () => {});
  wrlkit(program, 'simplify', '-q', room, '--counts', '2500', '-o', folder);
  const simple = fs.readdirSync(folder).find(name => /pump_room_faces_\d+\.wrl$/.test(name));
  await picture('deviation', [room, path.join(folder, simple), '--allow-path', path.dirname(room)], {width: 1200, height: 720}, async page => {
    await page.getByRole('button', {name: 'Go to the worst place'}).click();
    await page.waitForFunction(() => window.viewer.compare.heat[window.viewer.compare.side]);
  });
  await picture('formulas', [ellipsoid, '--criteria', 'length-normal,melax'], {width: 1200, height: 720, fragment: '#mode=collapse'}, async page => {
    await page.waitForSelector('html[data-collapse]', {state: 'attached'});
    await page.getByRole('button', {name: 'All of it'}).click();
    await page.getByRole('button', {name: '200', exact: true}).click();
    await to_top(page);
  });
  await picture('phone', [ellipsoid, '--criteria', 'length-normal,melax'], {width: 390, height: 780, fragment: '#mode=collapse', dark: true}, async page => {
    await page.waitForSelector('html[data-collapse]', {state: 'attached'});
    await page.getByRole('button', {name: 'Panel', exact: true}).click();
    await page.getByRole('button', {name: 'All of it'}).click();
    await page.getByRole('button', {name: '200', exact: true}).click();
    await to_top(page);
  });
} finally {
  await browser.close();
  fs.rmSync(folder, {recursive: true});
}
