wrlkit convert -q -p 'recognise,dedup,instance{forms=true}' %s %t.wrl
wrlkit diff -q --json %s %t.wrl |
    python3 -c 'import json, sys; d = json.load(sys.stdin); print(d["names"]["missing"], d["surface"]["max"] < 0.001)'
