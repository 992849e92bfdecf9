mkdir -p %t &&
    wrlkit convert corpus/plant/pump_room_loose.wrl %t/1/w.wrl -p weld,lod --jobs 1 &&
    wrlkit convert corpus/plant/pump_room_loose.wrl %t/3/w.wrl -p weld,lod --jobs 3 &&
    cmp %t/1/w.wrl %t/3/w.wrl &&
    echo same
