# What --json and --report say, without what depends on the machine.
wrlkit tiles %S/inputs/box.wrl -o %t.set --json --report %t.json | python3 -c "
import json, sys
said = json.load(sys.stdin)
print(said == json.load(open('%t.json'))['tiles'])
print({k: v for k, v in said.items() if k not in ('bytes', 'levels', 'tiles')})
print([(t['file'], t['level'], t['error'], t['triangles'], t['draws'], t['parts']) for t in said['tiles']])"
