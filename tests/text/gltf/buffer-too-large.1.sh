# A buffer of 5 GB of nothing, which takes no place on the disk.
truncate -s 5G %t.bin
cat >%t.gltf <<'EOF'
{"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
 "nodes": [{"mesh": 0, "name": "large"}, {"name": "rest"}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
 "bufferViews": [{"buffer": 0, "byteLength": 36}],
 "buffers": [{"byteLength": 5368709120, "uri": "t.bin"}]}
EOF
wrlkit cat %t.gltf --memory 1G
