#!/usr/bin/env python3
"""What a viewer of a set of 3D Tiles has to draw and to load, from eight places: four corners outside, and four places within.

  bench/tiles_views.py [--pixels 16] [--height 1080] SET...      SET is a folder with tileset.json

A tile is refined while its geometricError is more than so many pixels of a picture that is 16:9 and 60 degrees wide from top to
bottom, as CesiumJS and 3d-tiles-renderer refine it; what is outside the picture is left out. For each place: tiles, draws,
triangles and bytes of what is shown.
"""
import argparse
import json
import math
from pathlib import Path

from glb import glb_json, n_triangles

ANGLE, ASPECT = math.radians(60), 16 / 9


def drawn(path):
    """Draws and triangles of a tile."""
    gltf = glb_json(path)
    draws = triangles = 0
    for node in gltf.get('nodes', []):
        if 'mesh' not in node:
            continue
        places = node.get('extensions', {}).get('EXT_mesh_gpu_instancing', {}).get('attributes')
        n = gltf['accessors'][next(iter(places.values()))]['count'] if places else 1
        for primitive in gltf['meshes'][node['mesh']]['primitives']:
            draws += 1
            triangles += n * n_triangles(gltf, primitive)
    return draws, triangles


class Tile:
    """In the coordinates of the set, z up."""

    def __init__(self, json_of, origin, folder):
        t = json_of.get('transform', [0] * 16)
        self.origin = [origin[i] + t[12 + i] for i in range(3)]
        self.error = json_of['geometricError']
        b = json_of['boundingVolume']['box']
        self.middle = [self.origin[i] + b[i] for i in range(3)]
        self.half = [b[3], b[7], b[11]]
        self.children, self.draws, self.triangles, self.bytes = [], 0, 0, 0
        uri = json_of.get('content', {}).get('uri', '')
        if uri.endswith('.json'):
            path = folder / uri
            inside = Tile(json.loads(path.read_text())['root'], self.origin, path.parent)
            self.__dict__.update(inside.__dict__)
            return
        if uri:
            self.draws, self.triangles = drawn(folder / uri)
            self.bytes = (folder / uri).stat().st_size
        self.children = [Tile(c, self.origin, folder) for c in json_of.get('children', [])]

    def distance(self, eye):
        return math.hypot(*(max(abs(e - m) - h, 0) for e, m, h in zip(eye, self.middle, self.half)))


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def unit(v):
    size = math.hypot(*v)
    return [x / size for x in v]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


class View:
    def __init__(self, eye, target, height, pixels):
        self.eye, self.pixels, self.scale = eye, pixels, height / (2 * math.tan(ANGLE / 2))
        ahead = unit([t - e for t, e in zip(target, eye)])
        right = unit(cross(ahead, [0, 0, 1]))
        up = cross(right, ahead)
        y, x = math.tan(ANGLE / 2), math.tan(ANGLE / 2) * ASPECT
        self.planes = [ahead] + [[ahead[i] * k + s * side[i] for i in range(3)] for side, k in ((right, x), (up, y)) for s in (1, -1)]

    def sees(self, tile):
        way = [m - e for m, e in zip(tile.middle, self.eye)]
        return all(dot(way, p) + sum(abs(h * c) for h, c in zip(tile.half, p)) >= 0 for p in self.planes)

    def shown(self, tile):
        if not self.sees(tile):
            return []
        distance = max(tile.distance(self.eye), 1e-6)
        if not tile.children or tile.error * self.scale / distance <= self.pixels:
            return [tile]
        return [t for child in tile.children for t in self.shown(child)]


def places(root):
    """Eyes and what they look at."""
    m, h = root.middle, root.half
    for x, y in ((1, 1), (-1, 1), (-1, -1), (1, -1)):
        yield 'outside', [m[0] + 1.5 * x * h[0], m[1] + 1.5 * y * h[1], m[2] + 1.5 * h[2]], m
    for x, y in ((1, 1), (-1, 1), (-1, -1), (1, -1)):
        eye = [m[0] + 0.5 * x * h[0], m[1] + 0.5 * y * h[1], m[2] - h[2] + min(2, h[2])]
        yield 'within', eye, [m[0], m[1], eye[2]]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('sets', nargs='+', type=Path)
    parser.add_argument('--pixels', type=float, default=16)
    parser.add_argument('--height', type=float, default=1080)
    args = parser.parse_args()
    for folder in args.sets:
        root = Tile(json.loads((folder / 'tileset.json').read_text())['root'], (0, 0, 0), folder)
        size = sum(p.stat().st_size for p in folder.rglob('*') if p.is_file())
        print(f'{folder}: {size} bytes')
        for name, eye, target in places(root):
            shown = View(eye, target, args.height, args.pixels).shown(root)
            print(f'  {name:8} {len(shown):5} tiles {sum(t.draws for t in shown):6} draws {sum(t.triangles for t in shown):9} triangles {sum(t.bytes for t in shown):10} bytes')


if __name__ == '__main__':
    main()
