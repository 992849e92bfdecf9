// A mesh stream, decoded (docs/progressive.md, Mesh stream): all that is needed to go to any state and back. Vertices and
// faces are numbered as they appear, so a state is a prefix of each list. Attributes are read over: the picture of a collapse
// has colours of its own.
import {ByteReader, coordinateReader, orderOf, singleAt} from './bytes';

/// Split i makes vertex base.vertices + i. Its fan, the corners of the split vertex before it, is fan[fanEnd[i - 1]..fanEnd[i]).
export interface Record {
  baseVertices: number;
  baseFaces: number;
  faces: number;            // of the original
  splits: number;
  vertex: Uint32Array;      // that is split
  coarse: Float64Array;     // xyz of it before
  fine: Float64Array;       // and behind
  made: Float64Array;       // xyz of the new vertex
  error: Float32Array;      // after each split, from the original; error[-1] is baseError
  baseError: number;
  faceEnd: Uint32Array;     // faces after each split
  fan: Uint32Array;
  goes: Uint8Array;         // 1: the corner of the fan goes to the new vertex
  fanEnd: Uint32Array;
  positions: Float64Array;  // of all vertices at the finest state
  corners: Uint32Array;     // vertices of all corners at the finest state
}

/// Numbers without end, for arrays whose size is not given.
class Growing {
  array = new Uint32Array(1024);
  size = 0;
  push(x: number): void {
    if (this.size === this.array.length) {
      const larger = new Uint32Array(2 * this.size);
      larger.set(this.array);
      this.array = larger;
    }
    this.array[this.size++] = x;
  }
  get(): Uint32Array { return this.array.slice(0, this.size); }
}

class Decoder {
  private readonly b: ByteReader;
  private readonly coordinate: (predicted: number) => number;
  private readonly width: number;
  private readonly rec: Record;
  private nWedges = 0;
  private nFaces = 0;
  private error = 0;
  private readonly fans: number[][] = [];
  private readonly wedges: Uint32Array;
  private readonly corners: Uint32Array;
  private readonly positions: Float64Array;
  private readonly fan = new Growing();
  private readonly goes = new Growing();

  constructor(bytes: Uint8Array) {
    const b = this.b = new ByteReader(bytes);
    if (b.text(4) !== 'WPM1') throw new Error('no progressive mesh');
    const flags = b.byte(), kind = b.byte();
    b.take(8 + 24);
    this.error = b.f32();
    this.width = (flags & 8 ? 3 : 0) + (flags & 32 ? 4 : flags & 16 ? 3 : 0) + (flags & 64 ? 2 : 0);
    this.coordinate = coordinateReader(b, kind);
    const vertices = b.number(), wedges = b.number(), faces = b.number(), splits = b.number(), all = b.number();
    if (Math.max(all, splits, vertices) > bytes.length * 3 + 64) throw new Error('counts and bytes contradict each other');
    this.corners = new Uint32Array(3 * all);
    this.wedges = new Uint32Array(3 * all);
    this.positions = new Float64Array(3 * (vertices + splits));
    this.rec = {
      baseVertices: vertices, baseFaces: faces, faces: all, splits, baseError: this.error, vertex: new Uint32Array(splits), coarse: new Float64Array(3 * splits),
      fine: new Float64Array(3 * splits), made: new Float64Array(3 * splits), error: new Float32Array(splits), faceEnd: new Uint32Array(splits),
      fan: this.fan.array, goes: new Uint8Array(0), fanEnd: new Uint32Array(splits), positions: this.positions, corners: this.corners,
    };
    this.base(vertices, wedges, faces);
    for (let i = 0; i < splits; ++i) this.split(i);
    this.rec.fan = this.fan.get();
    this.rec.goes = Uint8Array.from(this.goes.get());
  }

  get record(): Record { return this.rec; }

  private base(vertices: number, wedges: number, faces: number): void {
    const b = this.b;
    const p: [number, number, number] = [0, 0, 0];
    for (let v = 0; v < vertices; ++v) {
      b.number();
      for (let k = 0; k < 3; ++k) this.positions[3 * v + k] = p[k] = this.coordinate(p[k]!);
      this.fans.push([]);
    }
    for (let w = 0; w < wedges; ++w) this.newWedge();
    let v = 0, w = 0;
    for (let f = 0; f < faces; ++f) {
      b.number();
      for (let k = 0; k < 3; ++k) {
        v += b.whole();
        if (this.width) w += b.whole();
        this.setCorner(3 * f + k, v, w);
      }
      ++this.nFaces;
    }
  }

  private setCorner(c: number, v: number, w: number): void {
    this.corners[c] = v;
    this.wedges[c] = w;
    const fan = this.fans[v];
    if (!fan) throw new Error('a face has a vertex that is not there');
    fan.push(c);
  }

