# Options of passes that name files: neither an input nor another output, nor what has another format.
mkdir -p %t.d
cp %S/inputs/box.wrl %t.d/f.wrl
printf '[[pass]]\nname = "merge"\ncsv = "parts.csv"\n' > %t.d/each.toml
cd %t.d
echo '<h1>mine</h1>' > page.html
before=$(cat f.wrl page.html | cksum)
try() {
  code=0
  "$@" 2>&1 || code=$?
  [ "$before" = "$(cat f.wrl page.html | cksum)" ] || echo "destroyed by: $*"
  echo "$code"
}
try wrlkit convert f.wrl o.glb -p 'cull{smaller=1,list=f.wrl}'
try wrlkit convert f.wrl o.glb -p 'merge{csv=./f.wrl}'
try wrlkit convert f.wrl o.glb -p 'merge{csv=o.glb}'
try wrlkit convert f.wrl o.glb -p 'cull{smaller=1,list=a.txt},merge{csv=./a.txt}'
try wrlkit convert f.wrl o.glb --report r.json -p 'merge{csv=page.html}'
try wrlkit convert f.wrl o.glb -p 'lightmap{checkpoint=o.glb}'
try wrlkit convert f.wrl o.glb -p 'lightmap{checkpoint=old.wrl}'
try wrlkit render f.wrl f.wrl o.png -p 'merge{csv=a.csv}'
try wrlkit convert f.wrl o.json --format glb --report o.json
try wrlkit corpus run each.toml f.wrl -o out
ln -s later.glb link.json
try wrlkit convert f.wrl later.glb --report link.json
try wrlkit tiles f.wrl -o set --report set/tileset.json
rm link.json
ls
