# What was typed in haste is answered before any work, in a line.
mkdir -p %t.d/src
cd %t.d
printf '#VRML V2.0 utf8\nShape { geometry Box { } }\n' > a.wrl
printf '#VRML V2.0 utf8\nShape { geometry Bax { } ' > b.wrl
printf '#VRML V2.0 utf8\nShape { geometry Box { } }\n' > src/$'new\nline.wrl'
printf '' > recipe.toml
echo a.wrl > list
for words in 'convert a.wrl b.wrl c.wrl d.wrl e.wrl f.wrl x.glb' 'convert @list x.glb' 'convert *.wxl x.glb' 'simplify src -o x --ratios 0.5' \
    'tiles a.wrl -o -' 'corpus run recipe.toml a.wrl -o -' 'view a.wrl src -o src' 'render a.wrl x.png --compare src' \
    'convert a.wrl x.glb --compress' 'simplify a.wrl -o x.glb --counts 1e3' 'tiles a.wrl -o tiles --at' 'tiles a.wrl -o tiles --at 50.1:8.6' \
    'simplify a.wrl -o x.iv --ratios 0.5' 'simplify a.wrl -o x.glb --error 0'; do
  wrlkit $words 2>&1; echo "$?"
done
wrlkit tiles a.wrl -o tiles --at '50.1 8.6 112' 2>&1
wrlkit check -q b.wrl
wrlkit simplify -q a.wrl --progressive -o wpm && wrlkit info wpm/a.wpm 2>&1
wrlkit corpus plan recipe.toml src -o out | cut -f 4-
ls
for words in 'tiles a.wrl -o tiles --at 50,8,nan' 'simplify a.wrl -o x.glb --ratios 0.5 --pixels nan' 'convert a.wrl x.wrl -p lod{pixels=0}' \
    'render a.wrl x.png --background 2,0,0' 'render a.wrl x.png --field-of-view nan' 'illuminate a.wrl x.xml --emission nan'; do
  wrlkit $words 2>&1; echo "$?"
done
wrlkit convert a.wrl x.wrl -p 'lod{vanish=1e-320}' && grep -o "range .*" x.wrl
