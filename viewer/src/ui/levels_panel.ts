// The levels of detail of a world: by distance or one for all, tinted, what is shown and how wrong it is.
import type {WorldMode} from '../modes/world';
import {levelColors, type LevelControl} from '../world/levels';
import {choice, h, section, slider, table} from './dom';
import {count, significant} from './format';
import {keptCheck} from './kept';
import {poppingPanel} from './popping_panel';
import {state} from '../state';

export function levelsPanel(mode: WorldMode, levels: LevelControl): HTMLElement {
  const figures = h('div'), key = `level${mode.suffix}`;
  const level = slider('Level', {min: 0, max: levels.most - 1, step: 1, value: 0}, value => fix(value));
  const manner = choice('Show', [['distance', 'By distance'], ['fixed', 'One level']] as const, 'distance', value => fix(value === 'fixed' ? Number(level.input.value) : null));
  const fix = (value: number | null): void => {
    levels.fixed = value;
    manner.set(value === null ? 'distance' : 'fixed');
    if (value !== null) level.set(value, value === 0 ? '0, the finest' : String(value));
    state.set(key, value);
    mode.stage.invalidate();
  };
  level.set(0, '0, the finest');
  const said = state.number(key);
  if (said !== null) fix(Math.max(0, Math.min(levels.most - 1, Math.round(said))));
  mode.stage.onFrame(() => {
    const f = levels.figures;
    const rows = f.shown.map((n, i) => [h('span', {}, h('i', {class: 'swatch small', style: `background:${levelColors[i % levelColors.length]}`}), String(i)), count(n), count(f.triangles[i]!)]);
    figures.replaceChildren(
      table('Levels that are shown', [{title: 'Level'}, {title: 'Objects', number: true}, {title: 'Triangles', number: true}], rows),
      h('p', {}, 'Error that is seen: ', h('output', {id: 'pixel-error'}, Number.isFinite(f.pixels) ? `${significant(f.pixels, 2)} pixels at most` : 'the eye is inside of a coarse object'), h('span', {class: 'soft'}, ', when a level begins where it is wrong by one pixel of 1080')));
  });
  return h('div', {class: 'panel'},
    section('Levels of detail', manner.element, level.element,
      keptCheck(`tint${mode.suffix}`, 'Tint by level', false, on => mode.setTint(on)), keptCheck(`flash${mode.suffix}`, 'Flash what switches', false, on => { mode.flash = on; })),
    section('Shown now', figures), poppingPanel(mode));
}
