#!/usr/bin/env python3
"""A world becomes 3D Tiles: every part is found by its name where it stands, errors are those that are there, boxes hold what is in them.

  tests/tiles_world.py --wrlkit build/release/wrlkit [--parts 200] [--rounds 60]

Makes a world of named boxes and bolts 5,000 km from the origin and named round parts, writes it as tiles of few triangles, reads tileset.json and the
tiles with only the struct module, and has `wrlkit diff` measure each coarse tile against the full ones that it stands for.
"""
import argparse
import json
from pathlib import Path
import random
import subprocess
import sys
import tempfile

from merged_parts import Glb
from names_table import Table, corners_by_path, with_bolts

SITE = (5_000_000, 250, -3_000_000)
FARTHEST = 1e-3  # metres that a corner may be from where it was


def round_parts(n):
    """Text of spheres, cylinders and cones of many sizes, with names."""
    r = random.Random(3)
    forms = ['Sphere { radius %g }', 'Cylinder { radius %g height 3 }', 'Cone { bottomRadius %g height 2 }']
    text = ['#VRML V2.0 utf8', 'DirectionalLight {}']
    for i in range(n):
        at = [round(SITE[k] + r.uniform(-60, 60), 3) for k in range(3)]
        size = round(r.choice([0.05, 0.3, 1, 4]) * r.uniform(0.8, 1.2), 3)
        text.append(f'DEF Round_{i} Transform {{ translation {at[0]} {at[1]} {at[2]} children Shape {{ appearance Appearance {{ material Material {{ diffuseColor 0 {i % 3 / 2} 1 }} }} geometry {forms[i % 3] % size} }} }}')
    return '\n'.join(text) + '\n'


class Tiles:
    """The tiles of a set with their origins in the coordinates of the world, y up."""

    def __init__(self, folder):
        self.folder = folder = folder.resolve()  # Inlines of it are looked for from elsewhere
        self.set = json.loads((folder / 'tileset.json').read_text())
        self.all, self.n_files = [], 1
        self._add(self.set['root'], (0, 0, 0), None, folder)

    def _add(self, tile, origin, parent, folder):
        uri = folder / tile['content']['uri']
        if uri.suffix == '.json':
            assert 'transform' not in tile and 'children' not in tile
            self.n_files += 1
            inside = json.loads(uri.read_text())['root']
            assert inside['geometricError'] == tile['geometricError'] and inside['refine'] == 'REPLACE'
            me = self._add(inside, origin, parent, uri.parent)
            assert is_within(me['box'], self._box(tile, origin)), 'a box that does not hold what its file describes'
            return me
        t = tile.get('transform', [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1])
        assert t[:12] == [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0], 'tiles are only moved'
        origin = (origin[0] + t[12], origin[1] + t[14], origin[2] - t[13])
        me = {'tile': tile, 'origin': origin, 'parent': parent, 'glb': uri, 'children': [], 'box': self._box(tile, origin)}
        self.all.append(me)
        for child in tile.get('children', []):
            me['children'].append(self._add(child, origin, me, folder))
        return me

    @staticmethod
    def _box(tile, origin):
        b = tile['boundingVolume']['box']
        middle, half = (origin[0] + b[0], origin[1] + b[2], origin[2] - b[1]), (b[3], b[11], b[7])
        return [m - h for m, h in zip(middle, half)], [m + h for m, h in zip(middle, half)]


def corners_of(tile):
    """Of each part, by its whole name, the corners in the coordinates of the world."""
    return {path: [[c + o for c, o in zip(p, tile['origin'])] for p in points] for path, points in corners_by_path(Glb(tile['glb'])).items()}


def tables_of_places(tile):
    """Of each node with instances, how many."""
    glb = Glb(tile['glb'])
    found = [n['extensions']['EXT_mesh_gpu_instancing']['attributes'] for n in glb.json['nodes'] if 'EXT_mesh_gpu_instancing' in n.get('extensions', {})]
    return [len(glb.accessor(next(iter(attributes.values())))) for attributes in found]


def is_within(inner, outer, slack=1e-6):
    return all(a >= b - slack for a, b in zip(inner[0], outer[0])) and all(a <= b + slack for a, b in zip(inner[1], outer[1]))


