// The page of a tileset begins here: wrlkit has put into it where tileset.json is.
import {Color} from 'three';
import {TilesMode} from './modes/tiles';
import {followAddress} from './state';
import {h} from './ui/dom';
import {counted, significant} from './ui/format';
import {listenToKeys} from './ui/keys';
import {Shell} from './ui/shell';
import {TilesPanel} from './ui/tiles_panel';
import {Tree} from './ui/tree';
import {Stage} from './view/stage';
import {pathOf, type NamedPart} from './tiles/names';
import './ui/style.css';

interface Contents {
  tileset: string;  // address, from the page
  name: string;
}

async function start(contents: Contents): Promise<void> {
  if (location.protocol === 'file:') throw new Error('a browser loads tiles from a web server only, as from wrlkit view --serve');
  const shell = new Shell(contents.name, document.getElementById('app')!);
  shell.say('Loading');
  const stage = new Stage(shell.canvas);
  shell.onTheme = () => stage.setBackground(new Color(shell.dark ? 0x1a1e23 : 0xf1f3f5));
  shell.onTheme();
  shell.onPrint = () => stage.drawNow();
  const mode = new TilesMode(stage, new URL(contents.tileset, location.href).href);
  await mode.begin();
  const camera = stage.rememberedCamera();
  stage.overview(mode.box);
  if (camera) stage.take(camera);
  const tree = new Tree<NamedPart>(mode.names, (part, closer) => mode.select(part, closer));
  const panel = new TilesPanel(mode);
  mode.onNames(() => tree.refresh());
  mode.onSelect(part => tree.select(part));
  stage.onFrame(() => {
    const chosen = mode.selected ? `${pathOf(mode.selected)} · ` : '', f = stage.figures;
    shell.say(`${chosen}${counted(mode.set.shown.length, 'tile')} · ${counted(f.triangles, 'triangle')} · error ≤ ${significant(mode.set.error, 2)} px${mode.set.loading ? ' · loading' : ''}`);
  });
  shell.setModes([{key: 'tiles', title: 'Tiles', left: tree.element, right: panel.element, over: null, enter: () => stage.show(mode)}]);
  listenToKeys(shell, () => mode);
  Object.assign(window, {viewer: {mode}});  // for tests, and for people at the console
  document.documentElement.dataset['ready'] = 'yes';
}

function fail(error: unknown): void {
  document.getElementById('app')!.replaceChildren(h('p', {class: 'failed', role: 'alert'}, `These tiles cannot be shown: ${error instanceof Error ? error.message : String(error)}`));
  throw error;
}

followAddress();
start(JSON.parse(document.getElementById('contents')!.textContent!) as Contents).catch(fail);
