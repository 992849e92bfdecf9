in=%S/inputs/slash_names.wrl
kept() { wrlkit diff -q --json $in "$1" | python3 -c "import json,sys; print(json.load(sys.stdin)['names'])"; }
for options in '-p merge' '--names table' '--profile cesium'; do
    echo "-- $options"
    wrlkit convert -q $options $in %t.glb
    kept %t.glb
    wrlkit convert -q %t.glb %t.wrl
    kept %t.wrl
    grep -o 'DEF [^ ]*[/%][^ ]*' %t.wrl
done
echo '-- tiles'
wrlkit tiles -q $in -o %t.tiles
find %t.tiles -name '*.glb' -exec strings {} + | grep -o 'P/101\|a%2Fb' | sort -u
