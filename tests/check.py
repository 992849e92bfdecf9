#!/usr/bin/env python3
"""Runs tests that are files in the format they test.

  tests/check.py --wrlkit build/release/wrlkit tests/text        run all tests below a folder
  tests/check.py --wrlkit ... tests/text/parse/hex.wrl           run one
  tests/check.py --wrlkit ... --update tests/text/write          take the output as it is for the expected one

A test is a .wrl, .x3d, .x3dv or .test file with comments such as these. Words behind the '#' of a world count wherever they stand, so
they come behind the nodes, where no writer takes them for the world's leading comment.

  # RUN: wrlkit cat %s             a command for bash, run in the root of the project; %s is this file, %S its folder,
                                   %t a path in a folder that exists only while the test runs
  # RUN-SCRIPT: name.sh            the same of the commands in a file next to the test; %s, %S and %t are put in there, too.
                                   A RUN of more than 200 characters has to be one
  # | Shape {                      one line of the output; all such lines below a RUN are all of its output
  # OUTPUT                         there is output, not yet written down: --update puts it here
  # CHECK: geometry Cone           a line further down in the output contains this; {{...}} is a regular expression
  # CHECK-NEXT: height 3           the next one does
  # CHECK-NOT: radius              no line between the neighbouring CHECKs does
  # NEEDS: python                  the test is left out where the program was built without the Python package
  # NEEDS: scripts                 or without Duktape
  # NEEDS: memory-limit            or where it cannot run below a limit, as what sanitizers build
  # EXPECT-EXIT: 3                 exit code of the RUN above; otherwise 1 when an error is expected, else 0
  # EXPECT-ERROR [unknown-field] no field 'radius'
                                   the command reports this on this line of this file, on its error output; likewise
                                   EXPECT-WARNING and EXPECT-LOST. Any other message fails the test, and so do two of
                                   different words at a place where one is expected, or one that a command says twice.
  # EXPECT-ERROR@-1 [syntax]       the same for the line above, @3 for line 3 of any file, @3:7 for a column of it,
                                   @:7 for a column of this line, @* for any place or none

CHECK, EXPECT-EXIT and output belong to the RUN above them, EXPECT-ERROR, -WARNING and -LOST to the whole test.
"""
import argparse
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
import difflib
import os
from pathlib import Path
import re
import signal
import subprocess
import sys
import tempfile

ROOT = Path(__file__).resolve().parents[1]
DIRECTIVE = re.compile(r'#\s*(RUN|RUN-SCRIPT|CHECK|CHECK-NEXT|CHECK-NOT|EXPECT-EXIT):\s*(.*?)\s*$')
EXPECT = re.compile(r'#\s*EXPECT-(ERROR|WARNING|LOST)(?:@(\*|[+-]?\d+)?(?::(\d+))?)?\s+\[([a-z0-9-]+)\]\s*(.*?)\s*$')
OUTPUT = re.compile(r'# (?:\|(?: (.*))?|OUTPUT)$')
LONGEST_RUN = 200
NEARLY = re.compile(r'#\s*(RUN|RUN-SCRIPT|CHECK|EXPECT)\b')
MESSAGE = re.compile(r'(?:(?P<file>.+?):(?:(?P<line>\d+):(?P<column>\d+):)? )?(?P<kind>error|warning|lost): (?P<text>.*) \[(?P<name>[a-z0-9-]+)\]$')


@dataclass
class Run:
    command: str
    line: int                                    # of the RUN, from 0
    checks: list = field(default_factory=list)   # (kind, pattern, line)
    exit: int = None
    output: list = None                          # expected lines; None: not compared
    output_at: range = None                      # where they are in the test


@dataclass
class Expected:
    kind: str
    name: str
    text: str
    line: int          # None: any
    column: int        # None: any
    here: bool         # in the test itself, not in another file
    written_at: int


class Faulty(Exception):
    pass


def what_is_missing(options):
    """Names behind NEEDS that this build has not got."""
    missing = set()
    if not (options.wrlkit.parent / 'python/wrlkit/__main__.py').exists():
        missing.add('python')
    if not (options.wrlkit.parent / 'wrlkit_script').exists():
        missing.add('scripts')
    limited = [options.wrlkit, 'info', ROOT / 'tests/text/cli/inputs/box.wrl', '--memory', '8G']
    if subprocess.run(limited, capture_output=True, check=False).returncode != 0:
        missing.add('memory-limit')
    return missing


def needs(path):
    return set(re.findall(r'^# NEEDS: (\S+)$', path.read_text(encoding='utf-8'), re.MULTILINE))


