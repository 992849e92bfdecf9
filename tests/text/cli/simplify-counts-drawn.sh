# Triangles as simplify and as info count them.
for name in routed_and_shared inlined_tanks levels_with_more made_by_prototypes; do
  world=tests/text/cli/inputs/$name.wrl
  wrlkit simplify $world --ratios 0.3 --json -q -o %t 2>/dev/null | grep -o '^{"triangles":[0-9]*'
  wrlkit info $world --json -q | grep -o '"triangles":[0-9]*'
done
