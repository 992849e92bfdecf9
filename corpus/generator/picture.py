"""Pictures without a library: a picture is rows of pixels, tuples of 1 to 4 components (grey, grey and
alpha, RGB, RGBA) from 0 to 255. Each function gives the bytes of a file.
"""
import struct
import zlib


def png(rows):
    colour_type = {1: 0, 2: 4, 3: 2, 4: 6}[len(rows[0][0])]
    raw = b''.join(b'\0' + bytes(c for pixel in row for c in pixel) for row in rows)
    head = struct.pack('>IIBBBBB', len(rows[0]), len(rows), 8, colour_type, 0, 0, 0)
    return b'\x89PNG\r\n\x1a\n' + chunk(b'IHDR', head) + chunk(b'IDAT', deflated(raw)) + chunk(b'IEND', b'')


def chunk(kind, data):
    return struct.pack('>I', len(data)) + kind + data + struct.pack('>I', zlib.crc32(kind + data))


def deflated(raw):
    """A zlib stream of stored blocks: what zlib.compress gives depends on its version, and --check compares bytes."""
    parts = [raw[i:i + 65535] for i in range(0, len(raw), 65535)]
    blocks = [struct.pack('<BHH', part is parts[-1], len(part), len(part) ^ 0xffff) + part for part in parts]
    return b'\x78\x01' + b''.join(blocks) + struct.pack('>I', zlib.adler32(raw))


def bmp(rows):
    """24 bits, bottom row first, each row padded to four bytes."""
    width, height = len(rows[0]), len(rows)
    row_bytes = [b''.join(bytes((b, g, r)) for r, g, b in row) for row in reversed(rows)]
    data = b''.join(row + bytes(-len(row) % 4) for row in row_bytes)
    head = struct.pack('<IiiHHIIiiII', 40, width, height, 1, 24, 0, len(data), 2835, 2835, 0, 0)
    return b'BM' + struct.pack('<IHHI', 14 + len(head) + len(data), 0, 0, 14 + len(head)) + head + data


def tga(rows):
    """Type 2, 24 or 32 bits, top row first (bit 5 of the descriptor)."""
    depth = len(rows[0][0])
    head = struct.pack('<BBBHHBHHHHBB', 0, 0, 2, 0, 0, 0, 0, 0, len(rows[0]), len(rows), 8 * depth,
                       0x20 | (8 if depth == 4 else 0))
    return head + b''.join(bytes((b, g, r, *a)) for row in rows for r, g, b, *a in row)


def gif(rows):
    """At most 128 colours, LZW without compression: every code is 8 bits, a clear code before the table grows."""
    colours = sorted({pixel for row in rows for pixel in row})
    palette = b''.join(map(bytes, colours)).ljust(128 * 3, b'\0')
    pixels = [colours.index(pixel) for row in rows for pixel in row]
    codes = bytearray()
    for i in range(0, len(pixels), 126):
        codes += bytes([128]) + bytes(pixels[i:i + 126])
    codes.append(129)
    blocks = b''.join(bytes([len(part)]) + part for part in (codes[i:i + 255] for i in range(0, len(codes), 255)))
    size = struct.pack('<HH', len(rows[0]), len(rows))
    return b'GIF87a' + size + b'\xe6\0\0' + palette + b',' + bytes(4) + size + b'\0\x07' + blocks + b'\0;'


# ---- drawing -----------------------------------------------------------------------------------------------------

def drawn(width, height, colour):
    """A picture from a function of (x, y), y downwards."""
    return [[tuple(max(0, min(255, round(c))) for c in colour(x, y)) for x in range(width)] for y in range(height)]


# Block letters, five dots wide and seven high: the sign is drawn with them, the face variants spell with them.
FONT = {
    'A': '.###. #...# #...# ##### #...# #...# #...#', 'B': '####. #...# #...# ####. #...# #...# ####.',
    'C': '.###. #...# #.... #.... #.... #...# .###.', 'D': '####. #...# #...# #...# #...# #...# ####.',
    'E': '##### #.... #.... ####. #.... #.... #####', 'G': '.###. #...# #.... #.### #...# #...# .###.',
    'I': '.###. ..#.. ..#.. ..#.. ..#.. ..#.. .###.', 'K': '#...# #..#. #.#.. ##... #.#.. #..#. #...#',
    'L': '#.... #.... #.... #.... #.... #.... #####', 'M': '#...# ##.## #.#.# #.#.# #...# #...# #...#',
    'N': '#...# ##..# #.#.# #.#.# #..## #...# #...#', 'O': '.###. #...# #...# #...# #...# #...# .###.',
    'P': '####. #...# #...# ####. #.... #.... #....', 'R': '####. #...# #...# ####. #.#.. #..#. #...#',
    'S': '.#### #.... #.... .###. ....# ....# ####.', 'T': '##### ..#.. ..#.. ..#.. ..#.. ..#.. ..#..',
    'U': '#...# #...# #...# #...# #...# #...# .###.', 'V': '#...# #...# #...# #...# #...# .#.#. ..#..',
    '0': '.###. #...# #..## #.#.# ##..# #...# .###.', '1': '..#.. .##.. ..#.. ..#.. ..#.. ..#.. .###.',
    '2': '.###. #...# ....# ..##. .#... #.... #####', '3': '####. ....# ....# .###. ....# ....# ####.',
    '-': '..... ..... ..... .###. ..... ..... .....', '/': '....# ....# ...#. ..#.. .#... #.... #....',
    ' ': '..... ..... ..... ..... ..... ..... .....',
}


def lettering(text):
    """The set of (column, row) dots of a line of text, row 0 on top; and its width."""
    dots = {(6 * i + x, y) for i, letter in enumerate(text) for y, row in enumerate(FONT[letter].split())
            for x, dot in enumerate(row) if dot == '#'}
    return dots, 6 * len(text) - 1
