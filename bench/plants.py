#!/usr/bin/env python3
"""Levels of worlds against the whole world as one soup through meshoptimizer: triangles drawn, distances, ratios.

  bench/plants.py PROGRAM --baseline FOLDER [--cache FOLDER] [--ratios 0.25,0.1,0.03] [--json OUT] WORLD...

FOLDER has soup.py and soup_baseline (soup_baseline.cpp, compiled): they write the triangles that a .glb draws, and what
meshopt_simplify and meshopt_simplifySloppy make of them. PROGRAM simplifies the same world (`simplify --ratios`); every
result is measured by PROGRAM's `diff`, two-sided, in metres. A ratio is what PROGRAM leaves of the smaller of the two
baseline distances. Baselines are kept in the cache, by the bytes of the world.
"""
import argparse
import hashlib
import json
import math
from pathlib import Path
import resource
import subprocess
import sys
import tempfile


def run(*command):
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True, errors='replace')
    if done.returncode > 1:
        sys.exit(f'{" ".join(map(str, command))}\n{done.stderr}')
    return done.stdout


def distance(program, world, level):
    found = json.loads(run(program, 'diff', '-q', '--json', world, level))
    return {'triangles': found['triangles'][1], 'rms': found['surface']['rms'], 'max': found['surface']['max']}


def baselines(args, world, ratios):
    key = hashlib.sha256(world.read_bytes()).hexdigest()[:16]
    args.cache.mkdir(parents=True, exist_ok=True)
    kept = args.cache / f'{key}.json'
    found = json.loads(kept.read_text()) if kept.exists() else {}
    missing = [r for r in ratios if r not in found]
    if missing:
        with tempfile.TemporaryDirectory() as folder:
            glb, soup, base = (Path(folder) / n for n in ('world.glb', 'soup.bin', 'level'))
            run(args.program, 'convert', '-q', '--extras', 'none', world, glb)
            run(args.python, args.baseline / 'soup.py', glb, soup)
            run(args.baseline / 'soup_baseline', soup, base, *missing)
            for r in missing:
                found[r] = {kind: distance(args.program, world, f'{base}_{kind}_{r}.wrl') for kind in ('plain', 'sloppy')}
        kept.write_text(json.dumps(found))
    return found


def cpu_seconds():
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def levels(args, world, ratios):
    with tempfile.TemporaryDirectory() as folder:
        before = cpu_seconds()
        points = json.loads(run(args.program, 'simplify', '-q', '--json', world, '-o', folder, '--ratios', ','.join(ratios)))
        seconds = cpu_seconds() - before
        return [distance(args.program, world, p['file']) | {'said': p['rms']} for p in points['points']], seconds


def geometric_mean(values):
    return math.exp(sum(math.log(max(v, 1e-9)) for v in values) / len(values)) if values else float('nan')


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('program', type=Path)
    parser.add_argument('--baseline', type=Path, required=True)
    parser.add_argument('--cache', type=Path, default=Path(tempfile.gettempdir()) / 'plants-baseline')
    parser.add_argument('--python', default='/usr/bin/python3', help='one that has numpy, for soup.py')
    parser.add_argument('--ratios', default='0.25,0.1,0.03')
    parser.add_argument('--json', type=Path)
    parser.add_argument('worlds', nargs='+', type=Path)
    args = parser.parse_args()
    ratios = args.ratios.split(',')
    rows = []
    print(f'{"world":34} {"asked":>9} {"drawn":>9} {"rms mm":>9} {"best":>9} {"ratio":>6} {"max m":>8} {"best":>8} {"ratio":>6}')
    for world in args.worlds:
        drawn = json.loads(run(args.program, 'info', '-q', '--json', world))['triangles']
        found = baselines(args, world, ratios)
        made, seconds = levels(args, world, ratios)
        name = str(world)[-34:]
        for r in ratios:
            asked = int(float(r) * drawn)
            best = {k: min(found[r][kind][k] for kind in found[r]) for k in ('rms', 'max')}
            mine = next((m for m in made if m['triangles'] <= asked), None)
            if not mine:
                print(f'{name:34} {asked:9} not reached')
                rows.append({'world': str(world), 'ratio': r})
                continue
            row = {'world': str(world), 'ratio': r, 'asked': asked, **mine, 'baseline': found[r], 'seconds': seconds}
            for k in ('rms', 'max'):
                row[f'{k}_ratio'] = mine[k] / best[k] if best[k] > 0 else float(mine[k] > 0)
            rows.append(row)
            print(f'{name:34} {asked:9} {mine["triangles"]:9} {1000 * mine["rms"]:9.2f} {1000 * best["rms"]:9.2f} '
                  f'{row["rms_ratio"]:6.2f} {mine["max"]:8.3f} {best["max"]:8.3f} {row["max_ratio"]:6.2f}', flush=True)
        print(f'{"":34} {seconds:9.2f} CPU seconds', flush=True)
    for r in ratios:
        there = [row for row in rows if row['ratio'] == r and 'rms_ratio' in row]
        print(f'{r}: {len(there)} worlds, rms {geometric_mean([w["rms_ratio"] for w in there]):.3f} '
              f'(worst {max((w["rms_ratio"] for w in there), default=0):.2f}), '
              f'max {geometric_mean([w["max_ratio"] for w in there]):.3f}')
    if args.json:
        args.json.write_text(json.dumps(rows, indent=1))


if __name__ == '__main__':
    main()
