// Next to the comparison: how it is shown, figures of both worlds, the deviation with its scale. And what lies on the picture:
// names, divider, legend.
import {heatColors} from '../compare/heat';
import type {CompareMode, Layout} from '../modes/compare';
import {state} from '../state';
import type {World} from '../world/world';
import {button, choice, facts, h, section, slider, table, type Choice} from './dom';
import {bytes, count, length, millimetres, significant} from './format';
import {keptCheck} from './kept';

const usualGain = 2;  // as a power of two

export class ComparePanel {
  readonly element: HTMLElement;
  readonly over: HTMLElement;
  private readonly names: [HTMLElement, HTMLElement];
  private readonly divider: HTMLElement;
  private readonly legend = h('div', {class: 'scale'});
  private readonly layout: Choice<Layout>;
  private readonly side: Choice<'0' | '1'> | null;
  private readonly scale = slider('End of the scale', {min: -3, max: 0, step: 0.02, value: 0}, value => this.mode.setScale((this.mode.apart?.max ?? 1) * 10 ** value));
  private readonly gain = slider('Difference, times', {min: 0, max: 6, step: 0.5, value: usualGain}, value => this.setGain(value));

  constructor(private readonly mode: CompareMode) {
    const [a, b] = mode.worlds.map(w => w.world) as [World, World];
    const options: [Layout, string][] = [['divider', 'Divider'], ['side', 'Side by side'], ['difference', 'Difference']];
    if (mode.apart) options.push(['deviation', 'Deviation']);
    this.layout = choice('Compare', options, mode.layout, value => void mode.setLayout(value));
    this.side = mode.apart ? choice('Measured on', [['0', 'first'], ['1', 'second']] as const, '0', value => void mode.setSide(value === '0' ? 0 : 1)) : null;
    this.names = [h('div', {class: 'label'}, h('strong', {}, a.name)), h('div', {class: 'label'}, h('strong', {}, b.name))];
    this.divider = this.makeDivider();
    this.over = h('div', {class: 'labels'}, ...this.names, this.divider, this.legend);
    this.element = h('div', {class: 'panel'},
      section('Display', this.layout.element, this.gain.element, keptCheck('compare-edges', 'Edges (hidden lines removed)', false, on => mode.setEdges(on), 'x'), h('div', {class: 'buttons'}, button('All of it', () => mode.stage.overview(mode.box)))),
      ...(mode.apart ? [this.deviation()] : [section('Deviation', h('p', {}, 'Nothing was measured: one of the worlds shows no surface.'))]),
      section('Figures', this.figures(a, b)));
    mode.onChange(() => this.update());
    mode.stage.onFrame(() => this.place());
    this.setGain(Math.max(0, Math.min(6, state.number('gain') ?? usualGain)));
  }

  private setGain(value: number): void {
    this.mode.setGain(2 ** value);
    state.set('gain', value === usualGain ? null : value);
    this.gain.set(value, significant(2 ** value, 2));
  }

  private deviation(): HTMLElement {
    const {apart} = this.mode;
    if (!apart) return h('div');
    return section('Deviation',
      facts([['Largest', h('output', {id: 'largest-deviation'}, millimetres(apart.max))], ['Root mean square', millimetres(apart.rms)], ['At', apart.where.map(x => significant(x, 4)).join('  ')]]),
      h('div', {class: 'buttons'}, button('Go to the worst place', () => void this.mode.goToWorst(), {class: 'strong'})),
      this.side!.element, this.scale.element);
  }

  private figures(a: World, b: World): HTMLElement {
    const row = (name: string, of: (w: World) => number, text: (n: number) => string = count): string[] => {
      const [x, y] = [of(a), of(b)];
      return [name, text(x), text(y), x === y ? 'same' : x > 0 ? `${y >= x ? '+' : '−'}${Math.abs(100 * (y - x) / x).toFixed(1)} %` : ''];
    };
    return h('div', {class: 'scroll'}, table('Figures of both', [{title: ''}, {title: 'First', number: true}, {title: 'Second', number: true}, {title: 'Change', number: true}], [
      row('Triangles', w => w.triangles), row('Parts', w => w.parts.length), row('Shapes', w => w.parts.filter(p => p.mesh !== null).length),
      row('Materials', w => w.file.materials?.length ?? 0), row('As GLB', w => w.size, bytes)]));
  }

  private makeDivider(): HTMLElement {
    const {mode} = this;
    const handle = h('div', {class: 'divider', role: 'slider', tabindex: 0, 'aria-label': 'Divider', 'aria-valuemin': 0, 'aria-valuemax': 100, 'aria-valuenow': 50,
      pointerdown: (e: PointerEvent) => handle.setPointerCapture(e.pointerId),
      pointermove: (e: PointerEvent) => { if (handle.hasPointerCapture(e.pointerId)) mode.setDivider((e.clientX - mode.stage.canvas.getBoundingClientRect().left) / mode.stage.width); },
      keydown: (e: KeyboardEvent) => {
        const step = e.key === 'ArrowLeft' ? -0.02 : e.key === 'ArrowRight' ? 0.02 : 0;
        if (step !== 0) mode.setDivider(mode.divider + step), e.preventDefault();
      }}, h('span', {'aria-hidden': 'true'}, '⇔'));
    return handle;
  }

  private update(): void {
    const {mode} = this, deviation = mode.layout === 'deviation';
    this.layout.set(mode.layout);
    this.side?.set(mode.side === 0 ? '0' : '1');
    this.gain.element.hidden = mode.layout !== 'difference';
    this.divider.hidden = mode.layout !== 'divider';
    this.divider.setAttribute('aria-valuenow', String(Math.round(100 * mode.divider)));
    this.legend.hidden = !deviation;
    if (mode.apart) this.scale.set(Math.log10(mode.scale / (mode.apart.max || 1)), millimetres(mode.scale));
    const ticks = [0, 0.25, 0.5, 0.75, 1].map(t => h('span', {}, millimetres(t * mode.scale)));
    this.legend.replaceChildren(h('div', {class: 'ramp', style: `background:linear-gradient(to right,${heatColors.join()})`}), h('div', {class: 'ticks'}, ...ticks),
      h('p', {}, `Distance of ${mode.worlds[mode.side].world.name} from ${mode.worlds[mode.side === 0 ? 1 : 0].world.name}; largest ${length(mode.apart?.sides[mode.side].max ?? 0)}`));
    this.place();
  }

  private place(): void {
    const {mode} = this, {width, height} = mode.stage, [first, second] = this.names;
    const wide = width > height, side = mode.layout === 'side';
    first.hidden = second.hidden = mode.layout === 'difference' || mode.layout === 'deviation';
    const widest = side && !wide ? '' : ';max-width:50%';
    first.style.cssText = `left:0;top:0${widest}`;
    second.style.cssText = (side ? wide ? 'left:50%;top:0' : 'left:0;top:50%' : 'right:0;top:0') + widest;
    this.divider.style.left = `${100 * mode.divider}%`;
  }
}
