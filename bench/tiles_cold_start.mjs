// How long the page of a tileset takes from a cold start to its first picture, and what is transferred until then; three times.
//   node bench/tiles_cold_start.mjs WRLKIT TILES      needs tests/browser/node_modules
import {spawn} from 'node:child_process';
import {start_chromium} from '../tests/browser/viewer_page.mjs';
const [program, set] = process.argv.slice(2);
const server = spawn(program, ['view', '-q', set, '--serve'], {stdio: ['ignore', 'pipe', 'inherit']});
const address = await new Promise(r => server.stdout.setEncoding('utf8').once('data', t => r(t.trim())));
const browser = await start_chromium();
for (let i = 0; i < 3; ++i) {
  const context = await browser.newContext({viewport: {width: 1440, height: 900}}), page = await context.newPage();
  const cdp = await context.newCDPSession(page);
  await cdp.send('Network.enable');
  let bytes = 0, files = 0;
  cdp.on('Network.loadingFinished', e => { bytes += e.encodedDataLength; ++files; });
  const begin = Date.now();
  await page.goto(address);
  await page.waitForFunction(() => window.viewer && window.viewer.mode.set.shown.length > 0 && window.viewer.mode.stage.figures.triangles > 0, null, {timeout: 60000, polling: 20});
  const at = Date.now() - begin, b = bytes, f = files;
  await page.waitForFunction(() => !window.viewer.mode.set.loading, null, {timeout: 60000}).catch(() => 0);
  await page.waitForTimeout(1500);
  console.log(`first tiles ${at} ms, ${b} bytes in ${f} files; settled: ${bytes} bytes, ${files} files, ${await page.evaluate(() => window.viewer.mode.set.shown.length)} tiles`);
  await context.close();
}
await browser.close(); server.kill();
