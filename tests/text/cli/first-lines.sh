mkdir -p %t.d
cd %t.d
first() {
  echo "-- $1"
  echo "$1
$2" > world.txt
  wrlkit info world.txt 2>&1 | grep -oE 'world.txt: (vrml|x3d)[^,]*|(warning|error): .*'
}
first '# Notes on VRML 1.0' 'hello world'
first '# Notes on VRML 1.0' 'Separator { Cube { } }'
first '# VRML 1.0' 'Separator { Cube { } }'
first '#vrml v2.0' 'Shape { geometry Box { } }'
first 'PROFILE Interchange' 'Shape { geometry Box { } }'
first '# a comment' 'TriangleSet { }'
