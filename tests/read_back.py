#!/usr/bin/env python3
"""What wrlkit writes into another folder, wrlkit reads there: the same picture, and nothing outside that folder is needed.

  tests/read_back.py --wrlkit build/release/wrlkit [--found]

Worlds with urls, a sample of corpus/ (with --found: of ../shared/corpus or WRLKIT_SHARED, 77 when that is not there), are drawn where
they are, converted to .wrl and .x3d in a folder elsewhere, and drawn from there. Fails when pictures differ, or when reading the output
says that a file lies outside or is not found which the input found.
"""
import argparse
from concurrent.futures import ThreadPoolExecutor
import os
from pathlib import Path
import re
import subprocess
import sys
import tempfile
import zlib

ROOT = Path(__file__).resolve().parents[1]
SHARED = Path(os.environ.get('WRLKIT_SHARED', ROOT / '../shared')).resolve() / 'corpus'
URL = re.compile(rb'\burl\b|Url\b')
LARGEST = 2_000_000
SAMPLE = 60


def worlds(folder):
    """By a hash of their names, those with urls."""
    files = [p for p in folder.rglob('*') if p.suffix in ('.wrl', '.x3d') and p.is_file() and 'broken' not in p.parts]
    for path in sorted(files, key=lambda p: zlib.crc32(str(p.relative_to(folder)).encode())):
        if path.stat().st_size < LARGEST and URL.search(path.read_bytes()):
            yield path


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--wrlkit', required=True)
    parser.add_argument('--found', action='store_true')
    options = parser.parse_args()
    folder = SHARED if options.found else ROOT / 'corpus'
    if not folder.is_dir():
        print(f'skipped: there is no {folder}')
        return 77
    wrlkit = os.path.abspath(options.wrlkit)
    allowed = ['--allow-path', str(folder)]  # what worlds refer to stands next to their folders, too

    def run(*command):
        return subprocess.run([wrlkit, *map(str, command)], capture_output=True, text=True, errors='replace', timeout=120)

    def draw(world, picture, *more):
        said = run('render', world, picture, '--width', '96', '--height', '72', '--samples', '1', '--jobs', '1', *more).stderr
        return (picture.read_bytes() if picture.exists() else None), said.count('[url-outside]'), said.count('[url-not-found]')

    def judge(world, place):
        """What is wrong, and whether files came along."""
        place.mkdir()
        before = draw(world, place / 'before.png', *allowed)
        if before[0] is None:
            return [], 0
        faults, copied = [], 0
        for ending in ('wrl', 'x3d'):
            out = place / f'out/{ending}/world.{ending}'
            as_it_is = ending == 'wrl' and world.suffix == '.wrl'
            if run('convert', world, out, '--jobs', '1', *allowed, *(['-p', 'none', '--dump'] if as_it_is else [])).returncode > 1:
                continue  # another test's matter
            copied += any(out.parent.glob('world_files/**/*'))
            after = draw(out, place / f'{ending}.png')
            if after[1] or after[2] > before[2]:
                faults.append(f'{world} as {ending}: {after[1]} files outside, {after[2]} not found (before: {before[1]}, {before[2]})')
            if as_it_is and after[0] != before[0]:
                faults.append(f'{world} as {ending}: another picture')
        return faults, copied

    with tempfile.TemporaryDirectory() as scratch, ThreadPoolExecutor(2) as pool:
        sample = [w for w, _ in zip(worlds(folder), range(SAMPLE))]
        results = list(pool.map(judge, sample, [Path(scratch, str(i)) for i in range(len(sample))]))
    faults = [f for some, _ in results for f in some]
    copied = sum(c > 0 for _, c in results)
    print(f'{len(sample)} worlds with urls, {copied} of them with files that came along; {len(faults)} faults')
    for fault in faults:
        print(fault)
    return 1 if faults or copied < 5 else 0


if __name__ == '__main__':
    sys.exit(main())
