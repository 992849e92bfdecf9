if grep -q __asan_init "$(command -v wrlkit)"; then
  cat <<'END'
error: cannot read 'LARGE': it needs more memory than there is [cannot-read]
3 nothing
error: cannot read 'LARGE': it needs more memory than there is [cannot-read]
1 2 12
END
  exit
fi
mkdir -p %t.in
large=%t.in/large.wrl
{
  echo '#VRML V2.0 utf8'
  echo 'Shape { geometry IndexedFaceSet { coord Coordinate { point ['
  seq -f '%.0f 0 1 1 1 0 0 0 1' 1 600000
  echo '] } coordIndex ['
  seq 0 1799999 | paste -d ' ' - - - | sed 's/$/ -1/'
  echo '] } }'
} > "$large"
cp %S/inputs/box.wrl %t.in/
code=0
wrlkit tiles -q "$large" -o %t.none --memory 100M --jobs 1 2> %t.err || code=$?
sed "s|$large|LARGE|g" %t.err
echo "$code $(test -e %t.none || echo nothing)"
code=0
wrlkit tiles -q %t.in -o %t.set --memory 100M --jobs 1 --report %t.json 2> %t.err || code=$?
sed "s|$large|LARGE|g" %t.err
python3 -c "import json; t = json.load(open('%t.json'))['tiles']; print($code, t['files'], t['triangles'])"
