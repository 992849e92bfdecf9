"""A .glb as JSON and bytes, and what the import and export change in it."""
import json
import re
import struct
import uuid

JSON, BIN = 0x4E4F534A, 0x004E4942
# On imported objects and materials until the import has found them again.
NODE, MATERIAL = 'wrlkit_node', 'wrlkit_material'
# On objects of one LOD, for good: a text that they share, and of the coarser ones the number of the level.
LOD, LEVEL = 'wrlkit_lod', 'wrlkit_level'
# On objects of which the name is not that of the file: both, as long as nobody has given it another one.
NAMES = 'wrlkit_names'
GIVEN_BY_BLENDER = re.compile(r'(Node|Mesh|Material)_\d+(\.\d+)?')


class Glb:
    def __init__(self, path):
        data = path.read_bytes()
        self.bin = bytearray()
        at = 12
        while at < len(data):
            size, kind = struct.unpack_from('<II', data, at)
            chunk = data[at + 8:at + 8 + size]
            if kind == JSON:
                self.json = json.loads(chunk)
            elif kind == BIN:
                self.bin += chunk
            at += 8 + size

    def write(self, path):
        if self.bin:
            self.json.setdefault('buffers', [{}])[0]['byteLength'] = len(self.bin)
        text = json.dumps(self.json, ensure_ascii=False, separators=(',', ':')).encode()
        chunks = [(JSON, text + b' ' * (-len(text) % 4))]
        if self.bin:
            chunks.append((BIN, bytes(self.bin) + b'\0' * (-len(self.bin) % 4)))
        size = 12 + sum(8 + len(c) for _, c in chunks)
        with open(path, 'wb') as file:
            file.write(struct.pack('<4sII', b'glTF', 2, size))
            for kind, chunk in chunks:
                file.write(struct.pack('<II', len(chunk), kind) + chunk)

    def get(self, kind):
        return self.json.get(kind, [])

    def picture(self, texture):
        """(name, bytes) of the picture of a texture that is part of the file; None for others."""
        texture = self.get('textures')[texture]
        webp = texture.get('extensions', {}).get('EXT_texture_webp', {})
        image = self.get('images')[webp.get('source', texture.get('source'))]
        if 'bufferView' not in image:
            return None
        view = self.get('bufferViews')[image['bufferView']]
        begin = view.get('byteOffset', 0)
        return texture.get('name') or image.get('name') or 'Light', bytes(self.bin[begin:begin + view['byteLength']])

    def add_picture(self, data):
        """Number of a new texture."""
        self.bin += b'\0' * (-len(self.bin) % 4)
        views = self.json.setdefault('bufferViews', [])
        views.append({'buffer': 0, 'byteOffset': len(self.bin), 'byteLength': len(data)})
        self.bin += data
        images = self.json.setdefault('images', [])
        images.append({'bufferView': len(views) - 1, 'mimeType': 'image/jpeg' if data[:2] == b'\xff\xd8' else 'image/png'})
        textures = self.json.setdefault('textures', [])
        textures.append({'source': len(images) - 1})
        return len(textures) - 1


def level_ids(node):
    """The nodes of its coarser levels, finest first."""
    return node.get('extensions', {}).get('MSFT_lod', {}).get('ids', [])


def hang_levels(glb):
    """Makes the coarser levels siblings of the finest one, as Blender knows no MSFT_lod. Returns {node: number of the level}."""
    nodes = glb.get('nodes')
    parents = {child: node for node in nodes for child in node.get('children', [])}
    levels = {}
    for i, node in enumerate(nodes):
        if ids := [k for k in level_ids(node) if k not in levels]:
            family = parents[i]['children'] if i in parents else glb.json['scenes'][glb.json.get('scene', 0)]['nodes']
            family += ids
            lod = str(uuid.uuid4())
            node.setdefault('extras', {})[LOD] = lod
            for number, k in enumerate(ids, 1):
                levels[k] = number
                nodes[k].setdefault('extras', {}).update({LOD: lod, LEVEL: number})
    return levels


def leave_out_unreached(glb):
    """Without nodes that the scene does not reach: Blender shows them all."""
    nodes = glb.get('nodes')
    kept, waiting = set(), list(glb.json['scenes'][glb.json.get('scene', 0)].get('nodes', []))
    while waiting:
        i = waiting.pop()
        if i not in kept:
            kept.add(i)
            waiting += nodes[i].get('children', [])
    number = {old: new for new, old in enumerate(sorted(kept))}
    glb.json['nodes'] = [nodes[i] for i in sorted(kept)]
    for holder, key in [(n, 'children') for n in glb.json['nodes']] + [(s, 'nodes') for s in glb.get('scenes')]:
        if key in holder:
            holder[key] = [number[i] for i in holder[key] if i in number]
    for animation in glb.get('animations'):
        animation['channels'] = [c for c in animation['channels'] if c['target'].get('node', -1) in number]
        for c in animation['channels']:
            c['target']['node'] = number[c['target']['node']]
    glb.json['animations'] = [a for a in glb.get('animations') if a['channels']]


def mark(glb):
    """Says in extras which object of the file is which; what else is in extras becomes text, which Blender keeps as it is."""
    for kind, key in (('scenes', None), ('nodes', NODE), ('meshes', None), ('materials', MATERIAL), ('cameras', None)):
        for i, o in enumerate(glb.get(kind)):
            extras = {k: json.dumps(v) if isinstance(v, (dict, list)) else v for k, v in o.get('extras', {}).items()}
            if key:
                extras[key] = i
            if extras:
                o['extras'] = extras


def unmark(glb):
    """Text in extras and names become again what they were in the file that was imported."""
    for kind in ('scenes', 'nodes', 'meshes', 'materials', 'cameras'):
        for o in glb.get(kind):
            extras = o.get('extras', {})
            for k, v in extras.items():
                if isinstance(v, str) and v[:1] in '{[' and k in ('vrml97', 'wrlkit', 'MSFT_screencoverage'):
                    extras[k] = json.loads(v)
            here, there = json.loads(extras.pop(NAMES, '[null, null]'))
            if o.get('name') == here:
                o['name'] = there
            elif GIVEN_BY_BLENDER.fullmatch(o.get('name', '')):
                o['name'] = None
            if not o.get('name'):
                o.pop('name', None)


def join_levels(glb):
    """Objects of one LOD become levels (MSFT_lod) of its finest one again. A copy of the finest one alone is an object of its own."""
    nodes = glb.get('nodes')
    finest, coarser = {}, {}
    for i, node in enumerate(nodes):
        extras = node.get('extras', {})
        lod, level = extras.pop(LOD, None), extras.pop(LEVEL, 0)
        if level:
            coarser.setdefault(lod, {}).setdefault(level, i)
        elif lod is not None:
            finest.setdefault(lod, i)
    for lod, node in finest.items():
        if ids := [i for _, i in sorted(coarser.get(lod, {}).items())]:
            nodes[node].setdefault('extensions', {})['MSFT_lod'] = {'ids': ids}
            for holder, key in [(n, 'children') for n in nodes] + [(s, 'nodes') for s in glb.get('scenes')]:
                if key in holder:
                    holder[key] = [i for i in holder[key] if i not in ids]
            glb.json['extensionsUsed'] = sorted({*glb.get('extensionsUsed'), 'MSFT_lod'})
