( echo '#VRML V2.0 utf8'
echo 'Background { skyColor 1 1 1 }' ) > %t.a.wrl
( echo '#VRML V2.0 utf8'
echo 'Background { skyColor 0.2 0.4 0.6 } Viewpoint { position 9 9 9 }' ) > %t.b.wrl
wrlkit render %t.a.wrl %t.png --compare %t.b.wrl --width 60 --height 40
wrlkit render %t.a.wrl %t.png --compare %t.b.wrl --width 60 --height 40 --json --report %t.json
grep -o '"difference":{[^}]*}' %t.json
