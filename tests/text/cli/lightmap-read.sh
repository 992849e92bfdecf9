for as in moz emissive occlusion; do
    wrlkit convert -q corpus/features/lightmap.wrl %t.$as.glb --lightmap-as $as
    for mode in preview lightmap; do
        wrlkit render -q %t.$as.glb %t.$as.$mode.png --width 32 --height 24 --mode $mode
        echo $as $mode $(python3 tests/png.py %t.$as.$mode.png)
    done
done
