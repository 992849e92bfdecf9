mkdir -p %t/in/part %t/in/sounds %t/sister &&
    cp corpus/plant/textures/checker_plate.png %t/in/part/ &&
    cp corpus/plant/textures/checker_plate.png %t/in/part/same.png &&
    printf '#VRML V2.0 utf8\nShape { appearance Appearance { texture ImageTexture { url "checker_plate.png" } } geometry Box { } }' > %t/in/part/box.wrl &&
    cat > %t/in/a.wrl << 'EOF' &&
#VRML V2.0 utf8
PROTO Plate [ field MFString picture "part/same.png" ] { Shape { appearance Appearance { texture ImageTexture { url IS picture } } geometry Box { } } }
Shape { appearance Appearance { texture ImageTexture { url [ "part/checker_plate.png", "http://example.org/a.png" ] } } geometry Box { } }
Inline { url "part/box.wrl" }
Anchor { url "page.html" }
Background { backUrl "part/checker_plate.png" }
Plate { }
EOF
    wrlkit convert %t/in/a.wrl %t/out/b.wrl -p none &&
    grep -hE 'url|Url|picture "' %t/out/b.wrl &&
    (cd %t/out && find . -type f | sort) &&
    mv %t/in %t/gone &&
    wrlkit info %t/out/b.wrl | grep texture &&
    mv %t/gone %t/in &&
    wrlkit convert %t/in/a.wrl %t/sister/b.wrl -p none --link &&
    grep -hE 'url|Url|picture "' %t/sister/b.wrl &&
    wrlkit convert %t/in/a.wrl %t/sister/e.wrl -p none --embed &&
    grep -ohE '(url|Url|picture) .{24}' %t/sister/e.wrl &&
    ls %t/sister &&
    wrlkit convert %t/in/a.wrl %t/sister/c.glb &&
    grep -aohE '(url|Url|picture)" *: *\[[^]]*' %t/sister/c.glb | sort -u &&
    ls %t/sister/c_files
