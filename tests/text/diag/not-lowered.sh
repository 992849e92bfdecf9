printf '#X3D V3.3 utf8\nPROFILE Full\nPointLight { location 0 0 3 }\nShape { geometry Circle2D { } }
Shape { geometry Disk2D { } }
Shape { geometry DEF A IndexedTriangleSet { } }' > %t.x3dv &&
    wrlkit convert --dump %t.x3dv %t.b.wrl -p 'lightmap{quality=draft,max-size=64}'
