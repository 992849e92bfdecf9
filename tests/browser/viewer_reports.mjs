// The reports of compare-lod and of corpus report: the look of the viewer page, light and dark, on a screen and on a phone; axe-core
// finds no serious fault, nothing is asked of a network, nothing is said on the console.
//   node viewer_reports.mjs WRLKIT FOLDER
import assert from 'node:assert';
import fs from 'node:fs';
import path from 'node:path';
import {judge, open_page, start_chromium, wrlkit} from './viewer_page.mjs';
import {file_of, project} from './worlds.mjs';

const [program, folder] = process.argv.slice(2);
fs.rmSync(folder, {recursive: true, force: true});
fs.mkdirSync(folder, {recursive: true});
const inside = name => path.join(folder, name);
const ellipsoid = file_of('corpus/paper/ellipsoid_hole.wrl');
wrlkit(program, 'view', '-q', ellipsoid, '-o', inside('viewer.html'), '--criteria', 'melax');
wrlkit(program, 'compare-lod', '-q', ellipsoid, '-o', inside('criteria.html'), '--ratios', '0.5,0.2', '--criteria', 'lindstrom-turk,melax');
fs.writeFileSync(inside('all.toml'), '[[pass]]\nname = "weld"\n');
fs.mkdirSync(inside('in'));
for (const name of ['switch', 'lod', 'fog_linear']) fs.copyFileSync(path.join(project, `corpus/features/${name}.wrl`), inside(`in/${name}.wrl`));
fs.writeFileSync(inside('in/<b>broken & "quoted".wrl'), 'no world');
wrlkit(program, 'corpus', 'run', '-q', inside('all.toml'), inside('in'), '-o', inside('out'), '--jobs', '1');
wrlkit(program, 'corpus', 'report', '-q', inside('out'), '-o', inside('corpus.html'));

const look_of = page => page.evaluate(() => {
  const body = getComputedStyle(document.body), head = getComputedStyle(document.querySelector('.head')), button = getComputedStyle(document.querySelector('.tools button'));
  return [body.fontFamily, body.backgroundColor, body.color, head.backgroundColor, head.borderBottomColor, button.backgroundColor, button.borderRadius];
});

const browser = await start_chromium();
try {
  for (const dark of [false, true]) {
    const looks = [];
    for (const name of ['viewer', 'criteria', 'corpus']) {
      for (const width of name === 'viewer' ? [1440] : [1440, 390]) {
        const {page, faults, close} = await open_page(browser, inside(`${name}.html`), {width, height: 900, dark, ready: name === 'viewer' ? undefined : 'body'});
        if (width === 1440) looks.push(await look_of(page));
        else assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 390, `${name} is wider than a phone`);
        await judge(page, `${name}, ${width} wide, dark ${dark}`);
        assert.deepEqual(faults, [], name);
        await page.screenshot({path: inside(`${name}_${width}_${dark ? 'dark' : 'light'}.png`)});
        await close();
      }
    }
    assert.deepEqual(looks[1], looks[0], 'compare-lod looks like the viewer');
    assert.deepEqual(looks[2], looks[0], 'corpus report looks like the viewer');
  }

  // The table of files: sorted, searched, and in the other colours.
  const {page, faults} = await open_page(browser, inside('corpus.html'), {ready: 'body'});
  assert.equal(await page.locator('#rows tr').count(), 4);
  await page.getByRole('button', {name: 'input', exact: true}).click();
  assert.equal(await page.locator('th[aria-sort=descending]').textContent(), 'input');
  await page.getByRole('searchbox').fill('<B>');
  assert.match(await page.locator('#rows tr').first().textContent(), /<b>broken & "quoted"\.wrl/);
  assert.equal(await page.locator('#rows tr').count(), 1);
  await page.getByRole('button', {name: 'Dark'}).click();
  assert.equal(await page.evaluate(() => getComputedStyle(document.body).backgroundColor), 'rgb(20, 23, 27)');
  assert.deepEqual(faults, []);
  console.log('both reports look like the viewer; no serious fault');
} finally {
  await browser.close();
}
