// The page begins here: what wrlkit has put into it is read, and shown.
import {Box3, Color} from 'three';
import {readContents, readFile, type Contents} from './data';
import {CollapseMode} from './modes/collapse';
import {CompareMode} from './modes/compare';
import {WorldMode} from './modes/world';
import {followAddress} from './state';
import {CollapsePanel} from './ui/collapse_panel';
import {ComparePanel} from './ui/compare_panel';
import {h} from './ui/dom';
import {counted, significant} from './ui/format';
import {listenToKeys} from './ui/keys';
import {Shell, type ModeView} from './ui/shell';
import {Tree} from './ui/tree';
import {WorldPanel} from './ui/world_panel';
import {Stage} from './view/stage';
import {loadWorld} from './world/load';
import {labelOf} from './world/world';
import './ui/style.css';

function worldView(mode: WorldMode, shell: Shell, key: string, title: string): ModeView {
  const tree = new Tree(mode.world, (part, closer) => mode.select(part, closer));
  const panel = new WorldPanel(mode);
  mode.onSelect(part => tree.select(part));
  mode.stage.onFrame(() => {
    if (shell.mode !== key) return;
    const f = mode.stage.figures;
    const wrong = mode.levels && Number.isFinite(mode.levels.figures.pixels) ? ` · error ≤ ${significant(mode.levels.figures.pixels, 2)} px` : '';
    const chosen = mode.selected ? `${labelOf(mode.selected)} · ` : '';
    shell.say(mode.world.empty ? 'This world has nothing that could be seen.' : `${chosen}${counted(f.triangles, 'triangle')} · ${counted(f.draws, 'draw')} · ${f.milliseconds.toFixed(1)} ms${wrong}`);
  });
  return {key, title, left: tree.element, right: panel.element, over: null, enter: () => mode.enter()};
}

function collapseView(mode: CollapseMode, shell: Shell): ModeView {
  const panel = new CollapsePanel(mode);
  const enter = (): void => {
    shell.say('Reading the collapses');
    void mode.enter().then(() => {
      if (!panel.built) panel.build();
      shell.say('');
      document.documentElement.dataset['collapse'] = 'ready';
    });
  };
  return {key: 'collapse', title: 'Collapse', left: null, right: panel.element, over: panel.labels, enter};
}

function compareView(mode: CompareMode, shell: Shell): ModeView {
  const panel = new ComparePanel(mode);
  return {key: 'compare', title: 'Compare', left: null, right: panel.element, over: panel.over, enter: () => { shell.say(''); mode.enter(); }};
}

async function start(contents: Contents): Promise<void> {
  const shell = new Shell(contents.worlds.map(w => w.name).join(' and '), document.getElementById('app')!);
  shell.say('Loading');
  const stage = new Stage(shell.canvas);
  shell.onTheme = () => stage.setBackground(new Color(shell.dark ? 0x1a1e23 : 0xf1f3f5));
  shell.onTheme();
  shell.onPrint = () => stage.drawNow();
  const first = contents.worlds[0]!;
  const world = await loadWorld(first.name, await readFile(first.file));
  const mode = new WorldMode(world, stage);
  stage.overview(world.box);
  const begin = world.viewpoints[0];
  if (begin) mode.goTo(begin);
  if (!stage.sees(world.parts.flatMap(part => part.meshes).map(mesh => new Box3().setFromObject(mesh)))) stage.overview(world.box);
  const views = [worldView(mode, shell, 'world', contents.worlds.length > 1 ? 'First' : 'World')];
  const second = contents.worlds[1];
  let compare: CompareMode | null = null;
  if (second) {
    const other = new WorldMode(await loadWorld(second.name, await readFile(second.file)), stage, '2');
    compare = new CompareMode(stage, [mode, other], contents.deviation ?? null);
    views.unshift(compareView(compare, shell));
    views.push(worldView(other, shell, 'world2', 'Second'));
    other.recall();
  }
  const collapse = contents.collapses.length > 0 ? new CollapseMode(stage, contents.collapses) : null;
  if (collapse) views.push(collapseView(collapse, shell));
  Object.assign(window, {viewer: {world, mode, compare, collapse}});  // for tests, and for people at the console
  const camera = stage.rememberedCamera();
  shell.setModes(views);
  if (camera) stage.take(camera);
  mode.recall();
  listenToKeys(shell, () => shell.mode === 'world2' && compare ? compare.worlds[1] : mode);
  document.documentElement.dataset['ready'] = 'yes';
}

function fail(error: unknown): void {
  document.getElementById('app')!.replaceChildren(h('p', {class: 'failed', role: 'alert'}, `This page cannot be shown: ${error instanceof Error ? error.message : String(error)}`));
  throw error;
}

followAddress();
start(readContents()).catch(fail);
