// Numbers of a .wpm file (docs/progressive.md, Numbers).

const scratch = new DataView(new ArrayBuffer(8));

/// The place of a single among all singles.
export function orderOf(x: number): number {
  scratch.setFloat32(0, x);
  const bits = scratch.getUint32(0);
  return bits & 0x80000000 ? -1 - (bits & 0x7fffffff) : bits;
}

export function singleAt(order: number): number {
  scratch.setUint32(0, order >= 0 ? order : ((-1 - order) | 0x80000000) >>> 0);
  return scratch.getFloat32(0);
}

export class ByteReader {
  private at = 0;
  private readonly view: DataView;

  constructor(private readonly bytes: Uint8Array) {
    this.view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  }

  get ended(): boolean { return this.at >= this.bytes.length; }

  byte(): number {
    if (this.at >= this.bytes.length) throw new Error('the progressive data end too early');
    return this.bytes[this.at++]!;
  }
  number(): number {
    let n = 0, factor = 1;
    for (;;) {
      const b = this.byte();
      n += (b & 127) * factor;
      if (b < 128) return n;
      factor *= 128;
    }
  }
  whole(): number {
    const n = this.number();
    return n % 2 === 0 ? n / 2 : -(n + 1) / 2;
  }
  f32(): number { return this.view.getFloat32(this.skip(4), true); }
  f64(): number { return this.view.getFloat64(this.skip(8), true); }
  take(n: number): Uint8Array {
    const begin = this.skip(n);
    return this.bytes.subarray(begin, begin + n);
  }
  text(n: number): string { return new TextDecoder().decode(this.take(n)); }

  private skip(n: number): number {
    if (this.at + n > this.bytes.length) throw new Error('the progressive data end too early');
    this.at += n;
    return this.at - n;
  }
}

/// The double that is read when a single is printed with that many digits; ties go to the even digit, as C has it.
function printed(f: number, digits: number): number {
  const more = f.toExponential(digits), at = more.indexOf('e');
  const mantissa = more.slice(0, at);
  if (digits > 0 && mantissa.endsWith('5') && Number(more) === f) {
    const before = mantissa.at(-2) === '.' ? mantissa.at(-3)! : mantissa.at(-2)!;
    if ('02468'.includes(before)) return Number(mantissa.slice(0, -1) + more.slice(at));
  }
  return Number(f.toExponential(digits - 1));
}

/// Coordinates as differences from predictions (docs/progressive.md, Positions).
export function coordinateReader(bytes: ByteReader, kind: number): (predicted: number) => number {
  if (kind === 17) return () => bytes.f64();
  const step = Number(`1e${kind}`);
  if (kind <= 15) return p => (nearest(p * step) + bytes.whole()) / step;
  const single = (p: number): number => singleAt(orderOf(Math.fround(p)) + bytes.whole());
  // For kind 22 the single itself does for drawing and for predictions: it is what fround makes of the printed one.
  return kind === 16 || kind === 22 ? single : p => printed(single(p), kind - 12);
}

/// The nearest whole number, the even one of two, as C has it.
function nearest(x: number): number {
  const low = Math.floor(x), rest = x - low;
  return rest < 0.5 || (rest === 0.5 && low % 2 === 0) ? low : low + 1;
}
