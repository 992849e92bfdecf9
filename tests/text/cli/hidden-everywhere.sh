# What is hidden is said by every verb that draws, of VRML 1.0, too.
mkdir -p %t.d
cd %t.d
printf '#VRML V2.0 utf8\nShape { geometry Box { } }\nDEF SW_BEAMS Switch { choice Shape { geometry Box { } } }\n' > new.wrl
printf '#VRML V1.0 ascii\nSeparator { Cube { } DEF Parts Switch { Cube { } Cube { } } }\n' > old.wrl
printf '#VRML V2.0 utf8\nDEF All Switch { choice Shape { geometry Box { } } }\n' > all.wrl
said() { grep -oE 'about .* show them|--show-all$|--show-all \[' | sort -u; }
for world in new old; do
  for verb in 'check' 'info' 'convert @ x.glb' 'tiles @ -o tiles' 'render @ x.png --width 8 --height 8' 'view @ -o x.html' \
      'simplify @ --ratios 0.5 -o x.wrl' 'diff @ @' 'illuminate @ x.xml --samples 1 --max-edge 1m'; do
    words=${verb/@/$world.wrl}
    words=${words/@/$world.wrl}
    [ "$words" = "$verb" ] && words="$verb $world.wrl"
    echo "$world ${verb%% *}: $(wrlkit $words 2>&1 | said)"
  done
done
wrlkit tiles -q all.wrl -o tiles2 2>&1 | grep -o 'what there is.*'
for world in new old; do
  wrlkit info $world.wrl --show-all | grep -o 'triangles [0-9]*'
  wrlkit simplify $world.wrl --show-all --ratios 0.99 -o x.wrl --json | grep -o '^."triangles":[0-9]*'
done
wrlkit convert old.wrl x.wrl -p 'switch{Parts=1}' && wrlkit info x.wrl | grep -o 'triangles [0-9]*'
# A child that there is not, of either standard.
printf '#VRML V1.0 ascii\nSwitch { whichChild 5 Cube { } Sphere { } }\n' > no_child_old.wrl
printf '#VRML V2.0 utf8\nSwitch { whichChoice 5 choice [ Shape { geometry Box { } } Shape { geometry Sphere { } } ] }\n' > no_child_new.wrl
for world in no_child_old no_child_new; do
  echo "$world: $(wrlkit convert $world.wrl x.x3d 2>&1 | grep -oE 'wrl:.* show them')"
done
# A pattern that fits nothing leaves it as it is, and --show-all goes with a pattern.
echo "$(wrlkit convert new.wrl x.x3d -p 'switch{SW_X=0}' 2>&1 | grep -oE '\[[a-z-]+\]' | tr '\n' ' ')"
wrlkit convert all.wrl x.glb -p 'switch{All=-1}' --show-all
wrlkit info x.glb | grep -o 'triangles [0-9]*'
