for mode in preview lightmap checker density albedo; do
    wrlkit render corpus/features/lightmap.wrl %t.$mode.png --width 32 --height 24 --mode $mode
    echo $mode $(python3 tests/png.py %t.$mode.png)
done
