( echo "#VRML V2.0 utf8"
echo "LOD { range [ 5, 10 ] level [
Shape { geometry Box { } }
Shape { geometry Sphere { } }
Shape { geometry Cone { } } ] }" ) > %t.wrl
for level in 0 1 2 7 auto; do
    wrlkit render %t.wrl %t.$level.png --level $level --width 40 --height 30 --look-at 0,0,7,0,0,0,0,1,0
done
wrlkit render %t.wrl %t.png --width 40 --height 30 --look-at 0,0,7,0,0,0,0,1,0
for pair in "0 1" "1 2" "2 7" "1 auto"; do
    set -- $pair
    cmp -s %t.$1.png %t.$2.png && echo same || echo other
done
cmp %t.png %t.0.png && echo same