  /// The values of a row are not needed.
  private row(): void { for (let i = 0; i < this.width; ++i) this.b.number(); }
  private newWedge(): number {
    this.row();
    return this.nWedges++;
  }

  private split(i: number): void {
    const b = this.b, rec = this.rec, p = this.positions;
    const head = b.byte();
    const count = (head & 3) === 3 ? 3 + b.number() : head & 3;
    const v = b.number(), u = rec.baseVertices + i;
    if (head & 8) this.error = singleAt(orderOf(this.error) - b.number());
    b.whole();
    const fan = this.fans[v];
    if (!fan) throw new Error('a vertex is split that is not there');
    this.move(i, v, u, (head & 4) !== 0);
    const mask = b.take((fan.length + 7) >> 3);
    const stay: number[] = [], go: number[] = [];
    fan.forEach((c, k) => {
      const goes = mask[k >> 3]! >> (k & 7) & 1;
      (goes ? go : stay).push(c);
      this.fan.push(c);
      this.goes.push(goes);
    });
    this.fans[v] = stay;
    this.fans.push(go);
    for (const c of go) this.corners[c] = u;
    if (this.width) this.wedgesOf(go, (head & 16) !== 0);
    for (let f = 0; f < count; ++f) this.face(u, v, fan);
    if (head & 32) for (let n = b.number(); n > 0; --n) b.number(), this.row();
    rec.vertex[i] = v;
    rec.error[i] = this.error;
    rec.faceEnd[i] = this.nFaces;
    rec.fanEnd[i] = this.fan.size;
    if (p.length < 3 * u + 3) throw new Error('there are more splits than said');
  }

  private move(i: number, v: number, u: number, moves: boolean): void {
    const {rec, positions: p} = this;
    for (let k = 0; k < 3; ++k) rec.coarse[3 * i + k] = rec.fine[3 * i + k] = p[3 * v + k]!;
    if (moves) for (let k = 0; k < 3; ++k) rec.fine[3 * i + k] = p[3 * v + k] = this.coordinate(rec.coarse[3 * i + k]!);
    for (let k = 0; k < 3; ++k) {
      const at = 3 * i + k, predicted = moves ? 2 * rec.coarse[at]! - rec.fine[at]! : rec.coarse[at]!;
      rec.made[at] = p[3 * u + k] = this.coordinate(predicted);
    }
  }

  private wedgesOf(go: number[], oneByOne: boolean): void {
    const first = this.nWedges, becomes = new Map<number, number>();
    for (const c of go) {
      const w = this.wedges[c]!;
      if (oneByOne) {
        const n = this.b.number();
        if (n > 0) this.wedges[c] = first + n - 1;
        if (n > 0 && first + n - 1 === this.nWedges) this.newWedge();
      } else {
        if (!becomes.has(w)) becomes.set(w, this.newWedge());
        this.wedges[c] = becomes.get(w)!;
      }
    }
  }

  private face(u: number, v: number, fan: number[]): void {
    const b = this.b, f = this.nFaces++;
    if (3 * f + 3 > this.corners.length) throw new Error('there are more faces than said');
    const code = b.number(), i = Math.floor(code / 6), t = Math.floor(code / 2) % 3, far = i === 2 * fan.length;
    let thirdVertex: number, thirdWedge = 0;
    if (far) {
      thirdVertex = b.number();
    } else {
      const c = fan[i >> 1];
      if (c === undefined) throw new Error('a face lies at a corner that is not there');
      const other = c - c % 3 + (c % 3 + 1 + (i & 1)) % 3;
      thirdVertex = this.corners[other]!;
      thirdWedge = this.wedges[other]!;
    }
    b.whole();
    const placed: [number, number, number][] = [];
    for (let k = 0; k < 3; ++k) {
      if (k === t) {
        if (far && this.width) {
          thirdWedge = b.number();
          if (thirdWedge === this.nWedges) this.newWedge();
        }
        placed.push([3 * f + k, thirdVertex, thirdWedge]);
      } else {
        const vertex = (k - t + 3) % 3 === (code & 1 ? 1 : 2) ? u : v;
        placed.push([3 * f + k, vertex, this.width ? this.nearWedge(this.fans[vertex]!) : 0]);
      }
    }
    for (const [c, vertex, w] of placed) this.setCorner(c, vertex, w);
  }

  private nearWedge(corners: number[]): number {
    const j = this.b.number(), m = corners.length;
    return j < m ? this.wedges[corners[j]!]! : j > m ? j - m - 1 : this.newWedge();
  }
}

export function decode(bytes: Uint8Array): Record {
  return new Decoder(bytes).record;
}
