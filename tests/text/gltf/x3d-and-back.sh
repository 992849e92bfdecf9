# What only X3D has comes back from wrlkit's own GLB, and looks the same.
mkdir -p %t.d
cp tests/text/gltf/inputs/*.png %t.d/dots.png 2> /dev/null || cp $(find corpus tests -name '*.png' | sort | head -1) %t.d/dots.png
cd %t.d
dots='ImageTexture { url "dots.png" }'
look() {
  echo "#X3D V4.0 utf8
PROFILE Full
Shape { appearance Appearance { $1 } geometry $2 }" > a.x3dv
  back
}
back() {
  wrlkit convert -q a.x3dv a.glb && wrlkit convert -q a.glb b.x3d
  grep -oE "<(Physical|Unlit)?Material[^>]*|<Appearance [^>]*|<[A-Za-z]*Viewpoint[^/]*|<ColorRGBA[^/]*|containerField='[a-zA-Z]*|<ROUTE.*" b.x3d
  for file in a.glb b.x3d; do wrlkit render -q a.x3dv p.png --compare $file --width 80 --height 60 | grep -o 'mean [^,]*'; done
}
look 'material PhysicalMaterial { metallic 0.5 roughness 0.3 baseColor 1 0 0 }' 'Sphere { }'
look "material DEF PM PhysicalMaterial { roughness 0.5 transparency 0.5 normalScale 0.5 baseTexture $dots normalTexture $dots }" 'Box { }'
look "material Material { diffuseColor 1 1 0 emissiveColor 0.2 0 0 normalTexture $dots emissiveTexture $dots }" 'Box { }'
look "material UnlitMaterial { emissiveColor 1 1 0 transparency 0.25 emissiveTexture $dots }" 'Box { }'
look "material UnlitMaterial { transparency 0.25 emissiveTexture $dots }" 'Box { }'
look 'alphaMode "MASK" alphaCutoff 0.3 material Material { transparency 0.6 }' 'Box { }'
look 'material Material { }' 'TriangleSet { coord Coordinate { point [ 0 0 0 1 0 0 1 1 0 ] } color ColorRGBA { color [ 1 0 0 1 0 1 0 0.5 0 0 1 0.2 ] } }'
cat > a.x3dv <<'X'
#X3D V4.0 utf8
PROFILE Full
Viewpoint { description "P" position 0 0 5 centerOfRotation 1 2 3 nearDistance 0.1 }
OrthoViewpoint { description "O" position 0 0 9 fieldOfView [ -2 -1 2 1 ] centerOfRotation 4 5 6 }
Shape { geometry Box { } }
X
back
cat > a.x3d <<'X'
<X3D profile='Immersive' version='4.0'><Scene><Transform DEF='Cube.001'><Shape><Box/></Shape></Transform><Group DEF='NULL'/>
<TimeSensor DEF='Clock.1' loop='true'/><PositionInterpolator DEF='PI' key='0 1' keyValue='0 0 0 1 0 0'/>
<ROUTE fromNode='Clock.1' fromField='fraction_changed' toNode='PI' toField='set_fraction'/>
<ROUTE fromNode='PI' fromField='value_changed' toNode='Cube.001' toField='translation'/></Scene></X3D>
X
wrlkit convert -q a.x3d a.glb && wrlkit convert -q a.glb b.x3d && grep -oE '<ROUTE.*' b.x3d
wrlkit convert -q a.x3d a.wrl && grep -E '^DEF|^ROUTE' a.wrl && wrlkit check a.wrl
# --embed makes baked light and pictures of a GLB part of the file.
mkdir alone
printf '#VRML V2.0 utf8\nPointLight { location 0 3 3 }\nShape { appearance Appearance { material Material { } } geometry Box { } }\n' > lit.wrl
wrlkit convert -q lit.wrl alone/lit.wrl --embed -p 'lightmap{quality=draft,max-size=64}'
wrlkit convert -q lit.wrl alone/lit.x3d --embed -p 'lightmap{quality=draft,max-size=64}'
ls alone
