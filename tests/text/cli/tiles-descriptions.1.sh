python3 -c "
print('#VRML V2.0 utf8')
for i in range(40): print('Transform { translation %d 0 %d children Shape { geometry Sphere {} } }' % (3 * (i % 8), 3 * (i // 8)))" >%t.wrl
for n in 500 6; do
  wrlkit tiles %t.wrl -o %t.set --tile-triangles 1000 --tileset-tiles $n --json | python3 -c "
import json, sys
said = json.load(sys.stdin)
print(len(said['tiles']), said['descriptions'])"
  ls %t.set/tiles-* | grep json
  grep -o '"uri":"[^"]*json"' %t.set/tileset.json | sed 's/tiles-[0-9a-f]*/TILES/'
done
for f in %t.set/tiles-*/*.json; do grep -o '"uri":"[^"]*"' $f | tr '\n' ' '; done
