wrlkit convert -q %S/inputs/bolts.wrl %t.gltf --gpu-instancing &&
    python3 -c "
import json
d=json.load(open('%t.gltf'))
t=[n for n in d['nodes'] if 'extensions' in n]
a=d['accessors']
print(len(t), t[0]['extras']['names'], {k: (a[i]['count'], a[i]['type']) for k, i in t[0]['extensions']['EXT_mesh_gpu_instancing']['attributes'].items()})
print([n['name'] for n in d['nodes'] if 'mesh' in n and 'name' in n], d['nodes'][d['animations'][0]['channels'][0]['target']['node']]['name'], 'EXT_mesh_gpu_instancing' in d['extensionsRequired'])"
