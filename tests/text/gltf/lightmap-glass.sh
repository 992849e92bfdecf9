for as in base-color emissive moz extras; do
    wrlkit convert -q %s %t.$as.glb --lightmap-as $as
    wrlkit render -q %t.$as.glb %t.$as.png --width 32 --height 24
    echo $as $(python3 tests/png.py %t.$as.png)
done
