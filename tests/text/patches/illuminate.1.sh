printf '#VRML V2.0 utf8\nPointLight { location 0 1 1 }
Transform { children
DEF Hall
Group { children
DEF Wall
Shape { appearance Appearance { material Material { } } geometry
IndexedFaceSet { coord
Coordinate { point [-1 0 0, 1 0 0, 1 2 0, -1 2 0] } coordIndex [0 1 2 3 -1] } } } }
Shape { appearance Appearance { material Material { } } geometry
IndexedFaceSet { solid FALSE coord
Coordinate { point [-1 0 0, -1 0 2, 1 0 2, 1 0 0] } coordIndex [0 1 2 3 -1] } }' > %t.wrl
for m in path stochastic-iteration progressive-radiosity; do
    wrlkit illuminate %t.wrl %t.1.xml --method $m --max-edge 50cm --samples 16 --jobs 1 &&
        wrlkit illuminate %t.wrl - --method $m --max-edge 0.5 --samples 16 --jobs 2 |
        cmp - %t.1.xml &&
        wrlkit info %t.1.xml |
        sed '1d; s/of [^ ]*wrl, //'
done
head -6 %t.1.xml | cut -c 1-75 | sed 's/source="[^"]*" //'
