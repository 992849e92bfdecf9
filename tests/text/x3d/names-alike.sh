mkdir -p %t.d
cp %s %t.d/a.x3d
cd %t.d
for out in a.wrl b.x3d c.glb d.gltf; do
  wrlkit convert -q a.x3d $out
  wrlkit convert -q $out back.wrl
  echo "-- $out"
  wrlkit cat -q $out | grep -oE '((DEF|USE) [^ ]+|ROUTE .*)' | tr '\n' ','
  echo
  for file in $out back.wrl; do
    wrlkit diff -q --json a.x3d $file | python3 -c "
import json, sys
d = json.load(sys.stdin)
print('$file', d['names'], d['routes'], 'in place' if d['surface']['max'] < 0.001 else 'moved')"
  done
done
