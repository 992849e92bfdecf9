mkdir -p %t/in/part %t/out &&
    cp corpus/plant/textures/checker_plate.png %t/in/part/ &&
    printf '#VRML V2.0 utf8\nShape { appearance Appearance { texture ImageTexture { url [ "part/checker_plate.png", "http://example.org/a.png" ] } } geometry Box { } }' > %t/in/a.wrl &&
    wrlkit convert %t/in/a.wrl %t/out/b.wrl &&
    grep -A3 url %t/out/b.wrl &&
    wrlkit info %t/out/b.wrl --allow-path %t
