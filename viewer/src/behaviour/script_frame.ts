// Where Scripts run: a frame of an origin of its own, in which each Script has a Worker, so that one that does not end can be ended. Its
// policy and that of the page, which it inherits, allow no network; neither has 'unsafe-eval', for a program is a file of its Worker.
import annexC from '../../../tools/script_host/annex_c.js?raw';

export interface ScriptField {
  name: string;
  type: string;
  out: boolean;
  inout: boolean;
  value?: unknown;
}

/// A node of the world that a Script holds, by its number. `event`: what is sent when the Script sets that field; none: it may not.
export interface HeldNode {
  type: string;
  name: string;
  fields: Record<string, {type: string; value?: unknown; event?: string}>;
}

/// What comes out of the frame. ready: the environment is there, and the program begins. silent: its Worker was ended, for it did not answer.
export type FromFrame = {script: number; ready: true} | {script: number; silent: true} | {script: number; answer: string} | {script: number; fault: string};
export type ToFrame = {script: number; start: string; program: string} | {script: number; call: string} | {script: number; end: true};

/// In the frame, which relays, and asks each Worker whether it still listens: a program may go on after it has answered a call. When the
/// page was busy, only one tick is missed, however long it took.
function relay(): void {
  const workers = new Map<number, {worker: Worker; ready: boolean; ping: number; missed: number}>();  // ping: what it is to say, or 0
  const interval = 500, mostMissed = 4;  // milliseconds; ticks
  let fault = '';
  addEventListener('error', error => {
    fault = error.message.replace(/Failed to read .*? from '\w+': /, '');
    error.preventDefault();
  });
  // What is a handler is the body of a function: it cannot close the function that it is put in. Nothing runs here.
  const isBody = (program: string): boolean => {
    const probe = document.createElement('p');
    fault = '';
    probe.setAttribute('onclick', program);
    return typeof probe.onclick === 'function';
  };
  const end = (script: number): void => {
    workers.get(script)?.worker.terminate();
    workers.delete(script);
  };
  const begin = (port: MessagePort, script: number, text: string): void => {
    const file = URL.createObjectURL(new Blob([text], {type: 'text/javascript'}));
    const worker = new Worker(file), state = {worker, ready: false, ping: 0, missed: 0};
    worker.onmessage = ({data}: MessageEvent<unknown>) => {
      if (typeof data === 'number') {
        if (data === state.ping) state.ping = state.missed = 0;
        return;
      }
      if (data === true) state.ready = true;
      port.postMessage({script, ...(data === true ? {ready: true} : {answer: String(data)})});
    };
    worker.onerror = error => {
      error.preventDefault();
      port.postMessage({script, fault: error.message || 'it cannot be run'});
    };
    workers.set(script, state);
  };
  const tick = (port: MessagePort): void => {
    for (const [script, state] of workers) {
      if (!state.ready) continue;
      if (!state.ping) {
        state.ping = 1 + Math.random();
        state.worker.postMessage(state.ping);
      } else if (++state.missed >= mostMissed) {
        end(script);
        port.postMessage({script, silent: true});
      }
    }
  };
  addEventListener('message', event => {
    const port = event.ports[0];
    if (event.source !== parent || !port) return;
    port.onmessage = ({data}: MessageEvent<ToFrame>) => {
      const {script} = data;
      if ('end' in data) end(script);
      else if ('call' in data) workers.get(script)?.worker.postMessage(data.call);
      else if (isBody(data.program)) begin(port, script, data.start);
      else port.postMessage({script, fault: fault || 'it is no ECMAScript'});
    };
    setInterval(() => tick(port), interval);
  }, {once: true});
}

const policy = "default-src 'none'; script-src 'unsafe-inline'; worker-src blob:";
export const frameText = `<!doctype html><meta http-equiv="Content-Security-Policy" content="${policy}"><script>(${relay.toString()})()</script>`;

