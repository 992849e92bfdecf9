// One surface at one of its states, as arrays that a graphics card draws: three corners of their own for each face, so that each
// face can have its own greys. A step changes the corners around one edge.
import {BufferAttribute, BufferGeometry, Sphere, Vector3} from 'three';
import type {Record} from './record';
import {Refinement} from './refine';

/// Three greys at the corners of each face, in an order of its own (Lazanyi, 2.3): edges are seen where neighbours differ.
const greys = [72, 138, 214] as const;

function greyCorners(faces: number): Uint8Array {
  const colors = new Uint8Array(9 * faces);
  for (let f = 0, seed = 1; f < faces; ++f) {
    seed = Math.imul(seed ^ (f + 0x9e3779b9), 0x85ebca6b) >>> 0;
    seed = (seed ^ (seed >>> 13)) >>> 0;
    const first = seed % 3, turn = seed & 8 ? 1 : 2;
    for (let k = 0; k < 3; ++k) colors.fill(greys[(first + k * turn) % 3]!, 9 * f + 3 * k, 9 * f + 3 * k + 3);
  }
  return colors;
}

const many = 4000;  // changed corners from which on all are sent

export class Stepper {
  readonly geometry = new BufferGeometry();
  readonly corners: Uint32Array;
  readonly positions: Float64Array;  // of the vertices, at this state
  done: number;                      // splits that are there
  private readonly original: Uint32Array;  // vertices of all corners at the finest state
  private readonly place: BufferAttribute;
  private readonly drawn: Float32Array;
  private readonly center: Vector3;
  private changed: number[] | null = [];  // corners; null: all

  /// Begins at the original. Coordinates are drawn relative to `center`, which may be far away.
  constructor(readonly record: Record, center: Vector3) {
    this.center = center;
    this.corners = record.corners;
    this.original = record.corners.slice();
    this.positions = record.positions;
    this.done = record.splits;
    this.drawn = new Float32Array(9 * record.faces);
    for (let c = 0; c < this.corners.length; ++c) this.put(c);
    this.place = new BufferAttribute(this.drawn, 3);
    this.geometry.setAttribute('position', this.place);
    this.geometry.setAttribute('color', new BufferAttribute(greyCorners(record.faces), 3, true));
    this.geometry.setDrawRange(0, 3 * record.faces);
    this.geometry.computeBoundingSphere();
    this.geometry.boundingSphere ??= new Sphere();
    this.geometry.boundingSphere.radius *= 1.5;
  }

  /// The same surface for view-dependent refinement, in the same greys.
  refinement(): Refinement {
    return new Refinement(this.record, this.original, this.geometry.getAttribute('color').array as Uint8Array, this.center);
  }

  get faces(): number { return this.done > 0 ? this.record.faceEnd[this.done - 1]! : this.record.baseFaces; }
  /// From the original, in units of the surface.
  get error(): number { return this.done > 0 ? this.record.error[this.done - 1]! : this.record.baseError; }

  /// Takes the last split back: the next edge collapses.
  collapse(): void {
    const i = --this.done, rec = this.record, v = rec.vertex[i]!;
    for (let k = 0; k < 3; ++k) this.positions[3 * v + k] = rec.coarse[3 * i + k]!;
    for (let at = i > 0 ? rec.fanEnd[i - 1]! : 0; at < rec.fanEnd[i]!; ++at) {
      const c = rec.fan[at]!;
      this.corners[c] = v;
      this.touch(c);
    }
  }

  /// The collapse before it, taken back.
  split(): void {
    const i = this.done++, rec = this.record, v = rec.vertex[i]!, u = rec.baseVertices + i;
    for (let k = 0; k < 3; ++k) {
      this.positions[3 * v + k] = rec.fine[3 * i + k]!;
      this.positions[3 * u + k] = rec.made[3 * i + k]!;
    }
    for (let at = i > 0 ? rec.fanEnd[i - 1]! : 0; at < rec.fanEnd[i]!; ++at) {
      const c = rec.fan[at]!;
      if (rec.goes[at]) this.corners[c] = u;
      this.touch(c);
    }
    for (let c = 3 * (i > 0 ? rec.faceEnd[i - 1]! : rec.baseFaces); c < 3 * rec.faceEnd[i]!; ++c) this.touch(c);
  }

  /// Before it is drawn: what has changed goes to the graphics card.
  flush(): void {
    if (this.changed?.length === 0) return;
    this.geometry.setDrawRange(0, 3 * this.faces);
    this.place.clearUpdateRanges();
    for (const c of this.changed ?? []) this.place.addUpdateRange(3 * c, 3);
    this.place.needsUpdate = true;
    this.changed = [];
  }

  private touch(c: number): void {
    this.put(c);
    if (!this.changed) return;
    this.changed.push(c);
    if (this.changed.length > many) this.changed = null;
  }

  private put(c: number): void {
    const v = 3 * this.corners[c]!, at = 3 * c;
    this.drawn[at] = this.positions[v]! - this.center.x;
    this.drawn[at + 1] = this.positions[v + 1]! - this.center.y;
    this.drawn[at + 2] = this.positions[v + 2]! - this.center.z;
  }
}
