// A progressive world (docs/progressive.md, World file): surfaces, where each stands, and its record.
import {Matrix4} from 'three';
import {ByteReader} from './bytes';
import {decode, type Record} from './record';

export interface Surface {
  name: string;         // of its first place
  places: Matrix4[];
  scale: number;        // the largest, of errors
  color: [number, number, number];  // of the display, 0 to 255
  record: Record;
}

export function readWorld(data: ArrayBuffer): Surface[] {
  const b = new ByteReader(new Uint8Array(data));
  if (b.text(4) !== 'WPW1') throw new Error('no progressive world');
  const heads = Array.from({length: b.number()}, () => readPlaces(b));
  const pieces: Uint8Array[][] = heads.map(() => []);
  while (!b.ended) {
    const surface = b.number(), size = b.number();
    pieces[surface]?.push(b.take(size));
  }
  return heads.map((head, i) => ({...head, record: decode(joined(pieces[i]!))}));
}

function readPlaces(b: ByteReader): Omit<Surface, 'record'> {
  let name = '', color: [number, number, number] = [255, 255, 255], scale = 0;
  const places = Array.from({length: b.number()}, () => {
    const said = b.text(b.number());
    name ||= said;
    const m = Array.from({length: 12}, () => b.f64()) as [number, number, number, number, number, number, number, number, number, number, number, number];
    color = [b.byte(), b.byte(), b.byte()];
    b.byte();
    const matrix = new Matrix4().set(...m, 0, 0, 0, 1);
    scale = Math.max(scale, matrix.getMaxScaleOnAxis());
    return matrix;
  });
  return {name, places, scale, color};
}

function joined(pieces: Uint8Array[]): Uint8Array {
  const all = new Uint8Array(pieces.reduce((n, p) => n + p.length, 0));
  let at = 0;
  for (const p of pieces) all.set(p, at), at += p.length;
  return all;
}
