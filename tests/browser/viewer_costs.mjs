// What the page says that the next edge costs is what the library priced it at, for every collapse of a closed surface by each of the
// criteria of the seed paper and by Lindstrom-Turk.
//   node viewer_costs.mjs WRLKIT FOLDER COLLAPSE_COSTS
import assert from 'node:assert';
import {execFileSync} from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';
import {open_page, start_chromium, wrlkit} from './viewer_page.mjs';

const [program, folder, collapse_costs] = process.argv.slice(2);
execFileSync(collapse_costs, [folder]);
const expected = JSON.parse(fs.readFileSync(path.join(folder, 'costs.json'), 'utf8').replaceAll('inf', '1e999')), html = path.join(folder, 'bumps.html');
const cost = {'length-normal': 'lengthNormal', melax: 'melax', 'lindstrom-turk': 'planes'};
wrlkit(program, 'view', '-q', path.join(folder, 'bumps.wrl'), '-o', html, '--criteria', Object.keys(cost).join());

const browser = await start_chromium();
try {
  const {page, faults} = await open_page(browser, html, {fragment: '#mode=collapse'});
  await page.waitForSelector('html[data-collapse]', {state: 'attached'});
  for (const [i, criterion] of Object.keys(cost).entries()) {
    const shown = await page.evaluate(([i, key]) => {
      const {run} = window.viewer.collapse.lanes[i];
      return Array.from({length: run.steps}, (_, at) => { run.goTo(at); return run.next()[key]; });
    }, [i, cost[criterion]]);
    const wanted = expected[criterion];
    assert.equal(shown.length, wanted.length, criterion);
    const wrong = shown.flatMap((x, at) => Math.abs(x - wanted[at]) <= 1e-5 * Math.abs(wanted[at]) + 1e-9 ? [] : [[at, x, wanted[at]]]);
    assert.deepEqual(wrong.slice(0, 6), [], `${criterion}: ${wrong.length} of ${shown.length} collapses have another cost`);
    console.log(`${criterion}: ${shown.length} collapses cost the same`);
  }
  assert.deepEqual(faults, []);
} finally {
  await browser.close();
}
