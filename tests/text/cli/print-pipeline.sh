wrlkit render %S/inputs/pipes.wrl %t.a.png --width 32 --height 32 &&
    wrlkit render %S/inputs/pipes.wrl %t.b.png --width 32 --height 32 -p "$(wrlkit render x y.png --print-pipeline)" &&
    cmp %t.a.png %t.b.png &&
    echo same
