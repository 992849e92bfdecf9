#!/usr/bin/env python3
"""Planning, a run, a run with nothing left to do and a report of many small files: what they ask of the system grows as the number of files
does, and their memory hardly at all.

  tests/corpus_many.py --wrlkit WRLKIT [--files 1500]

Counted are calls that read and write, of the process with all its workers, as /proc/PID/io has them; a fifth of the files is compared with all
of them, the most of two runs: how often a pipe is looked at depends on who is quicker. No time is measured. bench/corpus_bench.py has the figures of 100,000 files.
"""
import argparse
import os
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
MORE_A_FILE = 2500   # bytes of memory


def run(wrlkit, *words):
    """Calls that read or write, and the peak of memory in bytes."""
    process = subprocess.Popen([wrlkit, 'corpus', *map(str, words)], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    text = process.stderr.read()
    os.waitid(os.P_PID, process.pid, os.WEXITED | os.WNOWAIT)
    counts = dict(line.split(': ') for line in pathlib.Path(f'/proc/{process.pid}/io').read_text().splitlines())
    _, status, usage = os.wait4(process.pid, 0)
    if os.waitstatus_to_exitcode(status):
        sys.exit(f'{words}: {text.decode()}')
    return int(counts['syscr']) + int(counts['syscw']), usage.ru_maxrss * 1024


def figures(wrlkit, tmp, n):
    for i in range(n):
        path = tmp / 'in' / f'{i // 500:03}' / f'{i:06}.wrl'
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(f'#VRML V2.0 utf8\nDEF Part_{i} Shape {{ geometry Box {{ size 1 2 {i % 7 + 1} }} }}\n')
    recipe = tmp / 'plain.toml'
    recipe.write_text('summary = "nothing but a conversion"\n')
    words = (recipe, tmp / 'in', '-o', tmp / 'out', '-q')
    return {'plan': run(wrlkit, 'plan', *words), 'run': run(wrlkit, 'run', *words, '--jobs', 2), 'run again': run(wrlkit, 'run', *words), 'report': run(wrlkit, 'report', tmp / 'out', '--looks', 0, '-q')}


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument('--wrlkit', type=pathlib.Path, required=True)
    parser.add_argument('--files', type=int, default=1500)
    options = parser.parse_args()
    wrlkit, most, faults = options.wrlkit.resolve(), options.files, 0
    few_runs = []
    for _ in range(2):
        with tempfile.TemporaryDirectory() as tmp:
            few_runs.append(figures(wrlkit, pathlib.Path(tmp), most // 5))
    few = {what: max(run[what] for run in few_runs) for what in few_runs[0]}
    with tempfile.TemporaryDirectory() as tmp:
        many = figures(wrlkit, pathlib.Path(tmp), most)
    for what in few:
        (calls, memory), (more_calls, more_memory) = few[what], many[what]
        linear, flat = more_calls <= 5.5 * calls + 100, more_memory - memory <= MORE_A_FILE * (most - most // 5)
        faults += not linear or not flat
        print(f'{"ok    " if linear and flat else "FAILED"} {what}: calls {calls} of {most // 5} files, {more_calls} of {most}; memory {memory / 1e6:.1f} MB, {more_memory / 1e6:.1f} MB')
    return 1 if faults else 0


sys.exit(main())
