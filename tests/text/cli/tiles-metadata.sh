mkdir -p %t.d
cd %t.d
cat > a.x3dv <<'EOF'
#X3D V3.3 utf8
PROFILE Immersive
WorldInfo { title "Plant" }
DEF Pump Transform { metadata MetadataString { name "tag" value "P-101" } children Shape { geometry Box { } } }
DEF Tank Transform { translation 5 0 0 children Shape { geometry Sphere { } } }
EOF
lost() { python3 -c "
import json
print(json.load(open('report.json'))['tiles']['lost'])"; }
wrlkit tiles -q a.x3dv -o set --report report.json
lost
wrlkit tiles -q a.x3dv -o set2 --report report.json -p 'merge{max-draws=1}'
lost
