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
world hidden_in_proto 'PROTO Roof [ ] { Switch { choice Shape { geometry Box { } } } } Roof { }'
world hidden_proto 'PROTO Bolt [ ] { Shape { geometry Box { } } } Switch { choice Bolt { } }'
world ignored 'PROTO P [ field MFNode a [ ] field MFNode b [ ] ] { Group { } }
P { a DEF G Group { children Group { } } b USE G } P { a USE G b [ USE G Shape { geometry Box { } } ] }'
for name in library lamps hidden by_proto passed inlined hidden_in_proto hidden_proto ignored; do
  wrlkit convert $name.wrl $name.x3d 2>&1 | grep -v '^ '
  echo "$name"
done
wrlkit simplify lamps.wrl --ratios 0.5 -o lamps_simple.wrl 2>&1 | grep -o 'drawn: .*'
code=0
wrlkit tiles lamps.wrl -o tiles > said.txt 2>&1 || code=$?
echo "$code $(grep -o 'drawn: .*' said.txt)"
# Of several inputs, the one that it is about is named.
world box 'Shape { geometry Box { } }'
wrlkit tiles box.wrl library.wrl -o tiles2 2>&1 | grep 'drawn: '
