"""The small pictures, the sound and the film that feature and node worlds refer to.

The picture is made so that no turn or mirror of it looks the same: a red arrow to the right along its lower edge, a
green one upwards along the left, a blue disc in the upper right.
"""
from math import pi, sin
import struct

from generator import picture

SIZE = 64


def arrows(x, y):
    up = SIZE - 1 - y
    if min(x, y, SIZE - 1 - x, up) < 2:
        return (40, 40, 40)
    if is_arrow(x, up):
        return (210, 40, 30)
    if is_arrow(up, x):
        return (30, 150, 50)
    if (x - 46) ** 2 + (up - 46) ** 2 < 100:
        return (40, 70, 200)
    return (236, 230, 212) if (x // 16 + y // 16) % 2 else (220, 212, 190)


def is_arrow(along, aside):
    return 10 <= along < 44 and 8 <= aside < 13 or 44 <= along < 56 and abs(aside - 10) <= (55 - along) * 0.7


def cut_corners(x, y):
    far = min(x, SIZE - 1 - x) + min(y, SIZE - 1 - y)
    return (*arrows(x, y), 255 if far > 20 else 128 if far > 14 else 0)


def beep():
    """A tenth of a second of 440 Hz, 8 kHz, 8 bits, one channel, fading out."""
    samples = bytes(round(128 + 100 * (1 - i / 800) * sin(2 * pi * 440 * i / 8000)) for i in range(800))
    form = struct.pack('<4sIHHIIHH', b'fmt ', 16, 1, 1, 8000, 8000, 1, 8)
    data = struct.pack('<4sI', b'data', len(samples)) + samples
    return struct.pack('<4sI4s', b'RIFF', 4 + len(form) + len(data), b'WAVE') + form + data


# ---- a film ------------------------------------------------------------------------------------------------------

# Codes of the size of a DC difference, for sizes 0 to 8 (ISO/IEC 11172-2, tables B.5a and B.5b).
LUMINANCE = '100', '00', '01', '101', '110', '1110', '11110', '111110', '1111110'
CHROMINANCE = '00', '01', '10', '110', '1110', '11110', '111110', '1111110', '11111110'


def film(frames):
    """MPEG-1 video of intra pictures only; a frame is rows of (Y, Cb, Cr), one a macroblock of 16 x 16."""
    rows, columns = len(frames[0]), len(frames[0][0])
    sequence = field((16 * columns, 12), (16 * rows, 12), (1, 4), (3, 4), (0x3ffff, 18), (1, 1), (20, 10), (0, 3))
    clock = field((0, 12), (1, 1), (0, 12), (1, 1), (0, 1))
    stream = section(0xb3, sequence) + section(0xb8, clock)
    for number, frame in enumerate(frames):
        stream += section(0x00, field((number, 10), (1, 3), (0xffff, 16), (0, 1)))
        for row, blocks in enumerate(frame):
            stream += section(row + 1, field((8, 5), (0, 1)) + macroblocks(blocks))
    return stream + section(0xb7, '')


def field(*values):
    return ''.join(f'{value:0{width}b}' for value, width in values)


def section(code, bits):
    bits += '0' * (-len(bits) % 8)
    return b'\0\0\1' + bytes([code]) + bytes(int(bits[i:i + 8], 2) for i in range(0, len(bits), 8))


def macroblocks(colours):
    """Each block has its mean only, as the difference to the block before."""
    bits, last = '', [128, 128, 128]
    for y, cb, cr in colours:
        bits += '11'   # next address, intra
        for channel, value in (0, y), (0, y), (0, y), (0, y), (1, cb), (2, cr):
            bits += mean(value - last[channel], CHROMINANCE if channel else LUMINANCE) + '10'
            last[channel] = value
    return bits


def mean(difference, sizes):
    size = abs(difference).bit_length()
    if not size:
        return sizes[0]
    return sizes[size] + f'{difference if difference > 0 else difference + (1 << size) - 1:0{size}b}'


def colour_bars():
    """Eight frames: a bright bar that moves over four colours."""
    bars = (82, 90, 240), (145, 54, 34), (41, 240, 110), (180, 128, 128)
    def colour(n, row, column):
        return (235, 128, 128) if row == n // 2 else bars[(column + n // 4) % 4]
    return film([[[colour(n, row, column) for column in range(4)] for row in range(4)] for n in range(8)])


def files(seed):
    plain = picture.drawn(SIZE, SIZE, arrows)
    for form in picture.png, picture.bmp, picture.tga, picture.gif:
        yield f'features/textures/arrows.{form.__name__}', form(plain)
    yield 'features/textures/arrows_alpha.png', picture.png(picture.drawn(SIZE, SIZE, cut_corners))
    yield 'nodes/media/arrows.png', picture.png(plain)
    yield 'nodes/media/beep.wav', beep()
    yield 'nodes/media/colour_bars.mpg', colour_bars()
