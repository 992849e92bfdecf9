    mkdir -p %t/plant/units/a &&
        cp corpus/paper/textures/rust.png %t/plant/ &&
        cp tests/text/diag/inputs/above.wrl %t/plant/units/a/ &&
        wrlkit convert %t/plant/units/a/above.wrl %t/out.glb 2>&1 | sed 's/below .*plant/below plant/' &&
        wrlkit info -q %t/out.glb | grep -o 'textures [0-9]*'
    code=0
    wrlkit convert --strict-paths %t/plant/units/a/above.wrl %t/strict.glb > %t/strict.txt 2>&1 || code=$?
    sed -n '1s/.*error/error/p' %t/strict.txt
    echo "exit code $code; files with the picture in them: $(grep -al 'image/png' %t/out.glb %t/strict.glb | sed 's/.*[/]//')"
