#!/usr/bin/env python3
"""Reads and writes PNG with only zlib, so that pictures are not judged by the code that wrote them.

  tests/png.py PICTURE...      of each the mean of each channel, in tens, and how many colours there are
"""
from pathlib import Path
import struct
import sys
import zlib


def pixels(path):
    """Width times channels, and the rows (PNG of 8 bits a channel, not interlaced)."""
    data, at, packed = path.read_bytes(), 8, b''
    while at < len(data):
        size, kind = struct.unpack_from('>I4s', data, at)
        body = data[at + 8:at + 8 + size]
        at += 12 + size
        if kind == b'IHDR':
            width, height, depth, color, _, _, interlaced = struct.unpack('>IIBBBBB', body)
            assert (depth, interlaced) == (8, 0)
        packed += body if kind == b'IDAT' else b''
    step = {0: 1, 2: 3, 4: 2, 6: 4}[color]
    raw, row, out = zlib.decompress(packed), bytearray(width * step), []
    for y in range(height):
        start = y * (width * step + 1)
        above, row, how = row, bytearray(raw[start + 1:start + 1 + width * step]), raw[start]
        for i in range(len(row)):
            a, b, c = (row[i - step], above[i], above[i - step]) if i >= step else (0, above[i], 0)
            if how == 4:
                pa, pb, pc = abs(b - c), abs(a - c), abs(a + b - 2 * c)
                add = a if pa <= pb and pa <= pc else b if pb <= pc else c
            else:
                add = (0, a, b, (a + b) // 2)[how]
            row[i] = (row[i] + add) & 255
        out.append(bytes(row))
    return step, b''.join(out)


def write(path, width, rgb):
    """Rows of 8-bit RGB, from the top."""
    def chunk(kind, body):
        return struct.pack('>I', len(body)) + kind + body + struct.pack('>I', zlib.crc32(kind + body))
    row = 3 * width
    lines = b''.join(b'\0' + rgb[i:i + row] for i in range(0, len(rgb), row))
    header = struct.pack('>IIBBBBB', width, len(rgb) // row, 8, 2, 0, 0, 0)
    path.write_bytes(b'\x89PNG\r\n\x1a\n' + chunk(b'IHDR', header) + chunk(b'IDAT', zlib.compress(lines)) + chunk(b'IEND', b''))


def main():
    for path in sys.argv[1:]:
        step, data = pixels(Path(path))
        n = len(data) // step
        means = [round(sum(data[k::step]) / n / 10) * 10 for k in range(step)]
        print(*means, 'in', len({data[i:i + step] for i in range(0, len(data), step)}), 'colours')


if __name__ == '__main__':
    main()
