// The canvas and its camera. It is drawn when something has changed, not all the time. What is drawn is the matter of the
// mode that is on: the world, the comparison, the collapse.
import {Color, Frustum, MathUtils, Matrix4, PerspectiveCamera, Quaternion, Sphere, Vector2, Vector3, WebGLRenderer, type Box3, type Plane} from 'three';
import {state} from '../state';
import {Navigator} from './navigate';

export interface Mode {
  /// What is looked at.
  readonly box: Box3;
  /// What is there may come out of the box: it moves, or is hidden now.
  readonly moves?: boolean;
  /// Its size on the canvas, when it is not all of it.
  picture?(): {width: number; height: number};
  draw(stage: Stage): void;
  /// Time goes on; true as long as another picture is wanted.
  tick?(seconds: number): boolean;
  /// Was clicked at, in pixels of the canvas.
  click?(x: number, y: number): void;
  /// The pointer is there, and no button is down.
  over?(x: number, y: number): void;
}

export interface FrameFigures {
  draws: number;
  triangles: number;
  milliseconds: number;
}

export class Stage {
  readonly canvas: HTMLCanvasElement;
  readonly renderer: WebGLRenderer;
  readonly camera = new PerspectiveCamera(45, 1, 0.1, 1000);
  readonly navigator: Navigator;
  /// The angle of the shorter side of the picture, in degrees, as VRML has it (ISO/IEC 14772-1, 6.53).
  fieldOfView = 45;
  readonly figures: FrameFigures = {draws: 0, triangles: 0, milliseconds: 0};
  private mode: Mode | null = null;
  private due = 0;
  private last = 0;
  private readonly after: (() => void)[] = [];

  constructor(canvas: HTMLCanvasElement) {
    this.canvas = canvas;
    this.renderer = new WebGLRenderer({canvas, antialias: true, preserveDrawingBuffer: true, powerPreference: 'high-performance'});
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    this.renderer.info.autoReset = false;
    this.navigator = new Navigator(this.camera, canvas, () => this.invalidate());
    canvas.addEventListener('pointerup', e => {
      if (e.button === 0 && this.navigator.wasClick) this.mode?.click?.(e.offsetX, e.offsetY);
    });
    canvas.addEventListener('pointermove', e => { if (e.buttons === 0) this.mode?.over?.(e.offsetX, e.offsetY); });
    new ResizeObserver(() => this.resize()).observe(canvas);
  }

  /// The size of the canvas, in pixels of the page.
  get width(): number { return this.canvas.clientWidth; }
  get height(): number { return this.canvas.clientHeight; }

  show(mode: Mode): void {
    this.mode = mode;
    this.invalidate();
  }

  shows(mode: Mode): boolean { return this.mode === mode; }

  /// Calls back after each picture.
  onFrame(call: () => void): void { this.after.push(call); }

  invalidate(): void {
    this.due ||= requestAnimationFrame(time => this.frame(time));
  }

  drawNow(): void {
    cancelAnimationFrame(this.due);
    this.frame(performance.now());
  }

  setBackground(color: Color): void {
    this.renderer.setClearColor(color);
    this.invalidate();
  }

  private resize(): void {
    if (this.width === 0 || this.height === 0) return;
    this.renderer.setSize(this.width, this.height, false);
    this.fit();
    this.invalidate();
  }

  private frame(time: number): void {
    this.due = 0;
    const mode = this.mode;
    if (!mode || this.width === 0) return;
    const seconds = this.last > 0 ? Math.min(0.1, (time - this.last) / 1000) : 1 / 60;
    const moving = this.navigator.step(seconds);
    const going = mode.tick?.(seconds) ?? false;
    const begin = performance.now();
    this.clip(mode.box, mode.moves ?? false);
    this.renderer.info.reset();
    mode.draw(this);
    Object.assign(this.figures, {draws: this.renderer.info.render.calls, triangles: this.renderer.info.render.triangles, milliseconds: performance.now() - begin});
    this.last = moving || going ? time : 0;
    for (const call of this.after) call();
    this.remember();
    if (moving || going) this.invalidate();
  }

  private fit(width = this.width, height = this.height): void {
    const tangent = Math.tan(MathUtils.degToRad(this.fieldOfView) / 2);
    this.camera.aspect = width / height;
    this.camera.fov = 2 * MathUtils.radToDeg(Math.atan(tangent / Math.min(1, this.camera.aspect)));
  }

