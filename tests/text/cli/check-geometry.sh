cat > %t.wrl << 'EOF' &&
#VRML V2.0 utf8
Shape {
  appearance Appearance { texture ImageTexture { url "absent.png" } }
  geometry IndexedFaceSet { coord Coordinate { point [0 0 0, 1 0 0, 2 0 0] } coordIndex [0 1 2 -1] }
}
EOF
    wrlkit check --quick %t.wrl && wrlkit check %t.wrl
