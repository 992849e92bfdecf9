// The mode in which one world is looked at.
import {AnimationMixer, Color, Raycaster, Scene, Vector3, type AnimationAction} from 'three';
import {Behaviour} from '../behaviour/behaviour';
import {state} from '../state';
import {askToOpen} from '../ui/open_question';
import {Boxes, drawEdges, Flashes, Highlight} from '../view/overlay';
import type {Mode, Stage} from '../view/stage';
import {Batches, batchedLayer} from '../world/batches';
import {Forms} from '../world/forms';
import {fieldOfView} from 'wrlkit-three';
import {LevelControl} from '../world/levels';
import {Lights, type Lighting} from '../world/lights';
import {PopMeter, type Pop, type Switch} from '../world/popping';
import {Looks, type Look} from '../world/looks';
import {boxOf, hide, isShown, partOf, type Part, type Viewpoint, type World} from '../world/world';

const mostHidden = 300;  // parts that the address keeps

export class WorldMode implements Mode {
  readonly scene = new Scene();
  readonly lights: Lights;
  readonly looks = new Looks();
  readonly forms: Forms;
  private readonly batches: Batches;
  look: Look = 'full';
  private lighting: Lighting = 'world';
  private tinted = false;
  edges = false;
  playing = false;
  manner: 'orbit' | 'walk' = 'orbit';
  selected: Part | null = null;
  private readonly highlight: Highlight;
  private readonly boxes: Boxes;
  private readonly mixer: AnimationMixer;
  private readonly actions: AnimationAction[];
  private readonly selectedBy: ((part: Part | null) => void)[] = [];
  private readonly runBy: (() => void)[] = [];
  readonly behaviour: Behaviour;
  readonly levels: LevelControl | null;
  flash = false;          // boxes around objects whose level changes
  private readonly flashes: Flashes;

  private viewpoint: Viewpoint | null = null;  // that was gone to
  private meter: PopMeter | null = null;
  private readonly hidden = new Set<Part>();

  /// `suffix` is what the address adds to the names of what it keeps of this world.
  constructor(readonly world: World, readonly stage: Stage, readonly suffix = '') {
    this.scene.add(world.root);
    this.batches = new Batches(this.scene, world);
    this.lights = new Lights(this.scene, world);
    this.forms = new Forms(world);
    this.highlight = new Highlight(this.scene);
    this.boxes = new Boxes(this.scene, world);
    this.levels = world.levels.length > 0 ? new LevelControl(world) : null;
    this.flashes = new Flashes(this.scene);
    this.mixer = new AnimationMixer(world.root);
    this.behaviour = new Behaviour(world, stage.camera, {told: id => this.act(id), changed: () => this.changedByItself(), failed: () => this.ranOrNot()});
    this.actions = world.clips.map(clip => this.mixer.clipAction(clip));
  }

  get box() { return this.world.box; }
  get moves() { return this.playing || this.behaviour.running; }

  enter(): void {
    this.stage.navigator.manner = this.manner;
    this.stage.show(this);
  }

  draw({renderer, camera, height}: Stage): void {
    const switched = this.levels?.update(camera, height) ?? [];
    if (this.flash) this.flashes.add(switched);
    this.lights.follow(camera);
    this.behaviour.draw();
    this.batches.update();
    renderer.render(this.scene, camera);
    if (!this.edges) return;
    this.setOverlays(false);
    drawEdges(renderer, this.scene, camera);
    this.setOverlays(true);
  }

  private setOverlays(on: boolean): void {
    for (const o of this.scene.children) if (o.userData['overlay']) o.layers.set(on ? 0 : 1), o.traverse(x => x.layers.set(on ? 0 : 1));
  }

  tick(seconds: number): boolean {
    if (this.playing) this.mixer.update(seconds);
    const going = this.behaviour.tick(seconds);
    return this.flashes.tick(seconds) || this.playing || going;
  }

  /// Not while the world runs, which plays them itself.
  play(on: boolean): void {
    this.playing = on && !this.behaviour.running;
    for (const action of this.actions) {
      if (this.playing && !action.isRunning()) action.play();
    }
    this.ranOrNot();
    this.stage.invalidate();
  }

  /// Runs what the world does; animations are played by it then.
  run(on: boolean): void {
    if (on) this.play(false);
    this.behaviour.set(on);
    this.ranOrNot();
  }

  runScripts(on: boolean): void {
    this.behaviour.runScripts(on);
    this.ranOrNot();
  }

  hearSounds(on: boolean): void {
    this.behaviour.sounds?.hear(on);
    this.ranOrNot();
    this.stage.invalidate();
  }

  /// Called when animations or the world begin or end.
  onRun(call: () => void): void { this.runBy.push(call); }

  private ranOrNot(): void { for (const call of this.runBy) call(); }

  private changedByItself(): void {
    this.batches.visibilityChanged();
    this.stage.invalidate();
  }

  /// What the world wants of the page.
  private act(event: string): void {
    const [what, name] = [event.slice(0, event.indexOf(':')), event.slice(event.indexOf(':') + 1)];
    if (what === 'open') askToOpen(name);
    const viewpoint = this.world.viewpoints.find(v => v.node === name) ?? this.world.viewpoints.find(v => v.name === name);
    if (what === 'viewpoint' && viewpoint) this.goTo(viewpoint);
  }

  setLook(look: Look): void {
    this.look = look;
    this.paint();
  }

  setTint(on: boolean): void {
    this.tinted = on;
    this.paint();
  }

