#!/usr/bin/env python3
"""view3dscene (Castle Game Engine) shows VRML with baked light as `wrlkit render` does.

  tests/view3dscene_baked.py --wrlkit build/release/wrlkit

Bakes two rooms of corpus/paper as VRML97 and compares the pictures of both programs from the first Viewpoint. Bounds: 2 of 255 levels in
the mean, and one pixel in fifty by more than 24 (edges, which they smooth in different ways). Skipped without view3dscene and xvfb-run
(Debian packages view3dscene and xvfb).
"""
import argparse
from pathlib import Path
import shutil
import subprocess
import sys
import tempfile

from same_picture import pixels

WORLDS = ('corpus/paper/stairs_room.wrl', 'corpus/paper/pipes.wrl')
WIDTH, HEIGHT = 400, 300


def rgb(path):
    step, data = pixels(path)
    return [data[i:i + 3] for i in range(0, len(data), step)]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--wrlkit', required=True)
    wrlkit = parser.parse_args().wrlkit
    if not shutil.which('view3dscene') or not shutil.which('xvfb-run'):
        print('skipped: needs view3dscene and xvfb')
        return 77
    faults = []
    for world in WORLDS:
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            lit, theirs, ours = folder / 'lit.wrl', folder / 'theirs.png', folder / 'ours.png'
            subprocess.run([wrlkit, 'convert', '-q', world, lit, '-p', 'lightmap{quality=draft,max-size=256}'], check=True)
            if 'Background' not in lit.read_text():  # where the file has none, view3dscene's is grey
                lit.write_text(lit.read_text() + 'Background { }\n')
            subprocess.run([wrlkit, 'render', '-q', lit, ours, '--width', str(WIDTH), '--height', str(HEIGHT)], check=True)
            subprocess.run(['xvfb-run', '-a', '-s', '-screen 0 1280x1024x24', 'view3dscene', '--hide-extras', '--hide-menu', '--no-sound', '--geometry',
                            f'{WIDTH}x{HEIGHT}', '--anti-alias', '2', lit, '--screenshot', '0', theirs], capture_output=True, timeout=250)
            if not theirs.exists():
                print('skipped: view3dscene has drawn nothing; it needs OpenGL')
                return 77
            far, total, a, b = 0, 0, rgb(theirs), rgb(ours)
            for p, q in zip(a, b, strict=True):
                d = [abs(x - y) for x, y in zip(p, q)]
                far, total = far + (max(d) > 24), total + sum(d)
            share, mean = far / len(a), total / 3 / len(a)
            print(f'{world}: {mean:.2f} levels in the mean, {share:.2%} of the pixels by more than 24')
            if mean > 2 or share > 0.02:
                faults.append(f'{world}: view3dscene shows another picture')
    print('\n'.join(faults), end='')
    return 1 if faults else 0


if __name__ == '__main__':
    sys.exit(main())
