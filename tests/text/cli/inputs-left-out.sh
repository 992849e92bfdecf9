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
  sed -nE '/wrlkit|error/p' err.txt
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
code=0
wrlkit info @list.txt in/a.wrl > out.txt 2> err.txt || code=$?
echo "$code $(grep -c triangles out.txt)"
# A word that means nothing is left out like a file that is not there, wherever it stands.
for inputs in "@gone.txt in/a.wrl" "in/a.wrl @none.txt" "in/a.wrl empty" "empty in/a.wrl" "gone* in/a.wrl"; do
  echo "== $inputs"
  for verb in info check "tiles -q -o tiles" "view -o v.html" render "corpus run -q -o web r.toml"; do
    rm -rf web
    code=0
    case $verb in
      render) wrlkit render -q --width 8 --height 8 $inputs v.png > out.txt 2> err.txt || code=$? ;;
      *) wrlkit $verb $inputs > out.txt 2> err.txt || code=$? ;;
    esac
    echo "$code $(grep -E 'wrlkit|error' err.txt)"
  done
done
# A glob is about what it matches: links that lead nowhere below other names are not its business.
wrlkit info 'in/*a.wrl' 2>&1 | head -1
# A list of many that are not there is not one endless line.
seq 100000 | sed 's/$/.wrl/' > many.txt
for verb in info check "tiles -q -o tiles" "view -o v.html"; do
  code=0
  wrlkit $verb @many.txt > out.txt 2> err.txt || code=$?
  echo "$code $(wc -l < err.txt) $(grep -o '8[.]wrl.*' err.txt)"
done
# A folder in a list is not a file; --include takes paths as they are given, too.
printf 'in/a.wrl\nin/below\n' > mixed.txt
wrlkit info @mixed.txt 2>&1 | grep 'wrlkit\|^in'
for include in 'in/below/*' 'below/*' 'b.wrl' 'other/*'; do
  wrlkit tiles in --include "$include" -o tiles 2>&1 | grep -o '^1 file\|^wrlkit.*'
done
true
