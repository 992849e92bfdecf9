mkdir -p %t.d/a/tex %t.d/b/tex
cd %t.d
page() { echo "#VRML V2.0 utf8"; echo "Shape { appearance Appearance { texture PixelTexture { image 1 1 3 $1 } } geometry Box { } }"; }
page 0xFF0000 > red.wrl
page 0x0000FF > blue.wrl
for color in red blue; do
  wrlkit convert $color.wrl $color.gltf -q
done
cp red*.png a/tex/wood.png
cp blue*.png b/tex/wood.png
printf '#VRML V2.0 utf8\nShape { appearance Appearance { texture ImageTexture { url "tex/wood.png" } } geometry Box { } }\n' > a/w.wrl
wrlkit convert a/w.wrl b/w.glb -q
wrlkit convert a/w.wrl b/w.gltf -q
wrlkit convert b/w.glb b/back.wrl -q
for file in w.glb w.gltf back.wrl; do
  wrlkit render a/w.wrl x.png --compare b/$file --width 32 --height 24 -q
done
