# What is missing is reported where VRML and X3D are written, as it is where glTF is.
mkdir -p %t.d
cd %t.d
printf '#VRML V2.0 utf8\nInline { url "none.wrl" }\nShape { appearance Appearance { texture ImageTexture { url "none.png" } } geometry Box { } }\nInline { url "http://example.org/a.wrl" }\nAnchor { url "none.html" }\n' > a.wrl
for to in b.glb b.wrl b.x3d; do
  wrlkit convert a.wrl $to 2>&1 | grep -o "error: .*"
  wrlkit convert -q a.wrl $to 2> log.txt || echo "$?"
done
