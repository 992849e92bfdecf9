#!/usr/bin/env python3
"""Whole processes on generated plants: CPU seconds, MB a CPU second and peak memory, against the floor and the peers that
are installed, all in one run, one after another, the median of several.

  bench/whole_process.py WRLKIT OUT_DIR [--sizes 1M,10M,100M] [--runs 5]

Needs ../shared/bench (the plant generator and the floor program). Peers: assimp, when it is on the PATH.
"""
import argparse, json, os, shutil, statistics, subprocess, sys

here = os.path.dirname(os.path.abspath(__file__))
shared = os.environ.get('WRLKIT_SHARED', os.path.join(here, '..', '..', 'shared'))


def measure(command, runs):
    """Median CPU seconds and largest peak of `runs` runs, after one that is not counted."""
    cpu, peak = [], 0
    for i in range(runs + 1):
        pid = os.spawnvp(os.P_NOWAIT, 'sh', ['sh', '-c', 'exec "$@" >/dev/null 2>&1', 'sh', *command])
        _, status, usage = os.wait4(pid, 0)
        if os.waitstatus_to_exitcode(status) not in (0, 1):
            return None
        if i:
            cpu.append(usage.ru_utime + usage.ru_stime)
            peak = max(peak, usage.ru_maxrss / 1024)
    return statistics.median(cpu), peak


def plant(out, size, kind):
    path = os.path.join(out, f'plant_{size}{"_" + kind if kind else ""}.wrl')
    if not os.path.exists(path):
        options = [f'--{kind}'] if kind else []
        subprocess.run([sys.executable, os.path.join(shared, 'bench', 'gen_plant.py'), path, '--size', size, *options],
                       check=True, stdout=subprocess.DEVNULL)
    return path


def floor_program(out):
    program = os.path.join(out, 'floor')
    if not os.path.exists(program):
        subprocess.run(['g++', '-O3', '-march=native', '-std=c++20', os.path.join(shared, 'bench', 'src', 'floor.cpp'),
                        '-o', program], check=True)
    return program


def main():
    p = argparse.ArgumentParser()
    p.add_argument('wrlkit')
    p.add_argument('out')
    p.add_argument('--sizes', default='1M,10M,100M')
    p.add_argument('--kinds', default=',explode')
    p.add_argument('--runs', type=int, default=5)
    a = p.parse_args()
    if not os.path.exists(os.path.join(shared, 'bench', 'gen_plant.py')):
        return print('skipped: ../shared/bench is not there')
    os.makedirs(a.out, exist_ok=True)
    floor = floor_program(a.out)
    print('| file | MB | command | CPU s | MB per CPU s | of the floor | peak MB | times the file |\n|---|---|---|---|---|---|---|---|')
    for kind in a.kinds.split(','):
        for size in a.sizes.split(','):
            path = plant(a.out, size, kind)
            mb = os.path.getsize(path) / 1e6
            glb = os.path.join(a.out, 'out.glb')
            commands = [('floor (fast_float, stored)', [floor, 'floats_store', path]),
                        ('wrlkit parse', [a.wrlkit, 'check', '--parse-only', '-q', path]),
                        ('wrlkit convert to glb', [a.wrlkit, 'convert', '-q', path, glb]),
                        ('wrlkit cat', [a.wrlkit, 'cat', '-q', path])]
            if shutil.which('assimp') and mb < 15:
                commands.append(('assimp export to glb', ['assimp', 'export', path, glb]))
            base = None
            for name, command in commands:
                result = measure(command, a.runs)
                if result is None:
                    print(f'| {os.path.basename(path)} | {mb:.1f} | {name} | failed | | | | |')
                    continue
                cpu, peak = result
                base = base or cpu
                print(f'| {os.path.basename(path)} | {mb:.1f} | {name} | {cpu:.3f} | {mb / cpu:.0f} | {base / cpu:.2f} | {peak:.0f} | {peak / mb:.1f} |', flush=True)


if __name__ == "__main__":
    main()
