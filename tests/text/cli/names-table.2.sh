for c in none meshopt; do
    wrlkit convert -q %S/inputs/names_table.wrl %t.glb --names table --compress $c
    wrlkit diff -q --json %S/inputs/names_table.wrl %t.glb |
        python3 -c "
import json,sys
d=json.load(sys.stdin)
print(d['triangles'], d['names'], d['surface']['max']<=0.001)"
done
