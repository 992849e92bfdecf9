wrlkit convert -q %S/inputs/mirrored_twist.wrl %t.glb -p 'merge{max-draws=1}' &&
    wrlkit diff -q %S/inputs/mirrored_twist.wrl %t.glb --json |
    python3 -c "
import json,sys
d=json.load(sys.stdin)
print(d['triangles'], d['surface']['max']<1e-5)"
