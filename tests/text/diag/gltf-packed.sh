sed 's/"byteLength": 48/"byteLength": 48, "extensions": {"EXT_meshopt_compression": {"buffer": 0, "byteLength": 48, "byteStride": 12, "count": 4, "mode": "ATTRIBUTES"}}/' tests/gltf/lod.gltf > %t.gltf
wrlkit cat %t.gltf
