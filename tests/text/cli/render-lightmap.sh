for mode in preview lightmap checker density albedo; do
    wrlkit render corpus/features/lightmap.wrl %t.$mode.png --width 32 --height 24 --mode $mode
done && cat %t.*.png | wc -c | grep -c '^[0-9]\{4,\}$'
