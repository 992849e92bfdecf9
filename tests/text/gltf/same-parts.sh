# Every part comes back to its own place, whatever is shared on the way.
there_and_back() {
  wrlkit $1 -q %S/inputs/same_parts.wrl %t.glb "${@:2}" && wrlkit convert -q %t.glb %t.wrl &&
    echo "$* | $(wrlkit diff -q --json %S/inputs/same_parts.wrl %t.wrl)"
}
{
  there_and_back convert
  there_and_back convert -p instance{forms=true}
  there_and_back convert -p expand-protos
  there_and_back convert --gpu-instancing
  there_and_back convert --extras facts
  there_and_back convert --extras none
  there_and_back convert --extras facts --names table
  there_and_back convert --origin 5,0,0
  there_and_back convert --origin 1e6,2e6,-3e6 --extras none
  there_and_back convert --profile portable
  there_and_back optimize --profile three
  there_and_back optimize --profile cesium
} | python3 -c "
import json, sys
for line in sys.stdin:
    words, facts = line.split(' | ')
    d = json.loads(facts)
    print(words, d['triangles'], 'in place' if d['bounds']['max_delta'] < 0.002 and d['surface']['max'] < 0.002 else 'moved')"
