// What the nodes of a behaviour graph compute (KHR_interactivity, "Math Operations"): those that wrlkit writes
// (writers/gltf/interactivity). Vectors are lists; a quaternion is x, y, z, w.
import {Quaternion, Vector3} from 'three';

export type Value = boolean | number | string | null | number[];
export type Inputs = (socket: string) => Value;
type Operation = (input: Inputs) => Value;

const number = (v: Value): number => typeof v === 'number' ? v : Number.NaN;
const list = (v: Value): number[] => Array.isArray(v) ? v : [];

const each = (f: (a: number) => number): Operation => input => {
  const a = input('a');
  return Array.isArray(a) ? a.map(f) : f(number(a));
};

const pair = (f: (a: number, b: number) => number): Operation => input => {
  const a = input('a'), b = input('b');
  return Array.isArray(a) ? a.map((v, i) => f(v, list(b)[i] ?? Number.NaN)) : f(number(a), number(b));
};

const compare = (f: (a: number, b: number) => boolean): Operation => input => f(number(input('a')), number(input('b')));

const equal = (a: Value, b: Value): boolean => Array.isArray(a) ? a.every((v, i) => v === list(b)[i]) : a === b;
const quaternion = (v: Value): Quaternion => new Quaternion().fromArray(list(v));

export const operations: Record<string, Operation> = {
  'math/Inf': () => Infinity,
  'math/add': pair((a, b) => a + b),
  'math/sub': pair((a, b) => a - b),
  'math/mul': pair((a, b) => a * b),
  'math/div': pair((a, b) => a / b),
  'math/rem': pair((a, b) => a % b),
  'math/abs': each(Math.abs),
  'math/floor': each(Math.floor),
  'math/ceil': each(Math.ceil),
  'math/fract': each(a => a - Math.floor(a)),
  'math/sin': each(Math.sin),
  'math/cos': each(Math.cos),
  'math/tan': each(Math.tan),
  'math/atan': each(Math.atan),
  'math/eq': input => equal(input('a'), input('b')),
  'math/ge': compare((a, b) => a >= b),
  'math/gt': compare((a, b) => a > b),
  'math/le': compare((a, b) => a <= b),
  'math/not': input => input('a') !== true,
  'math/and': input => input('a') === true && input('b') === true,
  'math/select': input => input(input('condition') === true ? 'a' : 'b'),
  'math/dot': input => list(input('a')).reduce((sum, v, i) => sum + v * (list(input('b'))[i] ?? 0), 0),
  'math/combine3': input => [number(input('a')), number(input('b')), number(input('c'))],
  'math/quatMul': input => quaternion(input('a')).multiply(quaternion(input('b'))).toArray(),
  'math/quatConjugate': input => quaternion(input('a')).conjugate().toArray(),
  'math/rotate3D': input => new Vector3().fromArray(list(input('a'))).applyQuaternion(quaternion(input('rotation'))).toArray(),
};
