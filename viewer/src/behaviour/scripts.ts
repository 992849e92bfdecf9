// Scripts of the world. The graph says which events they get and send (writers/gltf/interactivity/scripts.h); here they are made into calls
// of their functions, one at a time for each Script, and ended when one takes too long.
import {Quaternion, Vector3} from 'three';
import {vrmlOf, type GltfFile} from '../world/file';
import type {GraphFile} from './graph';
import {HeldNodes} from './held_nodes';
import type {Value} from './operations';
import {frameText, workerText, type FromFrame, type ScriptField, type ToFrame} from './script_frame';

const longestCall = 1000, longestStart = 20_000;  // milliseconds
const mostWaiting = 200, mostScripts = 32, longestAnswer = 1_000_000;  // characters

const ranLonger = (milliseconds: number): string => `was stopped because it ran for more than ${milliseconds / 1000} s`;

interface Call { name: string; field?: string; type?: string; value?: unknown }

interface Running {
  name: string;
  types: Map<string, string>;  // of what it sends
  inputs: Map<string, {type: string; field: string}>;
  waiting: Call[];
  busy: boolean;
  started: boolean;
  timer: number;
}

interface Found { node: number; name: string; program: string; fields: ScriptField[]; inputs: Map<string, {type: string; field: string}>; held: HeldNodes }

/// The Scripts of a file whose program is in it and whose events the graph knows.
export function scriptsOf(file: GltfFile, graph: GraphFile | null): Found[] {
  const known = new Set((graph?.events ?? []).map(e => /^(?:to|from)-script:(\d+):/.exec(e.id ?? '')?.[1]).filter(n => n !== undefined).map(Number));
  return [...known].sort((a, b) => a - b).flatMap(node => {
    const said = vrmlOf(file.nodes?.[node]?.extras)['Script'] as {url?: unknown; interface?: unknown} | undefined;
    const program = programIn(said?.url);
    if (!said || program === null) return [];
    const set = `from-script:${node}:`, held = new HeldNodes(file, (graph?.events ?? []).flatMap(e => e.id?.startsWith(set) ? [e.id.slice(set.length)] : []));
    return [{node, name: file.nodes?.[node]?.name ?? 'Script', program, held, ...interfaceOf(said.interface, held)}];
  }).slice(0, mostScripts);
}

function programIn(url: unknown): string | null {
  for (const text of [url].flat()) {
    const found = /^\s*(?:javascript|ecmascript|vrmlscript):/i.exec(String(text));
    if (found) return String(text).slice(found[0].length);
  }
  return null;
}

function interfaceOf(said: unknown, held: HeldNodes): Pick<Found, 'fields' | 'inputs'> {
  const fields: ScriptField[] = [], inputs: Found['inputs'] = new Map();
  for (const row of Array.isArray(said) ? said as unknown[][] : []) {
    const [access, type, name] = row.map(String) as [string, string, string];
    const inout = access === 'exposedField' || access === 'inputOutput';
    if (access === 'eventIn' || access === 'inputOnly') inputs.set(name, {type, field: name});
    else fields.push({name, type, out: inout || access === 'eventOut' || access === 'outputOnly', inout, ...(row.length > 3 ? {value: initial(name, type, row[3], held)} : {})});
    if (inout) for (const event of [name, `set_${name}`]) inputs.set(event, {type, field: name});
  }
  return {fields, inputs};
}

/// As annex_c.js takes values: flat lists, and numbers for nodes.
function initial(name: string, type: string, value: unknown, held: HeldNodes): unknown {
  if (type === 'SFNode' || type === 'MFNode') return held.take({name, type}, value);
  return Array.isArray(value) ? value.flat(3) : value;
}

export class Scripts {
  readonly faults: string[] = [];
  private readonly frame = document.createElement('iframe');
  private readonly channel = new MessageChannel();
  private readonly running = new Map<number, Running>();

  /// `sent`: an event of a Script. `changed`: there is another fault.
  constructor(scripts: readonly Found[], private readonly sent: (id: string, value: Value) => void, private readonly changed: () => void) {
    this.channel.port1.onmessage = ({data}: MessageEvent<FromFrame>) => this.take(data);
    this.frame.setAttribute('sandbox', 'allow-scripts');
    this.frame.setAttribute('title', 'Scripts of the world');
    this.frame.hidden = true;
    this.frame.srcdoc = frameText;
    this.frame.onload = () => {
      this.frame.onload = null;
      this.frame.contentWindow?.postMessage(null, '*', [this.channel.port2]);
      for (const script of scripts) this.start(script);
    };
    document.body.append(this.frame);
  }

  private start({node, name, program, fields, inputs, held}: Found): void {
    const types = new Map(fields.filter(f => f.out).flatMap(f => [[f.name, f.type], [`${f.name}_changed`, f.type]] as [string, string][]));
    for (const [event, type] of held.types) types.set(event, type);
    const functions = [...new Set(['initialize', 'eventsProcessed', ...inputs.keys()])];
    const script: Running = {name, types, inputs, waiting: [], busy: true, started: false, timer: 0};
    this.running.set(node, script);
    this.post({script: node, start: workerText(program, fields, held.nodes, functions), program});
    this.limit(node, script, longestStart);
  }

