# Anchors in .glb lead to what the same run makes of other files; so do those of scenes that became part of it. A path of
# another machine becomes the file of that name next to the input, as it is read, also in VRML.
mkdir -p %t.d/in/sub
cd %t.d
box() { echo 'Shape { geometry Box {} }'; }
cat > in/a.wrl <<X
#VRML V2.0 utf8
Anchor { url "sub/b.wrl#V" children $(box) }
Anchor { url "page.html" children $(box) }
Inline { url "SUB\\\\B.WRL" }
Inline { url "C:\\\\plants\\\\c.wrl" }
X
cat > in/sub/b.wrl <<X
#VRML V2.0 utf8
Anchor { url "../a.wrl" children $(box) }
X
cat > in/c.wrl <<X
#VRML V2.0 utf8
Anchor { url "a.wrl" children $(box) }
X
echo '<p>' > in/page.html
printf '' > r.toml
for format in wrl glb; do
  echo "== $format"
  wrlkit corpus run -q r.toml in -o out/$format --format $format; echo $?
  (cd out/$format && grep -aoE '"?url"?[ :][^]{]*' a.* c.* sub/b.* | cut -d} -f1)
done
