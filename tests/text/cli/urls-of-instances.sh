mkdir -p %t.d/in %t.d/out
cd %t.d
wrlkit render -q $OLDPWD/%S/inputs/box.wrl brick.png --width 8 --height 8
cat > in/a.wrl << 'EOF'
#VRML V2.0 utf8
PROTO Wall [ field MFString u "../brick.png" ] {
  Shape { appearance Appearance { texture ImageTexture { url IS u } } geometry Box { } }
}
Wall { u "../brick.png" }
EOF
for ending in wrl x3d; do
    wrlkit convert -q in/a.wrl out/a.$ending
    grep -o 'a_files[^"]*' out/a.$ending
    wrlkit check --strict-paths out/a.$ending
done
