mkdir -p %t
cat > %t/w.wrl <<'VRML'
#VRML V2.0 utf8
WorldInfo { info "about" }
DEF Unit Group { children DEF Pump Shape { tag "P-101" appearance DEF Look Appearance { material DEF Steel Material {} } geometry DEF Form Box {} } }
PROTO Valve [ field SFString tag "" ] { Shape { geometry Sphere {} } }
Valve { tag "V-1" }
Foo { a "b" }
Anchor { url "page.html" children Shape { geometry Cone {} } }
DEF I PositionInterpolator { key 0 keyValue 0 0 0 }
NavigationInfo {}
Fog {}
VRML
wrlkit tiles %t/w.wrl -o %t/out 2>&1 | grep "lost, for"
wrlkit tiles -q %t/w.wrl -o %t/out2 --json 2>/dev/null | python3 -c 'import json, sys; print(json.load(sys.stdin)["lost"])'
