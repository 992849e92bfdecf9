mkdir -p %t.d
cd %t.d
H='#VRML V2.0 utf8'
# Two plates whose long edges meet many short ones.
python3 - > two.wrl << 'EOF'
print('#VRML V2.0 utf8')
for x, y in ((0, 1), (1, 0)):
    points, faces = ['0 0 0', f'{x} {y} 0', f'{x} {y} 8', '0 0 8'], ['0 1 2 3 -1']
    for i in range(8):
        n = len(points)
        points += [f'{x} {y} {i}', f'{2 * x} {2 * y} {i}', f'{2 * x} {2 * y} {i + 1}', f'{x} {y} {i + 1}']
        faces.append(f'{n} {n + 1} {n + 2} {n + 3} -1')
    print(f'Transform {{ translation {5 * x} 0 0 children Shape {{ geometry IndexedFaceSet {{ solid FALSE coord Coordinate {{ point [ {", ".join(points)} ] }} coordIndex [ {" ".join(faces)} ] }} }} }}')
EOF
ball='DEF Ball Shape { geometry Sphere { } }'
echo "$H
$ball Transform { translation 3 0 0 children USE Ball } Transform { translation 6 0 0 children USE Ball }" > use.wrl
echo "$H
$ball Switch { choice Shape { geometry Sphere { radius 2 } } }" > switch.wrl
echo "$H
PROTO Valve [ field SFVec3f size 1 1 1 ] { Transform { scale IS size children Shape { geometry Sphere { } } } }
Valve { size 100 100 100 }" > proto.wrl
(echo "$H"; grep -v '#VRML' proto.wrl | head -1) > library.wrl
echo "$H
EXTERNPROTO Valve [ field SFVec3f size ] \"library.wrl#Valve\"
Valve { size 100 100 100 }" > extern.wrl
same() {
  rm -rf o
  wrlkit simplify "$@" -o o --json -q > o.json 2> log || cat log
  python3 - "$1" << 'EOF'
import json, subprocess, sys
simplified = json.load(open('o.json'))
def info(file):
    text = subprocess.run(['wrlkit', 'info', file, '--json'], capture_output=True, text=True).stdout
    return [json.loads(text)[k] for k in ('triangles', 'unique')]
print([simplified['triangles'], simplified['unique']] == info(sys.argv[1]))
for p in simplified['points']:
    difference = json.loads(subprocess.run(['wrlkit', 'diff', sys.argv[1], p['file'], '--json'], capture_output=True, text=True).stdout)['surface']['max']
    checked = subprocess.run(['wrlkit', 'check', '-q', p['file']], capture_output=True, text=True)
    print([p['triangles'], p['unique']] == info(p['file']), 0.5 * difference <= p['max'] + 1e-9 <= 2 * difference + 1e-8, checked.stdout + checked.stderr)
EOF
}
for world in "two.wrl --ratios 0.5" "two.wrl --counts 20" "use.wrl --error 5cm" "use.wrl --ratios 0.2" "switch.wrl --error 1cm" \
             "proto.wrl --error 1cm" "proto.wrl --ratios 0.2" "extern.wrl --error 10cm"; do
  echo "$world"
  same $world
done
echo '-- levels within a prototype that is scaled'
wrlkit convert -q proto.wrl levels.wrl -p 'weld,lod{errors=1cm}'
grep -c range levels.wrl
wrlkit convert -q proto.wrl levels.wrl -p 'weld,lod{errors=2m}'
grep -c range levels.wrl
echo '-- names'
echo "$H
DEF Tank Transform { children Shape { geometry DEF TankGeo Cylinder { radius 2 height 5 } } }
DEF Bolt Transform { translation 2 2 0 children DEF Bolt_s Shape { geometry DEF BoltGeo Cylinder { radius .01 height .03 } } }" > bolt.wrl
wrlkit simplify bolt.wrl --ratios 0.3 -o o 2>&1 > log | grep lost
wrlkit simplify bolt.wrl --ratios 0.3 -o o.glb 2>&1 > log | grep -c BoltGeo
