test=$PWD/%s
rm -rf %t && mkdir -p %t && cd %t
cp $test world.wrl
wrlkit convert -q -p 'cull{smaller=40mm,list=list.txt}' world.wrl out.wrl
cat list.txt
echo '--- a list over the input'
wrlkit convert -q -p 'cull{smaller=40mm,list=world.wrl}' world.wrl other.wrl 2>&1
echo "code $?, $(cmp $test world.wrl && echo the input is as it was), $(test -e other.wrl || echo no output)"
echo '--- over what an Inline names'
cp $test part.txt
printf '#VRML V2.0 utf8\nInline { url "part.txt" }\n' > whole.wrl
wrlkit convert -q -p 'cull{smaller=40mm,list=part.txt}' whole.wrl other.glb 2>&1
echo "code $?, $(cmp $test part.txt && echo the input is as it was), $(test -e other.glb || echo no output)"
echo '--- where the output fails, there is no list either'
wrlkit convert -q -p 'cull{smaller=40mm,list=later.txt}' world.wrl world.wrl/other.wrl 2> /dev/null
echo "code $?"
test -e later.txt || echo 'no list'
echo '--- a picture, and a table'
wrlkit render -q -p 'merge{max-draws=1,csv=parts.csv}' world.wrl world.png --width 32 --height 24
cat parts.csv
