set +o pipefail
rm -rf %t.empty
mkdir %t.empty
echo nothing to see > %t.text.wrl
for input in %t.empty http://x %t.absent %t.text.wrl
do
    for words in "info $input" "check $input" "tiles $input -o %t.tiles" "render $input %t.png" "convert $input %t.glb" \
        "optimize $input %t.glb" "diff $input $input" "simplify $input --ratios 0.5 -o %t.levels" \
        "illuminate $input %t.xml" "view $input -o %t.html"
    do
        wrlkit $words --json 2> %t.null > %t.json
        code=$?
        python3 -c 'import json, sys; json.load(sys.stdin)' < %t.json || echo "no document: $words"
        [ $code = 3 ] || echo "$code: $words"
    done
done
# An output in a folder that is a file, a corpus run that is not there, plans that make no sense.
echo file > %t.file
cp %S/inputs/box.wrl %t.box.wrl
cp recipes/plant-web.toml %t.toml
for words in "convert %t.box.wrl %t.file/o.glb" "optimize %t.box.wrl %t.file/o.glb" "tiles %t.box.wrl -o %t.file/o" \
    "render %t.box.wrl %t.file/o.png" "view %t.box.wrl -o %t.file/o.html" "cat %t.box.wrl -o %t.file/o.wrl" \
    "render %t.absent %t.none %t.png" "render %t.text.wrl %t.absent %t.png" "simplify %t.box.wrl --ratios 0.5 -o %t.file/o" "compare-lod %t.absent -o %t.lod.html" \
    "corpus run %t.toml %t.box.wrl -o %t.file/o" "corpus report %t.empty" "corpus plan %t.toml %t.absent -o %t.o"
do
    wrlkit $words --json 2> %t.null > %t.json
    code=$?
    python3 -c 'import json, sys; json.load(sys.stdin)' < %t.json || echo "no document: $words"
    [ $code = 3 ] || echo "$code: $words"
done
wrlkit info %t.empty --json 2> %t.null |
    python3 -c 'import json, sys; d = json.load(sys.stdin); print(d["exit_code"], d["messages"][0]["name"])'
