for f in corpus/vrml1/*.wrl; do
    wrlkit convert $f %t.wrl 2> /dev/null
    cmp <(wrlkit info $f 2> /dev/null |
        sed -n 2,3p) <(wrlkit info %t.wrl --allow-path corpus/vrml1 2> /dev/null |
        sed -n 2,3p) ||
        echo $f
done
echo done