/// In the Worker. `begin` is what annex_c.js gives; `program` is a function around the program, which sees nothing of this. Of what the Worker
/// has, it keeps the language: no timers, messages, requests or Workers of its own.
function environment(makeEnvironment: (ask: (what: string) => string, clock: () => number) => (global: unknown) => {load(fields: string): void; call(what: string): string}, fields: string, nodes: string, program: () => Record<string, unknown>): void {
  const global: object = self, post = postMessage.bind(self), {parse, stringify} = JSON;
  const held = parse(nodes) as HeldNode[], sets = new Map<string, unknown>();
  const fieldOf = (node: HeldNode | undefined, name: string): HeldNode['fields'][string] | undefined =>
    node?.fields[name] ?? node?.fields[name.replace(/^set_|_changed$/g, '')];
  const answer = (asked: {op: string; node?: number; field?: string; text?: string; value?: unknown}): object => {
    const node = held[asked.node ?? -1], field = fieldOf(node, asked.field ?? '');
    if (asked.op === 'get') return field && field.value !== undefined ? {type: field.type, value: field.value} : {};
    if (asked.op === 'describe') return {type: node?.type ?? '', name: node?.name ?? ''};
    if (asked.op === 'named') return {node: held.findIndex(n => n.name === asked.text) >= 0 ? held.findIndex(n => n.name === asked.text) : null};
    if (asked.op !== 'set') return {error: 'Browser functions that change the world are out of reach on this page'};
    if (!field?.event) return {error: `${asked.field ?? ''} of ${node?.type ?? 'that node'} cannot be set on this page`};
    field.value = asked.value;
    sets.set(field.event, asked.value);
    return {};
  };
  const environmentOf = makeEnvironment(text => stringify(answer(parse(text) as Parameters<typeof answer>[0])), () => Date.now() / 1000);
  let script: {load(fields: string): void; call(what: string): string} | null = null;
  // What its functions send, and what they have set in nodes.
  const call = (what: string): string => {
    sets.clear();
    const said = parse(script!.call(what)) as {events: object[]; error: string};
    for (const [name, value] of sets) said.events.push({name, value});
    return stringify(said);
  };
  addEventListener('message', event => {
    if (typeof event.data === 'number') post(event.data);
    else if (script) post(call(String(event.data)));
  });
  const language = new Set<PropertyKey>(('globalThis Infinity NaN undefined eval isFinite isNaN parseFloat parseInt decodeURI decodeURIComponent encodeURI ' +
    'encodeURIComponent escape unescape Object Function Boolean Symbol Error AggregateError EvalError RangeError ReferenceError SyntaxError TypeError ' +
    'URIError Number BigInt Math Date String RegExp Array Int8Array Uint8Array Uint8ClampedArray Int16Array Uint16Array Int32Array Uint32Array ' +
    'Float16Array Float32Array Float64Array BigInt64Array BigUint64Array ArrayBuffer DataView Map Set WeakMap WeakSet WeakRef JSON Promise Reflect ' +
    'Proxy Intl Iterator console').split(' '));
  for (let at: object = global; at !== Object.prototype; at = Object.getPrototypeOf(at) as object)
    for (const key of Reflect.ownKeys(at)) if (!language.has(key)) Reflect.deleteProperty(at, key);
  script = environmentOf(global);
  post(true);
  script.load(fields);
  for (const [name, value] of Object.entries(program())) if (value !== undefined) Object.defineProperty(global, name, {value, configurable: true});
  post(call('{"name":"initialize"}'));
}

const reserved = /^(await|break|case|catch|class|const|continue|debugger|default|delete|do|else|enum|export|extends|false|finally|for|function|if|import|in|instanceof|let|new|null|return|static|super|switch|this|throw|true|try|typeof|var|void|while|with|yield|arguments|eval)$/;
const isName = (name: string): boolean => /^[A-Za-z_$][\w$]*$/.test(name) && !reserved.test(name);

/// The file of a Worker. `functions`: what may be called.
export function workerText(program: string, fields: readonly ScriptField[], nodes: readonly HeldNode[], functions: readonly string[]): string {
  const found = functions.filter(isName).map(name => `${JSON.stringify(name)}: typeof ${name} === 'function' ? ${name} : undefined`);
  return `(${environment.toString()})(\n${annexC}\n, ${JSON.stringify(JSON.stringify({fields}))}, ${JSON.stringify(JSON.stringify(nodes))}, function () {\n${program}\nreturn {${found.join(', ')}};\n});`;
}