def bounds(points):
    return [f(p[i] for p in points) for f in (min, max) for i in range(3)]


def leaves_of(tile):
    return [tile] if not tile['children'] else [leaf for child in tile['children'] for leaf in leaves_of(child)]


def true_error(wrlkit, tile, folder):
    """How far a coarse tile is from the full ones, as `wrlkit diff` says."""
    def inlined(tiles, path):
        parts = [f'Transform {{ translation {" ".join(repr(a - b) for a, b in zip(t["origin"], tile["origin"]))} children Inline {{ url "{t["glb"]}" }} }}' for t in tiles]
        path.write_text('#VRML V2.0 utf8\n' + '\n'.join(parts) + '\n')
        return path
    coarse, full = inlined([tile], folder / 'coarse.wrl'), inlined(leaves_of(tile), folder / 'full.wrl')
    result = subprocess.run([wrlkit, 'diff', full, coarse, '--json', '--allow-path', folder], capture_output=True, text=True)
    found = json.loads(result.stdout)
    assert all(found['triangles']), f'{tile["glb"]}: nothing is drawn: {result.stderr}'
    return found['surface']['max']


def check_tree(tiles, faults):
    if tiles.set['asset']['version'] != '1.1' or tiles.set['root']['refine'] != 'REPLACE':
        faults.append('not a set of 3D Tiles 1.1 that is refined by REPLACE')
    if tiles.set['geometricError'] < tiles.set['root']['geometricError']:
        faults.append('the error of the set is below that of its root')
    for t in tiles.all:
        name, error = t['glb'].name, t['tile']['geometricError']
        if not t['children'] and error != 0:
            faults.append(f'{name}: a full tile with an error')
        if t['parent'] and (error > t['parent']['tile']['geometricError'] or not is_within(t['box'], t['parent']['box'])):
            faults.append(f'{name}: a larger error or a larger box than the tile above it')
        b = bounds([p for points in corners_of(t).values() for p in points])
        if not is_within((b[:3], b[3:]), t['box']):
            faults.append(f'{name}: {b} is not within its box {t["box"]}')


def check_parts(tiles, boxes, names, faults):
    full = {}
    for leaf in leaves_of(tiles.all[0]):
        for path, points in corners_of(leaf).items():
            full.setdefault(path, []).extend(points)
    if set(full) != names:
        faults.append(f'full tiles: missing {sorted(names - set(full))[:3]}, not known {sorted(set(full) - names)[:3]}')
    for path, box in boxes.items():
        if path in full and max(abs(a - b) for a, b in zip(bounds(full[path]), box)) > FARTHEST:
            faults.append(f'{path}: fills {bounds(full[path])}, not {box}')
    for t in tiles.all:
        table = Table(Glb(t['glb']))
        if not table.sources or any(source != path.split('/')[0] for path, source in zip(table.paths, table.sources)):
            faults.append(f'{t["glb"].name}: rows that are not of the file that they are in')
        if unknown := set(corners_of(t)) - names:
            faults.append(f'{t["glb"].name}: names that nothing has: {sorted(unknown)[:3]}')


def check_levels(tiles, levels, names, faults):
    """What is said of each level: the names of its tiles and of full ones above it."""
    def depth(tile):
        return len(tile['glb'].stem) - 1
    for k, level in enumerate(levels):
        seen = {path for t in tiles.all if depth(t) == k or not t['children'] and depth(t) < k for path in corners_of(t)}
        if level['parts'] != len(seen):
            faults.append(f'level {k}: {level["parts"]} parts are said to be shown, there are {len(seen)}')
    if levels[-1]['parts'] != len(names) or not levels[0]['parts'] < len(names):
        faults.append(f'parts of the last level and of the root: {[level["parts"] for level in levels]} of {len(names)}')


def check_errors(wrlkit, tiles, folder, faults):
    ratios = []
    for t in tiles.all:
        if not t['children']:
            continue
        said, true = t['tile']['geometricError'], true_error(wrlkit, t, folder)
        ratios.append(said / true)
        if not true <= said <= 2 * true:
            faults.append(f'{t["glb"].name}: says {said} m, is {true} m from the full surface')
    return ratios


