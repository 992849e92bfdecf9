// Chromium without a window, and the small web server of its page. The page fetches its jobs from here and posts what it
// saw: no protocol of the browser's own is needed, and people can open the same page by hand. Nothing else is reachable.
import {spawn} from 'node:child_process';
import fs from 'node:fs';
import http from 'node:http';
import os from 'node:os';
import path from 'node:path';

const here = path.dirname(new URL(import.meta.url).pathname);
/// The shell without windows opens a page for half the CPU time of the whole browser.
export const chromium = process.env.WRLKIT_CHROMIUM ?? ['/usr/bin/chromium-headless-shell', '/usr/bin/chromium'].find(fs.existsSync) ?? '';
export const has_chromium = chromium !== '' && fs.existsSync(chromium);

const types = {'.html': 'text/html', '.css': 'text/css', '.mjs': 'text/javascript', '.js': 'text/javascript', '.png': 'image/png', '.glb': 'model/gltf-binary', '.wasm': 'application/wasm', '.json': 'application/json'};

export function serve_file(folders, url, response) {
  const [, top, ...rest] = decodeURIComponent(new URL(url, 'http://localhost').pathname).split('/');
  const file = folders[top] && !rest.includes('..') ? path.join(folders[top], ...rest) : '';
  if (!file || !fs.existsSync(file)) return response.writeHead(404).end();
  response.writeHead(200, {'Content-Type': types[path.extname(file)] ?? 'application/octet-stream'});
  fs.createReadStream(file).pipe(response);
}

async function body_of(request) {
  const pieces = [];
  for await (const piece of request) pieces.push(piece);
  return JSON.parse(Buffer.concat(pieces).toString());
}

function make_server(folder, jobs, got) {
  const folders = {page: path.join(here, 'page'), node_modules: path.join(here, 'node_modules'), out: folder};
  return http.createServer(async (request, response) => {
    if (request.url === '/job') return response.end(JSON.stringify((await jobs.next()).value ?? null));
    if (request.url !== '/result') return serve_file(folders, request.url, response);
    got(await body_of(request));
    response.end();
  });
}

/// Drawing without a graphics card, in as few processes as can be: starting one takes longer than most tests of a page.
export const drawing = ['--disable-gpu', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--force-color-profile=srgb', '--in-process-gpu',
  '--renderer-process-limit=1', '--disable-features=SpareRendererForSitePerProcess,IsolateOrigins,site-per-process'];

function start_chromium(url, profile) {
  const flags = ['--headless', '--no-sandbox', '--disable-quic', '--no-first-run', '--disable-background-networking', '--disable-component-update', '--disable-sync',
    '--disable-dev-shm-usage', '--enable-logging=stderr', `--user-data-dir=${profile}`, ...drawing];
  return spawn(chromium, [...flags, url], {detached: true, stdio: ['ignore', 'ignore', 'pipe']});
}

/// Has the page do all jobs, a list or what comes one after the other from an async generator; their files lie in `folder`
/// and have addresses below /out/. Gives the results to `got` in turn; throws when none comes for `patience` seconds.
export async function take_pictures(folder, jobs, got, patience = 120) {
  const profile = fs.mkdtempSync(path.join(os.tmpdir(), 'wrlkit-chromium-'));
  let server, browser, log = '', timer;
  try {
    await new Promise((resolve, reject) => {
      const wait = () => {
        clearTimeout(timer);
        timer = setTimeout(() => reject(new Error(`the browser says nothing for ${patience} s:\n${log.slice(-2000)}`)), patience * 1000);
      };
      server = make_server(folder, (jobs[Symbol.asyncIterator] ?? jobs[Symbol.iterator]).call(jobs), result => { wait(); result.end ? resolve() : got(result); });
      server.listen(0, '127.0.0.1', () => {
        wait();
        browser = start_chromium(`http://127.0.0.1:${server.address().port}/page/index.html`, profile);
        browser.stderr.setEncoding('utf8').on('data', text => { log += text; });
        browser.on('error', reject);
        browser.on('exit', code => reject(new Error(`the browser ended with ${code}:\n${log.slice(-2000)}`)));
      });
    });
  } finally {
    clearTimeout(timer);
    await stop(browser);
    server?.close();
    server?.closeAllConnections();
    fs.rmSync(profile, {recursive: true, force: true, maxRetries: 5});
  }
}

/// Ends the browser and all processes that it started.
async function stop(browser) {
  if (!browser?.pid || browser.exitCode !== null) return;
  const gone = new Promise(resolve => browser.once('exit', resolve));
  process.kill(-browser.pid, 'SIGKILL');
  await gone;
}
