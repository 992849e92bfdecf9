( echo "#VRML V2.0 utf8"
echo "Transform { translation 5 2 1 children
Shape { appearance Appearance { material Material { emissiveColor 1 1 1 } } geometry Box { } } }" ) > %t.wrl
wrlkit render %t.wrl %t.x.png --turntable 8 --width 40 --height 30 && ls %t.x_0*.png | wc -l
cmp %t.x_000.png %t.x_001.png > %t.out || echo other
cmp %t.x_001.png %t.x_005.png && echo same
