mkdir -p %t/in/part && cp corpus/plant/textures/checker_plate.png %t/in/part/ &&
    printf '#VRML V2.0 utf8\nShape { appearance Appearance { texture ImageTexture { url "checker_plate.png" } } geometry Box { } }' > %t/in/part/box.wrl &&
    wrlkit convert -q %t/in/part/box.wrl %t/in/tank.gltf && rm -r %t/in/part &&
    printf '#VRML V2.0 utf8\nInline { url "tank.gltf" }' > %t/in/a.wrl &&
    wrlkit convert %t/in/a.wrl %t/out/b.wrl -p none &&
    grep url %t/out/b.wrl &&
    (cd %t/out && find . -type f | sort) &&
    mv %t/in %t/gone &&
    wrlkit info --json %t/out/b.wrl | python3 -c 'import json, sys
i = json.load(sys.stdin)
print(i["triangles"], "triangles, picture", "found" if i["textures"][0]["found"] else "missing")'
