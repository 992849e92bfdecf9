// A page of `wrlkit view` in Chromium, opened from disk or from a server. Whatever it says on the console or asks of another site is a fault.
import assert from 'node:assert';
import {spawnSync} from 'node:child_process';
import fs from 'node:fs';
import {createRequire} from 'node:module';
import path from 'node:path';
import {pathToFileURL} from 'node:url';
import {chromium} from 'playwright-core';
import {chromium as executablePath, drawing} from './browser.mjs';

const launch = () => chromium.launch({executablePath, args: drawing});
let shared;

/// A browser; the one that all tests of this process share, after share_chromium().
export const start_chromium = async () => shared ?? await launch();

/// From now on start_chromium() gives one and the same browser, and closing it closes its pages. What is returned ends it.
export async function share_chromium() {
  shared = await launch();
  const end = shared.close.bind(shared);
  shared.close = () => Promise.all(shared.contexts().map(context => context.close()));
  return end;
}

/// Runs wrlkit; its standard output.
export function wrlkit(program, ...args) {
  const run = spawnSync(program, args.map(String), {encoding: 'utf8', maxBuffer: 1 << 28});
  if (run.status !== 0 && run.status !== 1) throw new Error(`wrlkit ${args.join(' ')}: ${run.status}\n${run.stderr}`);
  return run.stdout;
}

/// {page, faults}: the page, a file or an address, when all of it is there; faults fills while it lives.
export async function open_page(browser, file, {width = 1000, height = 640, fragment = '', dark = false, touch = false, ready = 'html[data-ready]'} = {}) {
  const context = await browser.newContext({viewport: {width, height}, colorScheme: dark ? 'dark' : 'light', hasTouch: touch});
  const page = await context.newPage();
  const faults = [];
  page.on('console', message => { if (['error', 'warning'].includes(message.type()) && !of_the_machine.test(message.text())) faults.push(`${message.type()}: ${message.text()}`); });
  page.on('pageerror', error => faults.push(`exception: ${error.stack ?? error}`));
  const served = file.startsWith('http:'), address = served ? file : pathToFileURL(path.resolve(file)).href;
  const own = served ? url => url.startsWith(new URL(file).origin) : url => url.startsWith('file:');
  page.on('request', request => { if (!/^(data|blob):/.test(request.url()) && !own(request.url())) faults.push(`asks for ${request.url()}`); });
  await page.goto(address + fragment, {timeout: 120_000});
  try {
    await page.waitForSelector(ready, {timeout: 120_000, state: 'attached'});
  } catch (error) {
    throw new Error(`${file} does not get ready: ${faults.join('\n')} ${error}`);
  }
  return {page, faults, close: () => context.close()};
}

const axe = () => fs.readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');

/// axe-core finds no serious fault; the number of lesser ones.
export async function judge(page, what) {
  await page.evaluate(axe());
  const {violations} = await page.evaluate(() => window.axe.run(document, {runOnly: ['wcag2a', 'wcag2aa', 'wcag21a', 'wcag21aa', 'best-practice']}));
  const serious = violations.filter(v => ['serious', 'critical'].includes(v.impact));
  assert.deepEqual(serious.map(v => `${v.id}: ${v.nodes.map(n => `${n.html.slice(0, 160)} ${n.failureSummary}`).join(' | ')}`), [], what);
  return violations.length;
}

// What Chromium says about drawing without a graphics card, in headless tests only; what 3d-tiles-renderer says about every tileset of 3D Tiles 1.1.
const of_the_machine = /tiles versions at 1.1 or higher|GL Driver Message|GPU stall due to ReadPixels|Automatic fallback to software WebGL/;

/// What the canvas shows, again.
export const picture_of = page => page.evaluate(async () => {
  const next = () => new Promise(done => requestAnimationFrame(done));
  window.viewer.mode.stage.invalidate();
  await next();
  await next();
  return document.querySelector('.view canvas').toDataURL();
});

/// A number as the page writes it.
export const number_of = text => Number(text.replaceAll(',', ''));
