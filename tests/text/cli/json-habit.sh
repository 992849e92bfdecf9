set +o pipefail
mkdir -p %t.d/folder && cp %S/inputs/box.wrl %t.d && cp %S/inputs/box.wrl %t.d/folder
cd %t.d
echo nothing > broken.wrl
echo box.wrl > list.txt
cat > kind.py <<'END'
import json, sys
made, words = json.load(sys.stdin), sys.argv[1]
shown = [f'{k} {made[k]}' for k in ('readable', 'written', 'exit_code', 'pictures', 'kind', 'name') if k in made and made[k] is not True]
many = f' of {len(made)}' if isinstance(made, list) and len(made) < 10 else ''
print(f'{words}: {type(made).__name__}{many}' + (' ' + shown[0] if shown and isinstance(made, dict) else ''))
END
kind() {
    wrlkit $1 --json 2> log.txt | python3 kind.py "$1"
}
refused() {
    wrlkit $1 --json > out.txt 2> log.txt
    local code=$?
    cat log.txt out.txt
    echo "$1: $code"
}
set -f
for words in 'info box.wrl' 'check box.wrl' 'info box.wrl box.wrl' 'check box.wrl box.wrl' 'info folder/' 'check folder/' 'info fold*/*.wrl' \
    'check @list.txt' 'info none.wrl' 'check none.wrl' 'info box.wrl none.wrl' 'info box.wrl broken.wrl' 'convert none.wrl o.glb' \
    'optimize none.wrl o.glb' 'cat none.wrl -o o.wrl' 'render none.wrl o.png' 'render box.wrl o.png --width 8 --height 8' \
    'render box.wrl t.png --turntable 2 --width 8 --height 8' 'simplify none.wrl -o o --ratios 0.5' 'tiles broken.wrl -o tiles' \
    'illuminate none.wrl o.xml' 'diff box.wrl none.wrl' 'view none.wrl -o o.html' 'passes weld' passes 'explain Cone' 'explain weld' \
    'explain unknown-node' 'explain Pyramid' docs 'docs recipes' formats; do
    kind "$words"
done
set +e
refused 'cat box.wrl'
refused 'convert box.wrl -'
refused 'info box.wrl --report -'
refused 'convert box.wrl - --report -'
