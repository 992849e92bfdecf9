wrlkit convert %S/inputs/pipes.wrl %t.glb
for flags in --time-passes --stats '--print-after all' --verify-each; do
    wrlkit convert %S/inputs/pipes.wrl %t.2.glb $flags > %t.out 2>&1
    cmp -s %t.glb %t.2.glb || echo "$flags"
done
echo compared
