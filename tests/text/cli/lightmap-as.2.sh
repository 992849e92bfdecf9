wrlkit simplify -q corpus/features/lightmap.wrl --ratios 0.5 -o %t > /dev/null &&
    ls %t |
    grep png |
    sed 's/_[0-9]*\.baked/_N.baked/' &&
    wrlkit simplify -q corpus/features/lightmap.wrl --ratios 0.5 -o %t.2 --dump > /dev/null &&
    ls %t.2 |
    grep -c png
grep -c 'lightCoord ' %t.2/lightmap_lod.wrl
