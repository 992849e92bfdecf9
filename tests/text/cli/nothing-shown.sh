# Worlds that show nothing, and one that does by way of a prototype and an Inline.
mkdir -p %t.d
cd %t.d
world() { { echo '#VRML V2.0 utf8'; echo "$2"; } > "$1.wrl"; }
world library "$(printf "PROTO Bolt [ ] { Shape { geometry Box { } } }\nPROTO Nut [ ] { Shape { geometry Box { } } }")"
world lamps 'PointLight { } PointLight { } Viewpoint { }'
world hidden 'DEF Roof Switch { choice Inline { url "lamps.wrl" } }'
world by_proto 'PROTO Bolt [ ] { Shape { geometry Box { } } } Bolt { }'
world passed 'PROTO At [ field MFNode what [ ] ] { Transform { children IS what } } At { what Shape { geometry Box { } } }'
world inlined 'Inline { url "by_proto.wrl" }'
for name in library lamps hidden by_proto passed inlined; do
  wrlkit convert $name.wrl $name.x3d 2>&1 | grep -v '^ '
  echo "$name"
done
wrlkit simplify lamps.wrl --ratios 0.5 -o lamps_simple.wrl 2>&1 | grep -o 'drawn: .*'
{ wrlkit tiles lamps.wrl -o tiles 2>&1 || true; } | grep -o 'drawn: .*'
