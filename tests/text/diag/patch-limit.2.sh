sed 's/IndexedFaceSet {/& solid FALSE/; s/1000/1e9/g' %t.wrl > %t.2.wrl
wrlkit illuminate %t.2.wrl %t.xml --max-edge 1mm --samples 1 --max-patches 1000 -Wno-patch-limit &&
    wrlkit info %t.xml --json |
    grep -o '"patches":[0-9]*,"back":[0-9]*'
