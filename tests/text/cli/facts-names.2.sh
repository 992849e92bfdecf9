wrlkit optimize --profile cesium %S/inputs/facts_names.wrl %t.glb 2>&1 | grep '^  different names:'
wrlkit diff -q --json %S/inputs/facts_names.wrl %t.glb |
    python3 -c "
import json,sys
print(json.load(sys.stdin)['names']['missing'])"
