#!/usr/bin/env python3
"""Whether two builds of wrlkit write the same bytes: every world of both corpora, to each format and through some pipelines.
What a refactoring has to leave alone; differences are listed, with the first message that differs.

  bench/same_bytes.py OLD NEW [--only REGEX] [--jobs N]     OLD, NEW: programs, or files that --keep wrote
  bench/same_bytes.py PROGRAM --keep FILE                   runs one program and keeps what it made
"""
import argparse, concurrent.futures, hashlib, json, os, pathlib, re, subprocess, sys, tempfile

root = pathlib.Path(__file__).resolve().parents[1]
ways = {
    'glb': ['out.glb'],
    'wrl': ['out.wrl'],
    'x3d': ['out.x3d'],
    'lod': ['out.glb', '-p', 'join,weld,lod'],
    'small': ['out.glb', '-p', 'dedup,instance,merge', '--compress', 'meshopt'],
    'world': ['out.wrl', '-p', 'weld,lod{scope=world}'],
    'light': ['out.glb', '-p', 'lightmap{quality=draft,density=1,max-size=64}'],
    'draco': ['out.glb', '-p', 'weld', '--compress', 'draco'],
    'dump': ['out.wrl', '-p', 'inline,expand-protos,prune,flatten,weld', '--dump'],
}


def worlds(only):
    endings = ('.wrl', '.wrz', '.gz', '.x3d', '.x3dv', '.x3dz', '.iv', '.gltf', '.glb', '.vrml')
    for folder in (root / 'corpus', root.parent / 'shared' / 'corpus'):
        for path in sorted(folder.rglob('*')):
            if path.is_file() and path.name.lower().endswith(endings) and (not only or re.search(only, str(path))):
                yield path


def convert(program, world, way, threads):
    with tempfile.TemporaryDirectory() as folder:
        out, *options = ways[way]
        command = [program, 'convert', str(world), out, *options, '-q', '--jobs', str(threads)]
        try:
            run = subprocess.run(command, capture_output=True, cwd=folder, timeout=300)
            code, said = run.returncode, run.stderr.decode(errors='replace')
        except subprocess.TimeoutExpired:
            code, said = 'timeout', ''
        made = hashlib.sha256()
        for path in sorted(pathlib.Path(folder).rglob('*')):
            if path.is_file():
                made.update(path.name.encode() + b'\0' + path.read_bytes())
        return {'code': code, 'bytes': made.hexdigest()[:20], 'said': said}


def results(program, only, jobs, threads):
    if program.endswith('.json'):
        return json.loads(pathlib.Path(program).read_text())
    program = os.path.abspath(program)
    jobs_to_run = [(world, way) for world in worlds(only) for way in ways]
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        made = pool.map(lambda t: convert(program, *t, threads), jobs_to_run)
        return {f'{os.path.relpath(world, root)} {way}': m for (world, way), m in zip(jobs_to_run, made)}


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument('programs', nargs='+')
    arguments.add_argument('--keep')
    arguments.add_argument('--only')
    arguments.add_argument('--jobs', type=int, default=os.cpu_count())
    arguments.add_argument('--threads', type=int, default=1, help='of each conversion')
    a = arguments.parse_args()
    made = [results(p, a.only, a.jobs, a.threads) for p in a.programs]
    if a.keep:
        pathlib.Path(a.keep).write_text(json.dumps(made[0]))
    if len(made) == 1:
        return print(len(made[0]), 'conversions')
    old, new = made
    other = [k for k in new if k in old and (old[k]['bytes'], old[k]['code']) != (new[k]['bytes'], new[k]['code'])]
    for k in other:
        print(f'{k}: other bytes (exit code {old[k]["code"]}, now {new[k]["code"]})')
    said = [k for k in new if k in old and old[k]['said'] != new[k]['said']]
    for k in said:
        before, after = old[k]['said'].splitlines(), new[k]['said'].splitlines()
        lines = [f'- {x}' for x in before if x not in after][:1] + [f'+ {x}' for x in after if x not in before][:1]
        print(f'{k}: other messages', *lines, sep='\n  ')
    print(f'{len(new)} conversions, {len(other)} with other bytes, {len(said)} with other messages')
    return bool(other)


sys.exit(main())
