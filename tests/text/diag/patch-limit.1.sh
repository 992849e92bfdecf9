printf '#VRML V2.0 utf8\nPointLight { }
Shape { appearance Appearance { material Material { } } geometry
IndexedFaceSet { coord
Coordinate { point [0 0 0, 1000 0 0, 1000 1000 0] } coordIndex [0 1 2] } }' > %t.wrl
wrlkit illuminate %t.wrl %t.xml --max-edge 1 --samples 1 --max-patches 1000
