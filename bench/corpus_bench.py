#!/usr/bin/env python3
"""Figures of corpus run, beyond what ctest has the time for.

  bench/corpus_bench.py WRLKIT kill IN [RECIPE]     an undisturbed run with one job; another, killed at three random moments and resumed, with two:
                                                    the same bytes? nothing done twice? and what the workers used of the cores
  bench/corpus_bench.py WRLKIT scale [N ...]        planning, a run, a resumed run and a report of N small files (10000, 100000): seconds and peak memory,
                                                    which must grow as N does; the files are in a temporary folder, 200 bytes each
  bench/corpus_bench.py WRLKIT overhead IN          what a file costs on top of its conversion: the run against the sum of what its workers used; and how much of
                                                    the time as many workers as there are cores were there, which others on the machine do not change
"""
import hashlib, json, os, pathlib, random, resource, signal, subprocess, sys, tempfile, time

WRLKIT = sys.argv[1] if len(sys.argv) > 1 else ''
ROOT = pathlib.Path(__file__).resolve().parents[1]


def run(*words, **more):
    """Exit code, wall clock and processor seconds, and peak memory in MB of the process and of the largest of its workers."""
    start = time.time()
    process = subprocess.Popen([WRLKIT, *map(str, words)], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, **more)
    _, status, usage = os.wait4(process.pid, 0)
    return os.waitstatus_to_exitcode(status), time.time() - start, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def tree(folder):
    return {str(p.relative_to(folder)): hashlib.sha256(p.read_bytes()).hexdigest() for p in sorted(folder.rglob('*')) if p.is_file() and '.wrlkit' not in p.parts}


def journal(folder):
    lines = []
    for path in sorted((folder / '.wrlkit').glob('journal-*')):
        for line in path.read_text().splitlines():
            try:
                lines.append(json.loads(line))
            except json.JSONDecodeError:
                pass
    return lines


def kill(worlds, recipe=ROOT / 'recipes/plant-web.toml'):
    with tempfile.TemporaryDirectory() as tmp:
        tmp = pathlib.Path(tmp)
        words = ('corpus', 'run', recipe, worlds, '--timeout', '5m')
        code, wall, cpu, _ = run(*words, '-o', tmp / 'whole', '--jobs', 1)
        whole, lines = tree(tmp / 'whole'), journal(tmp / 'whole')
        states = {s: sum(l['state'] == s for l in lines) for s in sorted({l['state'] for l in lines})}
        print(f'undisturbed, 1 job: exit code {code}, {len(lines)} files, {states}, {wall:.0f} s, {cpu:.0f} CPU s')
        for l in lines:
            if l['state'] not in ('made', 'made-partly'):
                print(f"  {l['state']:10} {l['input']}: {l.get('cause', '')[:150]}")
        rng = random.Random(time.time())
        for i in range(3):
            process = subprocess.Popen([WRLKIT, *map(str, words), '-o', str(tmp / 'killed'), '--jobs', '2'], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            enough = len(journal(tmp / 'killed')) + rng.randint(1, len(lines) // 4)
            while process.poll() is None and len(journal(tmp / 'killed')) < enough:
                time.sleep(0.05)
            process.send_signal(signal.SIGKILL)
            process.wait()
            part = tree(tmp / 'killed')
            half = [n for n, h in part.items() if whole.get(n) != h]
            print(f'killed with {len(part)} outputs there; not as in the undisturbed run: {half}')
        code, wall, cpu, _ = run(*words, '-o', tmp / 'killed', '--jobs', 2)
        again = journal(tmp / 'killed')
        print(f'resumed, 2 jobs: exit code {code}, {wall:.0f} s, {cpu:.0f} CPU s; the same bytes: {tree(tmp / "killed") == whole}; lines {len(again)}, files {len({l["output"] for l in again})}')


def scale(*sizes):
    print('     files    plan s   run s   CPU s   resume s   report s    MB: plan, run, resume, report')
    for n in [int(s) for s in sizes] or [10000, 100000]:
        with tempfile.TemporaryDirectory() as tmp:
            tmp = pathlib.Path(tmp)
            for i in range(n):
                path = tmp / 'in' / f'{i // 1000:03}' / f'{i:06}.wrl'
                if i % 1000 == 0:
                    path.parent.mkdir(parents=True)
                path.write_text(f'#VRML V2.0 utf8\nDEF Part_{i} Transform {{ translation {i} 0 0 children Shape {{ appearance Appearance {{ material Material {{ }} }} geometry Box {{ size 1 2 {i % 7 + 1} }} }} }}\n')
            words = (ROOT / 'recipes/plant-web.toml', tmp / 'in', '-o', tmp / 'out')
            plan, first, again = run('corpus', 'plan', *words), run('corpus', 'run', *words, '-q'), run('corpus', 'run', *words, '-q')
            report = run('corpus', 'report', tmp / 'out', '--looks', '0', '-q')
            assert (plan[0], first[0], again[0], report[0]) == (0, 0, 0, 0), (plan, first, again, report)
            print(f'{n:10} {plan[1]:9.2f} {first[1]:7.1f} {first[2]:7.1f} {again[1]:10.2f} {report[1]:10.2f}    {plan[3]:.0f}, {first[3]:.0f}, {again[3]:.0f}, {report[3]:.0f}')


def overhead(worlds):
    with tempfile.TemporaryDirectory() as tmp:
        tmp = pathlib.Path(tmp)
        cores = len(os.sched_getaffinity(0))
        code, wall, cpu, _ = run('corpus', 'run', ROOT / 'recipes/plant-web.toml', worlds, '-o', tmp / 'out', '--jobs', cores)
        lines = journal(tmp / 'out')
        sample = random.Random(1).sample([l['input'] for l in lines], min(100, len(lines)))
        used = resource.getrusage(resource.RUSAGE_CHILDREN)
        for path in sample:
            run('convert', path, tmp / 'one.glb', '--recipe', ROOT / 'recipes/plant-web.toml', '--jobs', '1')
        now = resource.getrusage(resource.RUSAGE_CHILDREN)
        loop = now.ru_utime + now.ru_stime - used.ru_utime - used.ru_stime
        in_run = sum(l['cpu'] for l in lines if l['input'] in set(sample))
        print(f'{len(lines)} files, {cores} jobs: {wall:.1f} s, {cpu:.1f} CPU s, {100 * cpu / wall / cores:.0f} % of the cores, with a worker for each {100 * sum(l["seconds"] for l in lines) / wall / cores:.0f} % of the time; of the run itself, next to its workers: {1000 * (cpu - sum(l["cpu"] for l in lines)) / len(lines):.2f} ms CPU a file')
        print(f'{len(sample)} of them by a shell loop over wrlkit convert: {1000 * loop / len(sample):.1f} ms CPU a file; in the run {1000 * in_run / len(sample):.1f} ms')


MODES = {'kill': kill, 'scale': scale, 'overhead': overhead}
if len(sys.argv) < 3 or sys.argv[2] not in MODES:
    sys.exit(__doc__)
MODES[sys.argv[2]](*sys.argv[3:])
