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
}

const point = (a: Float64Array, i: number): Vector3 => new Vector3(a[3 * i], a[3 * i + 1], a[3 * i + 2]);

/// `positions` and `corners` are those of the state behind split i.
export function edgeOf(rec: Record, i: number, positions: ArrayLike<number>, corners: Uint32Array): Edge {
  const fine = point(rec.fine, i), made = point(rec.made, i), result = point(rec.coarse, i);
  const v = rec.vertex[i]!, u = rec.baseVertices + i;
  const goesToMade = result.distanceToSquared(made) < result.distanceToSquared(fine);
  const goer = goesToMade ? v : u;
  const normal = (f: number): Vector3 => {
    const [a, b, c] = [0, 1, 2].map(k => 3 * corners[3 * f + k]!).map(at => new Vector3(positions[at], positions[at + 1], positions[at + 2]));
    return b!.sub(a!).cross(c!.sub(a!)).normalize();
  };
  const first = i > 0 ? rec.faceEnd[i - 1]! : rec.baseFaces, end = rec.faceEnd[i]!;
  const sides = Array.from({length: end - first}, (_, k) => normal(first + k));
  const begin = i > 0 ? rec.fanEnd[i - 1]! : 0;
  const around: Vector3[] = [];
  for (let k = begin; k < rec.fanEnd[i]!; ++k) if (corners[rec.fan[k]!] === goer) around.push(normal(Math.floor(rec.fan[k]! / 3)));
  const length = fine.distanceTo(made);
  const bend = Math.max(0, ...around.map(n => Math.min(1, ...sides.map(s => (1 - n.dot(s)) / 2))));
  return {
    from: goesToMade ? fine : made, to: goesToMade ? made : fine, result, faces: sides.length, length,
    lengthNormal: sides.length === 2 ? length / Math.abs(sides[0]!.dot(sides[1]!)) : length, melax: length * bend,
  };
}
