wrlkit convert -q %s %t.gltf && python3 - %t.gltf <<'PY'
import json, math, os, struct, sys
gltf = json.load(open(sys.argv[1]))
data = open(os.path.join(os.path.dirname(sys.argv[1]), gltf["buffers"][0]["uri"]), "rb").read()
def read(i):
    a = gltf["accessors"][i]
    v = gltf["bufferViews"][a["bufferView"]]
    letter, n = {5121: "B", 5123: "H", 5125: "I", 5126: "f"}[a["componentType"]], {"SCALAR": 1, "VEC3": 3}[a["type"]]
    step, at = v.get("byteStride") or struct.calcsize(letter) * n, v.get("byteOffset", 0) + a.get("byteOffset", 0)
    return [struct.unpack_from("<" + letter * n, data, at + step * k) for k in range(a["count"])]
def turned(q, p):
    x, y, z, w = q
    t = [2 * (y * p[2] - z * p[1]), 2 * (z * p[0] - x * p[2]), 2 * (x * p[1] - y * p[0])]
    return [p[0] + w * t[0] + y * t[2] - z * t[1], p[1] + w * t[1] + z * t[0] - x * t[2], p[2] + w * t[2] + x * t[1] - y * t[0]]
def triangles(node, place):
    n = gltf["nodes"][node]
    def here(p):
        p = turned(n.get("rotation", [0, 0, 0, 1]), [a * b for a, b in zip(p, n.get("scale", [1, 1, 1]))])
        return place([a + b for a, b in zip(p, n.get("translation", [0, 0, 0]))])
    for primitive in gltf["meshes"][n["mesh"]]["primitives"] if "mesh" in n else []:
        points = [here(p) for p in read(primitive["attributes"]["POSITION"])]
        corners = [i[0] for i in read(primitive["indices"])]
        for k in range(0, len(corners), 3):
            yield [points[i] for i in corners[k:k + 3]]
    for child in n.get("children", []):
        yield from triangles(child, here)
for root in gltf["scenes"][0]["nodes"]:
    volume, low, high = 0, [math.inf] * 3, [-math.inf] * 3
    for a, b, c in triangles(root, lambda p: p):
        volume += sum(a[i] * (b[(i + 1) % 3] * c[(i + 2) % 3] - b[(i + 2) % 3] * c[(i + 1) % 3]) for i in range(3)) / 6
        for p in (a, b, c):
            low, high = [min(u, v) for u, v in zip(low, p)], [max(u, v) for u, v in zip(high, p)]
    if low[0] < math.inf:
        print("{} {:.2f}".format(gltf["nodes"][root]["name"], volume), *("{:.1f}..{:.1f}".format(round(u, 1) + 0.0, round(v, 1) + 0.0) for u, v in zip(low, high)))
PY
