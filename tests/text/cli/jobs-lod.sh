mkdir -p %t &&
    wrlkit convert corpus/plant/pump_room_loose.wrl %t/1.wrl -p weld,lod --jobs 1 &&
    wrlkit convert corpus/plant/pump_room_loose.wrl %t/3.wrl -p weld,lod --jobs 3 &&
    cmp %t/1.wrl %t/3.wrl &&
    echo same
