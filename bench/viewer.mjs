// How long a page of `wrlkit view` takes: from opening it from disk to its first picture, and the script of each frame while edges
// collapse. Drawing is apart: it depends on the graphics card, and here there may be none.
//   node bench/viewer.mjs WRLKIT WORLD [COLLAPSED]      a world, and one to collapse; needs tests/browser/node_modules
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import {pathToFileURL} from 'node:url';
import {start_chromium, wrlkit} from '../tests/browser/viewer_page.mjs';

const [program, world, collapsed] = process.argv.slice(2);
const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'wrlkit-viewer-'));
const median = list => list.sort((a, b) => a - b)[Math.floor(list.length / 2)];
const browser = await start_chromium();

function make(file, ...flags) {
  const html = path.join(folder, 'page.html');
  wrlkit(program, 'view', '-q', file, '-o', html, ...flags);
  return html;
}

/// Milliseconds since the navigation began when the page was ready, and when its first picture was drawn and read back.
async function open(html) {
  const context = await browser.newContext({viewport: {width: 1440, height: 900}}), page = await context.newPage();
  await page.addInitScript(() => {
    new MutationObserver((_, observer) => {
      if (!document.documentElement?.dataset.ready) return;
      observer.disconnect();
      window.ready = performance.now();
      requestAnimationFrame(() => requestAnimationFrame(() => {
        const gl = window.viewer.mode.stage.renderer.getContext();
        gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
        window.drawn = performance.now();
      }));
    }).observe(document, {attributes: true, subtree: true});
  });
  await page.goto(pathToFileURL(html).href);
  await page.waitForFunction(() => window.drawn, null, {timeout: 120_000});
  const times = await page.evaluate(() => ({ready: window.ready, drawn: window.drawn, ...window.viewer.mode.stage.figures, parts: window.viewer.world.parts.length, all: window.viewer.world.triangles}));
  await context.close();
  return times;
}

const bundle = fs.statSync(path.join(path.dirname(program), 'viewer/index.html')).size;
const html = make(world);
const opened = [];
for (let i = 0; i < 5; ++i) opened.push(await open(html));
console.log(`${path.basename(world)}: ${(fs.statSync(world).size / 1e6).toFixed(1)} MB, ${opened[0].parts} parts, ${opened[0].all} triangles; page ${(fs.statSync(html).size / 1e6).toFixed(2)} MB, ${(bundle / 1e6).toFixed(2)} MB of it without the world`);
console.log(`  ready after ${median(opened.map(o => o.ready)).toFixed(0)} ms, first picture after ${median(opened.map(o => o.drawn)).toFixed(0)} ms (medians of five), ${Math.min(...opened.map(o => o.drawn)).toFixed(0)} ms at best; ${opened[0].draws} draws, ${opened[0].triangles} triangles`);

if (collapsed) {
  const page = await browser.newPage({viewport: {width: 1440, height: 900}});
  const three = make(collapsed, '--criteria', 'length-normal,melax,lindstrom-turk');
  await page.goto(`${pathToFileURL(three).href}#mode=collapse`);
  await page.waitForSelector('html[data-collapse]', {state: 'attached', timeout: 120_000});
  const rows = await page.evaluate(() => {
    const {collapse} = window.viewer, {stage} = collapse, draw = stage.renderer.render, rows = [];
    stage.renderer.render = () => undefined;
    const time = work => { const begin = performance.now(); work(); return performance.now() - begin; };
    const frames = (name, work) => {
      const list = Array.from({length: 120}, () => time(work)).sort((a, b) => a - b);
      rows.push([name, list[60], list[119]]);
    };
    collapse.askBelow = 0;
    for (const speed of [60, 1000, 10_000]) {
      Object.assign(collapse, {playing: true, speed});
      frames(`${speed} edges a second`, () => { collapse.tick(1 / 60); collapse.draw(stage); });
    }
    collapse.playing = false;
    collapse.jump(collapse.first.faces[0] / 5);
    for (const kind of ['lens', 'near']) {
      collapse.setDetail(kind);
      frames(`${kind}: a new cut each frame`, () => collapse.draw(stage));
    }
    stage.renderer.render = draw;
    return {faces: collapse.first.faces[0], rows};
  });
  console.log(`${path.basename(collapsed)}: ${rows.faces} faces, three criteria; script of a frame, median and longest of 120`);
  for (const [name, middle, longest] of rows.rows) console.log(`  ${name}: ${middle.toFixed(1)} ms, ${longest.toFixed(1)} ms`);
}
await browser.close();
fs.rmSync(folder, {recursive: true});