  /// Near and far planes around what is looked at.
  private clip(box: Box3, moves: boolean): void {
    this.fit();
    const ball = box.getBoundingSphere(new Sphere());
    const distance = this.camera.position.distanceTo(ball.center);
    this.camera.far = (distance + ball.radius) * (moves ? 4 : 1.05) + 1e-6;
    this.camera.near = Math.max(this.camera.far / 20000, moves ? 0 : (distance - ball.radius) * 0.9, Math.min(this.navigator.distance * 0.05, ball.radius * 0.01));
    this.camera.updateProjectionMatrix();
    this.camera.updateMatrixWorld();
  }

  /// Draws with the part of the canvas that is given, in pixels of the page from its lower left corner.
  within(x: number, y: number, width: number, height: number, draw: () => void): void {
    this.renderer.setViewport(x, y, width, height);
    this.renderer.setScissor(x, y, width, height);
    this.renderer.setScissorTest(true);
    this.fit(width, height);
    this.camera.updateProjectionMatrix();
    draw();
    this.renderer.setScissorTest(false);
    this.renderer.setViewport(0, 0, this.width, this.height);
  }

  /// Draws the whole picture, of which only columns are seen.
  clipped(left: number, width: number, draw: () => void): void {
    this.renderer.setScissor(left, 0, width, this.height);
    this.renderer.setScissorTest(true);
    draw();
    this.renderer.setScissorTest(false);
  }

  /// Looks at all of a box, from the direction that the camera has.
  frameBox(box: Box3): void {
    if (box.isEmpty()) return;
    this.fitMode();
    this.navigator.frameBox(box);
  }

  /// All that the mode shows.
  frameAll(): void { if (this.mode) this.frameBox(this.mode.box); }

  /// Whether any of the boxes lies in the picture, however far away.
  sees(boxes: readonly Box3[]): boolean {
    this.fitMode();
    const {camera} = this, {near, far} = camera;
    Object.assign(camera, {near: 1e-9, far: 1e12});
    camera.updateProjectionMatrix();
    camera.updateMatrixWorld();
    const frustum = new Frustum().setFromProjectionMatrix(new Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse));
    Object.assign(camera, {near, far});
    return boxes.some(box => frustum.planes.slice(0, 4).every(plane => reaches(plane, box)));
  }

  overview(box: Box3): void {
    this.fitMode();
    this.navigator.overview(box);
  }

  /// As one picture of the mode, which may have several side by side.
  private fitMode(): void {
    const {width, height} = this.mode?.picture?.() ?? this;
    this.fit(width, height);
  }

  /// Where the page is on the canvas, as three.js counts: -1 to 1.
  toClip(x: number, y: number): Vector2 {
    return new Vector2(x / this.width * 2 - 1, 1 - y / this.height * 2);
  }

  /// Metres that one pixel shows at that distance.
  metresPerPixel(distance: number): number {
    return 2 * distance * Math.tan(MathUtils.degToRad(this.camera.fov) / 2) / this.height;
  }

  private remember(): void {
    const {position: p, quaternion: q} = this.camera;
    const numbers = [p.x, p.y, p.z, q.x, q.y, q.z, q.w, this.navigator.distance, this.fieldOfView];
    state.set('camera', numbers.join(' '));  // all digits: the picture comes back to the pixel
  }

  /// The camera of the address, if it has one.
  rememberedCamera(): number[] | null {
    const n = (state.get('camera') ?? '').split(' ').map(Number);
    return n.length === 9 && n.every(Number.isFinite) ? n : null;
  }

  take(n: number[]): void {
    this.fieldOfView = MathUtils.clamp(n[8]!, 1, 170);
    this.navigator.take(new Vector3(n[0], n[1], n[2]), unit(new Quaternion(n[3], n[4], n[5], n[6])), n[7]!);
  }
}

/// The vector with length one; what has it up to rounding stays as it is.
function unit(q: Quaternion): Quaternion {
  return Math.abs(q.lengthSq() - 1) < 1e-9 ? q : q.lengthSq() > 0 ? q.normalize() : q.identity();
}

/// Whether a part of a box is on the inner side of a plane.
function reaches(plane: Plane, {min, max}: Box3): boolean {
  const {x, y, z} = plane.normal;
  return plane.distanceToPoint(new Vector3(x > 0 ? max.x : min.x, y > 0 ? max.y : min.y, z > 0 ? max.z : min.z)) >= 0;
}
