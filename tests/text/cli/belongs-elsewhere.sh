in=%S/inputs/box.wrl
says() { wrlkit "$@" || echo "exit code $?"; }
{
    says convert $in %t.glb -p 'weld(tolerance=1)'
    says convert $in %t.glb -p decimate
    says convert $in %t.glb -p 'lod{scope=wrold}'
    says convert $in %t.glb -p 'lod{ratios=0.5:2}'
    says help lod
    says
    says corpus run recipes/plant-web.toml $in -o %t.d --unit in
    says render $in
    says render $in %t.png --look-at 1,2
    says render $in %t.png --field-of-view 200
    says convert $in %t.glb --profile thre
    says convert $in %t.glb --profile Three -q
} 2>&1
