// Moving the camera by mouse, touch and keys. Orbit: around a pivot, up stays up. Free: the same, any way round. Walk: at the
// world's own speed, looking around; through walls.
import {MathUtils, Matrix4, Quaternion, Spherical, Vector3, type Box3, type PerspectiveCamera} from 'three';

export type Manner = 'orbit' | 'free' | 'walk';

const up = new Vector3(0, 1, 0);
const filled = 0.94;  // of the picture, by a box that is framed
const corners = [0, 1, 2, 3, 4, 5, 6, 7].map(i => [i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1] as const);

export class Navigator {
  manner: Manner = 'orbit';
  speed = 1;                      // of walking, metres a second
  readonly pivot = new Vector3();
  private readonly pointers = new Map<number, {x: number; y: number; button: number}>();
  private readonly keys = new Set<string>();
  private moved = 0;              // pixels since the first pointer went down
  private fingers = 0;            // pointers that were down at one time since then

  constructor(private readonly camera: PerspectiveCamera, private readonly element: HTMLElement, private readonly changed: () => void) {
    element.addEventListener('pointerdown', e => this.down(e));
    element.addEventListener('pointermove', e => this.move(e));
    for (const type of ['pointerup', 'pointercancel'] as const) element.addEventListener(type, e => this.pointers.delete(e.pointerId));
    element.addEventListener('wheel', e => this.wheel(e), {passive: false});
    element.addEventListener('contextmenu', e => e.preventDefault());
    element.addEventListener('keydown', e => this.key(e, true));
    element.addEventListener('keyup', e => this.key(e, false));
    element.addEventListener('blur', () => this.keys.clear());
  }

  /// A press of one finger that did not move: it is meant as a click.
  get wasClick(): boolean { return this.moved < 5 && this.fingers === 1; }

  get distance(): number { return this.camera.position.distanceTo(this.pivot); }

  /// Looks at a ball from the direction that the camera has.
  frame(center: Vector3, radius: number): void {
    const half = Math.min(MathUtils.degToRad(this.camera.fov) / 2, Math.atan(Math.tan(MathUtils.degToRad(this.camera.fov) / 2) * this.camera.aspect));
    const back = new Vector3(0, 0, 1).applyQuaternion(this.camera.quaternion);
    this.pivot.copy(center);
    this.camera.position.copy(center).addScaledVector(back, radius / Math.sin(half));
    this.changed();
  }

  /// Looks at a box from the direction that the camera has; all of it is just seen. A point is seen from a metre away.
  frameBox(box: Box3): void {
    const toCamera = this.camera.quaternion.clone().invert();
    const tall = Math.tan(MathUtils.degToRad(this.camera.fov) / 2) * filled, wide = tall * this.camera.aspect;
    const center = box.getCenter(new Vector3()), half = box.getSize(new Vector3()).multiplyScalar(0.5);
    let distance = half.length() || 1;
    for (const [x, y, z] of corners) {
      const p = new Vector3(x, y, z).multiply(half).applyQuaternion(toCamera);
      distance = Math.max(distance, p.z + Math.abs(p.x) / wide, p.z + Math.abs(p.y) / tall);
    }
    this.pivot.copy(center);
    this.camera.position.set(0, 0, distance).applyQuaternion(this.camera.quaternion).add(center);
    this.changed();
  }

  /// From in front and above.
  overview(box: Box3): void {
    this.camera.quaternion.setFromRotationMatrix(new Matrix4().lookAt(new Vector3(0.55, 0.5, 1), new Vector3(), up));
    this.frameBox(box);
  }

  /// Where another camera is; what lies ahead at that distance becomes the pivot.
  take(position: Vector3, orientation: Quaternion, distance: number): void {
    this.camera.position.copy(position);
    this.camera.quaternion.copy(orientation);
    this.pivot.set(0, 0, -distance).applyQuaternion(orientation).add(position);
    this.changed();
  }

  /// Moves by the keys that are held; true while there are any.
  step(seconds: number): boolean {
    if (this.keys.size === 0) return false;
    const forward = this.held('KeyW', 'ArrowUp') - this.held('KeyS', 'ArrowDown');
    const side = this.held('KeyD', 'ArrowRight') - this.held('KeyA', 'ArrowLeft');
    const rise = this.held('KeyE', 'PageUp') - this.held('KeyQ', 'PageDown');
    if (this.manner === 'walk') this.walk(forward, side, rise, seconds * this.speed * (this.keys.has('ShiftLeft') ? 4 : 1));
    else this.rotate(-side * seconds * 1.5, -forward * seconds * 1.5);
    return true;
  }

  private held(...codes: string[]): number { return codes.some(code => this.keys.has(code)) ? 1 : 0; }

  private key(e: KeyboardEvent, down: boolean): void {
    if (e.ctrlKey || e.metaKey || e.altKey) return;
    const arrows = ['ArrowUp', 'ArrowDown', 'ArrowLeft', 'ArrowRight'];
    const walking = ['KeyW', 'KeyA', 'KeyS', 'KeyD', 'KeyQ', 'KeyE', 'PageUp', 'PageDown', 'ShiftLeft'];
    if (!arrows.includes(e.code) && !(this.manner === 'walk' && walking.includes(e.code))) return;
    if (down) this.keys.add(e.code);
    else this.keys.delete(e.code);
    e.preventDefault();
    this.changed();
  }

