// Popping on demand: what each switch of level changes in the picture, the strongest first, and both levels with their difference.
import type {WorldMode} from '../modes/world';
import {switches, type Pop} from '../world/popping';
import {labelOf} from '../world/world';
import {button, h, section, table} from './dom';
import {count, length, significant} from './format';

const rowsShown = 20;
const slice = 30;   // milliseconds of work between two pictures of the page

export function poppingPanel(mode: WorldMode): HTMLElement {
  const all = switches(mode.world);
  if (all.length === 0) return section('Popping', h('p', {}, 'The file does not say at which distance levels switch.'));
  const progress = h('p', {class: 'hint', role: 'status'}), list = h('div', {class: 'scroll'}), shown = h('div');
  let running = 0;

  const fill = (pops: readonly Pop[]): void => {
    const rows = pops.slice(0, rowsShown).map(p => [
      button(labelOf(p.object.part), () => show(p), {class: 'link'}), `${p.level} → ${p.level + 1}`, length(p.distance), count(p.changed)]);
    list.replaceChildren(table('Switches that change most', [{title: 'Object'}, {title: 'Level'}, {title: 'At', number: true}, {title: 'Pixels', number: true}], rows));
  };
  const show = (chosen: Pop): void => {
    const pop = mode.popping(chosen);
    shown.replaceChildren(popPictures(pop), h('div', {class: 'buttons'}, button('Look from there', () => mode.goToSwitch(pop, pop.distance))));
  };
  const measure = (): void => {
    const run = ++running, found: Pop[] = [];
    const go = (): void => {
      if (run !== running) return;
      const end = performance.now() + slice;
      while (found.length < all.length && performance.now() < end) found.push({...mode.popping(all[found.length]!), pictures: []});
      const done = found.length === all.length;
      progress.textContent = done ? `${count(all.length)} switches, seen from here.` : `${count(found.length)} of ${count(all.length)}`;
      if (!done) return void requestAnimationFrame(go);
      found.sort((a, b) => b.changed - a.changed);
      fill(found);
      show(found[0]!);
    };
    go();
  };
  return section('Popping',
    h('p', {class: 'hint'}, 'What changes in a picture of 1920 × 1080 when one level takes the place of the other, at the distance where that happens.'),
    h('div', {class: 'buttons'}, button('Measure all switches', measure, {id: 'measure-popping'})), progress, list, shown);
}

function popPictures(pop: Pop): HTMLElement {
  const names = [`Level ${pop.level}`, `Level ${pop.level + 1}`, 'Difference'];
  const pictures = pop.pictures.map((image, i) => {
    const canvas = h('canvas', {width: image.width, height: image.height, role: 'img', 'aria-label': `${names[i]} of ${labelOf(pop.object.part)}`});
    canvas.getContext('2d')?.putImageData(image, 0, 0);
    return h('figure', {}, canvas, h('figcaption', {}, names[i]!));
  });
  return h('div', {class: 'pops'}, h('div', {class: 'pictures'}, ...pictures),
    h('p', {}, h('output', {id: 'pop-pixels'}, `${count(pop.changed)} of ${count(pop.covered)} pixels change`),
      `, by ${significant(pop.mean, 2)} of 255 on average and ${pop.largest} at most. `, h('span', {class: 'soft'}, 'Counted from 9 of 255 on. Small differences are made brighter.')));
}
