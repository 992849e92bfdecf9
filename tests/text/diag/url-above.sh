    mkdir -p %t/plant/units/a &&
        cp corpus/paper/textures/rust.png %t/plant/ &&
        cp tests/text/diag/inputs/above.wrl %t/plant/units/a/ &&
        wrlkit convert %t/plant/units/a/above.wrl %t/out.glb 2>&1 | sed 's/below .*plant/below plant/' &&
        { wrlkit convert --strict-paths %t/plant/units/a/above.wrl %t/strict.glb 2>&1 || true; } | head -1 | sed 's/.*error/error/' &&
        wrlkit info -q %t/out.glb | grep -o 'textures [0-9]*'