def check_places(tiles, plain, faults):
    """Surfaces that stand in several places are stored once; without that option nothing is."""
    full, coarse = (sum((tables_of_places(t) for t in tiles.all if bool(t['children']) == has), []) for has in (False, True))
    if not full or min(full + coarse) < 4:
        faults.append(f'places in tables: {full} of full tiles, {coarse} of coarse ones')
    if any(tables_of_places(t) for t in plain.all):
        faults.append('places in tables without --gpu-instancing')
    draws = [sum('mesh' in n for n in Glb(t['glb']).json['nodes']) for t in tiles.all]
    if max(draws) > 32:
        faults.append(f'{max(draws)} draws')
    return sum(full), sum(coarse)


def bytes_of(folder):
    return {str(p.relative_to(folder)): p.read_bytes() for p in sorted(folder.rglob('*')) if p.is_file()}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--wrlkit', required=True)
    parser.add_argument('--parts', type=int, default=200)
    parser.add_argument('--bolts', type=int, default=80)
    parser.add_argument('--rounds', type=int, default=60)
    parser.add_argument('--triangles', type=int, default=800)
    args = parser.parse_args()
    text, near = with_bolts(args.parts, args.bolts)
    boxes = {f'far.wrl/Site/{name}': [b + o for b, o in zip(box, SITE * 2)] for name, box in near.items()}
    names = set(boxes) | {f'round.wrl/Round_{i}' for i in range(args.rounds)}
    faults = []
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / 'in' / 'parts').mkdir(parents=True)
        (folder / 'in' / 'parts' / 'boxes.inl').write_text(text)
        (folder / 'in' / 'far.wrl').write_text(f'#VRML V2.0 utf8\nDEF Site Transform {{ translation {SITE[0]} {SITE[1]} {SITE[2]} children Inline {{ url "parts/boxes.inl" }} }}\n')
        (folder / 'in' / 'round.wrl').write_text(round_parts(args.rounds))

        def make(out, *flags, code=0):
            made = subprocess.run([args.wrlkit, 'tiles', folder / 'in', '-o', folder / out, '--triangles', str(args.triangles), *flags], capture_output=True, text=True)
            if made.returncode != code:
                faults.append(f'{out}: exit code {made.returncode}: {made.stderr}')
        make('out', '--compress', 'none', '--tileset-tiles', '12', '--report', folder / 'report.json')
        tiles = Tiles(folder / 'out')
        check_tree(tiles, faults)
        check_levels(tiles, json.loads((folder / 'report.json').read_text())['tiles']['levels'], names, faults)
        if not len(tiles.all) / 12 <= tiles.n_files <= len(tiles.all) / 4:
            faults.append(f'{tiles.n_files} files describe {len(tiles.all)} tiles, 12 each at most')
        check_parts(tiles, boxes, names, faults)
        ratios = check_errors(args.wrlkit, tiles, folder, faults)
        make('plain', '--compress', 'none', '--tileset-tiles', '12', '--no-gpu-instancing')
        plain = Tiles(folder / 'plain')
        check_parts(plain, boxes, names, faults)
        places = check_places(tiles, plain, faults)
        make('one', '--compress', 'none', '--tileset-tiles', '12', '--jobs', '1')
        if bytes_of(folder / 'out') != bytes_of(folder / 'one'):
            faults.append('one thread gives other bytes')
        # A damaged file costs itself; the set takes the place of the one before.
        (folder / 'in' / 'broken.wrl').write_text('this is no world')
        make('out', '--compress', 'none', '--tileset-tiles', '12', code=1)
        if bytes_of(folder / 'out') != bytes_of(folder / 'one'):
            faults.append('a file that cannot be read changes the tiles of the others')
    print(f'{len(tiles.all)} tiles in {tiles.n_files} files, {len(ratios)} of them coarse; errors said over those measured: {min(ratios):.2f} to {max(ratios):.2f}; {places[0]} and {places[1]} parts in tables of places')
    print('\n'.join(faults) or 'all parts found, all errors and boxes right')
    return 1 if faults else 0


if __name__ == '__main__':
    sys.exit(main())
