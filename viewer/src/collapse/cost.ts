// What the next collapse costs by the formulas of the seed paper (Lazanyi, 2.2).
import {Vector3} from 'three';
import type {Record} from './record';

/// The edge that the collapse before split i takes away, at the state behind the split.
export interface Edge {
  from: Vector3;       // the vertex that goes
  to: Vector3;         // the one that stays
  result: Vector3;     // where it will be
  faces: number;       // that will be gone
  length: number;
  lengthNormal: number;
  melax: number;
  planes: number;      // Lindstrom and Turk: squared distances of the result from the planes of the faces around, by twice their area
}

const point = (a: Float64Array, i: number): Vector3 => new Vector3(a[3 * i], a[3 * i + 1], a[3 * i + 2]);

/// `positions` and `corners` are those of the state behind split i.
export function edgeOf(rec: Record, i: number, positions: ArrayLike<number>, corners: Uint32Array): Edge {
  const fine = point(rec.fine, i), made = point(rec.made, i), result = point(rec.coarse, i);
  const v = rec.vertex[i]!, u = rec.baseVertices + i;
  const goesToMade = result.distanceToSquared(made) < result.distanceToSquared(fine);
  const goer = goesToMade ? v : u;
  const corner = (f: number, k: number): Vector3 => new Vector3().fromArray(positions as number[], 3 * corners[3 * f + k]!);
  const area = (f: number): Vector3 => {
    const a = corner(f, 0);
    return corner(f, 1).sub(a).cross(corner(f, 2).sub(a));
  };
  const normal = (f: number): Vector3 => area(f).normalize();
  /// Along the normal of twice the area: |n| d^2 = (n d)^2 / |n|.
  const fromPlane = (f: number): number => {
    const n = area(f), size = n.length();
    return size > 0 ? n.dot(corner(f, 0).sub(result)) ** 2 / size : 0;
  };
  const first = i > 0 ? rec.faceEnd[i - 1]! : rec.baseFaces, end = rec.faceEnd[i]!;
  const sides = Array.from({length: end - first}, (_, k) => normal(first + k));
  const begin = i > 0 ? rec.fanEnd[i - 1]! : 0;
  const around: Vector3[] = [];
  let planes = 0;
  for (let f = first; f < end; ++f) planes += fromPlane(f);
  for (let k = begin; k < rec.fanEnd[i]!; ++k) {
    const f = Math.floor(rec.fan[k]! / 3);
    if (corners[rec.fan[k]!] === goer) around.push(normal(f));
    planes += fromPlane(f);
  }
  const length = fine.distanceTo(made);
  const bend = Math.max(0, ...around.map(n => Math.min(1, ...sides.map(s => (1 - n.dot(s)) / 2))));
  return {
    from: goesToMade ? fine : made, to: goesToMade ? made : fine, result, faces: sides.length, length,
    lengthNormal: sides.length === 2 ? length / Math.abs(sides[0]!.dot(sides[1]!)) : length, melax: length * bend, planes,
  };
}
