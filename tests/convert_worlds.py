#!/usr/bin/env python3
"""Converts every world of a corpus to glTF once, by `wrlkit corpus run`; the tests that judge glTF read the results.

  tests/convert_worlds.py --wrlkit build/release/wrlkit --to FOLDER [--found] [--names REGEX] [--largest BYTES]
      [--pipeline TEXT | --profile NAME]

Worlds are those of corpus/, with --found those of ../shared/corpus (or WRLKIT_SHARED); its damaged ones, too. --profile: as
`wrlkit optimize` makes them. Fails when a worker crashed or ran out of time or memory, when a world that is not damaged is not
read, or when less than everything was made and no message says why. What was made of which world is in
FOLDER/.wrlkit/journal-1-of-1.jsonl.
"""
import argparse, csv, json, math, os, re, shutil, subprocess, sys

project = os.path.abspath(os.path.join(os.path.dirname(__file__), '..'))
shared = os.path.abspath(os.path.join(os.environ.get('WRLKIT_SHARED', os.path.join(project, '..', 'shared')), 'corpus'))
formats = [f + gz for f in ('vrml97', 'vrml1', 'x3d', 'x3dv') for gz in ('', ' gz')]


def own():
    corpus = os.path.join(project, 'corpus')
    for folder, _, names in os.walk(corpus):
        yield from (os.path.join(folder, n) for n in names if n.endswith(('.wrl', '.x3d')))


def found():
    with open(os.path.join(shared, 'MANIFEST.tsv'), newline='') as f:
        for row in csv.DictReader(f, delimiter='\t'):
            damaged = row['path'].startswith('broken/') and not row['format'].startswith('asset')
            if damaged or row['format'] in formats:
                yield os.path.join(shared, row['path'])


def recipe_of(options):
    pipeline, output = options.pipeline, '[output]\nformat = "glb"\n'
    if options.profile:
        told = subprocess.run([options.wrlkit, 'optimize', '--profile', options.profile, '--print-profile'], capture_output=True, text=True, check=True)
        pipeline = re.search(r'^  optimize runs (\S+)$', told.stdout, re.M)[1]
        output += f'profile = "{options.profile}"\n'
    return (f'pipeline = {json.dumps(pipeline)}\n' if pipeline else '') + output


def fault_of(job, broken):
    """What is wrong with how a world ended; None when nothing is."""
    state, severities = job['state'], {m['severity'] for m in job['messages']}
    if state not in ('made', 'made-partly') and not (broken and state == 'failed'):
        return f"{state}: {job.get('cause', '')}"
    if state != 'made' and 'error' not in severities:
        return f'{state} without a message'
    return None


def main():
    p = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument('--wrlkit', required=True)
    p.add_argument('--to', required=True)
    p.add_argument('--found', action='store_true')
    p.add_argument('--names', default='')
    p.add_argument('--largest', type=float, default=math.inf)
    p.add_argument('--pipeline')
    p.add_argument('--profile')
    a = p.parse_args()
    shutil.rmtree(a.to, ignore_errors=True)
    if a.found and not os.path.isdir(shared):
        print(f'skipped: there is no {shared}')
        return 77
    base = shared if a.found else os.path.join(project, 'corpus')
    os.makedirs(a.to)
    recipe = os.path.join(a.to, 'recipe.toml')
    with open(recipe, 'w') as f:
        f.write(recipe_of(a))
    worlds = sorted(w for w in (found() if a.found else own()) if re.search(a.names, os.path.relpath(w, base)) and os.path.getsize(w) <= a.largest)
    subprocess.run([a.wrlkit, 'corpus', 'run', recipe, '-', '-q', '-o', a.to, '--base', base, '--allow-path', base, '--timeout', '60s'],
                   input='\n'.join(worlds), text=True, stderr=subprocess.DEVNULL)
    with open(os.path.join(a.to, '.wrlkit', 'journal-1-of-1.jsonl')) as f:
        jobs = {job['input']: job for job in map(json.loads, f)}
    faults = [(w, 'not in the journal' if w not in jobs else fault_of(jobs[w], '/broken/' in w)) for w in worlds]
    faults = [(w, why) for w, why in faults if why]
    for world, why in faults:
        print(f'{world}: {why}')
    print(f'{len(worlds)} worlds, {sum(job["state"] != "failed" for job in jobs.values())} of them converted, {len(faults)} faults')
    return bool(faults) or not worlds


sys.exit(main())
