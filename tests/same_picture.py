#!/usr/bin/env python3
"""Sharing, merging and making small change nothing that is seen, nor any name that has to stay.

  tests/same_picture.py --wrlkit build/release/wrlkit

Draws worlds before and after, reads the pictures with only zlib, and counts pixels that differ.

- The pump room, `dedup,instance` and `merge`: at most one pixel in a thousand by more than 8 of 255 levels (edges that a millionth of a
  metre moves across the middle of a pixel), 0.05 levels in the mean. The surface may deviate by the tolerance of `instance`.
- Several worlds, `optimize --tolerance 1mm`: one pixel in a hundred (edges that a millimetre moves), and two levels in the mean: normals
  of eight bits, highlights that are those of glTF's materials, pictures as WebP. The surface may deviate by the tolerance, and that of `instance`.
- `--found`: the same of worlds of ../shared/corpus (WRLKIT_SHARED); ends with 77 when that is not there.
"""
import argparse
import json
import os
from pathlib import Path
import subprocess
import sys
import tempfile

from png import pixels

ROOM = 'corpus/plant/pump_room_faces.wrl'
SHARED = os.path.join(os.environ.get('WRLKIT_SHARED', '../shared'), 'corpus/plant/')
EXACT, SMALL = (0.001, 0.05, 0.0002), (0.01, 2, 0.0012)  # parts of the pixels, levels, metres
CASES = [(ROOM, ['convert', '-p', 'dedup,instance'], True, EXACT), (ROOM, ['convert', '-p', 'merge{max-draws=40}'], False, EXACT)]


def made_small(*worlds):
    return [(w, ['optimize', '--tolerance', '1mm', *more], keeps_names, SMALL) for w, keeps_names, *more in worlds]


CASES += made_small(
    (ROOM, True), ('corpus/features/mirrored_nested.wrl', True), ('corpus/features/lod.wrl', True), ('corpus/features/colour_per_face.wrl', True),
    ('corpus/features/texture_repeat.wrl', True, '--texture-format', 'keep'), ('corpus/vrml1/Texture2Transform.wrl', True))
FOUND = made_small(
    (SHARED + 'hairo-world-narrec/RobotTestPool/resource/wp_anark.wrl', True),
    (SHARED + 'choreonoid/Labo1/resource/pipes.wrl', False))  # 139 of its geometries have a name, but nothing that is drawn


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--wrlkit', required=True)
    parser.add_argument('--found', action='store_true')
    options = parser.parse_args()
    wrlkit = options.wrlkit
    if options.found and not Path(SHARED).exists():
        print(f'skipped: there is no {SHARED}')
        return 77

    def run(*command):
        return subprocess.run([wrlkit, *command], check=True, capture_output=True, text=True).stdout

    faults = []
    with tempfile.TemporaryDirectory() as folder:
        def picture(world):
            run('render', '-q', str(world), f'{folder}/a.png', '--width', '400', '--height', '250')
            return pixels(Path(folder, 'a.png'))
        for world, command, keeps_names, (most_far, most_mean, most_deviation) in (FOUND if options.found else CASES):
            what = f"{Path(world).name}, {' '.join(command)}"
            out = Path(folder, 'b.glb')
            run(command[0], '-q', world, str(out), *command[1:])
            step, before = picture(world)
            after = picture(out)[1]
            d = [abs(a - b) for a, b in zip(before, after, strict=True)]
            far, mean = sum(max(d[i:i + step]) > 8 for i in range(0, len(d), step)) * step / len(d), sum(d) / len(d)
            found = json.loads(run('diff', '-q', world, str(out), '--json'))
            deviation, missing = found['surface']['max'], found['names']['missing']
            print(f'{what}: {far:.5%} of the pixels differ by more than 8 levels, {mean:.4f} levels in the mean; surface {deviation:.2g} m')
            if far > most_far or mean > most_mean or deviation > most_deviation or (keeps_names and missing):
                faults.append(f'{what}: too much; names that are missing: {missing}')
    print('\n'.join(faults), end='')
    return 1 if faults else 0


if __name__ == '__main__':
    sys.exit(main())
