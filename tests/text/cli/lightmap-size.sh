for size in 4k 16x16; do
    for out in wrl x3d glb; do
        echo $out $(wrlkit convert --print-pipeline corpus/features/lightmap.wrl %t.$out --lightmap-size $size |
            grep -o 'budget=[1-9][0-9]*\|texels=[1-9][0-9]*')
    done
done
echo $(wrlkit convert --print-pipeline corpus/features/lightmap.wrl %t.glb --lightmap-size 4k --lightmap-as emissive --sky mesh |
    grep -oE 'into=lightmap|budget=[1-9][0-9]*|sky')
wrlkit convert --stats -q corpus/features/lightmap.wrl %t.wrl --lightmap-size 16x16 2>&1 | grep texels
