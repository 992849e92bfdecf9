#!/usr/bin/env python3
"""Every message has a test that provokes it.

  tests/diag_coverage.py

Prints each name of base/diagnostics.def without a file tests/text/diag/NAME.wrl, .x3d, .x3dv or .test that expects it, and
each such file that no message has. The exit code is 1 when there is any.
"""
from pathlib import Path
import re
import sys

ROOT = Path(__file__).resolve().parents[1]
TESTS = ROOT / 'tests/text/diag'

# What no file can provoke; a unit test must name the message instead.
BY_UNIT_TESTS = {
    'pass-failed': 'only passes that a program adds fail without a word',
    'verify': 'tells of a fault of a pass, not of a world',
    'not-finite': 'the parser has made numbers finite already; only other users of the library can meet it',
    'no-patches': 'the verbs ask first what a file is',
    'no-font': 'where fonts are installed, they are found',
}


def names():
    rows = re.findall(r'^DIAG\(\w+,\s*(\w+),', (ROOT / 'base/diagnostics.def').read_text('utf-8'), re.MULTILINE)
    return [row.replace('_', '-') for row in rows]


def expected_in(test):
    return f'[{test.stem}]' in test.read_text('utf-8')


def main():
    tests = {t.stem: t for t in TESTS.iterdir() if t.suffix in ('.wrl', '.x3d', '.x3dv', '.test')}
    unit_tests = '\n'.join(t.read_text('utf-8') for t in (ROOT / 'tests/unit').glob('*.cpp'))
    faults = []
    for name in names():
        test = tests.pop(name, None)
        if test:
            if not expected_in(test):
                faults.append(f'{name}: {test.relative_to(ROOT)} does not expect it')
        elif name not in BY_UNIT_TESTS:
            faults.append(f'{name}: there is no tests/text/diag/{name}.wrl or .test')
        elif not re.search(rf'\bDiag::{name.replace("-", "_")}\b', unit_tests):
            faults.append(f'{name}: no unit test names it ({BY_UNIT_TESTS[name]})')
    faults += [f'{name}: there is no such message, but {test.relative_to(ROOT)}' for name, test in tests.items()]
    print('\n'.join(faults) if faults else f'all {len(names())} messages have a test')
    return 1 if faults else 0


if __name__ == '__main__':
    sys.exit(main())
