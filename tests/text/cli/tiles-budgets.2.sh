# Two textured spheres: pictures of the tile above them shrink until it is within its bytes, those of full tiles do not. A budget that geometry
# is over makes more tiles.
sizes() { python3 -c "
import json, sys
said = json.load(sys.stdin)
print([t['level'] for t in said['tiles']], [t['bytes'] <= $1 for t in said['tiles']], said['over'])"; }
python3 - %t.world.wrl <<'END'
import sys
import pathlib
import random
import struct
import zlib
r = random.Random(1)
rows = b''.join(b'\0' + r.randbytes(3 * 128) for _ in range(128))
chunk = lambda kind, data: struct.pack('>I', len(data)) + kind + data + struct.pack('>I', zlib.crc32(kind + data))
picture = b'\x89PNG\r\n\x1a\n' + chunk(b'IHDR', struct.pack('>IIBBBBB', 128, 128, 8, 2, 0, 0, 0)) + chunk(b'IDAT', zlib.compress(rows)) + chunk(b'IEND', b'')
world = pathlib.Path(sys.argv[1])
world.with_suffix('.png').write_bytes(picture)
shape = 'Transform { translation %d 0 0 children Shape { appearance Appearance { texture ImageTexture { url "' + world.with_suffix('.png').name + '" } } geometry Sphere {} } }'
world.write_text('#VRML V2.0 utf8\n' + '\n'.join(shape % (3 * i) for i in range(2)))
END
wrlkit tiles %t.world.wrl -o %t.set --tile-triangles 1000 --tile-bytes 4M --json | sizes 30000
wrlkit tiles %t.world.wrl -o %t.set --tile-triangles 1000 --tile-bytes 30K --json | sizes 30000
