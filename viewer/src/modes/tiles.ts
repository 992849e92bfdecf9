// The mode in which a tileset is looked at.
import {Box3, Matrix4, Raycaster, Scene, Vector3, type Object3D} from 'three';
import {state} from '../state';
import {Tileset, type LoadedTile} from '../tiles/loading';
import {Names, pathOf, type NamedPart} from '../tiles/names';
import {PartHighlight, TileBoxes} from '../tiles/overlays';
import {Tints, type Tint} from '../tiles/tints';
import type {Mode, Stage} from '../view/stage';
import {Lights} from '../world/lights';

const noLights = {lights: [], navigation: {type: [], speed: 1, size: [0.25, 1.6, 0.75] as [number, number, number], headlight: true}};

export class TilesMode implements Mode {
  readonly scene = new Scene();
  readonly box = new Box3();
  readonly set: Tileset;
  readonly names = new Names();
  selected: NamedPart | null = null;
  failed = '';                        // what could not be loaded
  private readonly lights = new Lights(this.scene, noLights);
  private readonly tints = new Tints();
  private readonly boxes = new TileBoxes(this.scene);
  readonly highlight = new PartHighlight(this.scene, this.names);
  private tint: Tint = 'none';
  private changed = false;            // the tiles that are shown
  private wanted = state.get('select');
  private readonly selectedBy: ((part: NamedPart | null) => void)[] = [];
  private readonly namedBy: (() => void)[] = [];

  constructor(readonly stage: Stage, url: string) {
    this.set = new Tileset(url);
    const {tiles} = this.set;
    this.scene.add(tiles.group);
    tiles.addEventListener('needs-update', () => stage.invalidate());
    tiles.addEventListener('load-model', ({scene, tile}) => this.loaded(scene, tile as LoadedTile));
    tiles.addEventListener('tile-visibility-change', () => { this.changed = true; stage.invalidate(); });
    tiles.addEventListener('load-error', ({error}) => { this.failed = String(error.message); stage.invalidate(); });
  }

  /// Resolves when the tree of tiles is there.
  async begin(): Promise<void> {
    const {tiles} = this.set;
    const root = new Promise<void>((resolve, reject) => {
      tiles.addEventListener('load-root-tileset', () => resolve());
      tiles.addEventListener('load-error', ({error}) => reject(error));
    });
    tiles.update();
    await root;
    const {camera, width, height} = this.stage;
    tiles.setCamera(camera);
    tiles.setResolution(camera, Math.max(1, width), Math.max(1, height));
    const local = new Box3(), matrix = new Matrix4();
    if (tiles.getOrientedBoundingBox(local, matrix)) this.box.copy(local).applyMatrix4(tiles.group.matrixWorld.clone().multiply(matrix));
    if (this.box.isEmpty()) this.box.set(new Vector3(-1, -1, -1), new Vector3(1, 1, 1));
  }

  draw({renderer, camera, width, height}: Stage): void {
    const {tiles} = this.set;
    tiles.setResolution(camera, width, height);
    tiles.update();
    if (this.changed) this.refresh();
    this.lights.follow(camera);
    renderer.render(this.scene, camera);
  }

  tick(): boolean { return this.set.loading; }

  private loaded(scene: Object3D, tile: LoadedTile): void {
    const isNew = this.names.add(scene, this.set.tiles.group.matrixWorld);
    this.tints.apply(tile, scene, this.tint);
    if (isNew) for (const call of this.namedBy) call();
    if (this.wanted !== null) this.select(this.names.find(this.wanted));
  }

  /// What lies over the tiles is that of those which are shown.
  private refresh(): void {
    this.changed = false;
    const shown = this.set.shown;
    this.boxes.show(shown, this.set.tiles.group);
    this.highlight.show(this.selected, shown);
  }

  setError(pixels: number): void {
    this.set.tiles.errorTarget = pixels;
    this.stage.invalidate();
  }

  setTint(tint: Tint): void {
    this.tint = tint;
    for (const tile of this.set.loaded) if (tile.engineData.scene) this.tints.apply(tile, tile.engineData.scene, tint);
    this.stage.invalidate();
  }

  setBoxes(on: boolean): void {
    this.boxes.on = on;
    this.changed = true;
    this.stage.invalidate();
  }

  setBudget(bytes: number): void {
    this.set.budget = bytes;
    this.stage.invalidate();
  }

  onSelect(call: (part: NamedPart | null) => void): void { this.selectedBy.push(call); }
  onNames(call: () => void): void { this.namedBy.push(call); }

  select(part: NamedPart | null, closer = false): void {
    if (part) this.wanted = null;
    this.selected = part;
    this.refresh();
    if (this.wanted === null) state.set('select', part ? pathOf(part) : null);
    for (const call of this.selectedBy) call(part);
    if (closer && part) this.lookAt(part);
    this.stage.invalidate();
  }

  lookAt(part: NamedPart): void { this.stage.frameBox(part.box); }

  click(x: number, y: number): void {
    this.wanted = null;
    const ray = new Raycaster();
    ray.params.Line.threshold = ray.params.Points.threshold = 4 * this.stage.metresPerPixel(this.stage.navigator.distance);
    ray.setFromCamera(this.stage.toClip(x, y), this.stage.camera);
    const hit = ray.intersectObject(this.set.tiles.group, true)[0];
    this.select(hit ? this.names.at(hit.object, hit.face?.a ?? hit.index ?? 0, hit.instanceId) : null);
  }
}
