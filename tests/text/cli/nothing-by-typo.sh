mkdir -p %t.d
cd %t.d
for text in 'Shape { geometri Box { } }' 'Shap { geometry Box { } }' 'Transform { childern Shape { geometry Box { } } }' \
            'Shape { geometry Bxo { } }' 'Foo { }' 'Switch { choice Shape { geometry Box { } } Foo { } }' \
            'PointLight { foo 3 }' 'PROTO P [ ] { Group { foo 3 } }' 'Viewpoint { }'; do
  (echo '#VRML V2.0 utf8'; echo "$text") > a.wrl
  echo "$text"
  for words in "check a.wrl" "convert a.wrl a.glb -q" "optimize a.wrl a.glb -q" "view a.wrl -o a.html -q" "render a.wrl a.png -q"; do
    code=0
    wrlkit $words > out.txt 2>&1 || code=$?
    echo "$code ${words%% *} $(grep -o 'error: .*' out.txt | head -1)"
  done | sort | uniq
done
