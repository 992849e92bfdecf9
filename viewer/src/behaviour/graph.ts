// A behaviour graph of KHR_interactivity being run: events begin flows, flows set variables and properties. What it reads and changes
// of the world is the host's (host.ts).
import {operations, type Value} from './operations';

interface Input { node?: number; socket?: string; type?: number; value?: Value[] }

interface GraphNode {
  declaration: number;
  configuration?: Record<string, {value: (number | string)[]}>;
  values?: Record<string, Input>;
  flows?: Record<string, {node: number; socket?: string}>;
}

export interface GraphFile {
  types?: {signature: string}[];
  variables?: {type: number; value: Value[]}[];
  events?: {id?: string}[];
  declarations?: {op: string; extension?: string}[];
  nodes?: GraphNode[];
}

export interface Host {
  /// Undefined where there is no such property.
  get(pointer: string): Value | undefined;
  set(pointer: string, value: Value): boolean;
  play(animation: number, start: number, end: number, speed: number, done: () => void): void;
  stop(animation: number): void;
  stopAt(animation: number, time: number, done: () => void): void;
  /// An event that is for the page, with its value.
  send(id: string, value: Value): void;
}

const mostSteps = 1_000_000;  // of one event: flows entered and values computed

const plain = (values: Value[]): Value => values.length === 1 ? values[0]! : values as number[];

export class GraphRun {
  private readonly nodes: GraphNode[];
  private readonly variables: Value[];
  private readonly waiting: number[] = [];  // events of the graph's own
  private readonly received = new Map<number, Value>();  // the last value of events that came from the page
  private time = 0;
  private sinceTick = Number.NaN;
  private readonly listeners = new Map<string, number[]>();  // nodes by operation, and by what they listen to
  private readonly values = new Map<string, Value>();  // computed since something was set
  private readonly computing = new Set<string>();
  private steps = 0;
  private stopped = false;  // the event goes no further up

  constructor(private readonly graph: GraphFile, private readonly host: Host) {
    this.nodes = graph.nodes ?? [];
    this.variables = (graph.variables ?? []).map(v => plain(v.value));
    this.nodes.forEach((n, i) => this.list(n, i));
  }

  start(): void { this.happen('event/onStart'); }

  tick(seconds: number): void {
    this.happen('event/onTick');
    this.time += seconds;
    this.sinceTick = seconds;
  }

  /// A click at a node; then at those that hold it. True when something listens.
  select(way: readonly number[]): boolean {
    this.stopped = false;
    let heard = false;
    for (const node of way) {
      if (this.stopped) break;
      heard = this.happen('event/onSelect', node) || heard;
    }
    return heard;
  }

  /// An event of the page for the graph.
  receive(id: string, value: Value): void {
    const event = (this.graph.events ?? []).findIndex(e => e.id === id);
    const listeners = this.listeners.get(`event/receive ${event}`);
    if (event < 0 || !listeners) return;
    this.received.set(event, value);
    this.begin();
    for (const i of listeners) this.leave(i, 'out');
    this.deliver();
  }

  hover(way: readonly number[], in_: boolean): void {
    for (const node of way) this.happen(in_ ? 'event/onHoverIn' : 'event/onHoverOut', node);
  }

  /// Whether something happens when one of them is clicked.
  listens(way: readonly number[]): boolean {
    return way.some(node => this.listeners.has(`event/onSelect ${node}`));
  }

  /// Pointers that it may set.
  get pointersSet(): string[] {
    return (this.listeners.get('pointer/set') ?? []).map(i => String(this.nodes[i]?.configuration?.['pointer']?.value[0]));
  }

  private list(n: GraphNode, index: number): void {
    const operation = this.operation(n);
    const subject = n.configuration?.[operation === 'event/receive' ? 'event' : 'nodeIndex']?.value[0];
    for (const key of subject === undefined ? [operation] : [operation, `${operation} ${subject}`]) {
      const known = this.listeners.get(key);
      if (known) known.push(index);
      else this.listeners.set(key, [index]);
    }
  }

  private operation(n: GraphNode): string { return this.graph.declarations?.[n.declaration]?.op ?? ''; }

