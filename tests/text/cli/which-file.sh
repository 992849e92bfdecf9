mkdir -p %t.d
cd %t.d
printf '#VRML V2.0 utf8\nShape { geometry Box {} }\n' > box.wrl
printf '#VRML V2.0 utf8\n' > empty.wrl
wrlkit diff box.wrl empty.wrl 2>&1 | grep warning
wrlkit render box.wrl empty.wrl sheet.png 2>&1 | grep 'warning\|error' || echo "sheet: ${PIPESTATUS[0]}"
wrlkit tiles box.wrl empty.wrl -o set 2>&1 | grep warning
# What other programs need of a glTF file is looked for, also where wrlkit's own extras say it all.
wrlkit convert box.wrl box.gltf
rm box.bin
wrlkit check box.gltf 2>&1 | grep 'error\|warning'
# A tileset.json that is none is no tileset.
mkdir other
echo '{"bad":1}' > other/tileset.json
wrlkit view other/tileset.json -o page.html 2>&1 || echo "view: $?"
