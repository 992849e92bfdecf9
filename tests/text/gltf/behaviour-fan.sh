python3 - > %t.x3dv <<'PY'
n = 24
print("#X3D V3.3 utf8\nPROFILE Immersive\nDEF Touch TouchSensor {}\nShape { geometry Box {} }\nDEF Lamp Switch { whichChoice 0 children Shape { geometry Box {} } }\nDEF I IntegerTrigger {}")
for i in range(n):
    print(f"DEF T{i} BooleanTrigger {{}} DEF A{i} TimeTrigger {{}} DEF B{i} TimeTrigger {{}}")
print("ROUTE Touch.touchTime TO T0.set_triggerTime")
for i in range(n):
    for side in "AB":
        print(f"ROUTE T{i}.triggerTrue TO {side}{i}.set_boolean\nROUTE {side}{i}.triggerTime TO T{(i + 1) % n}.set_triggerTime")
print("ROUTE T9.triggerTrue TO I.set_boolean\nROUTE I.triggerValue TO Lamp.set_whichChoice")
PY
wrlkit convert --behaviour interactivity %t.x3dv %t.gltf
code=$?
python3 -c '
import json, sys
print("nodes of the graph:", len(json.load(open(sys.argv[1]))["extensions"]["KHR_interactivity"]["graphs"][0]["nodes"]))' %t.gltf
exit $code
