#!/usr/bin/env python3
"""Every part of a world whose names are in a table is found by its name, and stands where it stood.

  tests/names_table.py --wrlkit build/release/wrlkit [--parts 400] [--bolts 300]

Makes a plant of named boxes and bolts in turned, scaled and mirrored groups, writes it with `--names table`, and reads the .glb with nothing
but the struct module: the property table (EXT_structural_metadata), the feature ids of merged meshes (EXT_mesh_features) and of places
(EXT_instance_features, EXT_mesh_gpu_instancing). A hundred parts that a fixed seed picks must fill the boxes that they have in the world, below
the groups that they are in. Then wrlkit reads files of every compression and must find every name, in its group.
"""
import argparse
import json
import math
from pathlib import Path
import random
import subprocess
import sys
import tempfile

from merged_parts import Glb, turned, world


def with_bolts(n_parts, n_bolts):
    """The world of merged_parts, and bolts that are all one Box; every seventh of them is mirrored."""
    r = random.Random(8)
    text, boxes = world(n_parts)
    text += 'DEF Bolts Group { children [\n'
    for i in range(n_bolts):
        at, angle = [round(r.uniform(-50, 50), 3) for _ in range(3)], round(r.uniform(0, 6), 3)
        size, flip = (0.1, 0.1, 0.4), -1 if i % 7 == 3 else 1
        shape = 'Shape { appearance USE Paint2 geometry Box { size 0.1 0.1 0.4 } }'
        text += f' DEF Rack_{i // 10} Transform {{ children [\n' if i % 10 == 0 else ''
        text += f'  DEF Bolt_{i} Transform {{ translation {at[0]} {at[1]} {at[2]} rotation 0 0.6 0.8 {angle} scale 1 1 {flip} children {shape} }}\n'
        text += ' ] }\n' if i % 10 == 9 or i == n_bolts - 1 else ''
        corners = [[c + a for c, a in zip(turned((0, 0.6, 0.8, angle), [size[j] * ((k >> j & 1) - 0.5) for j in range(3)]), at)] for k in range(8)]
        boxes[f'Bolts/Rack_{i // 10}/Bolt_{i}'] = [f(c[j] for c in corners) for f in (min, max) for j in range(3)]
    return text + '] }\n', boxes


def rotated(q, v):
    x, y, z, w = q
    length = math.sqrt(x * x + y * y + z * z)
    angle = 2 * math.atan2(length, w)
    return turned((x / length, y / length, z / length, angle), v) if length > 0 else v


class Table:
    """Rows as paths: "Bolts/Rack_0/Bolt_1"."""

    def __init__(self, glb):
        metadata = glb.json['extensions']['EXT_structural_metadata']
        table = metadata['propertyTables'][0]
        fields = metadata['schema']['classes'][table['class']]['properties']
        size = {'UINT8': 1, 'UINT16': 2, 'UINT32': 4}

        def view(i):
            v = glb.json['bufferViews'][i]
            at = v.get('byteOffset', 0)
            assert at % 8 == 0, 'columns lie at multiples of eight bytes'
            return glb.bin[at:at + v['byteLength']]

        def column(i, width):
            data = view(i)
            return [int.from_bytes(data[k:k + width], 'little') for k in range(0, len(data), width)]

        name, parent = table['properties']['name'], table['properties']['parent']
        offsets = column(name['stringOffsets'], size[name.get('stringOffsetType', 'UINT32')])
        texts = view(name['values'])
        self.names = [texts[a:b].decode() for a, b in zip(offsets, offsets[1:])]
        parents = column(parent['values'], size[fields['parent']['componentType']])
        assert len(self.names) == len(parents) == table['count'] and len(texts) == offsets[-1]
        self.sources = None
        if 'source' in fields:
            named = {v['value']: v['name'] for v in metadata['schema']['enums'][fields['source']['enumType']]['values']}
            self.sources = [named[i] for i in column(table['properties']['source']['values'], 2)]
        nothing = fields['parent']['noData']
        self.paths = []
        for name, p in zip(self.names, parents):
            self.paths.append(name if p == nothing else self.paths[p] + '/' + name)


