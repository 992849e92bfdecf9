mkdir -p %t.d/loop
cd %t.d
box() { echo "Transform { translation $1 0 0 children DEF Box_$1 Shape { geometry Box { size 1 1 1 } } }"; }
inline() { echo "Transform { translation $1 0 0 children Inline { url \"$2\" } }"; }
(echo '#VRML V2.0 utf8'; inline 100 part.wrl; inline 200 zip.wrl; box 5; echo 'Anchor { url "other.wrl" children [ ] }') > main.wrl
(echo '#VRML V2.0 utf8'; box 0) > part.wrl
(echo '#VRML V2.0 utf8'; inline 1 part.wrl) | gzip > zip.wrl
(echo '#VRML V2.0 utf8'; box 50) > other.wrl
(echo '#VRML V2.0 utf8'; box 1; inline 10 b.wrl) > loop/a.wrl
(echo '#VRML V2.0 utf8'; box 2; inline 10 a.wrl) > loop/b.wrl
for order in 'main.wrl other.wrl part.wrl zip.wrl' 'zip.wrl part.wrl other.wrl main.wrl'; do
  wrlkit tiles $order -o set -q
  wrlkit tiles $order -o set --json | grep -o '"files":[0-9]*\|"inlined":[^]]*\|"triangles":[0-9]*,"parts":[0-9]*' | head -3
done
echo '-- below a Switch that is off'
mkdir off
(echo '#VRML V2.0 utf8'; box 5; echo 'Switch { choice Inline { url "part.wrl" } }') > off/main.wrl
cp part.wrl off
wrlkit tiles off -o off_set 2>&1 | grep 'inline,\|1 part'
wrlkit tiles off -o off_set --show-all 2>&1 | grep 'inline,\|parts'
echo '-- in circles'
wrlkit tiles loop -o loop_set -q --json 2> log | grep -o '"inlined":[^]]*\|"triangles":[0-9]*' | head -2
grep -o "error: .*" log
echo '-- into the folder of the inputs'
wrlkit tiles off -o off/ 2>&1
ls off
wrlkit tiles off -o off/set -q
wrlkit info off 2>&1 | grep 'passed over'
true
