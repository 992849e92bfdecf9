// How loud a Sound is at a place (ISO/IEC 14772-1, 6.42): full within an ellipsoid, nothing beyond another one, and between them 20 dB less
// from the one to the other. The location is a focus of both.

export interface Ellipsoids {
  location: readonly number[];
  direction: readonly number[];
  minFront: number;
  minBack: number;
  maxFront: number;
  maxBack: number;
}

/// From the focus to an ellipsoid, in a direction whose angle to the axis has that cosine.
function reach(front: number, back: number, cosine: number): number {
  const denominator = front + back - (front - back) * cosine;
  return denominator > 0 ? 2 * front * back / denominator : 0;
}

/// From 0 to 1, at a place in the coordinates of the Sound.
export function loudness(e: Ellipsoids, place: readonly number[]): number {
  const away = [0, 1, 2].map(k => place[k]! - e.location[k]!), distance = Math.hypot(...away), length = Math.hypot(...e.direction);
  const cosine = distance > 0 && length > 0 ? away.reduce((sum, v, k) => sum + v * e.direction[k]!, 0) / (distance * length) : 1;
  const inner = reach(e.minFront, e.minBack, cosine), outer = reach(e.maxFront, e.maxBack, cosine);
  if (distance <= inner) return 1;
  return distance < outer ? 10 ** -((distance - inner) / (outer - inner)) : 0;
}
