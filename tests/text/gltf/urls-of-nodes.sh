mkdir -p %t.d/in/part %t.d/out
cd %t.d
cat > in/a.wrl <<'EOF'
#VRML V2.0 utf8
Anchor { url [ "page.html#pump" "http://example.org/" ] children Shape { geometry Box { } } }
Sound { source AudioClip { url "part/ding.wav" } }
Script { url [ "part/run.js" "javascript: function f() {}" ] }
Inline { url "part/more.wrl" }
EOF
cat > in/part/more.wrl <<'EOF'
#VRML V2.0 utf8
Anchor { url "more.html" children Shape { geometry Sphere { } } }
EOF
echo sound > in/part/ding.wav
echo 'function f() {}' > in/part/run.js
urls() { python3 -c "
import sys, re
for text in re.findall(rb'\"url\" ?: ?(\[[^\]]*\])', open('$1', 'rb').read()): print(text.decode())"; }
wrlkit convert -q in/a.wrl out/a.glb
urls out/a.glb
ls out/a_files
echo '-- links to where files are'
mkdir link
wrlkit convert -q in/a.wrl link/a.gltf --link
urls link/a.gltf
echo '-- in the same folder, and for standard output, from that of the input'
wrlkit convert -q in/a.wrl in/a.glb
urls in/a.glb
wrlkit convert -q in/a.wrl - > stream.glb
urls stream.glb
echo '-- and back'
wrlkit convert -q out/a.glb back.wrl
grep -A3 'url' back.wrl
