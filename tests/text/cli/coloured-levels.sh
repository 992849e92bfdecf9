mkdir -p %t.d
cd %t.d
# A tank with two bands, a plate with squares, a ball with patches, with a colour for each face; a tank with bands by colours of vertices; one without colours.
python3 - > plant.wrl << 'EOF'
from math import acos, cos, pi, sin
palette = [(1, 1, 1), (0.9, 0.1, 0.1), (0.1, 0.2, 0.8), (0.95, 0.8, 0.1)]
def shape(name, x, points, faces, at_vertices=False):
    text = f'Transform {{ translation {x} 0 0 children DEF {name} Shape {{ appearance Appearance {{ material Material {{ }} }} geometry IndexedFaceSet {{ solid FALSE creaseAngle 0.5 coord Coordinate {{ point [ '
    text += ', '.join('%.6g %.6g %.6g' % p for p in points) + ' ] } coordIndex [ ' + ' '.join('%d %d %d -1' % f[:3] for f in faces) + ' ] '
    if at_vertices:
        of_vertex = {v: f[3] for f in faces for v in f[:3]}
        text += 'color Color { color [ ' + ', '.join('%g %g %g' % palette[of_vertex[i]] for i in range(len(points))) + ' ] } '
    elif len(faces[0]) > 3:
        text += 'colorPerVertex FALSE color Color { color [ ' + ', '.join('%g %g %g' % c for c in palette) + ' ] } colorIndex [ ' + ' '.join(str(f[3]) for f in faces) + ' ] '
    print(text + '} } }')
def grid(n, rows, at, colour):
    points = [at(i / n, row / rows) for row in range(rows + 1) for i in range(n + 1)]
    faces = []
    for row in range(rows):
        for i in range(n):
            k = row * (n + 1) + i
            for t in ((k, k + 1, k + n + 2), (k, k + n + 2, k + n + 1)):
                faces.append(t + ((colour((i + .5) / n, (row + .5) / rows),) if colour else ()))
    return points, faces
tank = lambda u, v: (cos(2 * pi * u), 4 * v, -sin(2 * pi * u))
ball = lambda u, v: (sin(pi * v) * cos(2 * pi * u), -cos(pi * v), -sin(pi * v) * sin(2 * pi * u))
def patch(u, v):
    p = ball(u, v)
    return 1 if p[0] > 0.85 else 2 if p[1] > 0.7 else 3 if p[2] > 0.9 else 0
print('#VRML V2.0 utf8')
shape('Tank', 0, *grid(48, 60, tank, lambda u, v: 1 if .2 < v < .35 else 2 if .6 < v < .75 else 0))
shape('Plate', 3, *grid(24, 24, lambda u, v: (2 * u, 0, 2 * v), lambda u, v: (int(6 * u) + int(6 * v)) % 2 * 3))
shape('Ball', 8, *grid(48, 32, ball, patch))
shape('Vertices', 16, *grid(48, 60, tank, lambda u, v: 1 if .2 < v < .35 else 2 if .6 < v < .75 else 0), True)
shape('Plain', 12, *grid(48, 60, tank, None))
EOF
cat > measure.py << 'EOF'
import json, subprocess, sys
source, file = sys.argv[1:3]
said = json.loads(subprocess.run(['wrlkit', 'diff', '--json', source, file], capture_output=True, text=True).stdout)
looks = said['looks']
palette = {'#ffffff', '#cccccc', '#e61a1a', '#e51a1a', '#1a33cc', '#f2cc1a'}
print('other colours:', sorted({l['look'] for l in looks['made']} - palette))
print('share below', next(s for s in (0.001, 0.01, 0.02, 0.05, 0.2, 1) if looks['share'] <= s))
EOF
echo '-- simplify'
wrlkit simplify plant.wrl --ratios 0.1,0.03 -o o --json -q > o.json
for file in $(python3 -c "import json; print(*[p['file'] for p in json.load(open('o.json'))['points']])"); do
  python3 measure.py plant.wrl $file
done
python3 -c "
import json
print(all(0.001 < p['max'] < 0.2 for p in json.load(open('o.json'))['points']))"
echo '-- a tree of LODs, from afar'
wrlkit convert -q plant.wrl lod.wrl -p 'weld,lod{scope=world,ratios=0.1:0.03,cell-triangles=3000}'
tr '\n' ' ' < lod.wrl | grep -o 'color \[[^]]*\]' | grep -oE '[0-9.]+ [0-9.]+ [0-9.]+' | sort -u
echo '-- tiles'
wrlkit tiles -q plant.wrl -o tiles --triangles 2000 --compress none
wrlkit convert -q tiles/tiles-*/r.glb - --format wrl | tr '\n' ' ' | grep -o 'color \[[^]]*\]' | grep -oE '[0-9.]+ [0-9.]+ [0-9.]+' | sort -u
echo '-- within an error'
wrlkit simplify plant.wrl --error 2cm -o e --json -q > e.json
python3 measure.py plant.wrl $(python3 -c "import json; print(json.load(open('e.json'))['points'][0]['file'])")
