#!/usr/bin/env python3
"""Reads .wpm files by docs/progressive.md alone, and compares each surface at its finest with the IndexedFaceSet that
it was made from: positions bit for bit, faces in their order. So the page tells enough to write a reader."""
import argparse, pathlib, re, struct, subprocess, sys, tempfile

class Bytes:
    def __init__(self, data):
        self.data, self.at = data, 0
    def take(self, n):
        self.at += n
        assert self.at <= len(self.data), 'the bytes end'
        return self.data[self.at - n:self.at]
    def fixed(self, code):
        return struct.unpack('<' + code, self.take(struct.calcsize('<' + code)))
    def number(self):
        n = shift = 0
        while True:
            b = self.take(1)[0]
            n |= (b & 127) << shift
            shift += 7
            if b < 128:
                return n
    def whole(self):
        n = self.number()
        return -(n + 1) // 2 if n & 1 else n // 2

def single(x): return struct.unpack('<f', struct.pack('<f', x))[0]
def order(x):
    b = struct.unpack('<I', struct.pack('<f', x))[0]
    return -1 - (b & 0x7fffffff) if b >> 31 else b
def from_order(n): return struct.unpack('<f', struct.pack('<I', n if n >= 0 else (-1 - n) | 0x80000000))[0]
def shortest(f): return next(x for x in (float('%.*e' % (d, f)) for d in range(9)) if single(x) == f)

