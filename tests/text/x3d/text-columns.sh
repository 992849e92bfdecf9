mkdir %t
shown() { wrlkit info "$1" --json | grep -o '"triangles":[0-9]*'; }
sed 's/string "خز"/string [ "خ" "ز" ]/' %s > %t/apart.x3dv
sed 's/horizontal FALSE//' %s > %t/line.x3dv
[ "$(shown %s)" = "$(shown %t/apart.x3dv)" ] && [ "$(shown %s)" != "$(shown %t/line.x3dv)" ] && echo same
