// Babylon.js as one script for the page: its packages have thousands of modules, which esbuild (a package of the viewer) puts into a few.
import {execFileSync} from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';

const here = path.dirname(new URL(import.meta.url).pathname), bundler = path.join(here, '../../viewer/node_modules/.bin/esbuild');
export const has_babylon = fs.existsSync(path.join(here, 'node_modules/@babylonjs/loaders')) && fs.existsSync(bundler);

/// Bundles page/NAME.mjs and the modules of Babylon.js that it imports. take_pictures(folder) serves the result at /out/babylon/NAME.js.
export function bundle_babylon(folder, name = 'babylon') {
  const options = ['--bundle', '--splitting', '--format=esm', '--log-level=warning', '--main-fields=module,main', `--outdir=${path.join(folder, 'babylon')}`];
  execFileSync(bundler, [path.join(here, 'page', `${name}.mjs`), ...options], {stdio: 'inherit'});
}
