// A page of `wrlkit view` in Chromium, opened from disk. Whatever it says on the console or asks of a network is a fault.
import {spawnSync} from 'node:child_process';
import path from 'node:path';
import {pathToFileURL} from 'node:url';
import {chromium} from 'playwright-core';

const executablePath = process.env.WRLKIT_CHROMIUM ?? '/usr/bin/chromium';
const flags = ['--disable-gpu', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--force-color-profile=srgb'];

export const start_chromium = () => chromium.launch({executablePath, args: flags});

/// Runs wrlkit; its standard output.
export function wrlkit(program, ...args) {
  const run = spawnSync(program, args.map(String), {encoding: 'utf8', maxBuffer: 1 << 28});
  if (run.status !== 0 && run.status !== 1) throw new Error(`wrlkit ${args.join(' ')}: ${run.status}\n${run.stderr}`);
  return run.stdout;
}

/// {page, faults}: the page when all of it is there; faults fills while it lives.
export async function open_page(browser, file, {width = 1000, height = 640, fragment = '', dark = false, touch = false} = {}) {
  const context = await browser.newContext({viewport: {width, height}, colorScheme: dark ? 'dark' : 'light', hasTouch: touch});
  const page = await context.newPage();
  const faults = [];
  page.on('console', message => { if (['error', 'warning'].includes(message.type()) && !of_the_machine.test(message.text())) faults.push(`${message.type()}: ${message.text()}`); });
  page.on('pageerror', error => faults.push(`exception: ${error.stack ?? error}`));
  page.on('request', request => { if (!/^(file|data|blob):/.test(request.url())) faults.push(`asks for ${request.url()}`); });
  await page.goto(pathToFileURL(path.resolve(file)).href + fragment);
  try {
    await page.waitForSelector('html[data-ready]', {timeout: 30_000, state: 'attached'});
  } catch (error) {
    throw new Error(`${file} does not get ready: ${faults.join('\n')} ${error}`);
  }
  return {page, faults, close: () => context.close()};
}

// What Chromium says about drawing without a graphics card, in headless tests only.
const of_the_machine = /GL Driver Message|GPU stall due to ReadPixels|Automatic fallback to software WebGL/;

/// A number as the page writes it.
export const number_of = text => Number(text.replaceAll(',', ''));
