// The mode in which edges collapse, one by one or by themselves, by one to three criteria side by side with one clock.
import {Box3, BufferGeometry, DirectionalLight, Float32BufferAttribute, HemisphereLight, Points, PointsMaterial, type Scene} from 'three';
import {LineMaterial} from 'three/addons/lines/LineMaterial.js';
import {LineSegments2} from 'three/addons/lines/LineSegments2.js';
import {LineSegmentsGeometry} from 'three/addons/lines/LineSegmentsGeometry.js';
import type {Edge} from '../collapse/cost';
import {readWorld} from '../collapse/file';
import {Run, type Detail, type Shading} from '../collapse/run';
import {readFile} from '../data';
import {state} from '../state';
import type {Mode, Stage} from '../view/stage';

/// What is seen of the next collapse: the edge, and where its vertex will be.
class NextEdge {
  private readonly line = new LineSegments2(new LineSegmentsGeometry(), new LineMaterial({color: 0xe0162b, linewidth: 5, depthTest: false}));
  private readonly dot = new Points(new BufferGeometry(), new PointsMaterial({color: 0xe0162b, size: 8, sizeAttenuation: false, depthTest: false}));

  constructor(scene: Scene) {
    this.line.renderOrder = this.dot.renderOrder = 1;
    this.line.frustumCulled = this.dot.frustumCulled = false;
    scene.add(this.line, this.dot);
  }

  show(edge: Edge | null): void {
    this.line.visible = this.dot.visible = edge !== null;
    if (!edge) return;
    this.line.geometry.dispose();
    this.line.geometry = new LineSegmentsGeometry().setPositions([...edge.from.toArray(), ...edge.to.toArray()]);
    this.dot.geometry.setAttribute('position', new Float32BufferAttribute(edge.result.toArray(), 3));
  }
}

export interface Lane {
  run: Run;
  edge: (Edge & {surface: string}) | null;
  marks: NextEdge;
  lamp: DirectionalLight;
  drawn: number;          // faces in the picture
}

export interface Rectangle {
  left: number;
  top: number;
  width: number;
  height: number;
}

export class CollapseMode implements Mode {
  readonly box = new Box3();
  lanes: Lane[] = [];     // of all criteria that are there
  shown: Lane[] = [];
  playing = false;
  askBelow = 0;           // faces
  speed = 60;             // collapses a second
  markNext = true;
  detail: Detail['kind'] = 'even';
  readonly lens = {x: 0.5, y: 0.5};  // in each part of the canvas, from its upper left corner
  private owed = 0;       // part of a collapse
  private loading: Promise<void> | null = null;
  private readonly changed: (() => void)[] = [];

  constructor(readonly stage: Stage, private readonly files: {criterion: string; file: number}[]) {
    const [x, y] = (state.get('lens') ?? '').split(' ').map(Number);
    if (Number.isFinite(x) && Number.isFinite(y)) Object.assign(this.lens, {x, y});
    stage.canvas.addEventListener('pointermove', e => this.moveLens(e.offsetX, e.offsetY));
  }

  onChange(call: () => void): void { this.changed.push(call); }

  async enter(): Promise<void> {
    this.stage.navigator.manner = 'free';
    await (this.loading ??= this.load());
    this.stage.show(this);
    this.update();
  }

  private async load(): Promise<void> {
    for (const {criterion, file} of this.files) {
      const run = new Run(criterion, readWorld(await readFile(file)));
      const lamp = new DirectionalLight(0xffffff, 2.6);
      run.scene.add(lamp, lamp.target, new HemisphereLight(0xffffff, 0x777777, 0.7));
      this.lanes.push({run, edge: null, marks: new NextEdge(run.scene), lamp, drawn: run.count});
      this.box.union(run.box);
    }
    const faces = state.number('faces');
    this.choose(state.get('criteria')?.split(',') ?? this.lanes.map(l => l.run.criterion));
    if (faces !== null) this.jump(faces);
  }

