#!/usr/bin/env python3
"""The errors that a set of 3D Tiles states against those that `wrlkit diff`, which knows nothing of tiles, measures.

  bench/tiles_errors.py WRLKIT [--sample 200] [--triangles N] WORLD...

Makes tiles of each world, takes up to `--sample` coarse ones (the root, and others spread evenly over the set), and measures each against
all full tiles below it, both ways. The geometricError must be at least that distance, and at most twice as much. Prints a row for each
world, then the tiles that fail; the exit code is 1 if there are any.
"""
import argparse
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
import statistics
import subprocess
import sys
import tempfile

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / 'tests'))
from tiles_world import Tiles, true_error


def evenly(items, n):
    return items if len(items) <= n else [items[i * len(items) // n] for i in range(n)]


def measured(args, world, folder):
    """The number of tiles, and for each tile of the sample its name, its level, its geometricError and its true distance."""
    flags = ['--triangles', str(args.triangles)] if args.triangles else []
    made = subprocess.run([args.wrlkit, 'tiles', '-q', world, '-o', folder / 'set', *flags], capture_output=True, text=True)
    if made.returncode:
        sys.exit(f'{world}: {made.stderr}')
    tiles = Tiles(folder / 'set').all
    sample = evenly([t for t in tiles if t['children']], args.sample)

    def one(at):
        work = folder / str(at)
        work.mkdir()
        return sample[at]['tile']['geometricError'], true_error(args.wrlkit, sample[at], work)
    with ThreadPoolExecutor(2) as pool:
        found = list(pool.map(one, range(len(sample))))
    return len(tiles), [(t['glb'].stem, len(t['glb'].stem) - 1, *f) for t, f in zip(sample, found)]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('wrlkit')
    parser.add_argument('worlds', nargs='+', type=Path)
    parser.add_argument('--sample', type=int, default=200)
    parser.add_argument('--triangles', type=int, help='of a tile')
    args = parser.parse_args()
    bad = []
    print('| world | tiles | measured | stated / measured: least | median | most | below 1 | above 2 |\n|---|---|---|---|---|---|---|---|')
    for world in args.worlds:
        with tempfile.TemporaryDirectory() as name:
            n, rows = measured(args, world, Path(name))
        if not rows:
            print(f'| {world.name} | {n} | 0 |', flush=True)
            continue
        ratios = sorted(stated / max(true, 1e-9) for _, _, stated, true in rows)
        bad += [f'{world.name} {tile}, level {level}: states {stated:.6g} m, is {true:.6g} m off' for tile, level, stated, true in rows if not true <= stated <= 2 * true]
        print(f'| {world.name} | {n} | {len(rows)} | {ratios[0]:.3f} | {statistics.median(ratios):.3f} | {ratios[-1]:.3f} | {sum(r < 1 for r in ratios)} | {sum(r > 2 for r in ratios)} |', flush=True)
    print('\n'.join(bad))
    return 1 if bad else 0


if __name__ == '__main__':
    sys.exit(main())
