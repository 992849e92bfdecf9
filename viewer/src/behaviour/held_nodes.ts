// Nodes of the world that Scripts hold in their fields, with what they can read there and set with directOutput: the graph has an event
// for each of those, "from-script:4:ball.translation" (writers/gltf/interactivity/events.h).
import {Quaternion} from 'three';
import {vrmlOf, type FileNode, type GltfFile} from '../world/file';
import type {HeldNode, ScriptField} from './script_frame';

/// Types of the fields that a graph can set.
const typesSet: Record<string, string> = {
  translation: 'SFVec3f', scale: 'SFVec3f', rotation: 'SFRotation', whichChoice: 'SFInt32', startTime: 'SFTime', stopTime: 'SFTime',
  set_triggerTime: 'SFTime', set_fraction: 'SFFloat',
};
const typeSet = (field: string): string => typesSet[field] ?? 'SFBool';  // on, enabled, loop, set_bind, ...

const sizes: Record<number, string> = {2: 'SFVec2f', 3: 'SFVec3f', 4: 'SFRotation'};

/// As annex_c.js takes it. Nodes are left out, and what has no type of its own there.
function valueOf(value: unknown): {type: string; value: unknown} | null {
  if (typeof value === 'boolean') return {type: 'SFBool', value};
  if (typeof value === 'number') return {type: 'SFFloat', value};
  if (typeof value === 'string') return {type: 'SFString', value};
  if (!Array.isArray(value)) return null;
  if (value.every(v => typeof v === 'string')) return {type: 'MFString', value};
  const type = sizes[value.length];
  return type && value.every(v => typeof v === 'number') ? {type, value} : null;
}

function placeOf(node: FileNode): Record<string, unknown> {
  const {translation = [0, 0, 0], rotation, scale = [1, 1, 1]} = node as {translation?: number[]; rotation?: number[]; scale?: number[]};
  const q = new Quaternion().fromArray((rotation ?? [0, 0, 0, 1]) as [number, number, number, number]);
  const s = Math.sqrt(Math.max(0, 1 - q.w * q.w));
  return {translation, scale, rotation: s < 1e-9 ? [0, 0, 1, 0] : [q.x / s, q.y / s, q.z / s, 2 * Math.acos(Math.min(1, Math.max(-1, q.w)))]};
}

export class HeldNodes {
  readonly nodes: HeldNode[] = [];
  readonly types = new Map<string, string>();  // of what the Script sets, by event
  private readonly numbers = new Map<string, number>();

  /// `events`: what the graph knows of that Script, "ball.translation".
  constructor(private readonly file: GltfFile, private readonly events: readonly string[]) {}

  /// The value of a field as annex_c.js takes it, with nodes by their numbers.
  take(field: Pick<ScriptField, 'name' | 'type'>, value: unknown): unknown {
    if (field.type === 'SFNode') return this.number(value, `${field.name}.`);
    return Array.isArray(value) ? value.map((v, i) => this.number(v, `${field.name}[${i}].`)) : [];
  }

  private number(value: unknown, prefix: string): number | null {
    const type = value && typeof value === 'object' ? Object.keys(value)[0] : undefined;
    if (type === undefined) return null;
    const said = (value as Record<string, Record<string, unknown>>)[type] ?? {}, name = String(said['USE'] ?? said['DEF'] ?? '');
    const known = this.numbers.get(`${type} ${name}`);
    if (name && known !== undefined) return known;
    const number = this.nodes.push(this.make(type, name, said, prefix)) - 1;
    this.numbers.set(`${type} ${name}`, number);
    return number;
  }

  private make(type: string, name: string, said: Record<string, unknown>, prefix: string): HeldNode {
    const inFile = name ? this.file.nodes?.find(n => n.name === name) : undefined;
    const kept = (inFile && vrmlOf(inFile.extras)[type]) as Record<string, unknown> | undefined;
    const fields: HeldNode['fields'] = {};
    for (const [field, value] of Object.entries({...said, ...kept, ...type === 'Transform' && inFile ? placeOf(inFile) : {}})) {
      const read = /^(DEF|USE)$/.test(field) ? null : valueOf(value);
      if (read) fields[field] = read;
    }
    for (const event of this.events) {
      if (!event.startsWith(prefix)) continue;
      const field = event.slice(prefix.length);
      fields[field] = {...fields[field], type: typeSet(field), event};
      this.types.set(event, typeSet(field));
    }
    return {type, name, fields};
  }
}
