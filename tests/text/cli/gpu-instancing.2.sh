for c in none quantize meshopt draco; do
    for e in all none; do
        wrlkit convert -q %S/inputs/bolts.wrl %t.glb --gpu-instancing --compress $c --extras $e
        wrlkit diff -q %S/inputs/bolts.wrl %t.glb --json |
            python3 -c "
import json,sys
d=json.load(sys.stdin)
print('$c $e', d['triangles'], d['names'], d['surface']['max']<=0.001)"
    done
done
