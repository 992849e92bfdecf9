mkdir -p %t.d
cd %t.d
json() { python3 -c "
import json, struct, sys
d = open('$1', 'rb').read()
j = json.loads(d[20:20 + struct.unpack_from('<I', d, 12)[0]])
print($2)"; }
echo '-- lines and points are nodes, not places of a table'
echo '#VRML V2.0 utf8
DEF Route Transform { translation 0 0 -5 children Shape { geometry IndexedLineSet { coord Coordinate { point [ 0 0 0 1 0 0 ] } coordIndex [ 0 1 -1 ] } } }
DEF Dots Transform { translation 0 -4 0 children Shape { geometry PointSet { coord Coordinate { point [ 0 0 0 1 0 0 ] } } } }
DEF Box Transform { translation 3 0 0 children Shape { geometry Box { } } }' > lines.wrl
wrlkit optimize -q lines.wrl o.glb --profile cesium
json o.glb "sorted((n.get('name', ''), n.get('translation'), 'extensions' in n) for n in j['nodes'])"
echo '-- few pixels of strong colours'
echo '#VRML V2.0 utf8
Shape { appearance Appearance { texture PixelTexture { image 2 2 3 0xFF0000 0x00FF00 0x0000FF 0xFFFFFF } } geometry Box { } }' > pixels.wrl
wrlkit optimize -q pixels.wrl o.glb
json o.glb "[i['mimeType'] for i in j['images']]"
wrlkit diff pixels.wrl o.glb | grep -o 'colours.*'
echo '-- what a Switch shares with the world is drawn once'
echo '#VRML V2.0 utf8
Switch { choice [
  DEF A Group { children Shape { appearance DEF L Appearance { material Material { } } geometry IndexedFaceSet { coord Coordinate { point [ 0 0 0 1 0 0 1 1 0 ] } coordIndex [ 0 1 2 -1 ] } } }
  DEF B Group { children Shape { appearance USE L geometry IndexedFaceSet { coord Coordinate { point [ 0 0 1 1 0 1 1 1 1 0 1 1 ] } coordIndex [ 0 1 2 3 -1 ] } } }
] }
Transform { translation 5 0 0 children USE A }
Transform { translation 7 0 0 children USE B }' > library.wrl
for passes in 'merge{instanced=true}' 'merge{max-draws=1}' merge; do
  wrlkit convert -q library.wrl o.wrl -p "$passes"
  wrlkit info o.wrl 2> log | grep -o 'triangles [0-9]*'
done
echo '-- OrthoViewpoint in other units'
echo '#X3D V4.0 utf8
PROFILE Immersive
UNIT length cm 0.01
OrthoViewpoint { position 0 0 1000 fieldOfView [ -200 -100 200 100 ] }
Shape { geometry Box { size 100 100 100 } }' > unit.x3dv
sed '/UNIT/d' unit.x3dv > centimetres.x3dv
for words in "unit.x3dv" "centimetres.x3dv --unit cm"; do
  wrlkit convert -q $words o.glb
  json o.glb "[(c['orthographic']['xmag'], c['orthographic']['ymag']) for c in j['cameras']]"
done
wrlkit convert -q o.glb back.x3d
grep -o 'OrthoViewpoint.*' back.x3d
echo '-- opacity of a picture and of the material'
echo '#X3D V4.0 utf8
PROFILE Immersive
Shape { appearance Appearance { material PhysicalMaterial { transparency 0.5 baseTexture PixelTexture { image 2 1 4 0xff0000ff 0x00ff0080 } } } geometry Box { } }
Shape { appearance Appearance { material UnlitMaterial { transparency 0.5 emissiveTexture PixelTexture { image 2 1 4 0xff0000ff 0x00ff0080 } } } geometry Box { } }' > alpha.x3dv
wrlkit convert -q alpha.x3dv o.glb
json o.glb "[(m['alphaMode'], m['pbrMetallicRoughness']['baseColorFactor'][3]) for m in j['materials']]"
wrlkit convert -q o.glb back.x3d
grep -c "transparency='0.5'" back.x3d
echo '#VRML V2.0 utf8
Shape { appearance Appearance { material Material { transparency 0.5 } texture PixelTexture { image 2 1 4 0xff0000ff 0x00ff0080 } } geometry Box { } }' > alpha.wrl
wrlkit convert -q alpha.wrl o.glb
json o.glb "[(m['alphaMode'], m['pbrMetallicRoughness'].get('baseColorFactor')) for m in j['materials']]"
echo '-- two WorldInfos'
echo '#VRML V2.0 utf8
Group { children [ WorldInfo { title "A" info "a" } Shape { geometry Box { } } ] }
WorldInfo { info "b" }' > infos.wrl
wrlkit convert -q infos.wrl o.glb
wrlkit convert -q o.glb back.wrl
wrlkit diff infos.wrl back.wrl | grep -o 'others.*'
echo '-- far from the origin'
echo '#VRML V2.0 utf8
Shape { geometry IndexedFaceSet { solid FALSE coord Coordinate { point [ 0 0 0, 3512355.678 0 0, 3512355.678 3.25 5412345.678, 0 3.25 5412345.678 ] } coordIndex [ 0 1 2 3 -1 ] } }' > far.wrl
wrlkit optimize far.wrl o.glb --tolerance 1mm 2>&1 | grep -o 'positions within [^,]*'
sed 's/5412345.678/1e18/g' far.wrl > farther.wrl
wrlkit diff far.wrl farther.wrl 2> log | grep -o 'surface.*'
grep -o 'error.*' log
echo '-- unlit in glTF'
echo '#VRML V2.0 utf8
PointLight { location 0 3 0 }
Shape { appearance Appearance { texture PixelTexture { image 1 1 3 0xff0000 } } geometry Box { } }' > unlit.wrl
wrlkit convert -q unlit.wrl unlit.glb --extras none
wrlkit convert unlit.glb o.glb -p 'lightmap{quality=draft,max-size=64}' 2>&1 | grep -o 'warning.*'
echo '-- the checkpoint of another bake'
wrlkit convert -q unlit.wrl o.glb -p 'lightmap{quality=draft,max-size=64,checkpoint=kept}'
printf 'wrlkit bake\n01234567tiles of hours' > kept
wrlkit convert unlit.wrl o.glb -p 'lightmap{quality=draft,max-size=64,checkpoint=kept}' 2>&1 | grep -o 'kept.*'
tail -c 14 kept.bak
