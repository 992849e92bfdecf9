wrlkit convert %S/inputs/pipes.wrl %t.a.glb --recipe recipes/plant-web.toml &&
    wrlkit convert %S/inputs/pipes.wrl %t.b.glb --compress meshopt --tolerance 1mm -p "$(< %t.pipeline)" &&
    cmp %t.a.glb %t.b.glb &&
    echo same
