#!/usr/bin/env python3
"""What a fuzzer has reached, folder by folder: reads what libFuzzer prints for -print_coverage=1.

  build/sanitize/tests/fuzz/url_fuzz -runs=0 -print_coverage=1 CORPUS 2>&1 | tests/fuzz/coverage.py url

A line a folder of which something was reached: functions and edges (branches of the control flow) that ran, of those
that the fuzzer's program has; then functions of the project with the most edges that never ran.
"""
from collections import defaultdict
import os
from pathlib import Path
import re
import sys

FUNCTION = re.compile(r'^(UN)?COVERED_FUNC: hits: \d+ edges: (\d+)/(\d+) (.*) (/\S+?):\d+$')
ROOT = Path(__file__).resolve().parents[2]
LARGEST = 5


def main():
    folders = defaultdict(lambda: [0, 0, 0, 0])  # functions that ran, all, edges that ran, all
    unreached = []
    for line in sys.stdin:
        if not (m := FUNCTION.match(line.rstrip())):
            continue
        path = Path(os.path.normpath(m[5]))
        if not path.is_relative_to(ROOT) or (where := path.relative_to(ROOT)).parts[0] in ('tests', 'build'):
            continue
        ran, edges = int(m[2]), int(m[3])
        f = folders[str(where.parent)]
        f[0] += not m[1]
        f[1] += 1
        f[2] += ran
        f[3] += edges
        if m[1]:
            unreached.append((edges, m[4], str(where)))
    reached = {name: f for name, f in folders.items() if f[0]}
    print(f'{sys.argv[1]}: {sum(f[2] for f in reached.values())} edges')
    for name, (ran, functions, edges, of) in sorted(reached.items(), key=lambda item: -item[1][2]):
        print(f'  {name:28}{ran:5} of {functions:5} functions{edges:7} of {of:6} edges{100 * edges / of:5.0f} %')
    for edges, name, where in sorted((u for u in unreached if str(Path(u[2]).parent) in reached), reverse=True)[:LARGEST]:
        print(f'  never: {name[:80]} ({where}, {edges} edges)')


if __name__ == '__main__':
    main()
