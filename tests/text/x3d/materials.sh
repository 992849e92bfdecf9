wrlkit convert %s %t.gltf &&
    python3 -c "
import json
g = json.load(open('%t.gltf'))
print('\n'.join(json.dumps(x) for k in ('materials', 'cameras') for x in g[k]))
print(g['nodes'][0]['translation'], g['extensionsUsed'])"