def parse(lines, folder):
    """The RUNs and expected messages of a test."""
    runs, expected = [], []
    for i, line in enumerate(lines):
        if found := DIRECTIVE.search(line):
            add_directive(runs, *found.groups(), i, folder)
        elif found := EXPECT.search(line):
            expected.append(expectation(*found.groups(), i))
        elif found := OUTPUT.match(line):
            add_output(runs, found, i)
        elif NEARLY.search(line):
            raise Faulty(f'line {i + 1} looks like a directive, but is none: {line.strip()}')
    if not runs:
        raise Faulty('there is no RUN')
    if not expected and all(r.output is None and not r.checks and r.exit is None for r in runs):
        raise Faulty('nothing is checked')
    return runs, expected


def add_directive(runs, kind, text, i, folder):
    if kind == 'RUN' and len(text) > LONGEST_RUN:
        raise Faulty(f'line {i + 1}: a RUN of {len(text)} characters; from {LONGEST_RUN} on it has to be a RUN-SCRIPT')
    if kind == 'RUN':
        return runs.append(Run(text, i))
    if kind == 'RUN-SCRIPT':
        return runs.append(Run((folder / text).read_text(encoding='utf-8'), i))
    if not runs:
        raise Faulty(f'line {i + 1}: no RUN stands above it')
    if kind == 'EXPECT-EXIT':
        runs[-1].exit = int(text)
    else:
        runs[-1].checks.append((kind, text, i))


def expectation(kind, at, column, name, text, i):
    if at is None or at[0] in '+-':
        line, here = i + 1 + int(at or 0), True
    else:
        line, here = None if at == '*' else int(at), False
    return Expected(kind.lower(), name, text, line, column and int(column), here, i)


def add_output(runs, found, i):
    if not runs:
        raise Faulty(f'line {i + 1}: no RUN stands above it')
    run = runs[-1]
    if run.output is None:
        run.output, run.output_at = [], range(i, i)
    if i != run.output_at.stop:
        raise Faulty(f'line {i + 1}: the output of one RUN stands in two places')
    run.output_at = range(run.output_at.start, i + 1)
    if found[0] != '# OUTPUT':
        run.output.append(found[1] or '')


def execute(run, variables, options):
    """Exit code, output and error output; names of files in them as the test writes them."""
    command = re.sub(r'%[sSt]\b', lambda v: variables[v[0]], run.command)
    env = dict(os.environ, PATH=f'{options.wrlkit.parent}:{os.environ["PATH"]}', LC_ALL='C.UTF-8')
    process = subprocess.Popen(['bash', '-o', 'pipefail', '-c', command], cwd=ROOT, env=env, stdin=subprocess.DEVNULL,
                               stdout=subprocess.PIPE, stderr=subprocess.PIPE, start_new_session=True)
    try:
        streams = process.communicate(timeout=options.timeout)
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        process.communicate()
        raise Faulty(f'takes longer than {options.timeout} s: {command}')
    texts = [s.decode('utf-8', 'backslashreplace') for s in streams]
    for name in '%t', '%s':
        texts = [t.replace(variables[name], name) for t in texts]
    if process.returncode < 0 or process.returncode >= 128 or 'Sanitizer' in texts[1] or 'runtime error:' in texts[1]:
        raise Faulty(f'crashes ({process.returncode}): {command}\n{texts[1][:4000]}')
    return process.returncode, *texts


def matches(pattern, line):
    parts = re.split(r'\{\{(.*?)\}\}', pattern)
    text = ''.join(p if i % 2 else r'\s+'.join(map(re.escape, p.split(' '))) for i, p in enumerate(parts))
    return re.search(text, line)


def check_lines(run, lines):
    """The first CHECK that fails, in words; none: empty."""
    at, forbidden = 0, []
    for kind, pattern, i in run.checks + [('END', '', run.line)]:
        if kind == 'CHECK-NOT':
            forbidden.append((pattern, i))
            continue
        if kind == 'END':
            found = len(lines)
        elif kind == 'CHECK-NEXT':
            found = at if at < len(lines) and matches(pattern, lines[at]) else None
        else:
            found = next((k for k in range(at, len(lines)) if matches(pattern, lines[k])), None)
        if found is None:
            below = '\n'.join('    ' + line for line in lines[at:at + 8]) or '    (nothing)'
            return f'line {i + 1}: no line with: {pattern}\n  the output from there on:\n{below}'
        for unwanted, j in forbidden:
            if bad := next((line for line in lines[at:found] if matches(unwanted, line)), None):
                return f'line {j + 1}: there should be no line with: {unwanted}\n    {bad}'
        at, forbidden = found + 1, []
    return ''


def messages(text):
    return [m for m in map(MESSAGE.match, text.splitlines()) if m]


def satisfies(message, expected):
    if (message['kind'], message['name']) != (expected.kind, expected.name) or expected.text not in message['text']:
        return False
    if expected.here and message['file'] != '%s':
        return False
    return (expected.line in (None, int(message['line'] or 0))) and (expected.column in (None, int(message['column'] or 0)))


