printf '#VRML V2.0 utf8\nShape { appearance Appearance { material Material { diffuseColor 1 1 1 } } geometry Box { } }' |
    wrlkit illuminate - - --samples 1 --max-edge 9 --sky 0.5:0.25:0 |
    grep -o -m 1 'rgb=".*'
