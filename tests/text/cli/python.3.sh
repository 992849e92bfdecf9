printf 'import wrlkit\n\ndef f(:\n' > %t.d/syntax.py
printf 'import wrlkit\n\n@wrlkit.pass_\ndef weld(world):\n    pass\n' > %t.d/taken.py
printf 'raise SystemExit(0)\n' > %t.d/ends.py
for f in syntax taken ends absent; do
    printf "python = '$f.py'\n" > %t.d/$f.toml
    wrlkit convert %S/inputs/box.wrl %t.4.glb --recipe %t.d/$f.toml 2>&1 | head -1 | sed 's/.*error: //'
done
wrlkit cat %S/inputs/box.wrl --python %t.d/absent.py 2>&1 | sed "s/'.*'/FILE/"
