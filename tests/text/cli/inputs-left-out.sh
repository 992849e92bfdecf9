# Of many inputs, what is missing is said and the rest is done.
mkdir -p %t.d/in/below %t.d/empty
printf '#VRML V2.0 utf8\nShape { geometry Box { } }\n' > %t.d/in/a.wrl
cp recipes/plant-web.toml %t.d/r.toml
cd %t.d
cp in/a.wrl in/below/b.wrl
ln -s nowhere.wrl in/gone.wrl
printf 'in/a.wrl\nin/none.wrl\nin/below/b.wrl\n' > list.txt
printf 'in/none.wrl\n' > none.txt
try() {
  code=0
  "$@" > out.txt 2> err.txt || code=$?
  echo "$1 $2 $3: $code"
  grep -E 'wrlkit|error' err.txt || true
}
for inputs in in @list.txt @none.txt empty in/none.wrl; do
  echo "== $inputs"
  try wrlkit info $inputs
  try wrlkit check $inputs
  try wrlkit tiles $inputs -q -o tiles
  try wrlkit view $inputs -o v.html
  try wrlkit render $inputs -q v.png --width 8 --height 8
  rm -rf web
  try wrlkit corpus run r.toml $inputs -q -o web
done
wrlkit info @list.txt in/a.wrl 2> err.txt | grep -c triangles || true