class Mesh:
    """A mesh stream with all its splits."""
    def __init__(self, data):
        self.b = b = Bytes(data)
        assert b.take(4) == b'WPM1'
        flags, self.kind = b.fixed('BB')
        b.fixed('d6f')
        self.error, = b.fixed('f')
        self.width = 3 * bool(flags & 8) + (4 if flags & 32 else 3) * bool(flags & 16) + 2 * bool(flags & 64)
        n_vertices, n_wedges, n_faces, n_splits, self.n_faces = (b.number() for _ in range(5))
        self.position, self.vertex_number, self.rows = [], [], []
        self.vertex, self.wedge, self.face_number, self.fans = [], [], [], []
        number, before = -1, [0.0] * 3
        for _ in range(n_vertices):
            number += b.number() + 1
            before = self.point(before)
            self.add_vertex(before, number)
        for i in range(n_wedges):
            self.new_wedge(self.rows[-1] if i else None)
        number, v, w = -1, 0, 0
        for _ in range(n_faces):
            number += b.number() + 1
            corners = []
            for _ in range(3):
                v += b.whole()
                w += b.whole() if self.width else 0
                corners.append((v, w))
            self.add_face(corners, number)
        for _ in range(n_splits):
            self.split()
        assert b.at == len(data) and len(self.face_number) == self.n_faces and self.error == 0

    def point(self, predicted): return [self.coordinate(p) for p in predicted]
    def coordinate(self, p):
        if self.kind <= 15:
            step = float('1e%d' % self.kind)
            return (round(p * step) + self.b.whole()) / step
        if self.kind == 17:
            return self.b.fixed('d')[0]
        f = from_order(order(single(p)) + self.b.whole())
        return f if self.kind == 16 else shortest(f) if self.kind == 22 else float('%.*e' % (self.kind - 13, f))

    def row(self, like): return [from_order((order(like[i]) if like else 0) + self.b.whole()) for i in range(self.width)]
    def new_wedge(self, like):
        self.rows.append(self.row(like))
        return len(self.rows) - 1
    def add_vertex(self, p, number):
        self.position.append(p), self.vertex_number.append(number), self.fans.append([])
    def add_face(self, corners, number):
        for v, w in corners:
            self.fans[v].append(len(self.vertex))
            self.vertex.append(v), self.wedge.append(w)
        self.face_number.append(number)

    def split(self):
        b, width = self.b, self.width
        head = b.take(1)[0]
        n_faces = head & 3
        if n_faces == 3:
            n_faces += b.number()
        v = b.number()
        if head & 8:
            self.error = from_order(order(self.error) - b.number())
        number = self.vertex_number[v] + b.whole()
        old = new = self.position[v]
        if head & 4:
            new = self.position[v] = self.point(old)
        self.add_vertex(self.point([2 * p - q for p, q in zip(old, new)] if head & 4 else old), number)
        u = len(self.position) - 1
        fan = self.fans[v]
        mask = b.take((len(fan) + 7) // 8)
        goes = [mask[i // 8] >> i % 8 & 1 for i in range(len(fan))]
        self.fans[v] = [c for c, g in zip(fan, goes) if not g]
        self.fans[u] = [c for c, g in zip(fan, goes) if g]
        first_new, becomes = len(self.rows), {}
        for c in self.fans[u]:
            self.vertex[c] = u
            if not width:
                continue
            w = self.wedge[c]
            if head & 16:
                i = b.number()
                self.wedge[c] = w if i == 0 else first_new + i - 1
                if self.wedge[c] == len(self.rows):
                    self.new_wedge(self.rows[w])
            else:
                if w not in becomes:
                    becomes[w] = self.new_wedge(self.rows[w])
                self.wedge[c] = becomes[w]
        for _ in range(n_faces):
            self.face(u, v, fan)
        if head & 32:
            for _ in range(b.number()):
                w = b.number()
                self.rows[w] = self.row(self.rows[w])

    def face(self, u, v, fan):
        b = self.b
        code = b.number()
        i, t = code // 6, code // 2 % 3
        far = i == 2 * len(fan)
        if far:
            corner, like = (b.number(), 0), self.face_number[-1] if self.face_number else 0
        else:
            c = fan[i // 2]
            other = c - c % 3 + (c % 3 + 1 + i % 2) % 3
            corner, like = (self.vertex[other], self.wedge[other]), self.face_number[c // 3]
        number = like + b.whole()
        corners = [None] * 3
        for k in range(3):
            if k == t:
                if far and self.width:
                    w = b.number()
                    corner = corner[0], self.new_wedge(None) if w == len(self.rows) else w
                corners[k] = corner
                continue
            vertex = u if (k - t) % 3 == (1 if code & 1 else 2) else v
            corners[k] = vertex, self.near_wedge(self.fans[vertex]) if self.width else 0
        self.add_face(corners, number)

    def near_wedge(self, corners):
        j = self.b.number()
        if j < len(corners):
            return self.wedge[corners[j]]
        return j - len(corners) - 1 if j > len(corners) else self.new_wedge(self.rows[self.wedge[corners[0]]] if corners else None)

    def original(self):
        """Positions and corners in the order of the original."""
        place = sorted(range(len(self.position)), key=lambda v: self.vertex_number[v])
        faces = sorted(range(self.n_faces), key=lambda f: self.face_number[f])
        return [tuple(self.position[v]) for v in place], [self.vertex_number[c] for f in faces for c in self.vertex[3 * f:3 * f + 3]]

def read_world(data):
    b = Bytes(data)
    assert b.take(4) == b'WPW1'
    n = b.number()
    for _ in range(n):
        for _ in range(b.number()):
            b.take(b.number()), b.fixed('12d4B')
    streams = [b''] * n
    while b.at < len(data):
        i, size = b.number(), b.number()
        streams[i] += b.take(size)
    return [Mesh(s) for s in streams]

def face_set(text):
    """The one IndexedFaceSet of triangles in a text, without degenerate faces and unused points."""
    point = [float(x) for x in re.search(r'point\s*\[([^]]*)\]', text)[1].replace(',', ' ').split()]
    index = [int(x) for x in re.search(r'coordIndex\s*\[([^]]*)\]', text)[1].replace(',', ' ').split()]
    faces = [index[i:i + 3] for i in range(0, len(index), 4)]
    faces = [f for f in faces if len(set(f)) == 3]
    used = sorted({v for f in faces for v in f})
    number = {v: i for i, v in enumerate(used)}
    return [tuple(point[3 * v:3 * v + 3]) for v in used], [number[v] for f in faces for v in f]

def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--wrlkit', required=True)
    parser.add_argument('worlds', nargs='+', help='each of one IndexedFaceSet of triangles')
    args = parser.parse_args()
    faults = 0
    for world in args.worlds:
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            subprocess.run([args.wrlkit, 'convert', '-q', world, folder / 'plain.wrl', '-p', 'none'], check=True)
            subprocess.run([args.wrlkit, 'simplify', folder / 'plain.wrl', '--progressive', '-p', 'none', '-o', folder], check=True, stdout=subprocess.DEVNULL)
            meshes = read_world((folder / 'plain.wpm').read_bytes())
            good = [m.original() for m in meshes] == [face_set((folder / 'plain.wrl').read_text())]
            print(f'{world}: kind {meshes[0].kind}, {meshes[0].n_faces} faces: {"the same" if good else "NOT THE SAME"}')
            faults += not good
    sys.exit(bool(faults))

if __name__ == '__main__':
    main()
