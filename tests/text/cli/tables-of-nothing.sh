# Tables that merge and cull are asked for are written whatever there is to say, so that none is left of an earlier run.
mkdir -p %t.d/folder
cd %t.d
printf '#VRML V2.0 utf8\nDEF A Shape { geometry Box { } }\n' > one.wrl
echo old > parts.csv
echo old > gone.txt
wrlkit convert one.wrl x.wrl -p 'merge{csv=parts.csv},cull{list=gone.txt,smaller=1mm}' -Wno-draws-left
cat parts.csv gone.txt
wrlkit convert one.wrl x.wrl -p 'cull{list=gone.txt,smaller=9m}' 2>&1 | grep -oE 'cull has .*'
cat gone.txt
# A folder is no file.
wrlkit convert one.wrl x.wrl -p 'cull{list=folder}'; echo $?
wrlkit convert one.wrl x.wrl --report folder; echo $?
