// Baked light that knows where it comes from, in the viewer page: a ball with a highlight looks as `wrlkit render` shows it, from two sides;
// without directions it does not.
//   node viewer_light.mjs WRLKIT FOLDER
import assert from 'node:assert';
import fs from 'node:fs';
import path from 'node:path';
import {open_page, picture_of, start_chromium, wrlkit} from './viewer_page.mjs';

const [program, folder] = process.argv.slice(2);
fs.mkdirSync(folder, {recursive: true});
const source = path.join(folder, 'ball.wrl');
fs.writeFileSync(source, `#VRML V2.0 utf8
Viewpoint { position 0 0 1.7 description "front" }
Viewpoint { position 1.2 0 1.2 orientation 0 1 0 0.7854 description "aside" }
NavigationInfo { headlight FALSE }
PointLight { location 2 2 3 }
DEF Ball Shape { appearance Appearance { material Material { diffuseColor 0.5 0.5 0.6 specularColor 0.9 0.8 0.7 shininess 0.3 } } geometry Sphere { } }
`);

function baked(options) {
  const file = path.join(folder, `ball_${options}.wrl`), html = path.join(folder, `ball_${options}.html`);
  wrlkit(program, 'convert', '-q', source, file, '--dump', '-p', `lightmap{quality=draft,max-size=128${options}}`);
  wrlkit(program, 'view', '-q', file, '-o', html);
  return {file, html};
}

/// Mean difference of levels of the middles of two pictures of the same size, of 255. There is nothing but the ball.
const apart = (page, a, b) => page.evaluate(async pictures => {
  const [one, other] = await Promise.all(pictures.map(async url => {
    const image = new Image();
    image.src = url;
    await image.decode();
    const canvas = new OffscreenCanvas(image.width, image.height), context = canvas.getContext('2d');
    context.drawImage(image, 0, 0);
    return context.getImageData(image.width / 4, image.height / 4, image.width / 2, image.height / 2).data;
  }));
  let sum = 0;
  for (let i = 0; i < one.length; ++i) sum += i % 4 === 3 ? 0 : Math.abs(one[i] - other[i]);
  return sum / (0.75 * one.length);
}, [a, b]);

const directed = baked(',directional=true'), plain = baked('');
const browser = await start_chromium();
try {
  for (const [html, faithful] of [[directed.html, true], [plain.html, false]]) {
    const {page, faults, close} = await open_page(browser, html, {width: 1400, height: 640});
    await page.getByRole('tab', {name: 'View'}).click();
    for (const view of ['front', 'aside']) {
      await page.getByRole('button', {name: view, exact: true}).click();
      await page.waitForTimeout(1200);  // the way there
      const {width, height} = await page.locator('.view canvas').evaluate(({width, height}) => ({width, height}));
      const shown = path.join(folder, `${view}.png`);
      wrlkit(program, 'render', '-q', directed.file, shown, '--viewpoint', view, '--width', width, '--height', height);
      const levels = await apart(page, await picture_of(page), `data:image/png;base64,${fs.readFileSync(shown).toString('base64')}`);
      console.log(`${path.basename(html)} ${view}: ${levels.toFixed(2)} of 255`);
      assert(faithful ? levels < 0.5 : levels > 8, `${html} ${view}: ${levels}`);
    }
    assert.deepEqual(faults, []);
    await close();
  }
} finally {
  await browser.close();
}
