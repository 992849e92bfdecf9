for w in tiny_part large_scale; do
    for c in none quantize meshopt draco; do
        wrlkit convert -q %S/inputs/$w.wrl %t.glb --compress $c --tolerance 1mm
        wrlkit diff -q %S/inputs/$w.wrl %t.glb --json |
            python3 -c "
import json,sys
d=json.load(sys.stdin)
print('$w $c', d['triangles'][0]==d['triangles'][1], d['surface']['max']<0.0025)"
    done
done
