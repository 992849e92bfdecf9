// Pages of many worlds, of all kinds that wrlkit reads: each opens without a word on the console, shows something in
// every way that can be chosen, and counts the triangles that `wrlkit info` counts.
//   node viewer_worlds.mjs WRLKIT FOLDER [--all | --found PREFIX]        ten of them, thirty, or those found models whose path begins so,
//                                                                        which axe-core judges, too
import assert from 'node:assert';
import fs from 'node:fs';
import path from 'node:path';
import {judge, number_of, open_page, start_chromium, wrlkit} from './viewer_page.mjs';
import {every_format, file_of, found_worlds} from './worlds.mjs';

const ten = ['plant/pump_room_primitives', 'paper/stairs_room', 'features/animation', 'features/lightmap', 'features/lod', 'features/lines_colour_per_vertex',
  'features/text_family_style', 'features/proto_nested', 'features/negative_scale', 'vrml1/FaceSet'];
const thirty = [...ten, 'paper/pipes', 'features/animation_morph', 'features/background', 'features/billboard', 'features/colour_per_face', 'features/convex_false_star',
  'features/elevation_texcoord', 'features/extrusion_twisted', 'features/fog_linear', 'features/light_scope', 'features/light_spot', 'features/material_texture',
  'features/pixel_texture_4', 'features/points_colour', 'features/sensors', 'features/switch', 'features/texture_transform', 'features/transparency', 'nodes/MovieTexture', 'vrml1/Array'];

const [program, folder, all, prefix = ''] = process.argv.slice(2);
const own = all === '--all' ? thirty : ten;
const worlds = all === '--found' ? found_worlds(every_format).filter(w => w.name.startsWith(prefix)) : own.map(name => ({name, file: file_of(`corpus/${name}.wrl`)}));
fs.mkdirSync(folder, {recursive: true});
const browser = await start_chromium();
const faults = [];

async function look_at(name, world, html) {
  wrlkit(program, 'view', '-q', world, '-o', html);
  const {triangles, lines, points} = JSON.parse(wrlkit(program, 'info', '-q', '--json', world));
  const opened = await open_page(browser, html, {width: 800, height: 480});
  const {page} = opened;
  const counted = number_of(await page.textContent('#world-triangles'));
  if (counted !== triangles) faults.push(`${name}: ${counted} triangles, info says ${triangles}`);
  await page.waitForFunction(() => window.viewer.mode.stage.figures.draws > 0, null, {timeout: 5000}).catch(() => {
    if (triangles + lines + points > 0) faults.push(`${name}: nothing is drawn`);
  });
  if (all === '--found') await judge(page, name);
  // Whatever can be chosen in how it is shown is chosen once.
  await page.getByRole('tab', {name: 'View'}).click();
  for (const box of await page.locator('#panel-view input:is([type=radio], [type=checkbox])').all()) await box.check({force: true});
  await page.evaluate(() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done))));
  faults.push(...opened.faults.map(fault => `${name}: ${fault}`));
  await opened.close();
}

try {
  for (const {name, file, broken} of worlds) {
    assert(file, `${name} is not there`);
    const html = path.join(folder, 'world.html');
    fs.rmSync(html, {force: true});
    await look_at(name, file, html).catch(error => {
      if (!broken || fs.existsSync(html)) faults.push(`${name}: ${error}`);
    });
  }
} finally {
  await browser.close();
}
assert.deepEqual(faults, []);
console.log(`${worlds.length} worlds`);
