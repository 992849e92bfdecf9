"""Prints what the animations of a .gltf move: number of keys, and values at the ends and in the middle."""
import base64
import json
from pathlib import Path
import struct
import sys

path = Path(sys.argv[1])
gltf = json.loads(path.read_text('utf-8'))
uri = gltf['buffers'][0]['uri']
data = base64.b64decode(uri.partition(',')[2]) if uri.startswith('data:') else (path.parent / uri).read_bytes()
WIDTH = {'SCALAR': 1, 'VEC2': 2, 'VEC3': 3, 'VEC4': 4}


def rows(index):
    a = gltf['accessors'][index]
    view = gltf['bufferViews'][a['bufferView']]
    width = WIDTH[a['type']]
    flat = struct.unpack_from(f"<{width * a['count']}f", data, view.get('byteOffset', 0) + a.get('byteOffset', 0))
    return [flat[i:i + width] for i in range(0, len(flat), width)]


for animation in gltf['animations']:
    for channel in animation['channels']:
        sampler = animation['samplers'][channel['sampler']]
        target = channel['target']
        name = target.get('extensions', {}).get('KHR_animation_pointer', {}).get('pointer') or target['path']
        times, values = rows(sampler['input']), rows(sampler['output'])
        texts = [' '.join(f'{v + 0.0:.4g}' for v in values[i]) for i in (0, len(values) // 2, -1)]
        print(f'{name}: {len(times)} keys to {times[-1][0]:g} s: {" | ".join(texts)}')