  /// All nodes of that event; `asset`: of that node of the file.
  private happen(event: string, asset?: number): boolean {
    const listeners = this.listeners.get(asset === undefined ? event : `${event} ${asset}`);
    if (!listeners) return false;
    this.begin();
    for (const i of listeners) this.leave(i, 'out');
    this.deliver();
    return true;
  }

  private deliver(): void {
    for (let event = this.waiting.shift(); event !== undefined; event = this.waiting.shift()) {
      for (const i of this.listeners.get(`event/receive ${event}`) ?? []) this.leave(i, 'out');
    }
  }

  private begin(): void {
    this.steps = 0;
    this.values.clear();
  }

  private step(): void {
    if (++this.steps > mostSteps) throw new Error(`one event takes more than ${mostSteps} steps`);
  }

  private leave(node: number, socket: string): void {
    const to = this.nodes[node]?.flows?.[socket];
    if (to) this.enter(to.node);
  }

  private enter(index: number): void {
    const n = this.nodes[index];
    if (!n) return;
    this.step();
    const input = (socket: string): Value => this.input(n, socket);
    switch (this.operation(n)) {
      case 'flow/sequence':
        for (const socket of Object.keys(n.flows ?? {}).sort()) this.leave(index, socket);
        return;
      case 'flow/branch':
        return this.leave(index, input('condition') === true ? 'true' : 'false');
      case 'variable/set': {
        const values = (n.configuration?.['variables']?.value ?? []).map(v => [Number(v), input(String(v))] as const);
        for (const [variable, value] of values) this.variables[variable] = value;
        break;
      }
      case 'pointer/set':
        if (!this.host.set(String(n.configuration?.['pointer']?.value[0]), input('value'))) return this.leave(index, 'err');
        break;
      case 'animation/start':
        this.host.play(animation(input('animation')), Number(input('startTime')), Number(input('endTime')), Number(input('speed')), () => this.later(index));
        break;
      case 'animation/stop':
        this.host.stop(animation(input('animation')));
        break;
      case 'animation/stopAt':
        this.host.stopAt(animation(input('animation')), Number(input('stopTime')), () => this.later(index));
        break;
      case 'event/send':
        this.send(Number(n.configuration?.['event']?.value[0]), n.values?.['value'] ? input('value') : null);
        break;
      case 'event/stopPropagation':
        this.stopped = true;
        break;
    }
    this.values.clear();
    this.leave(index, 'out');
  }

  private later(node: number): void {
    this.begin();
    this.leave(node, 'done');
    this.deliver();
  }

  private send(event: number, value: Value): void {
    const id = this.graph.events?.[event]?.id;
    if (id) this.host.send(id, value);
    else this.waiting.push(event);
  }

  private input(n: GraphNode, socket: string): Value {
    const said = n.values?.[socket];
    if (!said) return null;
    if (said.node === undefined) return said.value ? plain(said.value) : null;
    return this.output(said.node, said.socket ?? 'value');
  }

  private output(index: number, socket: string): Value {
    const n = this.nodes[index];
    if (!n) return null;
    const operation = this.operation(n);
    if (operation === 'event/onTick') return socket === 'timeSinceStart' ? this.time : this.sinceTick;
    if (operation === 'event/receive') return this.received.get(Number(n.configuration?.['event']?.value[0])) ?? null;
    if (operation === 'variable/get') return this.variables[Number(n.configuration?.['variable']?.value[0])] ?? null;
    if (operation === 'pointer/get') return this.host.get(String(n.configuration?.['pointer']?.value[0])) ?? Number.NaN;
    return this.computed(`${index} ${socket}`, () => operations[operation]?.(s => this.input(n, s)) ?? null);
  }

  /// Each value once, until something is set: several nodes may ask for the same.
  private computed(key: string, compute: () => Value): Value {
    const known = this.values.get(key);
    if (known !== undefined) return known;
    if (this.computing.has(key)) throw new Error('a value depends on itself');
    this.step();
    this.computing.add(key);
    const value = compute();
    this.computing.delete(key);
    this.values.set(key, value);
    return value;
  }
}

/// The number in "/animations/3".
function animation(reference: Value): number { return Number(String(reference).split('/')[2]); }
