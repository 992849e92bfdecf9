# One world for each program.
run() {
  cat >%t.wrl <<END
#VRML V2.0 utf8
DEF G Group { }
DEF P Switch { whichChoice -1 choice Shape { appearance Appearance { material DEF M Material { } } geometry Box { } } }
DEF S Script { directOutput ${3:-TRUE} field SFNode g USE G field SFNode p USE P field SFNode m USE M eventOut SFInt32 which
  url "javascript: function initialize() { which = 0; $2 }" }
ROUTE S.which TO P.whichChoice
END
  echo "== $1"
  timeout 60 wrlkit convert %t.wrl %t.out.wrl -p startup 2>&1
  grep '^ whichChoice' %t.out.wrl || echo 'whichChoice -1'
}
run loop 'while (true) { }'
run string "var s = 'x'; while (true) s += s;"
run recursion 'function f() { f(); } f();'
run list 'new MFVec3f()[5000000];'
run nodes "for (;;) Browser.createVrmlFromString('Group { children [ Group { } Group { } ] }');"
run nested 'g.children = new MFNode(g);'
run syntax 'var = 1;'
run refused "Browser.loadURL(new MFString('http://example.org/x.wrl'), new MFString());"
run direct 'p.whichChoice = 0;' FALSE
run value 'm.transparency = 2;'
