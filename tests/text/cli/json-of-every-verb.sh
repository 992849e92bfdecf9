set +o pipefail
for verb in info 'diff %S/inputs/box.wrl' 'convert %t.glb' 'render %t.png' 'simplify --ratios 0.5 -o %t.d'
do
    set -- $verb
    v=$1
    shift
    case $v in 
        convert | render)
            wrlkit $v %S/inputs/absent.wrl $* --json
        ;;
        *)
            wrlkit $v $* %S/inputs/absent.wrl --json
        ;;
    esac 2>&1 > %t.null | grep -c cannot-read
done | uniq
