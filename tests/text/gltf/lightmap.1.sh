for as in moz extras; do
    for extras in all none; do
        wrlkit convert -q corpus/features/lightmap.wrl %t.glb --lightmap-as $as --extras $extras
        wrlkit render corpus/features/lightmap.wrl %t.png --compare %t.glb --width 100 --height 75
    done
done
