wrlkit convert %S/inputs/box.wrl %t.a.glb --unit mm --up z &&
    wrlkit convert %S/inputs/box.wrl %t.b.glb -p "$(wrlkit convert x y.glb --unit mm --up z --print-pipeline)" &&
    cmp %t.a.glb %t.b.glb &&
    echo same