  private post(message: ToFrame): void { this.channel.port1.postMessage(message); }

  private limit(node: number, script: Running, milliseconds: number): void {
    clearTimeout(script.timer);
    script.timer = window.setTimeout(() => this.end(node, ranLonger(milliseconds)), milliseconds);
  }

  private end(node: number, why: string): void {
    const script = this.running.get(node);
    if (!script) return;
    clearTimeout(script.timer);
    this.running.delete(node);
    this.post({script: node, end: true});
    this.note(`${script.name} ${why}`);
  }

  private note(fault: string): void {
    if (this.faults.includes(fault) || this.faults.length > 50) return;
    this.faults.push(fault);
    this.changed();
  }

  /// An event of the graph for a Script: "to-script:4:press".
  tell(id: string, value: Value): void {
    const [, node, event] = id.split(':'), script = this.running.get(Number(node)), input = script?.inputs.get(event ?? '');
    if (!script || !input) return;
    if (script.waiting.length >= mostWaiting) return this.note(`${script.name} gets more events than it can take`);
    script.waiting.push({name: event!, field: input.field, type: input.type, value: toVrml(input.type, value)}, {name: 'eventsProcessed'});
    this.next(Number(node), script);
  }

  private next(node: number, script: Running): void {
    const call = script.busy ? undefined : script.waiting.shift();
    if (!call) return;
    script.busy = true;
    this.limit(node, script, longestCall);
    this.post({script: node, call: JSON.stringify(call)});
  }

  /// What comes from there may be anything.
  private take(data: FromFrame): void {
    const script = this.running.get(data.script);
    if (!script) return;
    if ('fault' in data) return this.end(data.script, `cannot be run: ${data.fault.slice(0, 300)}`);
    if ('silent' in data) return this.end(data.script, ranLonger(longestCall));
    if ('ready' in data) {
      if (!script.started) this.limit(data.script, script, longestCall);
      script.started = true;
      return;
    }
    if (!script.busy || !script.started) return;
    if (data.answer.length > longestAnswer) return this.end(data.script, `was stopped because it sent more than ${longestAnswer} characters at once`);
    clearTimeout(script.timer);
    script.busy = false;
    this.answered(data.script, script, data.answer);
    this.next(data.script, script);
  }

  /// An output sends at most one event a call.
  private answered(node: number, script: Running, answer: string): void {
    let said: {events?: unknown; error?: unknown} | null = null;
    try {
      said = JSON.parse(answer) as {events?: unknown; error?: unknown};
    } catch {}
    if (said?.error) this.note(`${script.name} reports ${String(said.error).slice(0, 300)}`);
    const events = new Map<string, unknown>();
    for (const event of Array.isArray(said?.events) ? said.events as ({name?: unknown; value?: unknown} | null)[] : [])
      if (typeof event?.name === 'string' && script.types.has(event.name) && !events.has(event.name)) events.set(event.name, event.value);
    for (const [name, value] of events) {
      const sent = fromVrml(script.types.get(name)!, value);
      if (sent !== null) this.sent(`from-script:${node}:${name}`, sent);
    }
  }

  /// All of them end, with all that they have begun.
  dispose(): void {
    for (const script of this.running.values()) clearTimeout(script.timer);
    this.running.clear();
    this.channel.port1.close();
    this.frame.remove();
  }
}

/// A time in the graph means now; rotations are quaternions there.
function toVrml(type: string, value: Value): unknown {
  if (type === 'SFTime') return Date.now() / 1000;
  if (type !== 'SFRotation' || !Array.isArray(value)) return value;
  const q = new Quaternion().fromArray(value), angle = 2 * Math.acos(Math.min(1, Math.max(-1, q.w))), s = Math.sqrt(1 - Math.min(1, q.w * q.w));
  return s < 1e-9 ? [0, 0, 1, 0] : [q.x / s, q.y / s, q.z / s, angle];
}

const sizes: Record<string, number> = {SFVec3f: 3, SFColor: 3, SFRotation: 4};

/// Null where it is no value of that type.
function fromVrml(type: string, value: unknown): Value {
  if (type === 'SFBool') return value === true;
  if (type === 'SFTime') return 0;
  if (type === 'SFInt32' || type === 'SFFloat') return typeof value === 'number' && Number.isFinite(value) ? value : null;
  if (!Array.isArray(value) || value.length !== sizes[type] || !value.every(Number.isFinite)) return null;
  const [x, y, z, angle] = value as [number, number, number, number];
  if (type !== 'SFRotation') return [x, y, z];
  const axis = new Vector3(x, y, z);
  return axis.length() > 0 ? new Quaternion().setFromAxisAngle(axis.normalize(), angle).toArray() : [0, 0, 0, 1];
}
