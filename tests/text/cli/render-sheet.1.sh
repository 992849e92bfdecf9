mkdir -p %t.d &&
    cp %S/inputs/box.wrl %t.d/a.wrl &&
    cp %S/inputs/box.wrl %t.d/b.wrl &&
    wrlkit render %t.d %S/inputs/box.wrl %t.png --width 60 --height 40 &&
    head -c 24 %t.png |
    tail -c 8 |
    od -An -tu1 |
    xargs
