mkdir -p %t.d
cd %t.d
printf '#VRML V2.0 utf8\nDEF V Viewpoint { description "Front" }\nShape { geometry Sphere { } }\n' > a.wrl
printf '#VRML V2.0 utf8\nShape { geometry IndexedLineSet { coord Coordinate { point [0 0 0, 1 0 0] } coordIndex [0 1 -1] } }\n' > lines.wrl
try() { echo "-- $*"; wrlkit "$@" 2>&1 | sed 's/^\(Usage\|Run\).*//' | head -4; echo "${PIPESTATUS[0]}"; }
small='--width 16 --height 12'
try render a.wrl p.png $small --fit --viewpoint Front
try render a.wrl p.png $small --fit --look-at 0 0 9 0 0 0 0 1 0
try render a.wrl p.png $small --samples 32
try render a.wrl p.png --width 8 --width 9
try convert a.wrl o.glb --texture-quality 10
try convert a.wrl o.glb --print-after merge
try convert a.wrl o.stl --format glb
try convert a.wrl o.glb --recipe a.wrl
try convert a.wrl o.glb --print-recipe --json
try optimize --print-profile --json
try view a.wrl --serve --json
try convert a.wrl o.wrl -p 'weld{tolerance=1,tolerance=2}'
try convert a.wrl o.wrl -p 'weld{tolerance=1}x'
try convert a.wrl o.wrl -p 'lod{ratios=}'
echo '[output]
precision = 3.5' > r.toml
try convert a.wrl o.wrl --recipe r.toml
try simplify a.wrl -o levels --every 100000
try simplify a.wrl -o levels --ratios 1
try simplify lines.wrl -o s.glb --ratios 0.5 -q
try simplify a.wrl --progressive -o sphere.wpm
echo 'summary = "x"
[[pass]]
name = "weld"' > run.toml
printf '\xef\xbb\xbfa.wrl\r\n' > list
try corpus run run.toml @list -o out --base nowhere
wrlkit corpus run -q run.toml @list -o out && ls out
wrlkit corpus report out -q -o - --looks 0 | tail -c 8
