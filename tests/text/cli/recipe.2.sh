wrlkit convert %S/inputs/pipes.wrl %t.glb --compress meshopt --tolerance 1mm -p "$(< %t.pipeline)" --print-recipe > %t.toml &&
    wrlkit convert %S/inputs/pipes.wrl %t.c.glb --recipe %t.toml &&
    cmp %t.a.glb %t.c.glb &&
    echo same
