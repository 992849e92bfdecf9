wrlkit simplify corpus/paper/ellipsoid_hole.wrl --progressive --gzip -o %t --json |
    grep -c bytes &&
    wrlkit simplify corpus/paper/ellipsoid_hole.wrl --progressive -o %t > /dev/null &&
    gzip -dc %t/ellipsoid_hole.wpm.gz |
    cmp - %t/ellipsoid_hole.wpm &&
    echo same
