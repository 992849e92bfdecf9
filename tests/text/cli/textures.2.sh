for f in jpeg webp; do
    wrlkit optimize -q tests/text/cli/inputs/pictures.wrl %t.glb --allow-path corpus --texture-format $f &&
        wrlkit render -q tests/text/cli/inputs/pictures.wrl %t.png --allow-path corpus --compare %t.glb --width 200 --height 150 |
        python3 -c "
import sys
print(float(sys.stdin.read().split()[2].strip(',')) < 1.5)"
done
