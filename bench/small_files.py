#!/usr/bin/env python3
"""Bytes and CPU seconds of small glTF: `wrlkit optimize` from VRML, gltfpack from the plain glb that wrlkit makes of it.

  bench/small_files.py WRLKIT OUT_DIR [--sizes 1.4M,10M] [--runs 3]

Needs ../shared/bench (the plant generator); GLTFPACK names gltfpack's cli.js (npm), which is left out without it.
"""
import argparse, os, subprocess, sys

from whole_process import measure, shared


def main():
    p = argparse.ArgumentParser()
    p.add_argument('wrlkit')
    p.add_argument('out')
    p.add_argument('--sizes', default='1.4M,10M')
    p.add_argument('--runs', type=int, default=3)
    a = p.parse_args()
    if not os.path.exists(os.path.join(shared, 'bench', 'gen_plant.py')):
        return print('skipped: ../shared/bench is not there')
    os.makedirs(a.out, exist_ok=True)
    gltfpack = os.environ.get('GLTFPACK')
    print('| plant | step | bytes | CPU s |\n|---|---|---|---|')
    for size in a.sizes.split(','):
        path = lambda name: os.path.join(a.out, f'small_{size}{name}')
        if not os.path.exists(path('.wrl')):
            subprocess.run([sys.executable, os.path.join(shared, 'bench', 'gen_plant.py'), path('.wrl'), '--size', size], check=True, stdout=subprocess.DEVNULL)
        steps = [('convert', path('.glb'), [a.wrlkit, 'convert', '-q', path('.wrl'), path('.glb')])]
        steps += [(f'optimize --compress {c}', path(f'_{c}.glb'), [a.wrlkit, 'optimize', '-q', path('.wrl'), path(f'_{c}.glb'), '--tolerance', '1mm', '--compress', c]) for c in ('meshopt', 'draco')]
        if gltfpack:
            steps += [(f'gltfpack {" ".join(f)}', path('_pack.glb'), ['node', gltfpack, *f, '-i', path('.glb'), '-o', path('_pack.glb')]) for f in (['-cc'], ['-cc', '-kn', '-km'])]
        for name, made, command in steps:
            result = measure(command, a.runs)
            print(f'| {size} | {name} | {os.path.getsize(made)} | {result[0]:.3f} |' if result else f'| {size} | {name} | failed | |', flush=True)


if __name__ == "__main__":
    main()
