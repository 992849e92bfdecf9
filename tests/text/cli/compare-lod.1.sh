wrlkit compare-lod corpus/paper/ellipsoid_hole.wrl -o %t.html --counts 300,200 --criteria melax,lindstrom-turk --size 32 --json |
    python3 -c "
import json, sys
d = json.load(sys.stdin)
print(list(d), d['triangles'])
[print(c['name'], [(list(l), l['triangles'], l['rms'] < 0.03, l['max'] < 0.1, 0 < l['normal_degrees'] < 20) for l in c['levels']]) for c in d['criteria']]"
