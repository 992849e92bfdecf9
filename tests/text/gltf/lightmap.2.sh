for packed in quantize draco; do
    wrlkit convert -q corpus/features/lightmap.wrl %t.glb --lightmap-as extras --compress $packed
    wrlkit cat -q --dump %t.glb | grep -c lightCoord
    wrlkit cat -q --dump %t.glb | grep -c 'lightmapTransform'
done
