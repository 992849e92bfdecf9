#!/usr/bin/env python3
"""Every part of a merged world is found by its name, through its feature id, and stands where it stood.

  tests/merged_parts.py --wrlkit build/release/wrlkit [--draws 40] [--parts 600]

Makes a plant of named boxes in turned, scaled and mirrored groups, merges it to that many draw calls, reads the .glb with only
the struct module, and looks for a hundred parts that a fixed seed picks: the triangles with the id of that name must fill the box
that the part has in the world. Then wrlkit reads the file and must find every name again.
"""
import argparse
import json
import math
from pathlib import Path
import random
import struct
import subprocess
import sys
import tempfile

COLORS = [(0.7, 0.7, 0.7), (0.8, 0.2, 0.1), (0.1, 0.4, 0.8), (0.9, 0.8, 0.1), (0.2, 0.6, 0.2)]


def turned(axis_angle, p):
    (x, y, z, a), (c, s) = axis_angle, (math.cos(axis_angle[3]), math.sin(axis_angle[3]))
    d = (x * p[0] + y * p[1] + z * p[2]) * (1 - c)
    return (p[0] * c + (y * p[2] - z * p[1]) * s + x * d, p[1] * c + (z * p[0] - x * p[2]) * s + y * d, p[2] * c + (x * p[1] - y * p[0]) * s + z * d)


def world(n_parts):
    """The text, and of each part the box that it fills: (low, high)."""
    r = random.Random(5)
    text, boxes = ['#VRML V2.0 utf8'], {}
    for c, color in enumerate(COLORS):
        text.append(f'Shape {{ appearance DEF Paint{c} Appearance {{ material Material {{ diffuseColor {color[0]} {color[1]} {color[2]} }} }} }}')
    for unit in range(0, n_parts, 20):
        at = [round(r.uniform(-50, 50), 3) for _ in range(3)]
        axis = r.choice([(1, 0, 0), (0, 1, 0), (0, 0, 1), (0.6, 0.8, 0)])
        angle, scale = round(r.uniform(0, 6), 3), r.choice([(1, 1, 1), (2, 1, 0.5), (1, 1, -1)])
        text.append(f'DEF Unit_{unit} Transform {{ translation {at[0]} {at[1]} {at[2]} rotation {axis[0]} {axis[1]} {axis[2]} {angle} scale {scale[0]} {scale[1]} {scale[2]} children [')
        for part in range(unit, min(unit + 20, n_parts)):
            size, here = [round(r.uniform(0.1, 2), 3) for _ in range(3)], [round(r.uniform(-9, 9), 3) for _ in range(3)]
            text.append(f' DEF Part_{part} Transform {{ translation {here[0]} {here[1]} {here[2]} children Shape {{ appearance USE Paint{r.randrange(len(COLORS))} geometry Box {{ size {size[0]} {size[1]} {size[2]} }} }} }}')
            corners = []
            for k in range(8):
                p = [(here[i] + size[i] * ((k >> i & 1) - 0.5)) * scale[i] for i in range(3)]
                q = turned((*axis, angle), p)
                corners.append([q[i] + at[i] for i in range(3)])
            boxes[f'Unit_{unit}/Part_{part}'] = [f(c[i] for c in corners) for f in (min, max) for i in range(3)]
        text.append('] }')
    return '\n'.join(text) + '\n', boxes


class Glb:
    def __init__(self, path):
        data = path.read_bytes()
        n = struct.unpack_from('<I', data, 12)[0]
        self.json = json.loads(data[20:20 + n])
        self.bin = data[28 + n:]

    def accessor(self, i):
        a = self.json['accessors'][i]
        view = self.json['bufferViews'][a['bufferView']]
        width = {'SCALAR': 1, 'VEC2': 2, 'VEC3': 3, 'VEC4': 4}[a['type']]
        code = {5126: 'f', 5123: 'H', 5125: 'I'}[a['componentType']]
        size = struct.calcsize(code) * width
        stride, start = view.get('byteStride', size), view.get('byteOffset', 0) + a.get('byteOffset', 0)
        return [struct.unpack_from(f'<{width}{code}', self.bin, start + k * stride) for k in range(a['count'])]

    def draws(self):
        return sum('mesh' in n for n in self.json['nodes'])

    def corners_by_id(self):
        found = {}
        for node in self.json['nodes']:
            if 'mesh' not in node:
                continue
            moved = node.get('translation', [0, 0, 0])
            for p in self.json['meshes'][node['mesh']]['primitives']:
                sets = p['extensions']['EXT_mesh_features']['featureIds']
                ids = [int(v[0]) for v in self.accessor(p['attributes'][f"_FEATURE_ID_{sets[0]['attribute']}"])]
                assert sets[0]['featureCount'] == len(set(ids)), 'featureCount'
                points = self.accessor(p['attributes']['POSITION'])
                for (v,) in self.accessor(p['indices']) if 'indices' in p else [(v,) for v in range(len(points))]:
                    found.setdefault(ids[v], []).append([points[v][i] + moved[i] for i in range(3)])
        return found


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--wrlkit', required=True)
    parser.add_argument('--draws', type=int, default=40)
    parser.add_argument('--parts', type=int, default=600)
    args = parser.parse_args()
    text, boxes = world(args.parts)
    faults = []
    with tempfile.TemporaryDirectory() as folder:
        source, merged, table = (Path(folder) / n for n in ('plant.wrl', 'plant.glb', 'parts.csv'))
        source.write_text(text)
        subprocess.run([args.wrlkit, 'convert', source, merged, '-p', f'merge{{max-draws={args.draws},csv={table}}}'], check=True)
        glb = Glb(merged)
        names = glb.json['asset']['extras']['features']
        corners = glb.corners_by_id()
        if glb.draws() > args.draws:
            faults.append(f'{glb.draws()} draw calls, more than {args.draws}')
        rows = [row.split(',') for row in table.read_text().splitlines()[1:]]
        if {(int(i), name.strip('"')) for i, name, _ in rows} != set(enumerate(names)):
            faults.append('the CSV has other ids than the glTF')
        for name in random.Random(9).sample(sorted(boxes), 100):
            points = corners.get(names.index(name), []) if name in names else []
            if len(points) != 36:
                faults.append(f'{name}: {len(points)} corners')
                continue
            box = [f(p[i] for p in points) for f in (min, max) for i in range(3)]
            if max(abs(a - b) for a, b in zip(box, boxes[name])) > 1e-4:
                faults.append(f'{name}: fills {box}, not {boxes[name]}')
        report = json.loads(subprocess.run([args.wrlkit, 'diff', source, merged, '--json'], check=True, capture_output=True).stdout)
        if report['names']['missing']:
            faults.append(f"names missing: {report['names']['missing'][:5]}")
        if report['surface']['max'] > 1e-4:
            faults.append(f"surfaces are {report['surface']['max']} m apart")
        print(f'{len(names)} parts in {glb.draws()} draw calls')
    print('\n'.join(faults) or 'a hundred parts found by name')
    return 1 if faults else 0


if __name__ == '__main__':
    sys.exit(main())
