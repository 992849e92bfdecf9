wrlkit diff -q corpus/plant/pump_room_faces.wrl %t.glb --json |
    python3 -c "
import json,sys
d=json.load(sys.stdin)
print(d['triangles'][0]==d['triangles'][1], d['names'], d['surface']['max']<=0.0012)"
