mkdir -p %t.plant/unit
python3 -c "
import struct, sys, zlib
chunk = lambda kind, data: struct.pack('>I', len(data)) + kind + data + struct.pack('>I', zlib.crc32(kind + data))
sys.stdout.buffer.write(b'\x89PNG\r\n\x1a\n' + chunk(b'IHDR', struct.pack('>IIBBBBB', 1, 1, 8, 2, 0, 0, 0)) + chunk(b'IDAT', zlib.compress(bytes([0, 9, 9, 9]))) + chunk(b'IEND', b''))" >%t.plant/brick.png
echo '#VRML V2.0 utf8
Shape { appearance Appearance { texture ImageTexture { url "../brick.png" } } geometry Box {} }' >%t.plant/unit/wall.wrl
wrlkit tiles -q %t.plant/unit -o %t.set --allow-path %t.plant
echo $?
grep -c image/png %t.set/tiles-*/r.glb
wrlkit tiles -q %t.plant/unit -o %t.set --strict-paths 2>&1 | grep -o url-outside | head -1
test -s %t.set/tiles-*/r.glb && ! grep -q image/png %t.set/tiles-*/r.glb && echo 'a tile without the picture'
