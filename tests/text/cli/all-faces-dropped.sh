mkdir -p %t.d
cd %t.d
shape() { printf '#VRML V2.0 utf8\nShape { geometry '"$2"' }\n' > "$1.wrl"; }
shape faces 'IndexedFaceSet { coord Coordinate { point [0 0 0, 1 0 0, 1 1 0] } coordIndex [7 8 99 -1] }'
shape grid 'ElevationGrid { xDimension 3 zDimension 3 height [0 1] }'
shape later 'IndexedFaceSet { }'
shape box 'Box { }'
for name in faces grid later box; do
  echo "$name"
  for words in "convert $name.wrl o.glb" "render $name.wrl o.png" "view $name.wrl -o o.html" "optimize $name.wrl q.glb" "check $name.wrl"; do
    wrlkit $words -q 2>&1 | grep -o 'error.*'
    echo "${words%% *}: ${PIPESTATUS[0]}"
  done
done
wrlkit render faces.wrl box.wrl o.png -q 2>&1 | grep -o '^[a-z.]*:\|error.*' || echo "sheet: ${PIPESTATUS[0]}"
