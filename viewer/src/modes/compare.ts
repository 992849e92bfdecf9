// The mode in which two worlds are compared: one camera, a divider or side by side, the difference of the pictures, the distance of
// the surfaces.
import {Box3, BufferGeometry, Color, Float32BufferAttribute, Points, PointsMaterial, Scene, Vector3} from 'three';
import {Difference} from '../compare/difference';
import {Heat, heatColors} from '../compare/heat';
import {readFile, type Apart} from '../data';
import {state} from '../state';
import {drawEdges} from '../view/overlay';
import type {Mode, Stage} from '../view/stage';
import type {WorldMode} from './world';

export const layouts = ['divider', 'side', 'difference', 'deviation'] as const;
export type Layout = typeof layouts[number];

export class CompareMode implements Mode {
  readonly box: Box3;
  layout: Layout = 'divider';
  divider = 0.5;     // part of the width that shows the first world
  side: 0 | 1 = 0;   // of the deviation: of the first world from the second, or the other way
  edges = false;
  scale: number;     // metres at the end of the scale
  private readonly difference = new Difference();
  private readonly heat: (Heat | null)[] = [null, null];
  private readonly heatScene = new Scene();
  private readonly worst = new Points(new BufferGeometry(), new PointsMaterial({color: 0x1458c8, size: 14, sizeAttenuation: false, depthTest: false}));
  private readonly changed: (() => void)[] = [];

  constructor(readonly stage: Stage, readonly worlds: readonly [WorldMode, WorldMode], readonly apart: Apart | null) {
    this.box = worlds[0].box.clone().union(worlds[1].box);
    this.scale = apart?.max ?? 1;
    this.worst.renderOrder = 1;
    this.worst.frustumCulled = false;
    this.worst.visible = false;
    this.heatScene.add(this.worst);
    const wanted = state.get('layout') as Layout | null;
    if (wanted && layouts.includes(wanted)) this.layout = wanted;
    const said = state.get('side');
    this.side = said ? said === '1' ? 1 : 0 : this.worse;
    if (apart && state.get('worst')) this.markWorst(apart.where);
    this.scale *= state.number('scale') ?? 1;
    this.divider = state.number('divider') ?? this.divider;
  }

  /// The world on which the larger deviation was measured.
  private get worse(): 0 | 1 { return this.apart && this.apart.sides[1].max > this.apart.sides[0].max ? 1 : 0; }

  onChange(call: () => void): void { this.changed.push(call); }

  enter(): void {
    this.stage.navigator.manner = 'orbit';
    this.stage.show(this);
    void this.setLayout(this.layout);
  }

  async setLayout(layout: Layout): Promise<void> {
    this.layout = layout;
    state.set('layout', layout);
    if (layout === 'deviation') await this.loadHeat();
    this.update();
  }

  async setSide(side: 0 | 1): Promise<void> {
    this.side = side;
    state.set('side', side);
    await this.loadHeat();
    this.update();
  }

  setScale(metres: number): void {
    this.scale = metres;
    if (this.apart && this.apart.max > 0) state.set('scale', metres / this.apart.max);
    this.update();
  }

  setDivider(part: number): void {
    this.divider = Math.max(0.02, Math.min(0.98, part));
    state.set('divider', this.divider);
    this.update();
  }

  setGain(factor: number): void {
    this.difference.gain = factor;
    this.stage.invalidate();
  }

  setEdges(on: boolean): void {
    this.edges = on;
    for (const world of this.worlds) world.setEdges(on);
  }

  /// Looks at the place where the surfaces are farthest apart, on the side that has it.
  async goToWorst(): Promise<void> {
    if (!this.apart) return;
    const {max, where} = this.apart, place = new Vector3(...where);
    this.side = this.worse;
    state.set('side', this.side);
    state.set('worst', 1);
    this.markWorst(where);
    await this.setLayout('deviation');
    this.stage.navigator.frame(place, Math.max(4 * max, this.box.getSize(new Vector3()).length() / 60));
  }

  private markWorst(where: readonly number[]): void {
    this.worst.geometry.setAttribute('position', new Float32BufferAttribute(where, 3));
    this.worst.visible = true;
  }

  private async loadHeat(): Promise<void> {
    if (!this.apart || this.heat[this.side]) return;
    const side = this.side;
    const heat = new Heat(await readFile(this.apart.sides[side].file), heatColors.map(c => new Color(c)));
    this.heat[side] = heat;
    this.heatScene.add(heat.mesh);
  }

  private update(): void {
    this.heat.forEach((heat, i) => {
      if (!heat) return;
      heat.mesh.visible = i === this.side;
      heat.scale = this.scale;
    });
    for (const call of this.changed) call();
    this.stage.invalidate();
  }

  private drawDeviation({renderer, camera}: Stage): void {
    const {worst, heatScene} = this;
    renderer.render(heatScene, camera);
    if (!this.edges) return;
    const marked = worst.visible;
    worst.visible = false;
    drawEdges(renderer, heatScene, camera);
    worst.visible = marked;
  }

  picture(): {width: number; height: number} {
    const {width, height} = this.stage, wide = width > height;
    return this.layout !== 'side' ? this.stage : {width: wide ? width / 2 : width, height: wide ? height : height / 2};
  }

  draw(stage: Stage): void {
    const {width, height} = stage, [a, b] = this.worlds;
    if (this.layout === 'deviation') return this.drawDeviation(stage);
    if (this.layout === 'difference') return this.difference.draw(stage.renderer, width, height, [() => a.draw(stage), () => b.draw(stage)]);
    if (this.layout === 'side') {
      const wide = width > height;
      stage.within(0, wide ? 0 : height / 2, wide ? width / 2 : width, wide ? height : height / 2, () => a.draw(stage));
      stage.within(wide ? width / 2 : 0, 0, wide ? width / 2 : width, wide ? height : height / 2, () => b.draw(stage));
      return;
    }
    const left = Math.round(width * this.divider);
    stage.clipped(0, left, () => a.draw(stage));
    stage.clipped(left, width - left, () => b.draw(stage));
  }
}
