#!/usr/bin/env python3
"""Sharing and merging change nothing that is seen, nor any name that has to stay.

  tests/same_picture.py --wrlkit build/release/wrlkit

Draws the pump room before and after `dedup,instance` and `merge`, reads the pictures with nothing but zlib, and counts pixels that
differ. Bounds: at most one pixel in a thousand by more than 8 of 255 levels (edges that a millionth of a metre moves across the middle
of a pixel), 0.05 levels in the mean. The surface may deviate by the tolerance of `instance`.
"""
import argparse
import json
from pathlib import Path
import struct
import subprocess
import sys
import tempfile
import zlib

WORLD = 'corpus/plant/pump_room_faces.wrl'
CASES = [('dedup,instance', True), ('merge{max-draws=40}', False)]


def pixels(path):
    """Width times channels, and the rows (PNG of 8 bits a channel, not interlaced)."""
    data, at, packed = path.read_bytes(), 8, b''
    while at < len(data):
        size, kind = struct.unpack_from('>I4s', data, at)
        body = data[at + 8:at + 8 + size]
        at += 12 + size
        if kind == b'IHDR':
            width, height, depth, color, _, _, interlaced = struct.unpack('>IIBBBBB', body)
            assert (depth, interlaced) == (8, 0)
        packed += body if kind == b'IDAT' else b''
    step = {0: 1, 2: 3, 4: 2, 6: 4}[color]
    raw, row, out = zlib.decompress(packed), bytearray(width * step), []
    for y in range(height):
        start = y * (width * step + 1)
        above, row, how = row, bytearray(raw[start + 1:start + 1 + width * step]), raw[start]
        for i in range(len(row)):
            a, b, c = (row[i - step], above[i], above[i - step]) if i >= step else (0, above[i], 0)
            if how == 4:
                pa, pb, pc = abs(b - c), abs(a - c), abs(a + b - 2 * c)
                add = a if pa <= pb and pa <= pc else b if pb <= pc else c
            else:
                add = (0, a, b, (a + b) // 2)[how]
            row[i] = (row[i] + add) & 255
        out.append(bytes(row))
    return step, b''.join(out)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--wrlkit', required=True)
    wrlkit = parser.parse_args().wrlkit

    def run(*command):
        return subprocess.run([wrlkit, *command], check=True, capture_output=True, text=True).stdout

    faults = []
    with tempfile.TemporaryDirectory() as folder:
        def picture(world):
            run('render', '-q', str(world), f'{folder}/a.png', '--width', '400', '--height', '250')
            return pixels(Path(folder, 'a.png'))
        step, before = picture(WORLD)
        for passes, keeps_names in CASES:
            out = Path(folder, 'b.glb')
            run('convert', '-q', WORLD, str(out), '-p', passes)
            after = picture(out)[1]
            d = [abs(a - b) for a, b in zip(before, after, strict=True)]
            far, mean = sum(max(d[i:i + step]) > 8 for i in range(0, len(d), step)) * step / len(d), sum(d) / len(d)
            found = json.loads(run('diff', '-q', WORLD, str(out), '--json'))
            deviation, missing = found['surface']['max'], found['names']['missing']
            print(f'{passes}: {far:.5%} of the pixels differ by more than 8 levels, {mean:.4f} levels in the mean; surface {deviation:.2g} m')
            if far > 0.001 or mean > 0.05 or deviation > 0.0002 or (keeps_names and missing):
                faults.append(f'{passes}: too much; names that are missing: {missing}')
    print('\n'.join(faults), end='')
    return 1 if faults else 0


if __name__ == '__main__':
    sys.exit(main())
