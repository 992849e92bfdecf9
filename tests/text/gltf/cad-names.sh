mkdir -p %t.d
cp %S/inputs/cad_names.wrl %t.d/a.wrl
cd %t.d
compare() {
  wrlkit diff -q --json "$1" "$2" | python3 -c "
import json, sys
d = json.load(sys.stdin)
print('$2', d['names'], 'in place' if d['surface']['max'] < 0.001 else 'moved')"
}
for extras in all facts; do
  wrlkit convert -q a.wrl $extras.glb --extras $extras
  wrlkit convert -q $extras.glb $extras.wrl
  grep -oE '(DEF|USE|ROUTE) .*' $extras.wrl | sed 's/ {.*//'
  compare a.wrl $extras.wrl
done
