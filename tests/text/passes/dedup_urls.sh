mkdir -p %t/a %t/b
for f in a b; do
    cp corpus/features/textures/arrows.png %t/$f/p.png
    printf '#VRML V2.0 utf8\nShape { appearance Appearance { texture ImageTexture { url "p.png" } } geometry Box {} }\nShape { appearance Appearance { texture ImageTexture { url "p.png" } } geometry Box {} }\n' > %t/$f/x.wrl
done
printf '#VRML V2.0 utf8\nInline { url "a/x.wrl" }\nInline { url "b/x.wrl" }\n' > %t/all.wrl
wrlkit convert %t/all.wrl %t/o.wrl -p inline,dedup --stats 2>&1
