#!/usr/bin/env python3
"""Quality of edge collapse: RMS distance of the levels of every mesh of a folder from the original, as a multiple of what
CGAL's Lindstrom-Turk leaves with as many triangles.

  simplify_quality.py BENCH MESHDIST CGAL MESHES WORK [criterion] [mesh,mesh]

BENCH is simplify_bench. MESHDIST prints a line with `rms=` for `MESHDIST REFERENCE TEST SAMPLES`; CGAL writes a level for
`CGAL IN.ply OUT.ply RATIO lt`. What CGAL gives is measured once and kept in WORK/cgal.json. Without the meshes this says so."""
import json, math, pathlib, re, subprocess, sys

ratios = ['0.5', '0.25', '0.1', '0.05', '0.01']
floor = 2e-6  # of the diagonal; below, single precision is measured
samples = '200000'


def run(*command):
    return subprocess.run([str(c) for c in command], check=True, capture_output=True, text=True).stdout


def rms(meshdist, reference, level):
    out = run(meshdist, reference, level, samples)
    return {k: float(re.search(rf'\b{k}=(\S+)', out)[1]) for k in ('rms', 'max', 'faces', 'ndev', 'flip')}


def main():
    if len(sys.argv) < 6 or not pathlib.Path(sys.argv[4]).is_dir():
        print('skipped: no meshes', file=sys.stderr)
        return
    bench, meshdist, cgal, meshes, work = sys.argv[1:6]
    criterion = sys.argv[6] if len(sys.argv) > 6 else 'lindstrom-turk'
    work = pathlib.Path(work)
    work.mkdir(exist_ok=True)
    kept = work / 'cgal.json'
    reference = json.loads(kept.read_text()) if kept.exists() else {}
    wanted = sys.argv[7].split(',') if len(sys.argv) > 7 else []
    logs = []
    print('| mesh | ' + ' | '.join(f'{float(r):.0%}' for r in ratios) + ' | mean |\n|---' + '|---' * (len(ratios) + 1) + '|')
    for path in sorted(pathlib.Path(meshes).glob('*.wrl.gz')):
        mesh = path.name.removesuffix('.wrl.gz')
        if wanted and mesh not in wanted:
            continue
        original = work / f'{mesh}_1.ply'
        if not original.exists():
            run(bench, 'levels', path, work / mesh, 'lindstrom-turk', '1')
        run(bench, 'levels', path, work / f'{mesh}_{criterion}', criterion, ','.join(ratios))
        row = []
        for r in ratios:
            key = f'{mesh} {r}'
            if key not in reference:
                run(cgal, original, work / 'cgal.ply', r, 'lt')
                reference[key] = rms(meshdist, original, work / 'cgal.ply')
                kept.write_text(json.dumps(reference, indent=1))
            ours = rms(meshdist, original, work / f'{mesh}_{criterion}_{r}.ply')
            row.append(max(ours['rms'], floor) / max(reference[key]['rms'], floor))
            mark = '' if ours['faces'] <= 1.01 * reference[key]['faces'] + 2 else f' ({ours["faces"]:.0f}:{reference[key]["faces"]:.0f})'
            row[-1] = (row[-1], mark)
        mean = math.exp(sum(math.log(q) for q, _ in row) / len(row))
        logs.append(math.log(mean))
        print(f'| {mesh} | ' + ' | '.join(f'{q:.2f}{m}' for q, m in row) + f' | {mean:.3f} |', flush=True)
    print(f'geometric mean over the meshes: {math.exp(sum(logs) / len(logs)):.3f}')


main()
