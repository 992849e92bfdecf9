#!/usr/bin/env python3
"""Quality of edge collapse: RMS distance of the levels of every mesh of a folder from the original, as a multiple of what
CGAL's Lindstrom-Turk leaves with as many triangles; then how much of the creases and borders is kept, and how many edges are
folded (their faces' normals more than 150 degrees apart), ours and CGAL's.

  simplify_quality.py BENCH MESHDIST CGAL MESHES WORK [criterion] [mesh,mesh]

BENCH is simplify_bench. MESHDIST prints a line with `rms=`, `crease_recall=` and so on for `MESHDIST REFERENCE TEST SAMPLES`; CGAL
writes a level for `CGAL IN.ply OUT.ply RATIO lt`. What CGAL gives is measured once and kept in WORK/cgal.json. Without the
meshes this says so."""
import array, json, math, pathlib, re, subprocess, sys

ratios = ['0.5', '0.25', '0.1', '0.05', '0.01']
floor = 2e-6  # of the diagonal; below, single precision is measured
samples = '200000'


def run(*command):
    return subprocess.run([str(c) for c in command], check=True, capture_output=True, text=True).stdout


def folds(level):
    """Edges of two faces of one winding that look in nearly opposite directions, of a binary PLY of triangles."""
    data = level.read_bytes()
    at = data.index(b'end_header\n') + len(b'end_header\n')
    n_vertices, n_faces = (int(re.search(rf'element {e} (\d+)', data[:at].decode())[1]) for e in ('vertex', 'face'))
    p = array.array('f', data[at : at + 12 * n_vertices])
    first, count = {}, 0
    for f in range(n_faces):
        begin = at + 12 * n_vertices + 13 * f + 1
        t = array.array('I', data[begin : begin + 12])
        a, b, c = (p[3 * v : 3 * v + 3] for v in t)
        u, v = [b[k] - a[k] for k in range(3)], [c[k] - a[k] for k in range(3)]
        n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
        length = math.hypot(*n) or 1
        n = [x / length for x in n]
        for k in range(3):
            edge = (t[k], t[(k + 1) % 3])
            other = first.pop(edge[::-1], None)
            if other is None:
                first[edge] = n
            else:
                count += sum(x * y for x, y in zip(n, other)) < -0.866
    return count


def measured(meshdist, reference, level):
    out = run(meshdist, reference, level, samples)
    keys = ('rms', 'max', 'faces', 'ndev', 'flip', 'crease_recall', 'border_recall')
    return {k: float(re.search(rf'\b{k}=(\S+)', out)[1]) for k in keys} | {'folds': folds(level)}


def row(mesh, cells):
    print(f'| {mesh} | ' + ' | '.join(cells) + ' |', flush=True)


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
    logs, features = [], []
    print('| mesh | ' + ' | '.join(f'{float(r):.0%}' for r in ratios) + ' | mean |\n|---' + '|---' * (len(ratios) + 1) + '|')
    for path in sorted(pathlib.Path(meshes).glob('*.wrl.gz')):
        mesh = path.name.removesuffix('.wrl.gz')
        if wanted and mesh not in wanted:
            continue
        original = work / f'{mesh}_1.ply'
        if not original.exists():
            run(bench, 'levels', path, work / mesh, 'lindstrom-turk', '1')
        run(bench, 'levels', path, work / f'{mesh}_{criterion}', criterion, ','.join(ratios))
        distances, pairs = [], []
        for r in ratios:
            key = f'{mesh} {r}'
            if 'folds' not in reference.get(key, {}):
                run(cgal, original, work / 'cgal.ply', r, 'lt')
                reference[key] = measured(meshdist, original, work / 'cgal.ply')
                kept.write_text(json.dumps(reference, indent=1))
            ours, theirs = measured(meshdist, original, work / f'{mesh}_{criterion}_{r}.ply'), reference[key]
            mark = '' if ours['faces'] <= 1.01 * theirs['faces'] + 2 else f' ({ours["faces"]:.0f}:{theirs["faces"]:.0f})'
            distances.append((max(ours['rms'], floor) / max(theirs['rms'], floor), mark))
            pairs.append((ours, theirs))
        mean = math.exp(sum(math.log(q) for q, _ in distances) / len(distances))
        logs.append(math.log(mean))
        row(mesh, [f'{q:.2f}{m}' for q, m in distances] + [f'{mean:.3f}'])
        features.append((mesh, pairs))
    print(f'geometric mean over the meshes: {math.exp(sum(logs) / len(logs)):.3f}')
    for title, key, form in (('creases', 'crease_recall', '.1f'), ('borders', 'border_recall', '.1f'), ('folds', 'folds', '.0f')):
        print(f'\n{title}, ours / CGAL\n')
        for mesh, pairs in features:
            if pairs[0][0][key] >= 0:
                row(mesh, [f'{ours[key]:{form}} / {theirs[key]:{form}}' for ours, theirs in pairs])


main()
