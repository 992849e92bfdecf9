printf '#VRML V2.0 utf8\nDirectionalLight { direction 0 0 -1 }
Shape { appearance Appearance { material Material { diffuseColor 1 1 1 } texture PixelTexture { image 5 5 1 0x00 0xff 0x00 0xff 0x00 0xff 0x00 0xff 0x00 0xff 0x00 0xff 0x00 0xff 0x00 0xff 0x00 0xff 0x00 0xff 0x00 0xff 0x00 0xff 0x00 } } geometry
IndexedFaceSet { coord
Coordinate { point [-1 -1 0, 1 -1 0, 1 1 0, -1 1 0] } coordIndex [0 1 2 3 -1] } }' > %t.wrl
wrlkit illuminate %t.wrl %t.xml --max-edge 30cm --samples 4 && wrlkit info %t.xml | tail -1
wrlkit convert %t.wrl %t.lit.wrl -p "lightmap{patches=%t.xml}" --dump &&
    grep -o 'lightmapScale 1.0000' %t.lit.wrl
