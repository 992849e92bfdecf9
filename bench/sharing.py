#!/usr/bin/env python3
"""What sharing and merging bring: draw calls, nodes, meshes and bytes before and after, how far surfaces moved, CPU seconds.

  bench/sharing.py build/release/wrlkit [--timeout 120] FILE-OR-FOLDER...

Each world goes to VRML by `dedup`, by `dedup,instance`, and to glTF by `merge{max-draws=500}`. After each `diff` says which names are missing
and how far the surfaces are from where they were, in metres. Seconds are those of the process (user and system).
"""
import argparse
import json
from pathlib import Path
import re
import resource
import subprocess
import sys
import tempfile

RUNS = [('dedup', 'dedup', 'wrl'), ('instance', 'dedup,instance', 'wrl'), ('merge', 'merge{max-draws=500}', 'glb')]


def run(command, timeout):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    try:
        done = subprocess.run(command, capture_output=True, text=True, errors='replace', timeout=timeout)
    except subprocess.TimeoutExpired:
        return None, timeout
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return done, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def figures(text, name):
    return {k: int(n) for n, k in re.findall(rf'(\d+)  {name}\.(\S+)', text)}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('wrlkit')
    parser.add_argument('--timeout', type=int, default=120)
    parser.add_argument('--no-diff', action='store_true', help='of large worlds')
    parser.add_argument('worlds', nargs='+', type=Path)
    args = parser.parse_args()
    worlds = [f for w in args.worlds for f in (sorted(p for p in w.rglob('*') if p.suffix in ('.wrl', '.wrz')) if w.is_dir() else [w])]
    total, bad = {}, 0
    with tempfile.TemporaryDirectory() as folder:
        for world in worlds:
            for name, passes, kind in RUNS:
                plain, out = (Path(folder) / f'{n}.{kind}' for n in ('plain', 'out'))
                first = 'inline,expand-protos' if kind == 'wrl' else ''
                run([args.wrlkit, 'convert', world, plain, *(['-p', first] if first else [])], args.timeout)
                done, seconds = run([args.wrlkit, 'convert', world, out, '-p', ','.join(p for p in (first, passes) if p), '--stats'], args.timeout)
                if done is None or done.returncode not in (0, 1) or not out.exists():
                    if done is None or done.returncode != 3:
                        bad += 1
                        print(f'{world}: {name}: {"timeout" if done is None else f"exit code {done.returncode}"}')
                    continue
                f = figures(done.stderr, name)
                if not f:
                    continue
                bytes_before, bytes_after = plain.stat().st_size, out.stat().st_size
                moved, missing = '', ''
                if not args.no_diff:
                    diff, _ = run([args.wrlkit, 'diff', plain, out, '--json'], args.timeout)
                    try:
                        report = json.loads(diff.stdout)
                        moved, missing = f"{report['surface']['max']:.2g} m", len(report['names']['missing'])
                    except (AttributeError, ValueError, KeyError):
                        moved = 'no diff'
                print(f"{name:9} draws {f['draws-before']:6} {f['draws-after']:6}  nodes {f['nodes-before']:7} {f['nodes-after']:7}  meshes {f['meshes-before']:6} {f['meshes-after']:6}  "
                      f'bytes {bytes_before:10} {bytes_after:10}  {seconds:6.2f} s  {moved:10} {missing:>3}  {world.name}', flush=True)
                sums = total.setdefault(name, [0] * 9)
                for i, v in enumerate((1, f['draws-before'], f['draws-after'], f['nodes-before'], f['nodes-after'], f['meshes-before'], f['meshes-after'], bytes_before, bytes_after)):
                    sums[i] += v
    for name, s in total.items():
        print(f'{name}: {s[0]} worlds changed, draws {s[1]} -> {s[2]}, nodes {s[3]} -> {s[4]}, meshes {s[5]} -> {s[6]}, bytes {s[7]} -> {s[8]}')
    return 1 if bad else 0


if __name__ == '__main__':
    sys.exit(main())
