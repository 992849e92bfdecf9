wrlkit convert -q %S/inputs/far_box.wrl %t.gltf
sed 's/"generator":"[^"]*"/"generator":"another program"/' %t.gltf > %t.other.gltf
cp %t.bin %t.other.bin 2> /dev/null
wrlkit info -q %t.other.gltf | grep from
wrlkit info -q %S/inputs/far_box.wrl | grep from
