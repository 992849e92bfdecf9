// What is seen when a level takes the place of another: both from the distance where that happens, as a screen of 1080 lines
// shows them, and how the pictures differ.
import {Color, DataUtils, HalfFloatType, MathUtils, PerspectiveCamera, Vector3, WebGLRenderTarget, type Light, type Object3D, type Scene, type WebGLRenderer} from 'three';
import {fieldOfView} from 'wrlkit-three';
import {screen} from './levels';
import type {Levels, World} from './world';

const width = Math.round(screen * 16 / 9);
const layer = 2;        // what the camera here sees: lights, and the level whose turn it is
const visible = 8;      // of 255: smaller changes are not counted

export interface Switch {
  object: Levels;
  level: number;        // the finer one
}

/// Levels are of 255, of the component that changes most.
export interface Pop extends Switch {
  distance: number;     // metres from the eye to the middle of the object
  covered: number;      // pixels that show one of the levels
  changed: number;      // pixels that change visibly
  mean: number;         // change of the covered ones
  largest: number;
  pictures: ImageData[];  // finer, coarser, the difference through a square root
}

/// All that can switch by distance.
export function switches(world: World): Switch[] {
  return world.levels.flatMap(object => object.levels.slice(1).flatMap((_, level) => object.switchDistance(level) > object.radius ? [{object, level}] : []));
}

export class PopMeter {
  private readonly camera = new PerspectiveCamera(fieldOfView, width / screen);
  private readonly target = new WebGLRenderTarget(1, 1, {type: HalfFloatType, samples: 4});

  constructor(private readonly scene: Scene) {
    this.camera.layers.set(layer);
    scene.traverse(o => { if ((o as Light).isLight) o.layers.enable(layer); });
  }

  /// As seen from the direction of `eye`. `light` is given where the camera stands.
  measure({object, level}: Switch, renderer: WebGLRenderer, eye: Vector3, light: (camera: PerspectiveCamera) => void): Pop {
    const distance = object.switchDistance(level);
    const frame = this.place(object, distance, eye);
    light(this.camera);
    const page = renderer.getClearColor(new Color()), alpha = renderer.getClearAlpha(), sky = this.scene.background;
    const behind = sky instanceof Color ? sky : page;
    renderer.setClearColor(0x000000, 0);
    this.scene.background = null;
    const [finer, coarser] = [level, level + 1].map(k => shownOn(behind, this.picture(object.levels[k]!, renderer, frame), frame)) as [Picture, Picture];
    this.scene.background = sky;
    renderer.setClearColor(page, alpha);
    return {object, level, distance, ...compared(finer, coarser)};
  }

  /// The camera where the object switches, and the part of its picture that shows the object.
  private place(object: Levels, distance: number, eye: Vector3): Size {
    const {camera} = this, middle = object.box.getCenter(new Vector3()), radius = object.radius;
    const back = eye.clone().sub(middle);
    if (back.lengthSq() === 0) back.set(0, 0, 1);
    camera.position.copy(middle).addScaledVector(back.normalize(), distance);
    camera.lookAt(middle);
    camera.near = Math.max((distance - radius) * 0.9, distance * 1e-3);
    camera.far = (distance + radius) * 1.1;
    const lines = screen / Math.tan(MathUtils.degToRad(fieldOfView) / 2);
    const side = Math.ceil(radius / Math.sqrt(Math.max(distance ** 2 - radius ** 2, 1e-30)) * lines) + 4;
    const frame = {width: Math.min(width, side), height: Math.min(screen, side)};
    camera.setViewOffset(width, screen, (width - frame.width) / 2, (screen - frame.height) / 2, frame.width, frame.height);
    camera.updateProjectionMatrix();
    camera.updateMatrixWorld();
    return frame;
  }

  /// Linear colours with alpha, half floats, the lowest row first. Which level is visible is settled again before the next picture
  /// of the page (LevelControl).
  private picture(level: Object3D, renderer: WebGLRenderer, {width, height}: Size): Uint16Array {
    level.visible = true;
    level.traverse(o => o.layers.enable(layer));
    this.target.setSize(width, height);
    renderer.setRenderTarget(this.target);
    renderer.clear();
    renderer.render(this.scene, this.camera);
    const data = new Uint16Array(4 * width * height);
    renderer.readRenderTargetPixels(this.target, 0, 0, width, height, data);
    renderer.setRenderTarget(null);
    level.traverse(o => o.layers.disable(layer));
    return data;
  }
}

interface Size {
  width: number;
  height: number;
}

interface Picture {
  image: ImageData;
  covered: Uint8Array;
}

/// As a screen shows it on a background.
function shownOn(behind: Color, data: Uint16Array, {width, height}: Size): Picture {
  const image = new ImageData(width, height), covered = new Uint8Array(width * height);
  const under = [behind.r, behind.g, behind.b];
  for (let y = 0; y < height; ++y) {
    for (let x = 0; x < width; ++x) {
      const from = 4 * ((height - 1 - y) * width + x), to = y * width + x, alpha = DataUtils.fromHalfFloat(data[from + 3]!);
      covered[to] = alpha > 0 ? 1 : 0;
      for (let c = 0; c < 3; ++c) image.data[4 * to + c] = Math.round(255 * toDisplay(DataUtils.fromHalfFloat(data[from + c]!) + (1 - alpha) * under[c]!));
      image.data[4 * to + 3] = 255;
    }
  }
  return {image, covered};
}

function toDisplay(linear: number): number {
  const v = MathUtils.clamp(linear, 0, 1);
  return v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055;
}

function compared(a: Picture, b: Picture): Omit<Pop, keyof Switch | 'distance'> {
  const {width, height} = a.image, difference = new ImageData(width, height);
  let covered = 0, changed = 0, sum = 0, largest = 0;
  for (let i = 0; i < width * height; ++i) {
    let most = 0;
    for (let c = 4 * i; c < 4 * i + 3; ++c) most = Math.max(most, Math.abs(a.image.data[c]! - b.image.data[c]!));
    covered += a.covered[i]! | b.covered[i]!;
    changed += most > visible ? 1 : 0;
    sum += most;
    largest = Math.max(largest, most);
    difference.data.fill(Math.round(Math.sqrt(most * 255)), 4 * i, 4 * i + 3);
    difference.data[4 * i + 3] = 255;
  }
  return {covered, changed, mean: covered > 0 ? sum / covered : 0, largest, pictures: [a.image, b.image, difference]};
}
