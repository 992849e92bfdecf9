// The page of `wrlkit view FOLDER` in Chromium: pictures, search, order, a broken world with its message, and no fault of access.
//   node gallery.mjs WRLKIT FOLDER
import assert from 'node:assert';
import fs from 'node:fs';
import path from 'node:path';
import {judge, open_page, start_chromium, wrlkit} from './viewer_page.mjs';
import {file_of} from './worlds.mjs';

const [program, folder] = process.argv.slice(2);
const archive = path.join(folder, 'archive'), html = path.join(folder, 'gallery.html');
fs.rmSync(folder, {recursive: true, force: true});
fs.mkdirSync(archive, {recursive: true});
for (const name of ['lod', 'fog_linear', 'inline_missing']) fs.copyFileSync(file_of(`corpus/features/${name}.wrl`), path.join(archive, `${name}.wrl`));
const hostile = `<img src=x onerror=alert(1)> "&'.wrl`;
fs.writeFileSync(path.join(archive, hostile), 'garbage <script>alert(1)</script>');
wrlkit(program, 'view', '-q', archive, '-o', html);

const browser = await start_chromium();
try {
  for (const dark of [false, true]) {
    const {page, faults, close} = await open_page(browser, html, {dark, ready: '#n:not(:empty)'});
    const names = () => page.locator('#worlds > li:visible a').allTextContents();
    const figures = key => page.locator('#worlds > li').evaluateAll((all, key) => all.map(o => Number(o.dataset[key])), key);
    assert.deepEqual((await names()).sort(), [hostile, 'fog_linear.wrl', 'inline_missing.wrl', 'lod.wrl'].sort());
    assert.equal(await page.locator('#worlds img').count(), 3);
    const drawn = await page.locator('#worlds img').evaluateAll(all => Promise.all(all.map(async i => { await i.decode(); return i.naturalWidth; })));
    assert.deepEqual(drawn, [320, 320, 320]);
    assert.match(await page.locator('#worlds .none').textContent(), /unknown file format/);
    for (const a of await page.locator('#worlds a').evaluateAll(all => all.map(o => decodeURIComponent(o.getAttribute('href')))))
      assert(fs.existsSync(path.join(folder, a)), a);
    await page.getByLabel('Order').selectOption('triangles');
    const triangles = await figures('triangles');
    assert.deepEqual(triangles, [...triangles].sort((a, b) => b - a));
    await page.getByLabel('Search').fill('LO');
    assert.deepEqual(await names(), ['lod.wrl']);
    assert.equal(await page.locator('#n').textContent(), '1 of 4 worlds');
    await page.getByLabel('Search').fill('');
    await page.getByLabel('Order').selectOption('name');
    assert.equal((await names()).length, 4);
    await judge(page, 'gallery');
    assert.deepEqual(faults, []);
    await close();
  }
} finally {
  await browser.close();
}
