// Numbers for people.

const whole = new Intl.NumberFormat('en');

export const count = (n: number): string => whole.format(n);

export function bytes(n: number): string {
  if (n < 1000) return `${n} B`;
  if (n < 1e6) return `${(n / 1e3).toPrecision(3)} kB`;
  return `${(n / 1e6).toPrecision(3)} MB`;
}

/// Metres, in the unit in which they are easy to read.
export function length(metres: number): string {
  const size = Math.abs(metres);
  if (size === 0) return '0 mm';
  if (size < 1e-5) return `${(metres * 1e6).toPrecision(3)} µm`;
  if (size < 1) return `${significant(metres * 1e3)} mm`;
  return `${significant(metres)} m`;
}

/// In millimetres whatever the size.
export const millimetres = (metres: number): string => `${significant(metres * 1e3)} mm`;

export function significant(x: number, digits = 3): string {
  if (x === 0) return '0';
  if (Math.abs(x) >= 1000) return whole.format(Math.round(x));
  if (Math.abs(x) >= 1e-4) return x.toPrecision(digits);
  const [mantissa, power] = x.toExponential(digits - 1).split('e') as [string, string];
  return `${mantissa} × 10${[...power].map(c => superscripts[c] ?? '').join('')}`;
}

const superscripts: Record<string, string> = {'-': '⁻', 0: '⁰', 1: '¹', 2: '²', 3: '³', 4: '⁴', 5: '⁵', 6: '⁶', 7: '⁷', 8: '⁸', 9: '⁹'};

/// 1 draw, 2 draws.
export const counted = (n: number, what: string): string => `${count(n)} ${what}${n === 1 ? '' : 's'}`;

export const share = (part: number, all: number): string => `${(all > 0 ? 100 * part / all : 0).toFixed(1)} %`;