def check_messages(text, expected):
    found = list({m[0]: m for m in messages(text)}.values())
    for m in found:
        if not any(satisfies(m, e) for e in expected):
            yield f'unexpected message: {m[0]}'
    for e in expected:
        fitting = [m for m in found if satisfies(m, e)]
        alike = [other for other in expected if (other.kind, other.name, other.line, other.here) == (e.kind, e.name, e.line, e.here)]
        if e.line is not None and len(fitting) > len(alike):
            yield f'line {e.written_at + 1}: {len(fitting)} messages where {len(alike)} are expected: [{e.name}]'
    for e in expected:
        if not any(satisfies(m, e) for m in found):
            yield f'line {e.written_at + 1}: expected but not reported: {e.kind} [{e.name}] {e.text}'


def said_again(run, text):
    """Messages that one command says twice, with the same words of the same place."""
    commands = len(re.findall(r'\bwrlkit\b', run.command))
    if re.search(r'\b(for|while|xargs)\b', run.command):
        return
    for line, n in Counter(m[0] for m in messages(text)).items():
        if n > max(commands, 1):
            yield f'said {n} times by {commands} commands: {line}'


def updated(lines, runs, outputs):
    """The test with the outputs that there were in place of those it has."""
    lines = list(lines)
    for run, output in reversed(list(zip(runs, outputs))):
        if run.output is not None:
            lines[run.output_at.start:run.output_at.stop] = [f'# | {line}'.rstrip() for line in output] or ['# OUTPUT']
    return lines


def check_run(run, code, lines, fails):
    if run.exit is not None and code != run.exit or run.exit is None and code != (1 if fails else 0):
        yield f'line {run.line + 1}: exit code {code}'
    if run.output is not None and run.output != [line.rstrip() for line in lines]:
        yield '\n'.join(difflib.unified_diff(run.output, lines, 'expected', 'found', lineterm=''))
    if fault := check_lines(run, lines):
        yield fault


def run_test(path, options):
    """What is wrong, as a list of texts."""
    text = path.read_text(encoding='utf-8')
    with tempfile.TemporaryDirectory(prefix='check_') as folder:
        name = path.relative_to(ROOT).as_posix() if path.is_relative_to(ROOT) else str(path)
        variables = {'%s': name, '%S': os.path.dirname(name), '%t': folder + '/t'}
        try:
            lines = text.split('\n')
            runs, expected = parse(lines, path.parent)
            faults, outputs, errors = [], [], ''
            fails = any(e.kind == 'error' for e in expected)
            for run in runs:
                code, output, error = execute(run, variables, options)
                outputs.append(output.split('\n')[:-1] if output.endswith('\n') else output.split('\n') if output else [])
                errors += error
                faults += [*check_run(run, code, outputs[-1], fails), *said_again(run, error)]
            message_faults = [*check_messages(errors, expected)]
        except Faulty as fault:
            return [str(fault)]
    if options.update and (new := '\n'.join(updated(lines, runs, outputs))) != text:
        path.write_text(new, encoding='utf-8')
        print(f'updated {name}')
        return message_faults
    faults += message_faults
    if faults and errors:
        faults.append('error output:\n' + errors[:4000].rstrip())
    return faults


def tests_below(paths):
    for path in map(Path, paths):
        if path.is_file():
            yield path.resolve()
        elif path.is_dir():
            yield from (p for end in ('wrl', 'x3d', 'x3dv', 'test') for p in path.resolve().rglob(f'*.{end}') if 'inputs' not in p.parts)
        else:
            sys.exit(f'check: there is no {path}')


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('tests', nargs='+', help='tests and folders of them; folders named inputs hold none')
    parser.add_argument('--wrlkit', type=Path, default=ROOT / 'build/release/wrlkit', help='the program')
    parser.add_argument('--update', action='store_true', help='write the output into the tests that have some')
    parser.add_argument('--jobs', type=int, default=os.cpu_count(), help='tests at a time')
    parser.add_argument('--timeout', type=float, default=60, help='seconds a command may take')
    options = parser.parse_args()
    options.wrlkit = options.wrlkit.resolve()
    if not options.wrlkit.is_file():
        sys.exit(f'check: there is no program {options.wrlkit}')
    below = sorted(set(tests_below(options.tests)))
    if not below:
        sys.exit('check: there are no tests')
    missing = what_is_missing(options)
    tests = [t for t in below if not needs(t) & missing]
    if len(tests) < len(below):
        print(f'{len(below) - len(tests)} tests are left out, for there is no {" and no ".join(sorted(missing))}')
    with ThreadPoolExecutor(options.jobs) as pool:
        results = list(pool.map(lambda t: run_test(t, options), tests))
    failed = [(t, faults) for t, faults in zip(tests, results) if faults]
    for test, faults in failed:
        print(f'FAILED {os.path.relpath(test, ROOT)}')
        for fault in faults:
            print('  ' + fault.replace('\n', '\n  '))
    print(f'{len(tests) - len(failed)} of {len(tests)} tests passed')
    return 1 if failed else 0


if __name__ == '__main__':
    sys.exit(main())
