// Next to the collapse: its clock, its bookmarks, what is shown. And the labels on the picture.
import type {CollapseMode, Lane} from '../modes/collapse';
import {state} from '../state';
import type {Detail, Shading} from '../collapse/run';
import {button, check, h, section, slider, table} from './dom';
import {count, length, significant} from './format';
import {keptCheck, keptChoice} from './kept';

const titles: Record<string, string> = {
  'length-normal': 'Formula 1',
  melax: 'Formula 2 (Melax)',
  'lindstrom-turk': 'Lindstrom-Turk (global)',
  quadric: 'Quadrics (global)',
};
const titleOf = (criterion: string): string => titles[criterion] ?? criterion;

/// What the next collapse costs, as its criterion has it.
function costOf({run, edge}: Lane): string {
  if (!edge) return 'no edge may go any more';
  if (run.criterion === 'length-normal') return `next edge costs ${significant(edge.lengthNormal)}`;
  if (run.criterion === 'melax') return `next edge costs ${significant(edge.melax)}`;
  if (run.criterion === 'lindstrom-turk') return `next edge costs ${significant(edge.planes)} (planes)`;
  return `next edge is ${length(edge.length)} long`;
}

export class CollapsePanel {
  readonly element = h('div', {class: 'panel'}, h('p', {class: 'hint'}, 'Reading the collapses.'));
  readonly labels = h('div', {class: 'labels'});
  private readonly figures = h('div', {class: 'scroll'});
  private readonly bookmarks = h('div', {class: 'buttons', role: 'group', 'aria-label': 'Interaction points'});
  private playButton = h('button');
  private readonly faces = h('input', {type: 'number', min: 1, step: 1, 'aria-label': 'Faces', class: 'faces', change: () => this.mode.jump(Number(this.faces.value))});
  private position = slider('Faces', {min: 0, max: 1000, step: 1, value: 1000}, () => undefined);
  private every = 0;
  built = false;
  private parts: {label: HTMLElement; faces: HTMLElement; lens: HTMLElement}[] = [];  // on the picture, one a criterion

  constructor(private readonly mode: CollapseMode) {
    mode.onChange(() => this.update());
    mode.stage.onFrame(() => this.placeLabels());
  }

  /// When the collapses are read.
  build(): void {
    const {mode} = this, first = mode.lanes[0]?.run;
    if (!first) return;
    this.built = true;
    const all = first.faces[0]!;
    this.every = niceStep(all);
    this.playButton = button('Play', () => mode.play(!mode.playing), {'data-key': 'p'});
    this.position = slider('Faces', {min: 0, max: 1000, step: 1, value: 1000}, value => mode.jump(this.facesAt(value)));
    const speed = slider('Speed', {min: 0, max: 4, step: 0.1, value: Math.log10(mode.speed)}, value => setSpeed(value));
    const setSpeed = (value: number): void => { mode.speed = 10 ** value; speed.set(value, `${significant(mode.speed, 2)} edges a second`); };
    setSpeed(Math.log10(mode.speed));
    const ask = h('input', {type: 'number', min: 0, step: 10, 'aria-label': 'Ask for a click only below so many faces', change: () => { mode.askBelow = Number(ask.value); }});
    mode.askBelow = Math.min(all, 100);
    ask.value = String(mode.askBelow);
    const every = h('input', {type: 'number', min: 1, step: 1, 'aria-label': 'Faces between interaction points', change: () => { this.every = Math.max(1, Number(every.value)); this.fillBookmarks(); }});
    every.value = String(this.every);
    this.element.replaceChildren(
      section('Collapse',
        h('div', {class: 'buttons'}, button('Back', () => mode.step(-1), {'data-key': 'back'}), button('Collapse edge', () => mode.step(1), {'data-key': 'space', class: 'strong'}), this.playButton, button('Original', () => mode.jump(all))),
        h('p', {class: 'hint'}, 'A click into the picture or the space bar collapses the marked edge.'),
        this.position.element,
        h('label', {class: 'line'}, 'Jump to', this.faces, 'faces'),
        h('label', {class: 'line'}, 'Ask for a click only below', ask, 'faces'),
        speed.element),
      section('At this moment', this.figures),
      section('Interaction points', h('label', {class: 'line'}, 'Every', every, 'faces'), this.bookmarks),
      section('Criteria', ...mode.lanes.map(({run}) => check(titleOf(run.criterion), mode.shown.some(l => l.run === run), on => this.choose(run.criterion, on)))),
      section('Display', keptChoice<Shading>('faces-as', 'Faces', [['greys', 'Three greys'], ['shaded', 'Shaded']], 'greys', value => mode.shade(value)).element,
        keptChoice<Detail['kind']>('detail', 'Detail', [['even', 'Everywhere'], ['lens', 'In a lens'], ['near', 'Near the eye']], 'even', value => mode.setDetail(value)).element,
        keptCheck('mark', 'Mark the next edge', true, on => mode.mark(on)), h('div', {class: 'buttons'}, button('All of it', () => mode.stage.overview(mode.box)), button('Look at the edge', () => this.lookAtEdge()))));
    this.fillBookmarks();
    this.update();
  }

