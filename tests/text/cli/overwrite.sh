# Each command would destroy its input; none may, and none may leave anything beside it.
mkdir -p %t.d
cp %S/inputs/box.wrl %t.d/f.wrl
cp -r corpus/features/billboard.wrl corpus/features/textures %t.d
cd %t.d
cp f.wrl g.wrl
ln -f f.wrl other-name.wrl
ln -sf f.wrl link.wrl
before=$(cat f.wrl g.wrl | cksum)
try() {
  code=0
  "$@" >out.txt 2>&1 || code=$?
  [ "$before" = "$(cat f.wrl g.wrl | cksum)" ] || echo "destroyed by: $*"
  echo "$code $(grep -cE 'overwrite|should end in|were read' out.txt)"
}
{
  try wrlkit convert f.wrl f.wrl
  try wrlkit convert f.wrl ./f.wrl
  try wrlkit convert f.wrl other-name.wrl
  try wrlkit convert f.wrl link.wrl
  try wrlkit optimize f.wrl f.wrl
  try wrlkit optimize f.wrl o.wrl
  try wrlkit view f.wrl -o f.wrl
  try wrlkit view f.wrl -o page.txt
  try wrlkit cat f.wrl -o f.wrl
  try wrlkit illuminate f.wrl f.wrl
  try wrlkit compare-lod f.wrl -o f.wrl
  try wrlkit render f.wrl f.wrl
  try wrlkit convert f.wrl o.glb --report f.wrl
  try wrlkit diff g.wrl f.wrl --report g.wrl
  try wrlkit info f.wrl --report f.wrl
} | sort | uniq -c | tr -s ' '
# A picture of the scene is an input, too, and a backup is kept of what may be replaced.
before=$(cat f.wrl g.wrl textures/* | cksum)
try() {
  code=0
  "$@" >out.txt 2>&1 || code=$?
  [ "$before" = "$(cat f.wrl g.wrl textures/* | cksum)" ] || echo "destroyed by: $*"
  echo "$code $(grep -cE 'files that were read' out.txt)"
}
try wrlkit render billboard.wrl textures/arrows.png --width 8 --height 8
cp f.wrl replaced.wrl
wrlkit convert -q replaced.wrl replaced.wrl --in-place
wrlkit convert -q replaced.wrl replaced.wrl --in-place
cmp f.wrl replaced.wrl.bak && echo kept
rm -r out.txt textures
ls
