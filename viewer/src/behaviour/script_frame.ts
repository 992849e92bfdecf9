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

/// What comes out of the frame. ready: the environment is there, and the program begins.
export type FromFrame = {script: number; ready: true} | {script: number; answer: string} | {script: number; fault: string};
export type ToFrame = {script: number; start: string} | {script: number; call: string} | {script: number; end: true};

/// In the frame, which relays.
function relay(): void {
  const workers = new Map<number, Worker>();
  addEventListener('message', event => {
    const port = event.ports[0];
    if (event.source !== parent || !port) return;
    port.onmessage = ({data}: MessageEvent<ToFrame>) => {
      const {script} = data;
      if ('end' in data) {
        workers.get(script)?.terminate();
        workers.delete(script);
      } else if ('start' in data) {
        const worker = new Worker(URL.createObjectURL(new Blob([data.start], {type: 'text/javascript'})));
        worker.onmessage = message => port.postMessage({script, ...(message.data === true ? {ready: true} : {answer: String(message.data)})});
        worker.onerror = error => {
          error.preventDefault();
          port.postMessage({script, fault: error.message || 'it cannot be run'});
        };
        workers.set(script, worker);
      } else workers.get(script)?.postMessage(data.call);
    };
  }, {once: true});
}

const policy = "default-src 'none'; script-src 'unsafe-inline'; worker-src blob:";
export const frameText = `<!doctype html><meta http-equiv="Content-Security-Policy" content="${policy}"><script>(${relay.toString()})()</script>`;

/// In the Worker. `begin` is what annex_c.js gives; `program` is a function around the program, which sees nothing of this.
function environment(makeEnvironment: (ask: () => string, clock: () => number) => (global: unknown) => {load(fields: string): void; call(what: string): string}, fields: string, program: () => Record<string, unknown>): void {
  const post = postMessage.bind(self);
  const refused = JSON.stringify({error: 'nodes of the world and Browser functions that change it are out of reach on this page'});
  const script = makeEnvironment(() => refused, () => Date.now() / 1000)(self);
  post(true);
  script.load(fields);
  for (const [name, value] of Object.entries(program())) if (value !== undefined) Object.defineProperty(self, name, {value, configurable: true});
  self.onmessage = event => { if (event.isTrusted) post(script.call(String(event.data))); };
  post(script.call('{"name":"initialize"}'));
}

const reserved = /^(await|break|case|catch|class|const|continue|debugger|default|delete|do|else|enum|export|extends|false|finally|for|function|if|import|in|instanceof|let|new|null|return|static|super|switch|this|throw|true|try|typeof|var|void|while|with|yield|arguments|eval)$/;
const isName = (name: string): boolean => /^[A-Za-z_$][\w$]*$/.test(name) && !reserved.test(name);

/// The file of a Worker. `functions`: what may be called.
export function workerText(program: string, fields: readonly ScriptField[], functions: readonly string[]): string {
  const found = functions.filter(isName).map(name => `${JSON.stringify(name)}: typeof ${name} === 'function' ? ${name} : undefined`);
  return `(${environment.toString()})(\n${annexC}\n, ${JSON.stringify(JSON.stringify({fields}))}, function () {\n${program}\nreturn {${found.join(', ')}};\n});`;
}
