mkdir -p %t.d
cd %t.d
cat > two.wrl <<'END'
#VRML V2.0 utf8
PointLight { location 0 3 3 }
Transform { translation -1.5 0 0 children DEF A Shape { appearance Appearance { material DEF M Material { } texture DEF T PixelTexture { image 2 1 3 0xFF0000 0x0000FF } textureTransform TextureTransform { scale 2 1 } } geometry Box { } } }
Transform { translation 1.5 0 0 children DEF B Shape { appearance Appearance { material USE M texture USE T } geometry Box { } } }
END
set +e
draws() {
  wrlkit tiles two.wrl -o set --json "$@" 2> err.txt | python3 -c 'import json, sys; t = json.load(sys.stdin)["tiles"]; print(len(t), t[0]["draws"], t[0]["parts"])'
  wrlkit render "$like" apart.png --compare set/tiles-*/r.glb --json --width 64 --height 48 --look-at 0 2 8 0 0 0 0 1 0 -q |
    python3 -c 'import json, sys; print("differs by", round(json.load(sys.stdin)["mean"]))'
}
# A TextureTransform is part of the texture coordinates.
grep -v PointLight two.wrl > unlit.wrl
like=unlit.wrl
draws
# Light is that of convert, whether it is baked here or was before.
wrlkit convert two.wrl lit.glb -q -p 'lightmap{quality=draft,max-size=64}'
like=lit.glb
draws -p 'lightmap{quality=draft,max-size=64}'
wrlkit convert two.wrl lit.wrl -q --dump -p 'lightmap{quality=draft,max-size=64}'
mv lit.wrl two.wrl
draws
wrlkit tiles two.wrl -o set -p lightmp 2>&1
echo $?
wrlkit tiles two.wrl -o set -p 'cull{smaller=100}' -q 2> err.txt
echo $?
