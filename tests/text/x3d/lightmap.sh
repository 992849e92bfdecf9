wrlkit convert -q corpus/features/lightmap.wrl --dump %t.x3d &&
    wrlkit convert -q %t.x3d --dump %t.wrl &&
    wrlkit cat --dump corpus/features/lightmap.wrl |
    grep -v url > %t.1 &&
    grep -v url %t.wrl |
    cmp - %t.1
