"""How often an animated WebP plays (0: without end), and the milliseconds of each picture: from its RIFF chunks."""
import sys

data = open(sys.argv[1], 'rb').read()
assert data[:4] == b'RIFF' and data[8:12] == b'WEBP' and int.from_bytes(data[4:8], 'little') == len(data) - 8
at, loops, pictures = 12, None, []
while at < len(data):
    size, body = int.from_bytes(data[at + 4:at + 8], 'little'), at + 8
    if data[at:at + 4] == b'ANIM':
        loops = int.from_bytes(data[body + 4:body + 6], 'little')
    if data[at:at + 4] == b'ANMF':
        pictures.append(int.from_bytes(data[body + 12:body + 15], 'little'))
    at = body + size + size % 2
print(loops, pictures)
