mkdir -p %t.d
cd %t.d
cat > far.wrl <<'EOF'
#VRML V2.0 utf8
DEF Pump Transform { translation 500000.5 20 -3000001 children Shape { geometry Box { } } }
DEF Tank Transform { translation 500040 20 -3000000 children [
  DEF Wall Shape { geometry Cylinder { } }
  Transform { translation 5 0 0 children USE Wall }
] }
Group { children DEF Deck Shape { geometry IndexedFaceSet {
  coord Coordinate { point [ 500000 19 -3000000, 500010 19 -3000000, 500010 19 -3000010 ] } coordIndex [ 0 1 2 -1 ] } } }
DEF Clock TimeSensor { cycleInterval 5 loop TRUE }
DEF Way PositionInterpolator { key [ 0 1 ] keyValue [ 500020 20 -3000000, 500025 20 -3000000 ] }
DEF Crane Transform { translation 500020 20 -3000000 children Shape { geometry Sphere { } } }
ROUTE Clock.fraction_changed TO Way.set_fraction
ROUTE Way.value_changed TO Crane.set_translation
EOF
places() {
  python3 -c "
import json, sys
d = json.load(open('$1'))
places = {n['name']: n.get('translation') for n in d['nodes'] if 'name' in n}
print(*(f'{n} {places[n]}' for n in ('Pump', 'Tank', 'Deck')), d['scenes'][0].get('extras', {}).get('vrml97', {}).get('origin'))"
}
back() {
  wrlkit convert -q far.gltf back.wrl
  wrlkit diff -q --json far.wrl back.wrl | python3 -c "
import json, sys
d = json.load(sys.stdin)
print('back:', d['triangles'], 'in place' if d['bounds']['max_delta'] < 0.1 and d['surface']['max'] < 0.1 else 'moved')"
  grep -o 'keyValue.*' back.wrl
}
echo '-- of itself, which is reported'
for extras in all facts none; do
  wrlkit convert far.wrl far.gltf --extras $extras 2>&1 | grep origin
  places far.gltf
  back
done
echo '-- to an origin that files of one plant share; one part stands on it'
wrlkit convert far.wrl far.gltf --origin 500040,20,-3000000 2>&1
places far.gltf
back
wrlkit convert far.wrl far.gltf --origin 500040,20,-3000000 --extras none 2>&1
places far.gltf
back
echo '-- not at all'
wrlkit convert far.wrl far.gltf --origin none 2>&1
places far.gltf
back
echo '-- near scenes stay, unless they are told to move'
printf '#VRML V2.0 utf8\nDEF Pump Shape { geometry Box { } } DEF Tank Shape { geometry Box { } } DEF Deck Shape { geometry Box { } }' > near.wrl
wrlkit convert near.wrl near.gltf
places near.gltf
wrlkit convert near.wrl near.gltf --origin 1,2,3
places near.gltf
wrlkit optimize -q near.wrl near.gltf --profile portable --origin=-.5,0,0
places near.gltf
printf '[output]\norigin = "1,2,3"\n' > recipe.toml
wrlkit convert --recipe recipe.toml near.wrl near.gltf
places near.gltf
echo '-- no origin'
wrlkit convert near.wrl near.glb --origin 1,2
echo $?
wrlkit convert near.wrl near2.wrl --origin 1,2,3
echo $?
