#!/usr/bin/env python3
"""The picture of README.md: a plant as it was written, with baked light, and with a tenth of its triangles and baked light.

  bench/hero_picture.py build/release/wrlkit corpus/plant/pump_room_faces.wrl docs/pictures/plant_before_after.png
"""
import argparse
from pathlib import Path
import subprocess
import sys
import tempfile

sys.path.insert(0, str(Path(__file__).parent.parent / 'tests'))
import png

width, height, border = 400, 260, 2
light = 'weld,lightmap{exposure=auto}'


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('program', type=Path)
    parser.add_argument('world', type=Path)
    parser.add_argument('out', type=Path)
    parser.add_argument('--viewpoint', default='Overview')
    args = parser.parse_args()

    def run(*command):
        subprocess.run([args.program, *map(str, command), '-q'], check=True, stdout=subprocess.DEVNULL)

    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        run('convert', args.world, folder / 'lit.glb', '-p', light)
        run('simplify', args.world, '-o', folder / 'tenth.wrl', '--ratios', 0.1)
        run('convert', folder / 'tenth.wrl', folder / 'lit_tenth.glb', '-p', light)
        beside = []
        for world in (args.world, folder / 'lit.glb', folder / 'lit_tenth.glb'):
            run('render', world, folder / 'picture.png', '--viewpoint', args.viewpoint, '--width', width, '--height', height)
            step, rgb = png.pixels(folder / 'picture.png')
            assert step == 3
            beside.append([rgb[i:i + 3 * width] for i in range(0, len(rgb), 3 * width)])
        between = b'\xff' * 3 * border
        rows = [between.join(lines) for lines in zip(*beside)]
    png.write(args.out, len(rows[0]) // 3, b''.join(rows))


if __name__ == '__main__':
    main()
