( wrlkit convert %S/inputs/box.wrl %t.2.wrl --recipe %t.d/names.toml --print-recipe > %t.whole.toml ) &&
    wrlkit convert %S/inputs/box.wrl %t.2.wrl --recipe %t.whole.toml 2> %t.err &&
    cmp %t.wrl %t.2.wrl &&
    echo same
