for v in '' --fit '--look-at 3,1,2,0,0,0,0,1,0 --field-of-view 60'; do
    wrlkit compare-lod corpus/paper/ellipsoid_hole.wrl -o %t.a.png --counts 452 --criteria melax --size 64 $v > %t.out
    wrlkit render corpus/paper/ellipsoid_hole.wrl %t.b.png --width 64 --height 64 --background 1,1,1 $v
    cmp %t.a.png %t.b.png && echo same
done
