// Running the program under test.
import {spawn} from 'node:child_process';

/// {code, text, seconds}: the exit code, or the name of the signal or 'timeout' that ended it; what it printed to stderr.
export function run(program, args, seconds = 60) {
  return new Promise(resolve => {
    const begin = performance.now();
    const child = spawn(program, args, {stdio: ['ignore', 'ignore', 'pipe']});
    let text = '', late = false;
    const timer = setTimeout(() => { late = true; child.kill('SIGKILL'); }, seconds * 1000);
    const end = code => { clearTimeout(timer); resolve({code: late ? 'timeout' : code, text, seconds: (performance.now() - begin) / 1000}); };
    child.stderr.setEncoding('utf8').on('data', piece => { if (text.length < 1e5) text += piece; });
    child.on('error', error => { text += error; end('not started'); });
    child.on('close', (code, signal) => end(signal ?? code));
  });
}

/// Does work(item) for all items, `lanes` at a time.
export async function in_lanes(items, lanes, work) {
  const next = items[Symbol.iterator]();
  const lane = async () => { for (let i = next.next(); !i.done; i = next.next()) await work(i.value); };
  await Promise.all(Array.from({length: lanes}, lane));
}

/// What work(item) gives for all items, in their order; the next n are under way while one is looked at.
export async function* ahead(items, n, work) {
  const under_way = [];
  for (const item of items) {
    under_way.push(work(item));
    if (under_way.length > n) yield await under_way.shift();
  }
  yield* under_way;
}
