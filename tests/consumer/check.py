"""What the programs of docs/cpp.md have made, in a folder (tests/consumer/run)."""
import json, pathlib, re, struct, sys

folder = pathlib.Path(sys.argv[1])


def glb(name):
    data = (folder / name).read_bytes()
    assert data[:4] == b'glTF', name
    length = struct.unpack_from('<I', data, 12)[0]
    return json.loads(data[20:20 + length]), data[28 + length:]


# convert.cpp: the BMP was decoded and is WebP now.
document, binary = glb('picture.glb')
image, = document['images']
assert image['mimeType'] == 'image/webp', image
view = document['bufferViews'][image['bufferView']]
picture = binary[view.get('byteOffset', 0):][:view['byteLength']]
assert picture[:4] == b'RIFF' and picture[8:12] == b'WEBP' and len(picture) > 30, picture[:16]

# walk.cpp
assert 'picture textures/' in (folder / 'walk.txt').read_text()

# pass.cpp: diffuseColor 1 0.4 0.2, a quarter of it, in linear light.
document, _ = glb('dim.glb')
linear = [((c + 0.055) / 1.055) ** 2.4 if c > 0.04045 else c / 12.92 for c in (0.25, 0.1, 0.05)]
colors = [m.get('pbrMetallicRoughness', {}).get('baseColorFactor', [1, 1, 1, 1])[:3] for m in document['materials']]
assert any(max(abs(a - b) for a, b in zip(c, linear)) < 1e-4 for c in colors), (colors, linear)
assert int((folder / 'pass.txt').read_text().split()[0]) > 0

# make.cpp: what it has made, and the world beside it with its picture.
made = (folder / 'made/made.wrl').read_text()
assert 'DEF Base Transform' in made and 'size 4 1 4' in made
pictures = re.findall(r'url "(.*?)"', made)
assert pictures and all((folder / 'made' / p).is_file() for p in pictures), pictures

# tinygltf_rough.cpp
if (folder / 'rough.glb').exists():
    document, _ = glb('rough.glb')
    assert int((folder / 'rough.txt').read_text().split()[0]) > 0
    assert all(m['pbrMetallicRoughness']['roughnessFactor'] == 0.5 for m in document['materials']), document['materials']

# writer.cpp: a Box has twelve triangles.
assert (folder / 'box.stl').read_text().count('endfacet') == 12
