// Odd worlds in the viewer page: names that look like markup, nothing to see, a point, lines, far from the origin, tiny, thousands of parts
// and colours, many Viewpoints; two worlds that do not meet, and collapses of what can hardly collapse.
//   node viewer_odd.mjs WRLKIT FOLDER
import assert from 'node:assert';
import fs from 'node:fs';
import path from 'node:path';
import {number_of, open_page, start_chromium, wrlkit} from './viewer_page.mjs';

const [program, folder] = process.argv.slice(2);
fs.mkdirSync(folder, {recursive: true});
const world = (name, text) => {
  const file = path.join(folder, `${name}.wrl`);
  fs.writeFileSync(file, `#VRML V2.0 utf8\n${text}\n`);
  return file;
};
const shape = (geometry, color = '0.8 0.3 0.2') => `Shape { appearance Appearance { material Material { diffuseColor ${color} } } geometry ${geometry} }`;
const placed = (at, inside, more = '') => `Transform { translation ${at} ${more} children [ ${inside} ] }`;
const faces = (points, index) => shape(`IndexedFaceSet { solid FALSE coord Coordinate { point [ ${points} ] } coordIndex [ ${index} ] }`);

const browser = await start_chromium();
async function with_page(files, work, options = {}) {
  const html = path.join(folder, `${path.basename(files[0], '.wrl')}.html`);
  wrlkit(program, 'view', '-q', ...files, '-o', html);
  const {page, faults, close} = await open_page(browser, html, options);
  await work(page);
  assert.deepEqual(faults, [], html);
  await close();
}

const drawn = async page => {
  await page.evaluate(() => new Promise(done => { window.viewer.mode.stage.invalidate(); requestAnimationFrame(() => requestAnimationFrame(done)); }));
  const seen = await page.evaluate(() => {
    const {canvas, renderer} = window.viewer.mode.stage, gl = renderer.getContext(), bytes = new Uint8Array(4 * canvas.width * canvas.height);
    gl.readPixels(0, 0, canvas.width, canvas.height, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
    const {width, height} = canvas, at = (x, y) => bytes.subarray(4 * (y * width + x), 4 * (y * width + x) + 3), back = at(0, 0).slice();
    const other = (x, y) => at(x, y).some((v, k) => Math.abs(v - back[k]) > 3);
    let pixels = 0, border = 0;
    for (let y = 0; y < height; ++y) {
      for (let x = 0; x < width; ++x) {
        if (!other(x, y)) continue;
        ++pixels;
        border += x === 0 || y === 0 || x === width - 1 || y === height - 1;
      }
    }
    let text = '';  // a list of numbers takes a second to get here
    for (let i = 0; i < bytes.length; i += 32768) text += String.fromCharCode(...bytes.subarray(i, i + 32768));
    return {pixels, border, draws: window.viewer.mode.stage.figures.draws, bytes: btoa(text)};
  });
  return {...seen, bytes: Buffer.from(seen.bytes, 'base64')};
};
const all_of_it = async page => {
  await page.getByRole('tab', {name: 'View'}).click();
  await page.getByRole('button', {name: 'All of it', exact: true}).click();
  return drawn(page);
};

async function markup() {
  const names = ['<script>alert(1)</script>', '</script><img/src=x/onerror=alert(1)>', '<!--', '\u202eevil', 'שלום_עולם', 'a&amp;b', '__proto__', 'x'.repeat(300)];
  const file = world('<b>markup & "more"', names.map((name, i) => `DEF ${name} ${placed(`${i} 0 0`, shape('Box { size .8 .8 .8 }', `0.${i} .5 .5`))}`).join('\n')
    + `\nViewpoint { description "</script><script>alert(2)</script>\u2028" position 4 0 20 }\nWorldInfo { title "</script><script>alert(3)</script>" info [ "\u2028<b>" ] }`);
  await with_page([file], async page => {
    page.on('dialog', () => assert.fail('a script of the world runs'));
    const shown = await page.locator('.part .name').allTextContents();
    for (const name of names) assert(shown.includes(name), name);
    assert.equal(await page.evaluate(() => document.querySelectorAll('img, b, .part script').length), 0);
    assert.equal(await page.title(), '<b>markup & "more".wrl: wrlkit');
    // A long name takes four lines, and what is said in extras is found.
    assert((await page.locator('tbody tr').last().boundingBox()).height < 120);
    await page.getByRole('searchbox').fill('alert(3)');
    assert.match(await page.locator('.found').textContent(), /^1 found/);
  });
}

/// The same picture of the same world, wherever it is and however large.
async function places() {
  const boxes = Array.from({length: 300}, (_, i) => placed(`${i % 20} 0 ${Math.floor(i / 20)}`, shape(i % 2 ? 'Box { size .8 .8 .8 }' : 'Cylinder { radius .4 height .8 }', `0.${i % 9 + 1} .5 .4`))).join('\n');
  let wanted;
  for (const [name, at, more] of [['near', '0 0 0', ''], ['utm', '456789.125 12 -5400000', ''], ['far', '1e7 1e7 1e7', ''], ['tiny', '0 0 0', 'scale 1e-6 1e-6 1e-6'], ['huge', '0 0 0', 'scale 1e6 1e6 1e6']]) {
    await with_page([world(name, placed(at, boxes, more))], async page => {
      const {bytes, pixels, border, draws} = await all_of_it(page);
      assert(pixels > 10_000 && border === 0, `${name}: ${pixels} pixels, ${border} of them at the border`);
      assert.equal(draws, 1, `${name}: parts of many colours are one draw`);
      wanted ??= bytes;
      const apart = bytes.filter((v, i) => Math.abs(v - wanted[i]) > 24).length;
      assert(apart < 0.01 * bytes.length, `${name}: ${apart} of ${bytes.length} bytes differ`);
    }, {width: 900, height: 560});
  }
}

async function little() {
  for (const text of ['', 'Group { }', 'Group { children [ Shape { geometry IndexedFaceSet { coord Coordinate { point [ 0 0 0 1']) {
    await with_page([world(`nothing${text.length}`, text)], async page => {
      assert.match(await page.textContent('.status'), /nothing that could be seen/);
    });
  }
  // A Viewpoint from which nothing is seen is no place to begin.
  await with_page([world('away', `Viewpoint { position 0 0 5 orientation 0 1 0 3.14159 }\n${shape('Box { }')}`)], async page => {
    assert((await drawn(page)).pixels > 1000);
    await page.keyboard.press('v');
    assert.equal((await drawn(page)).pixels, 0);
  });
  const line = shape('IndexedLineSet { coord Coordinate { point [ 10 10 10, 12 13 10, 14 10 10 ] } coordIndex [ 0 1 2 -1 ] }').replace('diffuseColor', 'emissiveColor');
  const point = placed('5 6 7', shape('PointSet { coord Coordinate { point [ 3 4 5 ] } }').replace('diffuseColor', 'emissiveColor'));
  for (const [name, text] of [['line', line], ['point', point]]) {
    await with_page([world(name, text)], async page => {
      const {pixels, border} = await all_of_it(page);
      assert(pixels > 4 && border === 0, `${name}: ${pixels} pixels`);
    });
  }
}

async function many() {
  const parts = Array.from({length: 20_000}, (_, i) => `DEF TAG_${i} ${placed(`${i % 200} 0 ${Math.floor(i / 200)}`, shape('Box { size .6 .6 .6 }', `${i % 97 / 97} ${i % 89 / 89} ${i % 13 / 13}`))}`);
  await with_page([world('parts', parts.join('\n'))], async page => {
    assert.equal((await drawn(page)).draws, 1);
    await page.getByRole('searchbox').fill('tag_1999');
    assert.match(await page.locator('.found').textContent(), /^11 found/);
    await page.getByRole('searchbox').press('Enter');
    assert.equal(await page.locator('#panel-part h2').first().textContent(), 'TAG_1999');
    assert(await page.locator('.part').count() < 100, 'only rows that are seen are in the page');
    await page.getByRole('button', {name: 'Show only this'}).click();
    assert.equal(await page.evaluate(() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(() => done(window.viewer.mode.stage.figures.triangles > 100))))), false);
  });
  const views = Array.from({length: 200}, (_, i) => `Viewpoint { position ${i} 2 10 description "Viewpoint number ${i} of a long list" }`);
  await with_page([world('views', `${views.join('\n')}\n${shape('Box { size 200 1 1 }')}`)], async page => {
    await page.getByRole('tab', {name: 'View'}).click();
    assert((await page.locator('.places').boundingBox()).height < 300);
    const eye = () => page.evaluate(() => window.viewer.mode.stage.camera.position.x);
    assert.equal(await eye(), 0);
    await page.keyboard.press('v');
    await page.keyboard.press('v');
    assert.equal(await eye(), 2);
    await page.keyboard.press('Shift+V');
    assert.equal(await eye(), 1);
  });
}

