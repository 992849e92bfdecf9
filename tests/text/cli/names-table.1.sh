wrlkit convert -q %S/inputs/names_table.wrl %t.gltf --names table &&
    python3 -c "
import json
d=json.load(open('%t.gltf'))
print([n.get('name') for n in d['nodes']])
print(len(d['animations'][0]['channels']), all('node' in c['target'] for c in d['animations'][0]['channels']))
print(d['extensionsUsed'])"
