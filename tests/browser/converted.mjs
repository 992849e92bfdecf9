// What tests/convert_worlds.py has made.
import fs from 'node:fs';
import path from 'node:path';

const codes = {made: 0, 'made-partly': 1, failed: 3};

/// {file, code, text} of each world by its path; none when there is no such folder. `code`: what `wrlkit convert` would have ended with.
export function converted_in(folder) {
  const journal = path.join(folder, '.wrlkit/journal-1-of-1.jsonl');
  if (!fs.existsSync(journal)) return new Map();
  const jobs = fs.readFileSync(journal, 'utf8').trimEnd().split('\n').map(line => JSON.parse(line));
  return new Map(jobs.map(job => [job.input, {file: path.join(folder, job.output), code: codes[job.state] ?? job.state, text: job.cause ?? ''}]));
}
