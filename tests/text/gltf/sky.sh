wrlkit convert -q --sky mesh %s %t.gltf && python3 -c '
import json, sys
gltf = json.load(open(sys.argv[1]))
day = next(n for n in gltf["nodes"] if n.get("name") == "Day")
children, scale, far = day["children"], day["scale"], gltf["cameras"][0]["perspective"]["zfar"]
print(f"Day: {len(children)} children, radius {scale[0]:g}, zfar {far:g}")' %t.gltf
