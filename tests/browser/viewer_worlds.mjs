// Pages of many worlds, of all kinds that wrlkit reads: each opens without a word on the console, shows something in
// every way that can be chosen, and counts the triangles that `wrlkit info` counts.
//   node viewer_worlds.mjs WRLKIT FOLDER [--all]        ten of them, or thirty
import assert from 'node:assert';
import fs from 'node:fs';
import path from 'node:path';
import {number_of, open_page, start_chromium, wrlkit} from './viewer_page.mjs';
import {file_of} from './worlds.mjs';

const ten = ['plant/pump_room_primitives', 'paper/stairs_room', 'features/animation', 'features/lightmap', 'features/lod', 'features/lines_colour_per_vertex',
  'features/text_family_style', 'features/proto_nested', 'features/negative_scale', 'vrml1/FaceSet'];
const thirty = [...ten, 'paper/pipes', 'features/animation_morph', 'features/background', 'features/billboard', 'features/colour_per_face', 'features/convex_false_star',
  'features/elevation_texcoord', 'features/extrusion_twisted', 'features/fog_linear', 'features/light_scope', 'features/light_spot', 'features/material_texture',
  'features/pixel_texture_4', 'features/points_colour', 'features/sensors', 'features/switch', 'features/texture_transform', 'features/transparency', 'nodes/MovieTexture', 'vrml1/Array'];

const [program, folder, all] = process.argv.slice(2);
fs.mkdirSync(folder, {recursive: true});
const browser = await start_chromium();
const faults = [];
try {
  for (const name of all === '--all' ? thirty : ten) {
    const world = file_of(`corpus/${name}.wrl`), html = path.join(folder, `${path.basename(name)}.html`);
    assert(world, `${name} is not there`);
    wrlkit(program, 'view', '-q', world, '-o', html);
    const {triangles, lines, points} = JSON.parse(wrlkit(program, 'info', '-q', '--json', world));
    const opened = await open_page(browser, html, {width: 800, height: 480});
    const {page} = opened;
    const counted = number_of(await page.textContent('#world-triangles'));
    if (counted !== triangles) faults.push(`${name}: ${counted} triangles, info says ${triangles}`);
    await page.waitForFunction(() => window.viewer.mode.stage.figures.draws > 0, null, {timeout: 5000}).catch(() => {
      if (triangles + lines + points > 0) faults.push(`${name}: nothing is drawn`);
    });
    // Whatever can be chosen in how it is shown is chosen once.
    await page.getByRole('tab', {name: 'View'}).click();
    for (const box of await page.locator('#panel-view input:is([type=radio], [type=checkbox])').all()) await box.check({force: true});
    await page.evaluate(() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done))));
    faults.push(...opened.faults.map(fault => `${name}: ${fault}`));
    await opened.close();
  }
} finally {
  await browser.close();
}
assert.deepEqual(faults, []);
console.log(`${all === '--all' ? thirty.length : ten.length} worlds`);
