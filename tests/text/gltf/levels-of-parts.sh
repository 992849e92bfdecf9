shown() { grep -E '^ *(LOD|Group|DEF.* Group|DEF.* Shape|range)' "$1"; }
wrlkit convert -q %S/inputs/vessels.wrl %t.gltf -p 'weld,lod{scope=world}'
wrlkit convert -q %t.gltf %t.wrl
shown %t.wrl
echo '-- of another program'
sed 's/"vrml97":/"other":/g; s/"generator":"[^"]*"/"generator":"another"/' %t.gltf > %t.b.gltf
wrlkit convert -q %t.b.gltf %t.wrl
shown %t.wrl