  /// Without light, what needs some is shown as its colour alone.
  private paint(): void {
    const unlit: Partial<Record<Look, Look>> = this.lighting === 'off' ? {full: 'albedo', grey: 'flat'} : {};
    const look = this.tinted ? 'grey' : unlit[this.look] ?? this.look;
    const byForm = look === 'form';
    if (this.tinted) this.levels?.tint(this.looks);
    else if (byForm) this.forms.tint(this.world, this.looks);
    else this.looks.apply(this.world.root, look);
    this.batches.setLook(this.looks, look, byForm ? this.forms.colors : null);
    this.stage.invalidate();
  }

  /// What is seen of a switch from where the eye is, but at the distance where it happens; in the colours of the world.
  popping(what: Switch): Pop {
    const {renderer, camera} = this.stage, tinted = this.tinted;
    if (tinted) this.setTint(false);
    const pop = (this.meter ??= new PopMeter(this.scene)).measure(what, renderer, camera.position, eye => this.lights.follow(eye));
    if (tinted) this.setTint(true);
    this.stage.invalidate();
    return pop;
  }

  /// Looks at an object from the distance where it switches.
  goToSwitch({object}: Switch, distance: number): void {
    const {camera, navigator} = this.stage, middle = object.box.getCenter(new Vector3());
    this.stage.fieldOfView = fieldOfView;
    navigator.take(middle.clone().add(new Vector3(0, 0, distance).applyQuaternion(camera.quaternion)), camera.quaternion.clone(), distance);
  }

  /// Hidden parts stay so when levels are switched.
  setHidden(part: Part, hidden: boolean): void {
    hide(part.object, 'user', hidden);
    if (hidden) this.hidden.add(part);
    else this.hidden.delete(part);
    const few = this.hidden.size > 0 && this.hidden.size <= mostHidden;
    state.set(`hidden${this.suffix}`, few ? [...this.hidden].map(p => p.node).join('.') : null);
    this.batches.visibilityChanged();
    this.stage.invalidate();
  }

  setLighting(lighting: Lighting): void {
    this.lighting = lighting;
    this.lights.set(lighting);
    this.paint();
  }

  setEdges(on: boolean): void {
    this.edges = on;
    this.stage.invalidate();
  }

  setBoxes(on: boolean): void {
    this.boxes.show(on);
    this.stage.invalidate();
  }

  setSky(on: boolean): void {
    const sky = this.world.sky;
    this.scene.background = on && sky ? new Color().setRGB(sky[0]!, sky[1]!, sky[2]!, 'srgb') : null;
    this.stage.invalidate();
  }

  move(manner: 'orbit' | 'walk'): void {
    this.manner = this.stage.navigator.manner = manner;
    state.set('move', manner === 'walk' ? manner : null);
  }

  /// The part of the address.
  recall(): void {
    const byNode = new Map(this.world.parts.map(p => [p.node, p]));
    for (const node of state.get(`hidden${this.suffix}`)?.split('.') ?? []) {
      const part = byNode.get(Number(node));
      if (part) this.setHidden(part, true);
    }
    const wanted = state.number(`select${this.suffix}`);
    if (wanted !== null) this.select(byNode.get(wanted) ?? null);
  }

  onSelect(call: (part: Part | null) => void): void { this.selectedBy.push(call); }

  select(part: Part | null, closer = false): void {
    this.selected = part;
    this.highlight.show(part);
    state.set(`select${this.suffix}`, part ? part.node : null);
    for (const call of this.selectedBy) call(part);
    if (closer && part) this.lookAt(part);
    this.stage.invalidate();
  }

  lookAt(part: Part): void {
    const box = boxOf(part);
    if (box.isEmpty()) box.expandByPoint(part.object.getWorldPosition(new Vector3()));
    this.stage.frameBox(box);
  }

  /// The next Viewpoint, or the one before.
  goToNext(by: 1 | -1): void {
    const {viewpoints} = this.world, n = viewpoints.length;
    if (n === 0 || !this.stage.shows(this)) return;
    const at = this.viewpoint ? viewpoints.indexOf(this.viewpoint) : by > 0 ? -1 : 0;
    this.goTo(viewpoints[(at + by + n) % n]!);
  }

  goTo(viewpoint: Viewpoint): void {
    this.viewpoint = viewpoint;
    const {position, quaternion, fov} = viewpoint.camera;
    this.stage.fieldOfView = fov;
    const center = this.box.getCenter(new Vector3());
    const ahead = new Vector3(0, 0, -1).applyQuaternion(quaternion);
    const distance = Math.max(center.clone().sub(position).dot(ahead), this.box.getSize(new Vector3()).length() * 0.05) || 1;
    this.stage.navigator.take(position, quaternion, distance);
  }

  click(x: number, y: number): void {
    const part = this.partAt(x, y);
    if (!this.behaviour.click(part)) this.select(part);
  }

  over(x: number, y: number): void {
    if (this.behaviour.hovers) this.behaviour.hover(this.partAt(x, y));
  }

  private partAt(x: number, y: number): Part | null {
    const ray = new Raycaster();
    ray.layers.enable(batchedLayer);
    ray.params.Line.threshold = ray.params.Points.threshold = 4 * this.stage.metresPerPixel(this.stage.navigator.distance);
    ray.setFromCamera(this.stage.toClip(x, y), this.stage.camera);
    const hit = ray.intersectObject(this.world.root, true).find(found => isShown(found.object));
    return hit ? partOf(this.world, hit.object) : null;
  }
}
