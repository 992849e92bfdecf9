# Links in VRML and X3D outputs lead to what has come along by its new name, and to all else where it is.
mkdir -p %t.d/in/sub %t.d/in/left
cd %t.d
cat > in/a.x3d <<'X'
<X3D profile='Immersive' version='3.3'><Scene>
<ExternProtoDeclare name='P' url='"sub/b.x3d#P.1"'/><ProtoInstance name='P'/>
<Anchor url='"page.html#top"'/><Anchor url='"sub/b.x3d#View.2"'/><Anchor url='"left/c.wrl#V.1" "http://example.org/left/c.wrl"'/>
<Anchor url='"#View.1"'/><Anchor url='"gone.html"'/><Anchor url='"dots.png"'/><Anchor url='"mailto:a@example.org"'/>
<Viewpoint DEF='View.1'/></Scene></X3D>
X
cat > in/sub/b.x3d <<'X'
<X3D profile='Immersive' version='3.3'><Scene>
<ProtoDeclare name='P.1'><ProtoBody><Group/></ProtoBody></ProtoDeclare>
<Viewpoint DEF='View.2'/><Anchor url='"../page.html"'/></Scene></X3D>
X
printf '#VRML V2.0 utf8\nDEF V.1 Viewpoint { }\nAnchor { url "../a.x3d#View.1" }\n' > in/left/c.wrl
echo '<p id=top>' > in/page.html
printf x > in/dots.png
printf '' > r.toml
for format in wrl x3d; do
  echo "== $format"
  wrlkit corpus run -q r.toml in -o new/$format --format $format --exclude left; echo $?
  (cd new/$format && grep -hoE "(url|PROTO|ProtoDeclare|DEF)[ =][^>{]*" a.* sub/b.* | sort)
done