async function compared() {
  const box = world('a', shape('Box { }')), ball = world('b', placed('1000 0 0', shape('Sphere { }')));
  await with_page([box, ball], async page => {
    assert(number_of((await page.textContent('#largest-deviation')).replace(' mm', '')) > 990_000);
    await page.getByRole('button', {name: 'Go to the worst place'}).click();
    await page.waitForFunction(() => window.viewer.compare.heat[window.viewer.compare.side]);
    await page.getByRole('button', {name: 'All of it', exact: true}).click();
    for (const layout of ['Side by side', 'Difference', 'Divider']) await page.getByRole('radio', {name: layout}).check({force: true});
  });
  await with_page([box, world('none', 'Group { }')], async page => assert.match(await page.locator('.panel').textContent(), /Nothing was measured/));
}

async function collapses() {
  const fins = faces(`0 0 0, 0 1 0, 0 2 0, ${[0, 1, 2].map(f => [0, 1, 2].map(y => `${Math.cos(2 * f).toFixed(3)} ${y} ${Math.sin(2 * f).toFixed(3)}`).join(', ')).join(', ')}`, [3, 6, 9].map(b => `0 1 ${b + 1} ${b} -1 1 2 ${b + 2} ${b + 1} -1`).join(' '));
  for (const [name, text] of [['fins', fins], ['one_face', faces('0 0 0, 1 0 0, 0 1 0', '0 1 2 -1')], ['bowtie', faces('0 0 0, 1 0 0, 0 1 0, -1 0 0, 0 -1 0', '0 1 2 -1 0 3 4 -1')]]) {
    await with_page([world(name, text)], async page => {
      await page.waitForSelector('html[data-collapse]', {state: 'attached'});
      const first = await page.locator('.label output').first().textContent();
      for (let i = 0; i < 30; ++i) await page.keyboard.press('Space');
      assert.match(await page.locator('.label').first().textContent(), /no edge may go any more/);
      for (let i = 0; i < 30; ++i) await page.keyboard.press('Backspace');
      assert.equal(await page.locator('.label output').first().textContent(), first, name);
      for (const detail of ['In a lens', 'Near the eye', 'Everywhere']) await page.getByLabel(detail).check({force: true});
      await page.getByRole('button', {name: 'Play'}).click();
    }, {fragment: '#mode=collapse'});
  }
}

try {
  await markup();
  await places();
  await little();
  await many();
  await compared();
  await collapses();
  console.log('odd worlds are shown');
} finally {
  await browser.close();
}
