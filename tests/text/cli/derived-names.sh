# Names that a verb chooses: what another run has written is replaced, a file of other contents with a message.
mkdir -p %t.d/other
cp corpus/paper/ellipsoid_hole.wrl %t.d/e.wrl
cp corpus/paper/stairs_room.wrl %t.d/room.wrl
cd %t.d
simplify="wrlkit simplify e.wrl --ratios 0.2 -o ."
$simplify -q > log.txt
$simplify >> log.txt
echo mine > e_lod.wrl
$simplify >> log.txt
echo '{"asset":{"version":"1.0","generator":"another"}}' > other/tileset.json
code=0
wrlkit tiles -q e.wrl -o other || code=$?
echo "$code $(cat other/tileset.json)"
echo mine > note.txt
wrlkit tiles -q e.wrl -o .
wrlkit tiles -q room.wrl -o .
ls -d other/* tiles-* *.txt *.wrl | sed 's/tiles-.*/tiles-/'
wrlkit illuminate -q room.wrl p.xml --samples 1 --max-edge 2m --pictures textures
first=$(ls textures | head -1)
cp textures/"$first" same.png
echo mine > textures/"$first"
wrlkit illuminate room.wrl p.xml --samples 1 --max-edge 2m --pictures textures 2>&1 | sed 's/textures.*png/PICTURE/'
cmp same.png textures/"$first" && echo made
