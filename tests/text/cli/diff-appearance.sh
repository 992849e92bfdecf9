mkdir -p %t.d
cd %t.d
world() {
  echo "#VRML V2.0 utf8
Viewpoint { description \"Front\" position 0 0 $4 } DirectionalLight { intensity $5 }
DEF T Transform { children Shape { appearance Appearance { material Material { diffuseColor $1 transparency $2 } texture PixelTexture { image 1 2 3 0xff0000 $3 } } geometry Box { } } }
Transform { translation 5 0 0 children Shape { appearance DEF A Appearance { material Material { diffuseColor $1 } } geometry Box { } } }
DEF C TimeSensor { } DEF P PositionInterpolator { key [ 0 1 ] keyValue [ 0 0 0 $6 0 0 ] }
ROUTE C.fraction_changed TO P.set_fraction ROUTE P.value_changed TO T.translation"
}
compare() {
  world "$@" > b.wrl
  wrlkit diff a.wrl b.wrl | tail -2
}
world '1 0 0' 0 0xff00 9 1 4 > a.wrl
echo '-- the same, also as glTF and X3D'
for file in a.wrl a.glb a.x3d; do
  test $file = a.wrl || wrlkit convert -q a.wrl $file
  wrlkit diff a.wrl $file | tail -2
done
echo '-- colour'
compare '0 0 1' 0 0xff00 9 1 4
echo '-- rounded'
compare '0.999 0 0.004' 0 0xff00 9 1 4
echo '-- transparency'
compare '1 0 0' 0.5 0xff00 9 1 4
echo '-- picture'
compare '1 0 0' 0 0xfe00 9 1 4
echo '-- Viewpoint'
compare '1 0 0' 0 0xff00 8 1 4
echo '-- light'
compare '1 0 0' 0 0xff00 9 0.5 4
echo '-- animation'
compare '1 0 0' 0 0xff00 9 1 3
echo '-- ROUTEs'
grep -v ROUTE a.wrl > b.wrl
wrlkit diff a.wrl b.wrl | tail -2
compare_with() {
  echo "-- $1"
  sed "$2" a.wrl > b.wrl
  wrlkit diff a.wrl b.wrl | tail -2
}
compare_with 'time of the animation' 's/TimeSensor { }/TimeSensor { cycleInterval 2 loop TRUE }/'
compare_with Background 's/^Viewpoint/Background { skyColor 1 0 0 } &/'
compare_with NavigationInfo 's/^Viewpoint/NavigationInfo { type "FLY" } &/'
compare_with highlights 's/diffuseColor/specularColor 1 1 1 &/'
compare_with 'sharper highlights' 's/diffuseColor/specularColor 1 1 1 shininess 0.8 &/'
compare_with 'shininess without highlights' 's/diffuseColor/shininess 0.8 &/'
compare_with Script 's/^Viewpoint/Script { url "vrmlscript: function f() { }" } &/'
compare_with 'range of a LOD' 's/DEF T Transform/DEF L LOD { range [ 9 ] level Group { } } &/'
echo '-- colours of faces'
for color in '1 0 0' '0 1 0'; do
  echo "#VRML V2.0 utf8
Shape { appearance Appearance { material Material { } } geometry IndexedFaceSet { coord Coordinate { point [ 0 0 0 1 0 0 1 1 0 0 1 0 ] } coordIndex [ 0 1 2 -1 0 2 3 -1 ] colorPerVertex FALSE color Color { color [ 0 0 1 $color ] } } }" > "${color// /}.wrl"
done
wrlkit diff 100.wrl 010.wrl | tail -2
wrlkit diff 100.wrl 010.wrl --json | grep -o '"looks".*'
