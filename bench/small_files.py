#!/usr/bin/env python3
"""Bytes, CPU seconds, names and deviation of small glTF: `wrlkit optimize` from VRML, gltfpack and glTF-Transform from the plain glb that
wrlkit makes of it (without extras: they would carry them along).

  bench/small_files.py WRLKIT OUT_DIR [--sizes 1.4M,10M] [--runs 3]       generated plants
  bench/small_files.py WRLKIT OUT_DIR --worlds FILE...                    worlds of your own, a row each

Needs ../shared/bench for plants (the generator). GLTFPACK names gltfpack's cli.js (npm: WebAssembly under Node.js, not the native program),
GLTF_TRANSFORM glTF-Transform's (@gltf-transform/cli); each is left out where it is not there.
"""
import argparse, json, os, subprocess, sys

from table.measure import SHARED, cost

GLTFPACK, TRANSFORM = os.environ.get('GLTFPACK'), os.environ.get('GLTF_TRANSFORM')


def steps_of(wrlkit, source, path):
    """(name, file, command) of everything that is compared; the peers read what the first step makes."""
    ours = lambda name, *options: (f'optimize{"".join(" " + o for o in options)}', path(f'_{name}.glb'), [wrlkit, 'optimize', '-q', source, path(f'_{name}.glb'), '--tolerance', '1mm', *options])
    steps = [('convert --extras none', path('.glb'), [wrlkit, 'convert', '-q', source, path('.glb'), '--extras', 'none'])]
    steps += [ours('three'), ours('cesium', '--profile', 'cesium'), ours('recognise', '--profile', 'cesium', '--recognise'), ours('draco', '--compress', 'draco')]
    if GLTFPACK:
        steps += [(f'gltfpack {" ".join(f)}', path('_pack.glb'), ['node', GLTFPACK, *f, '-i', path('.glb'), '-o', path('_pack.glb')]) for f in (['-cc'], ['-cc', '-kn', '-km'])]
    if TRANSFORM:
        steps += [('gltf-transform optimize, Draco', path('_transform.glb'), ['node', TRANSFORM, 'optimize', path('.glb'), path('_transform.glb'), '--compress', 'draco'])]
    return steps


def difference(wrlkit, source, made):
    """Names that are left of how many, and the largest distance of the surfaces in mm."""
    try:
        out = subprocess.run([wrlkit, 'diff', '-q', '--json', source, made], capture_output=True, text=True, timeout=600).stdout
        report = json.loads(out)
        return len(report['names']['missing']), report['surface']['max']
    except (ValueError, subprocess.TimeoutExpired):
        return None, None


def plants(a):
    print('| plant | step | bytes | CPU s |\n|---|---|---|---|')
    for size in a.sizes.split(','):
        path = lambda name: os.path.join(a.out, f'small_{size}{name}')
        if not os.path.exists(path('.wrl')):
            subprocess.run([sys.executable, SHARED / 'bench' / 'gen_plant.py', path('.wrl'), '--size', size], check=True, stdout=subprocess.DEVNULL)
        for name, made, command in steps_of(a.wrlkit, path('.wrl'), path):
            result = cost(command, a.runs)
            print(f'| {size} | {name} | {os.path.getsize(made)} | {result.cpu:.3f} |' if result else f'| {size} | {name} | failed | |', flush=True)


def worlds(a):
    """A cell has bytes, names missing, deviation and CPU seconds."""
    heads = None
    for source in a.worlds:
        path = lambda name: os.path.join(a.out, 'world' + name)
        cells = []
        steps = steps_of(a.wrlkit, source, path)
        if not heads:
            heads = [name for name, _, _ in steps[1:]]
            print('| world | ' + ' | '.join(heads) + ' |\n|---|' + '---|' * len(heads))
        for name, made, command in steps:
            if os.path.exists(made):
                os.remove(made)
            result = cost(command, a.runs)
            if name.startswith('convert'):
                continue
            if not result or not os.path.exists(made):
                cells.append('failed')
                continue
            missing, deviation = difference(a.wrlkit, source, made)
            far = '?' if deviation is None else 'inf' if deviation == float('inf') else f'{deviation * 1e3:.2g} mm'
            cells.append(f'{os.path.getsize(made)}; {missing}; {far}; {result.cpu:.2f} s')
        print(f'| {os.path.basename(os.path.dirname(source))}/{os.path.basename(source)} | ' + ' | '.join(cells) + ' |', flush=True)


def main():
    p = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument('wrlkit')
    p.add_argument('out')
    p.add_argument('--sizes', default='1.4M,10M')
    p.add_argument('--runs', type=int, default=3)
    p.add_argument('--worlds', nargs='*')
    a = p.parse_args()
    os.makedirs(a.out, exist_ok=True)
    if a.worlds:
        return worlds(a)
    if not (SHARED / 'bench' / 'gen_plant.py').exists():
        return print('skipped: ../shared/bench is not there')
    plants(a)


if __name__ == "__main__":
    main()
