in=%S/inputs/box.wrl
{
    wrlkit convert $in %t.glb -p 'weld(tolerance=1)'
    wrlkit convert $in %t.glb -p decimate
    wrlkit convert $in %t.glb -p 'lod{scope=wrold}'
    wrlkit convert $in %t.glb -p 'lod{ratios=0.5:2}'
    wrlkit help lod
    wrlkit
    wrlkit corpus run recipes/plant-web.toml $in -o %t.d --unit in
    wrlkit render $in
    wrlkit render $in %t.png --look-at 1,2
    wrlkit render $in %t.png --field-of-view 200
    wrlkit convert $in %t.glb --profile thre
    wrlkit convert $in %t.glb --profile Three -q
    echo $?
} 2>&1 || true
