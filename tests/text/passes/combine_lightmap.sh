mkdir %t &&
    wrlkit convert %s %t/panel.wrl &&
    cat %t/panel.wrl &&
    ls %t &&
    cp -r %t %t.2 &&
    wrlkit convert %s %t/panel.wrl &&
    cmp %t/panel.wrl %t.2/panel.wrl &&
    cmp %t/panel.baked_0.png %t.2/panel.baked_0.png
