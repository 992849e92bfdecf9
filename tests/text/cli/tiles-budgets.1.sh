# Five materials of which four differ in colour alone: with two draws they are colours of vertices, with one nothing can be done.
for draws in 16 2 1; do
  wrlkit tiles %S/inputs/colours.wrl -o %t.colours --compress none --tile-draws $draws --json | python3 -c "
import json, sys
said = json.load(sys.stdin)
print($draws, [t['draws'] for t in said['tiles']], said['over'])"
  wrlkit convert %t.colours/tiles-*/r.glb - --format wrl -q | tr '\n' ' ' | grep -o 'Color {[^]]*' | grep -o '[01] [01] [01]' | sort -u | tr '\n' ','
  echo
done