def corners_by_path(glb):
    """Of every part, by feature ids or as a node; the nodes that are left are in groups with names."""
    table, found = Table(glb), {}
    nodes = glb.json['nodes']

    def place(node, p):
        p = [a * b for a, b in zip(p, node.get('scale', (1, 1, 1)))]
        return [a + b for a, b in zip(rotated(node.get('rotation', (0, 0, 0, 1)), p), node.get('translation', (0, 0, 0)))]

    def visit(id, chain, path):
        node = nodes[id]
        chain = chain + [node]
        if 'name' in node:
            path = path + [node['name']]
        for c in node.get('children', ()):
            visit(c, chain, path)
        if 'mesh' not in node:
            return
        instancing = node.get('extensions', {}).get('EXT_mesh_gpu_instancing')
        for p in glb.json['meshes'][node['mesh']]['primitives']:
            points = glb.accessor(p['attributes']['POSITION'])
            corners = [v for (v,) in glb.accessor(p['indices'])] if 'indices' in p else range(len(points))
            if instancing:
                a = {k: glb.accessor(i) for k, i in instancing['attributes'].items()}
                features = node['extensions']['EXT_instance_features']['featureIds'][0]
                ids = [int(v[0]) for v in a[f"_FEATURE_ID_{features['attribute']}"]]
                assert features['featureCount'] == len(set(ids)) and features['propertyTable'] == 0
                for i, row in enumerate(ids):
                    here = {k.lower(): a[k][i] for k in ('TRANSLATION', 'ROTATION', 'SCALE') if k in a}
                    own = [place(here, points[v]) for v in corners]
                    put(path + [table.paths[row]], chain, own)
            elif 'EXT_mesh_features' in p.get('extensions', {}):
                features = p['extensions']['EXT_mesh_features']['featureIds'][0]
                ids = [int(v[0]) for v in glb.accessor(p['attributes'][f"_FEATURE_ID_{features['attribute']}"])]
                assert features['featureCount'] == len(set(ids)) and features['propertyTable'] == 0
                for v in corners:
                    put(path + [table.paths[ids[v]]], chain, [points[v]])
            else:
                put(path, chain, [points[v] for v in corners])

    def put(path, chain, points):
        for node in reversed(chain):
            points = [place(node, p) for p in points]
        found.setdefault('/'.join(path), []).extend(points)

    for root in glb.json['scenes'][0]['nodes']:
        visit(root, [], [])
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--wrlkit', required=True)
    parser.add_argument('--parts', type=int, default=400)
    parser.add_argument('--bolts', type=int, default=300)
    args = parser.parse_args()
    text, boxes = with_bolts(args.parts, args.bolts)
    faults = []
    with tempfile.TemporaryDirectory() as folder:
        source, made = Path(folder) / 'plant.wrl', Path(folder) / 'plant.glb'
        source.write_text(text)
        for pipeline in ('dedup', 'dedup,merge{instanced=true,max-draws=30}', 'recognise,dedup,instance{forms=true},merge{instanced=true,max-draws=30}'):
            subprocess.run([args.wrlkit, 'convert', '-q', source, made, '-p', pipeline, '--names', 'table'], check=True)
            glb = Glb(made)
            found = corners_by_path(glb)
            for name in random.Random(9).sample(sorted(boxes), 100):
                points = found.get(name, [])
                if len(points) != 36:
                    faults.append(f'{pipeline}: {name}: {len(points)} corners')
                    continue
                box = [f(p[i] for p in points) for f in (min, max) for i in range(3)]
                if max(abs(a - b) for a, b in zip(box, boxes[name])) > 1e-4:
                    faults.append(f'{pipeline}: {name}: fills {box}, not {boxes[name]}')
            print(f'{pipeline}: {len(boxes)} parts in {glb.draws()} draw calls')
            if 'merge' in pipeline and glb.draws() > 30:
                faults.append(f'{glb.draws()} draw calls')
            for compress in ('none', 'quantize', 'meshopt', 'draco'):
                subprocess.run([args.wrlkit, 'convert', '-q', source, made, '-p', pipeline, '--names', 'table', '--compress', compress], check=True)
                report = json.loads(subprocess.run([args.wrlkit, 'diff', '-q', source, made, '--json'], check=True, capture_output=True).stdout)
                if report['names']['missing']:
                    faults.append(f"{pipeline}, {compress}: names missing: {report['names']['missing'][:5]}")
                if report['surface']['max'] > 1e-3:
                    faults.append(f"{pipeline}, {compress}: surfaces are {report['surface']['max']} m apart")
    print('\n'.join(faults[:20]) or 'a hundred parts found by name, twice')
    return 1 if faults else 0


if __name__ == '__main__':
    sys.exit(main())
