# Two materials on one mesh, a level of detail, and a form that is stored as triangles.
mkdir -p %t.d
cd %t.d
cat > a.wrl <<'EOF'
#VRML V2.0 utf8
DEF Red Shape { appearance Appearance { material Material { diffuseColor 1 0 0 } }
  geometry DEF Plate IndexedFaceSet { coord Coordinate { point [ 0 0 0, 1 0 0, 1 1 0, 0 1 0 ] } coordIndex [ 0 1 2 3 -1 ] } }
Transform { translation 2 0 0 children DEF Blue Shape { appearance Appearance { material Material { diffuseColor 0 0 1 } } geometry USE Plate } }
Transform { translation 4 0 0 children USE Blue }
LOD { range 5 level [ Shape { geometry Box { } } Shape { geometry Box { size 1 1 1 } } ] }
EOF
for extras in all facts none; do
  wrlkit convert -q a.wrl a.glb --extras $extras
  wrlkit info -q a.glb | grep triangles
  wrlkit info -q --json a.glb | grep -o '"triangles":[0-9]*,"unique":[0-9]*'
done
wrlkit convert -q a.wrl a.glb --compress draco
wrlkit info -q a.glb | grep triangles
echo '-- merged parts come apart when they are read; they are stored once each'
wrlkit optimize -q a.wrl a.glb --profile cesium
wrlkit info -q a.glb | grep triangles
