wrlkit convert -q --behaviour interactivity %s %t.gltf && python3 -c '
import json, sys
gltf = json.load(open(sys.argv[1]))
graph = gltf["extensions"]["KHR_interactivity"]["graphs"][0]
for i, node in enumerate(graph["nodes"]):
    pointer = node.get("configuration", {}).get("pointer", {}).get("value", [""])[0]
    flows = [socket + ">" + str(to["node"]) for socket, to in node.get("flows", {}).items()]
    print(" ".join(filter(None, [str(i), graph["declarations"][node["declaration"]]["op"], pointer, *flows])))
print(" ".join(gltf["extensionsUsed"]))' %t.gltf
