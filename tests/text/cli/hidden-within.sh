# What Switches hide in Inlines, prototypes and sets of triangles is said, and --show-all shows it.
mkdir -p %t.d/src
cd %t.d/src
printf '#VRML V2.0 utf8\nDEF SW_A Switch { choice [ Shape { geometry Box { } } Shape { geometry Box { } } ] }\nShape { geometry Box { } }\n' > in.wrl
printf '#VRML V2.0 utf8\nInline { url "in.wrl" }\n' > inline.wrl
printf '#VRML V2.0 utf8\nPROTO P [ field SFInt32 which -1 ] { Switch { whichChoice IS which choice Shape { geometry Box { } } } }\nP { } P { which 0 }\n' > proto.wrl
printf '#X3D V3.3 utf8\nPROFILE Full\nDEF S Switch { children DEF T Shape { geometry TriangleSet { coord Coordinate { point [ 0 0 0 1 0 0 0 1 0 ] } } } }\nUSE T\n' > set.x3dv
for world in inline.wrl proto.wrl set.x3dv; do
  for verb in 'check @' 'info @' 'convert @ ../x.glb' 'diff @ @'; do
    echo "$world ${verb%%%% *}: $(wrlkit ${verb//@/$world} 2>&1 | grep -oE 'about .* off .*\); ' | sort -u)"
  done
  wrlkit info $world --show-all | grep -o 'triangles [0-9]*'
  wrlkit convert $world ../x.glb --show-all
  wrlkit info ../x.glb | grep -o 'triangles [0-9]*'
done
# Files that a text refers to stay as they are, so nothing is said of them.
wrlkit convert inline.wrl ../x.wrl
# A pattern may fit a Switch of an Inline.
wrlkit convert inline.wrl ../x.glb -p 'switch{SW_*=1}' && wrlkit info ../x.glb | grep -o 'triangles [0-9]*'
cd ..
printf '' > recipe.toml
wrlkit corpus run recipe.toml src -o out 2>&1 | sed 's/; [0-9]* s$//'
wrlkit view src -o gallery.html
grep -o '[0-9]* warning.*hidden-geometry' gallery.html
