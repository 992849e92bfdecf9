#!/usr/bin/env python3
"""Levels of detail of every world: `-p weld,lod` as VRML, and as the glTF that tests/convert_worlds.py has made.

  tests/lod_worlds.py --wrlkit build/release/wrlkit [--every N] [--made FOLDER...] [-v]

Worlds are those of corpus/ and, when it is there, of ../shared/corpus (or WRLKIT_SHARED); --every N takes each N-th of all.
For each world that wrlkit can read:
- the VRML is the same byte for byte with one and with two threads;
- it reads back without a message of its own: it has no message but those of the world written by `-p weld`;
- no part is lost: as many Shapes, triangles, lines and points are shown (of a LOD, the first level) as in that one, in the same bounds;
- in the glTF, where ranges are, no level's bounds differ from the first level's by more than the error that its range stands for.
The glTF itself is validated by the test validate. Prints the counts; fails when a world fails, or none has levels.
"""
import argparse, array, json, math, os, re, subprocess, sys, tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from merged_parts import Glb

project = os.path.abspath(os.path.join(os.path.dirname(__file__), '..'))
shared = os.path.abspath(os.path.join(os.environ.get('WRLKIT_SHARED', os.path.join(project, '..', 'shared')), 'corpus'))
per_pixel = 1080 / (2 * math.tan(0.785398 / 2))  # of the pass's defaults
endings = ('.wrl', '.wrz', '.wrl.gz', '.vrml', '.x3d', '.x3dv')


def worlds(folder):
    for path, _, names in sorted(os.walk(folder)):
        yield from (os.path.join(path, n) for n in sorted(names) if n.lower().endswith(endings))


def run(*command):
    r = subprocess.run(command, capture_output=True, timeout=600)
    return r.returncode, r.stdout.decode(errors='replace'), r.stderr.decode(errors='replace')


def shown(info):
    """What of `info --json` must not change by levels of detail."""
    return {k: info.get(k) for k in ('shapes', 'triangles', 'lines', 'points', 'bounds')}


def names_of_messages(text):
    return sorted(re.findall(r'\[([a-z0-9-]+)\]$', text, re.M))


class Gltf(Glb):
    """Of a .glb."""

    def positions(self, mesh):
        for primitive in self.json['meshes'][mesh]['primitives']:
            accessor = self.json['accessors'][primitive['attributes']['POSITION']]
            view = self.json['bufferViews'][accessor['bufferView']]
            begin = view.get('byteOffset', 0) + accessor.get('byteOffset', 0)
            assert view.get('byteStride', 12) == 12
            p = array.array('f', self.bin[begin : begin + 12 * accessor['count']])
            yield from zip(p[0::3], p[1::3], p[2::3])

    def levels(self):
        """The positions of each level of each LOD with ranges, and the ranges."""
        for parent in self.json.get('nodes', []):
            lod = parent.get('extras', {}).get('vrml97', {}).get('LOD', {})
            for child in parent.get('children', []):
                node = self.json['nodes'][child]
                ids = node.get('extensions', {}).get('MSFT_lod', {}).get('ids', [])
                nodes = [node] + [self.json['nodes'][i] for i in ids]
                if 'range' in lod and ids and all('mesh' in n for n in nodes):
                    yield [list(self.positions(n['mesh'])) for n in nodes], lod['range']


def bounds(points):
    return [f(p[k] for p in points) for f in (min, max) for k in range(3)]


def check_levels(gltf):
    """How many levels there are, and the first that is out of its bounds."""
    n = 0
    for levels, ranges in gltf.levels():
        box = bounds(levels[0])
        middle = [(box[k] + box[k + 3]) / 2 for k in range(3)]
        radius = max(math.dist(p, middle) for p in levels[0])
        rounding = 1e-6 * max(map(abs, box))
        for level, r in zip(levels[1:], ranges):
            n += 1
            error = (r - radius) / per_pixel + rounding
            off = max(abs(a - b) for a, b in zip(box, bounds(level)))
            if off > error:
                return n, f'a level is {off:.4g} out of bounds, where {error:.4g} is its error'
    return n, None


def made_in(folders):
    """The .glb of each world."""
    for folder in folders:
        journal = Path(folder, '.wrlkit/journal-1-of-1.jsonl')
        for line in journal.read_text().splitlines() if journal.exists() else []:
            job = json.loads(line)
            if job['state'].startswith('made'):
                yield job['input'], Path(folder, job['output'])


def check(wrlkit, world, made):
    with tempfile.TemporaryDirectory() as folder:
        # Pictures that are written along have the name of the world, so both are called the same.
        one, two, plain = (os.path.join(folder, n) for n in ('1/lod.wrl', '2/lod.wrl', 'plain.wrl'))
        for path in (one, two):
            os.mkdir(os.path.dirname(path))
        code, _, text = run(wrlkit, 'convert', world, plain, '-p', 'weld')
        if code < 0 or code > 3:
            return 0, f'exit code {code}'
        if not os.path.exists(plain):
            return None, None
        for path, jobs in ((one, '1'), (two, '2')):
            if (lod_code := run(wrlkit, 'convert', world, path, '-p', 'weld,lod', '--jobs', jobs)[0]) != code:
                return 0, f'exit code {lod_code}, where it is {code} without lod'
        data = open(one, 'rb').read()
        if data != open(two, 'rb').read():
            return 0, 'two threads make other bytes'
        (_, before, said), (_, after, said_of_lod) = (run(wrlkit, 'info', '--json', p) for p in (plain, one))
        if names_of_messages(said) != names_of_messages(said_of_lod):
            return 0, f'read back with {names_of_messages(said_of_lod)}, where it is {names_of_messages(said)}'
        if shown(json.loads(before)) != shown(json.loads(after)):
            return 0, f'{shown(json.loads(before))} became {shown(json.loads(after))}'
        return check_levels(Gltf(made[world])) if world in made else (0, None)


def main():
    args = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    args.add_argument('--wrlkit', default=os.path.join(project, 'build/release/wrlkit'))
    args.add_argument('--every', type=int, default=1)
    args.add_argument('--made', nargs='*', default=[])
    args.add_argument('-v', action='store_true')
    o = args.parse_args()
    files = list(worlds(os.path.join(project, 'corpus')))
    if os.path.isdir(shared):
        files += worlds(shared)
    else:
        print('the found corpus is not there (WRLKIT_SHARED): only worlds of this project')
    files = files[:: o.every]
    made = dict(made_in(o.made))
    failed = unread = with_levels = levels = 0
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        for world, (n, why) in zip(files, pool.map(lambda f: check(o.wrlkit, f, made), files)):
            unread += n is None
            with_levels += bool(n)
            levels += n or 0
            if why:
                failed += 1
            if why or o.v:
                print(f'{world}: {why or n}')
    print(f'{len(files)} worlds, {unread} of them are none; {with_levels} have levels, {levels} levels in all; {failed} fail')
    return bool(failed) or with_levels == 0


sys.exit(main())