  /// The criteria that are seen; at least one.
  choose(criteria: string[]): void {
    const chosen = this.lanes.filter(l => criteria.includes(l.run.criterion));
    this.shown = chosen.length > 0 ? chosen : this.lanes.slice(0, 1);
    this.update();
  }

  get first(): Run | null { return this.shown[0]?.run ?? null; }

  step(by: number): void {
    for (const {run} of this.lanes) run.goTo(run.at + by);
    this.update();
  }

  jump(faces: number): void {
    for (const {run} of this.lanes) run.goTo(run.stepOf(faces));
    this.update();
  }

  play(on: boolean): void {
    this.playing = on;
    this.owed = 0;
    this.update();
  }

  shade(shading: Shading): void {
    for (const {run} of this.lanes) run.shade(shading);
    this.stage.invalidate();
  }

  mark(on: boolean): void {
    this.markNext = on;
    this.update();
  }

  setDetail(kind: Detail['kind']): void {
    this.detail = kind;
    this.update();
  }

  private moveLens(x: number, y: number): void {
    const r = this.rectangles().find(part => x >= part.left && x < part.left + part.width && y >= part.top && y < part.top + part.height);
    if (this.detail !== 'lens' || !r) return;
    this.lens.x = (x - r.left) / r.width;
    this.lens.y = (y - r.top) / r.height;
    state.set('lens', `${this.lens.x} ${this.lens.y}`);
    this.stage.invalidate();
  }

  /// The lens's radius in a part of the canvas, pixels.
  lensRadius({width, height}: Rectangle): number { return 0.16 * Math.min(width, height); }

  private wantedDetail(part: Rectangle): Detail {
    if (this.detail === 'lens') return {kind: 'lens', x: 2 * this.lens.x - 1, y: 1 - 2 * this.lens.y, radius: this.lensRadius(part) / (part.height / 2)};
    return this.detail === 'near' ? {kind: 'near', distance: this.stage.navigator.distance} : {kind: 'even'};
  }

  private update(): void {
    for (const lane of this.lanes) {
      lane.edge = lane.run.next();
      lane.marks.show(this.markNext ? lane.edge : null);
    }
    if (this.first) state.set('faces', this.first.at > 0 ? this.first.count : null);
    for (const call of this.changed) call();
    this.stage.invalidate();
  }

  /// True while it is waiting for a click: few faces are left.
  get asks(): boolean { return this.first !== null && this.first.count <= this.askBelow; }

  tick(seconds: number): boolean {
    if (!this.playing || !this.first) return false;
    if (this.asks || this.first.at === this.first.steps) {
      this.play(false);
      return false;
    }
    this.owed += seconds * this.speed;
    const steps = Math.floor(this.owed);
    this.owed -= steps;
    for (let i = 0; i < steps && !this.asks; ++i) for (const {run} of this.lanes) run.goTo(run.at + 1);
    if (steps > 0) this.update();
    return true;
  }

  click(): void { this.step(1); }

  /// The parts of the canvas, one a criterion.
  rectangles(): Rectangle[] {
    const {width, height} = this.stage, n = this.shown.length, wide = width > height;
    return this.shown.map((_, i) => wide ? {left: i * width / n, top: 0, width: width / n, height} : {left: 0, top: i * height / n, width, height: height / n});
  }

  picture(): Rectangle | Stage { return this.rectangles()[0] ?? this.stage; }

  draw(stage: Stage): void {
    const rectangles = this.rectangles();
    this.shown.forEach((lane, i) => {
      const {run, lamp} = lane;
      const {left, top, width, height} = rectangles[i]!;
      run.flush();
      lamp.position.set(0.3, 0.5, 1).applyQuaternion(stage.camera.quaternion).add(stage.camera.position);
      lamp.target.position.copy(stage.camera.position);
      stage.within(left, stage.height - top - height, width, height, () => {
        lane.drawn = run.refine(this.wantedDetail(rectangles[i]!), stage.camera);
        stage.renderer.render(run.scene, stage.camera);
      });
    });
  }
}
