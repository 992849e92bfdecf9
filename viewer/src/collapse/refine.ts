// View-dependent refinement: splits that are wanted where the viewer looks, and no others. The vertices of a progressive mesh are
// a forest (split i makes two of one), and any cut through it is a mesh: each corner of the original is drawn at the finest of its
// ancestors that is there, and faces whose corners meet are gone (Xia and Varshney 1996; Luebke and Erikson 1997).
import {BufferAttribute, BufferGeometry, DynamicDrawUsage, Sphere, type Vector3} from 'three';
import type {Record} from './record';

/// Nodes of the forest: vertices of the base, then of split i the vertex that was split (base + 2 i) and the new one.
export class Refinement {
  readonly geometry = new BufferGeometry();
  readonly places: Float32Array;              // xyz of each node
  readonly before: Uint32Array;               // the node that each split splits
  readonly radius: Float32Array;              // of a ball around each node that has all that becomes of it
  faces = 0;
  private readonly leaf: Uint32Array;         // of each corner of the original
  private readonly shown: Uint32Array;        // of each node: itself, or the ancestor that is there
  private readonly colors: Uint8Array;        // of each corner of the original
  private readonly place: BufferAttribute;
  private readonly color: BufferAttribute;

  /// `corners` are those of the original, `colors` three bytes for each of them; places are relative to `center`.
  constructor(private readonly record: Record, corners: Uint32Array, colors: Uint8Array, center: Vector3) {
    const base = record.baseVertices, nodes = base + 2 * record.splits;
    this.places = new Float32Array(3 * nodes);
    this.before = new Uint32Array(record.splits);
    this.shown = new Uint32Array(nodes);
    this.colors = colors;
    const now = Uint32Array.from({length: base + record.splits}, (_, v) => v);  // the node of each vertex
    const put = (node: number, from: Float64Array, i: number): void => {
      for (let k = 0; k < 3; ++k) this.places[3 * node + k] = from[3 * i + k]! - center.getComponent(k);
    };
    for (let v = 0; v < base; ++v) put(v, record.positions, v);
    for (let i = record.splits - 1; i >= 0; --i) if (record.vertex[i]! < base) put(record.vertex[i]!, record.coarse, i);
    for (let i = 0; i < record.splits; ++i) {
      this.before[i] = now[record.vertex[i]!]!;
      put(now[record.vertex[i]!] = base + 2 * i, record.fine, i);
      put(now[base + i] = base + 2 * i + 1, record.made, i);
    }
    this.radius = this.radii(nodes);
    this.leaf = Uint32Array.from(corners, v => now[v]!);
    this.place = new BufferAttribute(new Float32Array(3 * corners.length), 3).setUsage(DynamicDrawUsage);
    this.color = new BufferAttribute(new Uint8Array(3 * corners.length), 3, true).setUsage(DynamicDrawUsage);
    this.geometry.setAttribute('position', this.place);
    this.geometry.setAttribute('color', this.color);
    this.geometry.boundingSphere = new Sphere(undefined, Infinity);
  }

  /// From the boxes of what becomes of each node, from the finest up.
  private radii(nodes: number): Float32Array {
    const {places, before} = this, low = places.slice(), high = places.slice(), radius = new Float32Array(nodes), base = this.record.baseVertices;
    for (let i = before.length - 1; i >= 0; --i) {
      const node = 3 * before[i]!, reach = [0, 0, 0];
      for (let k = 0; k < 3; ++k) {
        for (const child of [3 * (base + 2 * i), 3 * (base + 2 * i + 1)]) {
          low[node + k] = Math.min(low[node + k]!, low[child + k]!);
          high[node + k] = Math.max(high[node + k]!, high[child + k]!);
        }
        reach[k] = Math.max(high[node + k]! - places[node + k]!, places[node + k]! - low[node + k]!);
      }
      radius[before[i]!] = Math.hypot(...reach);
    }
    return radius;
  }

  /// Every split whose ancestors are there and that is wanted. O(splits and faces).
  update(wanted: (split: number, node: number) => boolean): void {
    const {before, shown} = this, base = this.record.baseVertices;
    for (let v = 0; v < base; ++v) shown[v] = v;
    for (let i = 0; i < before.length; ++i) {
      const node = before[i]!, first = base + 2 * i, there = shown[node] === node && wanted(i, node);
      shown[first] = there ? first : shown[node]!;
      shown[first + 1] = there ? first + 1 : shown[node]!;
    }
    this.draw();
  }

  private draw(): void {
    const {leaf, shown, places, colors} = this, out = this.place.array as Float32Array, outColors = this.color.array as Uint8Array;
    let n = 0;
    for (let c = 0; c < leaf.length; c += 3) {
      const a = shown[leaf[c]!]!, b = shown[leaf[c + 1]!]!, d = shown[leaf[c + 2]!]!;
      if (a === b || b === d || d === a) continue;
      for (let k = 0; k < 3; ++k) {
        out[9 * n + k] = places[3 * a + k]!;
        out[9 * n + 3 + k] = places[3 * b + k]!;
        out[9 * n + 6 + k] = places[3 * d + k]!;
      }
      for (let k = 0; k < 9; ++k) outColors[9 * n + k] = colors[3 * c + k]!;
      ++n;
    }
    this.faces = n;
    this.geometry.setDrawRange(0, 3 * n);
    this.place.needsUpdate = this.color.needsUpdate = true;
  }
}
