printf '{"asset": {"version": "2.0"}, "nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],\n"accessors": [{"componentType": 5126, "count": 4000000000, "type": "VEC3"}]}' |
    wrlkit cat -
