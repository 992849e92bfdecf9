# What cannot be written has replaced nothing.
mkdir -p %t.d/in %t.d/out/a_files
cd %t.d
printf '#VRML V2.0 utf8\nSound { source AudioClip { url "ding.wav" } }\nShape { geometry Box { } }\n' > in/a.wrl
echo RIFF > in/ding.wav
echo mine > out/a_files/ding.wav
wrlkit convert in/a.wrl out/a.glb 2>&1; echo $?
cat out/a_files/ding.wav
