// Runs several of the tests next to this file in one process and one browser, whose start costs as much as most of them. One that
// fails does not keep the others from running.
//   node in_one_browser.mjs WRLKIT FOLDER TEST...     TEST: viewer_world, ...; it gets WRLKIT and FOLDER/TEST
import path from 'node:path';
import {share_chromium} from './viewer_page.mjs';

const [program, folder, ...tests] = process.argv.slice(2);
const stop = await share_chromium();
let failed = 0;
for (const test of tests) {
  const begin = performance.now();
  process.argv.splice(2, Infinity, program, path.join(folder, test));
  const fault = await import(`./${test}.mjs`).then(() => null, error => error);
  failed += fault !== null;
  console.log(`-- ${test}: ${fault ? `FAILED: ${fault.stack ?? fault}` : 'passed'}, ${((performance.now() - begin) / 1000).toFixed(1)} s`);
}
await stop();
console.log(`${tests.length} tests, ${failed} of them failed`);
process.exitCode = failed ? 1 : 0;
