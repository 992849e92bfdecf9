# What stands next to an output stays when it belongs to something else.
mkdir -p %t.d/in
cd %t.d
printf '#VRML V2.0 utf8\nShape { appearance Appearance { texture ImageTexture { url "brick.png" } } geometry Box { } }\nSound { source AudioClip { url "in/ding.wav" } }\n' > in/a.wrl
cp "$OLDPWD"/corpus/plant/textures/checker_plate.png in/brick.png
mkdir in/in
echo sound > in/in/ding.wav
try() {
  code=0
  "$@" > said.txt 2>&1 || code=$?
  sed -n "s/.*\(wrlkit: '\|cannot write '\)[^']*\/out\//\1out\//p;t;/another file/p" said.txt
  echo "$code: $(ls out | tr '\n' ' ')"
}
mkdir out
echo '-- a buffer of another program: before any work'
echo mine > out/a.bin
try wrlkit convert -q in/a.wrl out/a.gltf
try wrlkit optimize -q in/a.wrl out/a.gltf
cat out/a.bin
echo '-- told to; then it is that of the output'
try wrlkit convert -q in/a.wrl out/a.gltf --overwrite
try wrlkit convert -q in/a.wrl out/a.gltf
try wrlkit optimize -q in/a.wrl out/a.gltf --profile portable
echo '-- a picture of another program'
rm -r out
mkdir out
echo mine > out/a_brick.png
try wrlkit convert -q in/a.wrl out/a.gltf
cat out/a_brick.png
rm out/a_brick.png
try wrlkit convert -q in/a.wrl out/a.gltf
cp -r out/a_files kept
echo '-- a copied file of another program'
rm -r out
mkdir -p out/a_files
echo mine > out/a_files/ding.wav
try wrlkit convert -q in/a.wrl out/a.glb
try wrlkit convert -q in/a.wrl out/a.wrl
cat out/a_files/ding.wav
echo '-- the same contents are no harm'
cp kept/ding.wav out/a_files/
try wrlkit convert -q in/a.wrl out/a.glb
try wrlkit convert -q in/a.wrl out/a.glb
