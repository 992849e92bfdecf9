# One line a verb of `wrlkit --help`: what it prints with --json where all is well.
cp %S/inputs/box.wrl %t.wrl
mkdir %t.in && cp %t.wrl %t.in/box.wrl
printf 'pipeline = "weld"\n[output]\nformat = "wrl"\n' > %t.toml
words_of() {
    case $1 in
        convert | optimize) echo %t.wrl %t.$1.glb ;;
        info | check) echo %t.wrl ;;
        cat) echo %t.wrl -o %t.cat.wrl ;;
        diff) echo %t.wrl %t.convert.glb ;;
        render) echo %t.wrl %t.png --width 20 --height 20 ;;
        simplify) echo %t.wrl --ratios 0.5 -o %t.simplified ;;
        compare-lod) echo %t.wrl --ratios 0.5 -o %t.lod.html ;;
        illuminate) echo %t.wrl %t.xml --samples 1 --max-edge 1m ;;
        tiles) echo %t.wrl -o %t.tiles ;;
        view) echo %t.wrl -o %t.html ;;
        corpus-run | corpus-plan) echo %t.toml %t.in -o %t.out ;;
        corpus-report) echo %t.out ;;
        passes | formats) ;;
        explain) echo Box ;;
        docs) echo profiles ;;
        completion) echo bash ;;
        manual) ;;
        *) echo --help ;;
    esac
}
what_is() {
    if [ ! -s "$1" ]; then
        echo nothing
    elif python3 -m json.tool < "$1" > %t.null 2>&1; then
        echo JSON
    else
        echo text
    fi
}
for verb in $(wrlkit --help | sed '1,/^Subcommands:/d' | sed 's/^  corpus /  corpus-/' | awk '/^  [a-z]/ { print $1 }'); do
    wrlkit $verb $(words_of $verb) --json > %t.json 2> %t.log || echo "$verb ends with $?: $(head -3 %t.log)"
    echo $verb $(what_is %t.json)
done
