# A corpus run does not replace files that no corpus run has made, unless it is told to.
mkdir -p %t.d/src %t.d/out
cd %t.d
printf '#VRML V2.0 utf8\nShape { geometry Box { } }\n' > src/a.wrl
printf '' > recipe.toml
echo mine > out/a.glb
wrlkit corpus run recipe.toml src -o out; echo $?
cat out/a.glb
wrlkit corpus run -q recipe.toml src -o out --overwrite; echo $?
head -c 4 out/a.glb; echo
wrlkit corpus run -q recipe.toml src -o out; echo $?
# A scene where the recipe belongs.
wrlkit corpus run src/a.wrl src -o out; echo $?
