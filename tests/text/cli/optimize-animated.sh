mkdir -p %t.d
cd %t.d
echo '#VRML V2.0 utf8
DEF T Transform { children [ DEF P Shape { geometry Box { } } DEF Q Group { children Shape { geometry Cone { } } } ] }
DEF C TimeSensor { } DEF I PositionInterpolator { key [ 0 1 ] keyValue [ 0 0 0 1 0 0 ] }
ROUTE C.fraction_changed TO I.set_fraction
ROUTE I.value_changed TO T.set_translation' > a.wrl
for extras in all none; do
  wrlkit convert -q a.wrl a.glb --extras $extras
  wrlkit optimize -q a.glb o.glb
  wrlkit convert -q o.glb back.wrl
  grep -o 'DEF [TQ] [A-Za-z]*\|ROUTE I.*' back.wrl
done
