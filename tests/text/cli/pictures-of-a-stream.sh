mkdir -p %t.d
cd %t.d
printf '#VRML V2.0 utf8\nShape { geometry Box { } }\n' > box.wrl
wrlkit render box.wrl box.png --width 8 --height 8
printf '#VRML V2.0 utf8\nShape { appearance Appearance { texture ImageTexture { url "box.png" } } geometry Box { } }\n' > a.wrl
printf 'Shape { appearance Appearance { texture ImageTexture { url "none.png" } } geometry Box { } }\n' >> a.wrl
for words in 'cat a.wrl' 'convert a.wrl - --format x3d' 'cat a.wrl --embed' 'cat a.wrl --link' 'cat -q a.wrl' 'cat a.wrl -o b.wrl'; do
    echo "$words"
    wrlkit $words 2> log.txt > out.txt || echo "exit code $?"
    sed '/^ /d' log.txt
done
