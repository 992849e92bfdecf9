for as in base-color emissive occlusion moz extras; do
    wrlkit convert -q corpus/features/lightmap.wrl %t.gltf --lightmap-as $as &&
        echo $as $(grep -o 'TEXCOORD_1' %t.gltf |
        sort -u) $(grep -oE '"(emissiveTexture|occlusionTexture|baseColorTexture|MOZ_lightmap|lightmap)":' %t.gltf |
        sort |
        uniq -c)
done
