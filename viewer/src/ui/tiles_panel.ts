// Next to a tileset: what is loaded and shown, how exact it is to be, the selected part.
import {Vector3} from 'three';
import type {TilesMode} from '../modes/tiles';
import {state} from '../state';
import {levelOf, usualBudget} from '../tiles/loading';
import {pathOf, type NamedPart} from '../tiles/names';
import {colorOfLevel, type Tint} from '../tiles/tints';
import {button, facts, h, section, slider, table} from './dom';
import {bytes, count, length, significant} from './format';
import {keptCheck, keptChoice} from './kept';
import {Tabs} from './tabs';

const usualError = 4;  // pixels
const errors = [0, 0.5, 1, 2, 4, 8, 16, 32, 64, 128] as const;
const budgets = [64e6, 128e6, usualBudget, 512e6];

export class TilesPanel {
  readonly element: HTMLElement;
  private readonly live = h('div', {class: 'live'});
  private readonly levels = h('div');
  private readonly part = h('div', {class: 'panel'});
  private readonly tabs: Tabs;

  constructor(private readonly mode: TilesMode) {
    this.tabs = new Tabs('Tiles', [
      {key: 'figures', title: 'Figures', content: h('div', {class: 'panel'}, section('Detail', this.error(), this.budget()), section('Now', this.live), section('Levels', this.levels))},
      {key: 'part', title: 'Part', content: this.part},
      {key: 'view', title: 'View', content: this.view()},
    ], key => state.set('panel', key));
    this.element = this.tabs.element;
    mode.onSelect(part => { this.showPart(part); if (part) this.tabs.show('part'); });
    mode.stage.onFrame(() => this.drawn());
    this.showPart(null);
    const wanted = state.get('panel');
    if (wanted) this.tabs.show(wanted, false);
  }

  private error(): HTMLElement {
    const said = state.number('error'), begin = Math.max(0, errors.findIndex(e => e >= (said ?? usualError)));
    const made = slider('Error in pixels', {min: 0, max: errors.length - 1, step: 1, value: begin}, i => set(i));
    const set = (i: number): void => {
      const pixels = errors[i]!;
      this.mode.setError(pixels);
      made.set(i, pixels === 0 ? '0: all of it' : String(pixels));
      state.set('error', pixels === usualError ? null : pixels);
    };
    set(begin);
    return made.element;
  }

  private budget(): HTMLElement {
    const options = budgets.map(b => [String(b), `${b / 1e6} MB`] as const);
    return keptChoice('memory', 'Memory', options, String(usualBudget), value => this.mode.setBudget(Number(value))).element;
  }

  private drawn(): void {
    const {set, stage} = this.mode, f = stage.figures, s = set.statistics;
    this.live.replaceChildren(facts([
      ['Tiles shown', h('output', {id: 'tiles-shown'}, count(set.shown.length))],
      ['Tiles loaded', h('output', {id: 'tiles-loaded'}, count(s.inCache))],
      ['On the way', count(s.queued + s.downloading + s.parsing)],
      ['Triangles drawn', h('output', {id: 'tiles-triangles'}, count(f.triangles))],
      ['Draws', count(f.draws)],
      ['Error seen', h('output', {id: 'tiles-error'}, `${significant(set.error, 2)} pixels at most`)],
      ['Came over the network', h('output', {id: 'tiles-bytes'}, bytes(set.bytes))],
      ['Memory', h('output', {id: 'tiles-memory'}, `${bytes(set.kept)} of ${bytes(set.budget)}`)],
      ['Time to draw', `${f.milliseconds.toFixed(1)} ms`],
      ...(this.mode.failed ? [['Not loaded', this.mode.failed] as const] : []),
    ]));
    this.levels.replaceChildren(this.levelTable());
  }

  private levelTable(): HTMLElement {
    const rows: {shown: number; loaded: number; error: number}[] = [];
    const at = (level: number) => {
      while (rows.length <= level) rows.push({shown: 0, loaded: 0, error: 0});
      return rows[level]!;
    };
    for (const tile of this.mode.set.loaded) {
      const row = at(levelOf(tile));
      ++row.loaded;
      row.error = Math.max(row.error, tile.geometricError);
    }
    for (const tile of this.mode.set.shown) ++at(levelOf(tile)).shown;
    const cells = rows.map((row, i) => [h('span', {}, h('i', {class: 'swatch small', style: `background:${colorOfLevel(i)}`}), String(i)), count(row.shown), count(row.loaded), length(row.error)]);
    return table('Levels', [{title: 'Level'}, {title: 'Shown', number: true}, {title: 'Loaded', number: true}, {title: 'Error', number: true}], cells);
  }

  private showPart(part: NamedPart | null): void {
    if (!part) {
      this.part.replaceChildren(h('p', {class: 'hint'}, 'Click a part in the picture, or choose one in the tree. The tree grows as tiles are loaded.'));
      return;
    }
    const size = part.box.getSize(new Vector3()), {triangles, tiles} = this.mode.highlight;
    const rows: [string, string | HTMLElement][] = [['Path', h('output', {id: 'part-path'}, pathOf(part))], ['Triangles shown', count(triangles)], ['In tiles', count(tiles)]];
    if (part.children.length > 0) rows.push(['Parts inside', count(part.children.length)]);
    if (!part.box.isEmpty()) rows.push(['Size', `${length(size.x)} × ${length(size.y)} × ${length(size.z)}`]);
    this.part.replaceChildren(section(part.name, facts(rows), h('div', {class: 'buttons'},
      button('Look at it', () => this.mode.lookAt(part)),
      ...(part.parent ? [button('Up', () => this.mode.select(part.parent))] : []))));
  }

  private view(): HTMLElement {
    const {mode} = this, {stage} = mode;
    const manner = keptChoice('move', 'Move', [['orbit', 'Orbit'], ['walk', 'Walk']] as const, 'orbit', value => { stage.navigator.manner = value; });
    const tint = keptChoice<Tint>('tint', 'Colours', [['none', 'Own'], ['level', 'By level'], ['tile', 'By tile']], 'none', value => mode.setTint(value));
    return h('div', {class: 'panel'}, section('Display', manner.element, tint.element, keptCheck('boxes', 'Boxes of tiles', false, on => mode.setBoxes(on), 'b')),
      section('Place', h('div', {class: 'buttons places'}, button('All of it', () => stage.overview(mode.box)))));
  }
}
