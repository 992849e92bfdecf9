wrlkit optimize corpus/plant/pump_room_faces.wrl %t.glb --tolerance 1mm --json > %t.json 2> /dev/null
python3 -c "
import json, os
d=json.load(open('%t.json'))
q=d['gltf']['quantization']
print(d['profile'], d['names_lost'], d['bytes_after']==os.path.getsize('%t.glb'), q['position']+q['placement']<=q['tolerance'])"
