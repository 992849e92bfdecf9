for verb in info 'info --json' check 'check --json' 'diff %S/inputs/box.wrl' passes formats; do
    wrlkit $verb $(case "$verb" in 
passes | formats)

;;
*)
    echo %S/inputs/box.wrl
;;
esac) > /dev/full 2> %t.err
    echo $? $(grep -c 'standard output' %t.err)
done | uniq
