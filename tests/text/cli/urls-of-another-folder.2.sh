mkdir -p %t/in/a &&
    cp %S/inputs/box.wrl %t/in/a/b.wrl &&
    printf '#VRML V2.0 utf8\nInline { url "a/b.wrl" }' > %t/in/a.wrl &&
    cd %t/in &&
    wrlkit convert a.wrl b.wrl &&
    wrlkit cat a.wrl &&
    cat b.wrl &&
    wrlkit cat ./a.wrl -o ../in/c.wrl &&
    cat c.wrl
