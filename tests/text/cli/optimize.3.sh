for p in portable three cesium unity godot; do
    wrlkit optimize -q corpus/plant/pump_room_faces.wrl %t.glb --profile $p
    echo $p $(grep -aoE '(KHR_mesh_quantization|EXT_meshopt_compression)' %t.glb | sort -u)
done
