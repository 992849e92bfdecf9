python3 -c "
print('#VRML V2.0 utf8\nDEF World Transform { scale 0.001 0.001 0.001 children [')
[print(f'DEF P{i} Transform {{ translation {i * 20011.7:.2f} 0 0 scale {-1 if i == 7 else 1} 1 1 children Shape {{ geometry Box {{ size 3 3 9 }} }} }}') for i in range(40)]
print('] }')" > %t.wrl
wrlkit optimize -q --profile cesium %t.wrl %t.glb
wrlkit info -q %t.glb > /dev/null
wrlkit optimize --profile cesium --json %t.wrl %t.glb 2> /dev/null |
    python3 -c "
import json,sys
d=json.load(sys.stdin)
print(d['gltf']['draws'], d['gltf']['instances'], d['names_lost'])"
