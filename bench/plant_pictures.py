#!/usr/bin/env python3
"""The pictures of docs/plants.md: a world and its levels side by side, from two places.

  bench/plant_pictures.py PROGRAM WORLD OUT.png [--viewpoints Overview,Platform] [--distance 1] [--ratios 0.25,0.1,0.03]

Without Viewpoints the world is seen from the front and from behind, from `--distance` of its diagonal. Those of docs/plants.md:
  corpus/plant/pump_room_faces.wrl plant_levels.png --viewpoints Overview,Platform
  plant.wrl plant_levels_generated.png             (gen_plant.py plant.wrl --size 1M)
  ../shared/plants/huldra/supports_indexed.wrl.gz plant_levels_huldra.png
  .../Labo1/resource/pipes.wrl plant_levels_pipes.png --distance 1.1
  .../Labo1/resource/tank.wrl plant_levels_tank.png --distance 1.1
"""
import argparse
import json
from pathlib import Path
import subprocess
import sys
import tempfile

sys.path.insert(0, str(Path(__file__).parent.parent / 'tests'))
import png

width, height, border = 296, 222, 2
directions = ((0.6, 0.4, 0.7), (-0.6, 0.4, -0.7))


def run(*command):
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True, errors='replace')
    if done.returncode > 1:
        sys.exit(f'{" ".join(map(str, command))}\n{done.stderr}')
    return done.stdout


def places(args):
    """Options of `render`."""
    if args.viewpoints:
        return [['--viewpoint', v] for v in args.viewpoints.split(',')]
    bounds = json.loads(run(args.program, 'info', '-q', '--json', args.world))['bounds']
    low, high = bounds['min'], bounds['max']
    middle = [(a + b) / 2 for a, b in zip(low, high)]
    diagonal = sum((b - a) ** 2 for a, b in zip(low, high)) ** 0.5
    eyes = ([m + args.distance * diagonal * d for m, d in zip(middle, way)] for way in directions)
    return [['--look-at', *eye, *middle, 0, 1, 0, '--background', 0.82, 0.86, 0.9] for eye in eyes]


def with_border(rgb):
    row, edge = 3 * width, b'\xff' * 3 * border
    line = b'\xff' * (row + 2 * len(edge))
    return [line] * border + [edge + rgb[i:i + row] + edge for i in range(0, len(rgb), row)] + [line] * border


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('program', type=Path)
    parser.add_argument('world', type=Path)
    parser.add_argument('out', type=Path)
    parser.add_argument('--viewpoints')
    parser.add_argument('--distance', type=float, default=1)
    parser.add_argument('--ratios', default='0.25,0.1,0.03')
    args = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        made = json.loads(run(args.program, 'simplify', '-q', '--json', args.world, '-o', folder, '--ratios', args.ratios))
        worlds = [args.world] + [p['file'] for p in made['points']]
        picture, rows = Path(folder) / 'picture.png', []
        for place in places(args):
            beside = []
            for world in worlds:
                run(args.program, 'render', '-q', world, picture, *place, '--width', width, '--height', height)
                step, pixels = png.pixels(picture)
                assert step == 3
                beside.append(with_border(pixels))
            rows += [b''.join(lines) for lines in zip(*beside)]
    png.write(args.out, len(rows[0]) // 3, b''.join(rows))


if __name__ == '__main__':
    main()