  private choose(criterion: string, on: boolean): void {
    const chosen = this.mode.shown.map(l => l.run.criterion).filter(c => c !== criterion);
    if (on) chosen.push(criterion);
    this.mode.choose(chosen);
    state.set('criteria', chosen.join(','));
  }

  /// Faces at a place of the slider, which is logarithmic.
  private facesAt(value: number): number {
    const run = this.mode.first!, most = run.faces[0]!, least = Math.max(1, run.faces[run.steps]!);
    return Math.round(least * (most / least) ** (value / 1000));
  }

  private lookAtEdge(): void {
    const edge = this.mode.shown[0]?.edge;
    if (edge) this.mode.stage.navigator.frame(edge.result, edge.length * 6);
  }

  private fillBookmarks(): void {
    const run = this.mode.first;
    if (!run) return;
    const most = run.faces[0]!, least = run.faces[run.steps]!, points: number[] = [];
    for (let n = Math.floor((most - 1) / this.every) * this.every; n >= Math.max(1, least) && points.length < 60; n -= this.every) points.push(n);
    for (let power = 10 ** Math.floor(Math.log10(this.every)); power >= 1; power /= 10) for (const n of [5 * power, 2 * power, power]) if (n < this.every && n >= Math.max(10, least)) points.push(n);
    this.bookmarks.replaceChildren(...points.map(n => button(count(n), () => this.mode.jump(n), {value: n})));
  }

  private update(): void {
    const run = this.mode.first;
    if (!run) return;
    const most = run.faces[0]!, least = Math.max(1, run.faces[run.steps]!);
    this.position.set(most > least ? 1000 * Math.log(run.count / least) / Math.log(most / least) : 0, count(run.count));
    if (document.activeElement !== this.faces) this.faces.value = String(run.count);
    this.playButton.textContent = this.mode.playing ? 'Stop' : 'Play';
    const rows = this.mode.shown.map(lane => [titleOf(lane.run.criterion), count(lane.run.count), length(lane.run.error), costOf(lane).replace(/^next edge (costs|is) | \(planes\)$/g, '')]);
    this.figures.replaceChildren(table('At this moment', [{title: 'Criterion'}, {title: 'Faces', number: true}, {title: 'Deviation up to', number: true}, {title: 'Next edge', number: true}], rows));
    for (const b of this.bookmarks.querySelectorAll('button')) b.setAttribute('aria-pressed', String(Number(b.value) === run.count));
    this.parts = this.mode.shown.map(lane => {
      const faces = h('output');
      const label = h('div', {class: 'label', 'data-criterion': lane.run.criterion}, h('strong', {}, titleOf(lane.run.criterion)), faces, h('span', {class: 'cost'}, costOf(lane)));
      return {label, faces, lens: h('div', {class: 'lens', hidden: true})};
    });
    this.labels.replaceChildren(...this.parts.flatMap(({label, lens}) => [label, lens]));
    this.placeLabels();
  }

  private placeLabels(): void {
    const rectangles = this.mode.rectangles();
    this.parts.forEach(({label, faces, lens}, i) => {
      const r = rectangles[i], lane = this.mode.shown[i];
      if (!r || !lane) return;
      label.style.cssText = `left:${r.left}px;top:${r.top}px;max-width:${r.width}px`;
      label.classList.toggle('narrow', r.width < 240);
      faces.textContent = `${count(lane.run.count)} faces` + (this.mode.detail === 'even' ? '' : `, ${count(lane.drawn)} drawn`);
      const radius = this.mode.lensRadius(r);
      lens.hidden = this.mode.detail !== 'lens';
      lens.style.cssText = `left:${r.left + this.mode.lens.x * r.width - radius}px;top:${r.top + this.mode.lens.y * r.height - radius}px;width:${2 * radius}px;height:${2 * radius}px`;
    });
  }
}

/// 1, 2 or 5 times a power of ten: some ten points from the original to nothing.
function niceStep(faces: number): number {
  const rough = faces / 10, power = 10 ** Math.floor(Math.log10(Math.max(1, rough)));
  return Math.max(1, [1, 2, 5].map(x => x * power).filter(x => x <= rough).at(-1) ?? 1);
}
