# What lies next to an output belongs to it: it is made again when it is gone, and nothing else is replaced.
mkdir -p %t.d
cd %t.d
shape() { printf '#VRML V2.0 utf8\nShape { appearance Appearance { texture ImageTexture { url "'"$1"'" } } geometry IndexedFaceSet { coord Coordinate { point [0 0 0 1 0 0 1 1 0] } coordIndex [0 1 2 -1] } }\n'; }
picture() { wrlkit render -q "$1.wrl" "$2" --width "$3" --height 8; }
printf '[[pass]]\nname = "weld"\n' > rec.toml
printf '#VRML V2.0 utf8\nBackground { skyColor 1 0 0 } Shape { geometry Sphere { } }\n' > red.wrl
printf '#VRML V2.0 utf8\nBackground { skyColor 0 0 1 } Shape { geometry Box { } }\n' > blue.wrl
box() { printf '#VRML V2.0 utf8\nShape { geometry Box { } }\n' > "$1"; }
run() { wrlkit corpus run rec.toml "$@" 2>&1 | grep -v "^  \|^lost" | sed 's/ in .*//'; }

echo '-- of others'
mkdir m out
picture red m/t.png 8
shape t.png > m/main.wrl
echo precious > out/main.bin
run m -o out --format gltf
cat out/main.bin
run m -o out --format gltf --overwrite > log
cat out/main.bin | head -c 8 | grep -c precious

echo '-- of others, after the first run'
mkdir later
shape none.png > later/a.wrl
run later -o later_out --format gltf
shape none.png > later/b.wrl
echo precious | tee later_out/b.bin > later_out/b.gltf
run later -o later_out --format gltf
cat later_out/b.bin later_out/b.gltf
rm later_out/b.gltf
run later -o later_out --format gltf
cat later_out/b.bin
ls later_out
run later -o later_out --format gltf --overwrite

echo '-- gone'
rm out/main.bin
run m -o out --format gltf
run m -o out --format gltf
ls out

echo '-- pictures of two worlds'
mkdir two
shape 2_t.png > two/a.wrl
shape t.png > two/a_2.wrl
picture red two/t.png 8
picture blue two/2_t.png 16
run two -o two_out --format gltf
for name in a a_2; do wrlkit render two/$name.wrl p.png -q --compare two_out/$name.gltf --width 40 --height 30 | grep -o 'mean [^,]*'; done
mkdir made
picture red made/a.picture_0.png 8
shape a.picture_0.png > made/b.wrl
wrlkit convert -q two/a.wrl made/a.glb
run made -o made_out --format wrl
for name in a.glb b.wrl; do wrlkit render made/$name p.png -q --compare made_out/${name%%.*}.wrl --width 40 --height 30 | grep -o 'mean [^,]*'; done
find two_out made_out -type f -not -path '*.wrlkit*' | sort

echo '-- simplify into one folder'
mkdir s1 s2
cp two/t.png s1/t.png
cp two/2_t.png s2/t.png
shape t.png | sed 's/IndexedFaceSet.*/Cone { } }/' > s1/x.wrl
shape t.png | sed 's/IndexedFaceSet.*/Cone { } }/' > s2/y.wrl
wrlkit simplify -q s1/x.wrl -o levels --ratios 0.5 > log
wrlkit simplify -q s2/y.wrl -o levels --ratios 0.5 > log
grep -ho 'url.*' levels/*_lod.wrl

echo '-- names that are not UTF-8'
mkdir names
shape none.png > names/$(echo -e 'lat\xe9.wrl')
shape none.png > names/$(echo -e 'lat\xe8.wrl')
run names -o names_out
run names -o names_out
wrlkit corpus report names_out --looks 0 --json | tr ',' '\n' | grep lat

echo '-- what lies above the inputs'
mkdir -p above/in/tex above/up
picture red above/up/q.png 8
picture blue above/in/tex/p.png 8
(shape ../up/q.png; shape tex/p.png | tail -1; echo 'Inline { url "../up/part.wrl" }') > above/in/a.wrl
box above/up/part.wrl
run above/in -o above/o1 --format wrl
run above/in -o above/o2 --format wrl --allow-path above/up
grep -ho 'url.*' above/o1/a.wrl above/o2/a.wrl
wrlkit check above/o2/a.wrl --allow-path above/o2 | tail -1
echo '-- a glob'
run 'above/in/*.wrl' -o above/o3 --format wrl --allow-path above/up
find above/o2 above/o3 -type f -not -path '*.wrlkit*' | sort

echo '-- what --exclude takes away'
mkdir -p left/in/parts
box left/in/parts/b.wrl
box left/in/parts/c.wrl
(echo '#VRML V2.0 utf8'; echo 'Inline { url "parts/b.wrl" }'; echo 'Inline { url "parts/c.wrl" }') > left/in/a.wrl
run left/in -o left/out --format wrl --exclude 'parts/b*'
grep -ho 'url.*' left/out/a.wrl
wrlkit check left/out/a.wrl | tail -1
find left/out -type f -not -path '*.wrlkit*' | sort

echo '-- an address elsewhere is not a file of that name'
mkdir -p away/in
box away/in/other.wrl
(echo '#VRML V2.0 utf8'; echo 'Anchor { url [ "other.wrl#A" "http://example.org/other.wrl#B" ] children Shape { geometry Box { } } }') > away/in/a.wrl
run away/in -o away/out --format x3d
grep -ho "url='[^']*'" away/out/a.x3d

echo '-- a folder of inputs below'
mkdir -p p/units
shape none.png | tee p/main.wrl p/units/a.wrl > log
run p -o p/units
run p -o p/new
run p -o p/new
true