  private down(e: PointerEvent): void {
    if (this.pointers.size === 0) this.moved = this.fingers = 0;
    this.pointers.set(e.pointerId, {x: e.clientX, y: e.clientY, button: e.shiftKey ? 2 : e.button});
    this.fingers = Math.max(this.fingers, this.pointers.size);
    this.element.setPointerCapture(e.pointerId);
  }

  private move(e: PointerEvent): void {
    const pointer = this.pointers.get(e.pointerId);
    if (!pointer) return;
    const before = this.gesture();
    const dx = e.clientX - pointer.x, dy = e.clientY - pointer.y;
    pointer.x = e.clientX;
    pointer.y = e.clientY;
    this.moved += Math.hypot(dx, dy);
    const after = this.gesture();
    if (before && after) {
      this.pan(after.x - before.x, after.y - before.y);
      const apart = after.spread > 0 && before.spread > 0 ? after.spread / before.spread : 1;
      if (this.manner === 'walk') this.walk(Math.log(apart), 0, 0, this.speed * 3);
      else this.dolly(1 / apart);
    } else if (this.manner === 'walk') {
      this.look(dx, dy);
    } else if (pointer.button === 0) {
      const turn = Math.PI / this.element.clientHeight;
      this.rotate(-dx * turn, -dy * turn);
    } else {
      this.pan(dx, dy);
    }
    this.changed();
  }

  /// Middle and distance of two fingers.
  private gesture(): {x: number; y: number; spread: number} | null {
    const [a, b] = this.pointers.values();
    return a && b ? {x: (a.x + b.x) / 2, y: (a.y + b.y) / 2, spread: Math.hypot(a.x - b.x, a.y - b.y)} : null;
  }

  private wheel(e: WheelEvent): void {
    e.preventDefault();
    const lines = e.deltaMode === WheelEvent.DOM_DELTA_LINE ? 30 : 1;
    if (this.manner === 'walk') this.walk(-Math.sign(e.deltaY), 0, 0, this.speed * 0.3);
    else this.dolly(Math.exp(MathUtils.clamp(e.deltaY * lines, -400, 400) * 0.0015));
    this.changed();
  }

  private rotate(around: number, over: number): void {
    const arm = this.camera.position.clone().sub(this.pivot);
    if (this.manner === 'free') {
      const turn = new Quaternion().setFromAxisAngle(new Vector3(0, 1, 0).applyQuaternion(this.camera.quaternion), around);
      turn.premultiply(new Quaternion().setFromAxisAngle(new Vector3(1, 0, 0).applyQuaternion(this.camera.quaternion), over));
      arm.applyQuaternion(turn);
      this.camera.quaternion.premultiply(turn);
    } else {
      const s = new Spherical().setFromVector3(arm);
      s.theta += around;
      s.phi = MathUtils.clamp(s.phi + over, 0.01, Math.PI - 0.01);
      arm.setFromSpherical(s);
      this.camera.quaternion.setFromRotationMatrix(new Matrix4().lookAt(arm, new Vector3(), up));
    }
    this.camera.position.copy(this.pivot).add(arm);
  }

  private pan(dx: number, dy: number): void {
    const metres = 2 * this.distance * Math.tan(MathUtils.degToRad(this.camera.fov) / 2) / this.element.clientHeight;
    const shift = new Vector3(-dx * metres, dy * metres, 0).applyQuaternion(this.camera.quaternion);
    this.pivot.add(shift);
    this.camera.position.add(shift);
  }

  private dolly(factor: number): void {
    this.camera.position.sub(this.pivot).multiplyScalar(factor).add(this.pivot);
  }

  private look(dx: number, dy: number): void {
    const turn = MathUtils.degToRad(this.camera.fov) / this.element.clientHeight;
    const ahead = new Spherical().setFromVector3(new Vector3(0, 0, 1).applyQuaternion(this.camera.quaternion));
    ahead.theta += dx * turn;
    ahead.phi = MathUtils.clamp(ahead.phi - dy * turn, 0.01, Math.PI - 0.01);
    const distance = this.distance;
    const back = new Vector3().setFromSpherical(ahead);
    this.camera.quaternion.setFromRotationMatrix(new Matrix4().lookAt(back, new Vector3(), up));
    this.pivot.copy(this.camera.position).addScaledVector(back, -distance);
  }

  private walk(forward: number, side: number, rise: number, metres: number): void {
    const ahead = new Vector3(0, 0, -1).applyQuaternion(this.camera.quaternion).setY(0).normalize();
    const right = new Vector3(1, 0, 0).applyQuaternion(this.camera.quaternion);
    const shift = new Vector3().addScaledVector(ahead, forward * metres).addScaledVector(right, side * metres).addScaledVector(up, rise * metres);
    this.camera.position.add(shift);
    this.pivot.add(shift);
  }
}
