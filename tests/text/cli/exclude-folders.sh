# A pattern that names a folder means all below it, "./" means nothing, and a pattern that means nothing is said.
mkdir -p %t.d/src/old %t.d/src/keep/old %t.d/src/rooms
cd %t.d
for name in a old/b keep/old/c rooms/d; do printf '#VRML V2.0 utf8\nShape { geometry Box { } }\n' > src/$name.wrl; done
plan() {
  echo "== $*"
  wrlkit corpus run -q r.toml src -o out "$@" 2>&1
  (cd out && find . -name '*.glb' | sort | tr '\n' ' ')
  echo
  rm -rf out
}
printf '' > r.toml
for pattern in old old/ ./old './old/**' src/old 'old/**' 'o*/' b.wrl 'o*' none; do plan --exclude "$pattern"; done
plan --include ./rooms --include none
