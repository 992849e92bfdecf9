#!/usr/bin/env python3
"""Compares `wrlkit info --json` with what independent readers found in the same files.

  tests/reference.py --wrlkit build/release/wrlkit [--at-least N] [-v]

Needs ../shared/corpus (or WRLKIT_SHARED): reference.tsv has triangles, lines, points and bounds per file and reader. A file
agrees when all of them are those of one reader. Fails when fewer than N files agree, or when a file cannot be read at all.
What the others are is in docs/conformance.md; -v prints them.
"""
import argparse, csv, json, os, subprocess, sys
from concurrent.futures import ThreadPoolExecutor

here = os.path.dirname(os.path.abspath(__file__))
corpus = os.path.join(os.environ.get('WRLKIT_SHARED', os.path.join(here, '..', '..', 'shared')), 'corpus')


def rows(name):
    with open(os.path.join(corpus, name), newline='') as f:
        yield from csv.DictReader(f, delimiter='\t')


def same_bounds(reference, bounds):
    if not reference['min']:
        return True
    if not bounds:
        return False
    low, high = ([float(x) for x in reference[k].split()] for k in ('min', 'max'))
    tolerance = 1e-4 * max(max(b - a for a, b in zip(low, high)), 1e-9)
    return all(abs(a - b) <= tolerance for a, b in zip(low + high, bounds['min'] + bounds['max']))


def agrees(reference, info):
    counts = all(int(reference[k] or 0) == info[k] for k in ('triangles', 'lines', 'points'))
    return counts and same_bounds(reference, info['bounds'])


def read(wrlkit, paths):
    """Of each file what is in it; nothing of those that cannot be read, and of all that come behind a crash."""
    r = subprocess.run([wrlkit, 'info', '-q', '--json', *(os.path.join(corpus, path) for path in paths)], capture_output=True, timeout=300)
    document = json.loads(r.stdout or '[]')  # an object where there is one file
    found = {info['file']: info for info in (document if isinstance(document, list) else [document])}
    return [(path, found.get(os.path.join(corpus, path))) for path in paths]


def main():
    p = argparse.ArgumentParser()
    p.add_argument('--wrlkit', required=True)
    p.add_argument('--at-least', type=int, default=0)
    p.add_argument('-v', action='store_true')
    a = p.parse_args()
    if not os.path.isdir(corpus):
        print('skipped: ../shared/corpus is not there')
        sys.exit(77)
    references = {}
    for r in rows('reference.tsv'):
        if r['ok'] == '1':
            references.setdefault(r['path'], []).append(r)
    files = [r['path'] for r in rows('MANIFEST.tsv') if r['format'].startswith(('vrml97', 'vrml1', 'x3d')) and not r['path'].startswith('broken/')]
    compared = agreed = unread = 0
    some = 50  # files a process
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        results = pool.map(lambda i: read(a.wrlkit, files[i:i + some]), range(0, len(files), some))
        for path, info in (pair for pairs in results for pair in pairs):
            if info is None:
                unread += 1
                print(f'not read: {path}')
                continue
            if path not in references:
                continue
            compared += 1
            good = any(agrees(r, info) for r in references[path])
            agreed += good
            if not good and a.v:
                print(path, {k: info[k] for k in ('triangles', 'lines', 'points', 'bounds')})
                for r in references[path]:
                    print('   ', r['reader'], r['triangles'], r['lines'], r['points'], r['min'], r['max'])
    print(f'{agreed} of {compared} files agree with a reader exactly; {unread} could not be read')
    sys.exit(agreed < a.at_least or unread > 0)


main()
