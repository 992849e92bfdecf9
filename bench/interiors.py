#!/usr/bin/env python3
"""Baked light of rooms beside path-traced pictures of them: how far they differ, and sheets to look at.

  bench/interiors.py --wrlkit build/release/wrlkit -o FOLDER [NAME ...] [--qualities draft,normal]

Each room is drawn from one place: path-traced, and as `render` shows it with its light baked. Of the two pictures, in 255ths, squares of 4 x 4 pixels
together, as few paths are noisy: the mean difference of all channels, the 99th percentile of the largest of a square's channels, and, within its edges, the Shape whose mean colour differs most, of those
that cover at least 0.2 % of the picture. Path-traced pictures are kept in FOLDER, as they take longest. FOLDER/NAME.png shows path-traced,
baked normal, baked draft, and FOLDER/table.md has the figures. `--limits` ends with 1 where a room is farther off than docs/lighting.md says.
"""
import argparse
import copy
import json
import os
from pathlib import Path
import re
import resource
import struct
import subprocess
import sys

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / 'tests'))
from png import pixels, write  # noqa: E402

FOUND = Path(os.environ.get('WRLKIT_SHARED', '../shared'), 'corpus')
LIMITS = {'mean': 2, 'p99': 12, 'shape': 10}
BLOCK = 4  # pixels along each side that are judged together: the noise of few paths is not the fault of a bake
SMALLEST = 0.002  # of the picture: Shapes that cover less are not judged by themselves


class Room:
    def __init__(self, name, world, *camera, options=''):
        self.name, self.camera, self.options = name, list(camera), options
        own = world.startswith('corpus/')
        self.file = Path(world) if own else FOUND / world


def view(name):
    return ['--viewpoint', name]


def look(text):
    return ['--look-at', *text.split(), '--field-of-view', '65']


HOUSE, OTHER_HOUSE = 'worlds/junjihashimoto/house.wrl', 'worlds/openhrp3/house/house.main.wrl'
BOOK = 'vrml97/vrml2-sourcebook/Chapter25LevelOfDetail/'
ROOMS = [  # found ones, chosen by eye; then our own
    Room('living-room', HOUSE, *view('Woonkamer')),
    Room('kitchen', HOUSE, *view('Keuken')),
    Room('bedroom', HOUSE, *view('Ouderslaapkamer')),
    Room('bathroom', HOUSE, *view('Badkamer')),
    Room('attic', HOUSE, *view('op zolder')),
    Room('parlour', OTHER_HOUSE, *look('2 0 1.5 8 3 1.2 0 0 1')),
    Room('curtains', OTHER_HOUSE, *look('0 -3 1.5 -6 -8 1.2 0 0 1')),
    Room('office', 'vrml1/castle-demo-models/lights_materials/raytracer/office.wrl', *look('1.9 2.8 1.9 -1 1.8 -1 0 1 0')),
    Room('dungeon', BOOK + 'Figure25_08DungeonRoom.wrl'),
    Room('sliding-doors', BOOK + 'Figure25_12DungeonRoomsWithSlidingDoors.wrl'),
    Room('stairs', 'corpus/paper/stairs_room.wrl'),
    Room('pump-room', 'corpus/plant/pump_room_faces.wrl'),
    Room('pipes', 'corpus/paper/pipes.wrl'),
]


def run(*command):
    """What it printed, and its CPU seconds."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    result = subprocess.run([str(c) for c in command], capture_output=True, text=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if result.returncode > 1:
        raise RuntimeError(f'{" ".join(map(str, command))}: {result.stderr[-400:]}')
    return result.stdout + result.stderr, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def color_of_number(n):
    """One of 2^24: neighbours differ, no two are alike, none is black."""
    mixed = (n + 1) * 0x9e3779 & 0xffffff
    return [mixed >> shift & 255 for shift in (16, 8, 0)]


def to_linear(byte):
    v = byte / 255
    return v / 12.92 if v <= 0.04045 else ((v + 0.055) / 1.055) ** 2.4


def number_shapes(source, to):
    """A .glb whose Shapes shine, each place of one in a colour of its own."""
    data = source.read_bytes()
    size = struct.unpack_from('<I', data, 12)[0]
    gltf, rest = json.loads(data[20:20 + size]), data[20 + size:]
    meshes, materials = [], []
    for node in gltf.get('nodes', []):
        if 'mesh' not in node:
            continue
        mesh = copy.deepcopy(gltf['meshes'][node['mesh']])
        node['mesh'] = len(meshes)
        for primitive in mesh['primitives']:
            primitive['material'] = len(materials)
            primitive['attributes'].pop('COLOR_0', None)
        factor = [to_linear(v) for v in color_of_number(len(materials))] + [1]
        materials.append({'pbrMetallicRoughness': {'baseColorFactor': factor}, 'doubleSided': True, 'extensions': {'KHR_materials_unlit': {}}})
        meshes.append(mesh)
    gltf.update(meshes=meshes, materials=materials)
    gltf['extensionsUsed'] = sorted({*gltf.get('extensionsUsed', []), 'KHR_materials_unlit'})
    text = json.dumps(gltf).encode()
    text += b' ' * (-len(text) % 4)
    to.write_bytes(struct.pack('<4sIIII', b'glTF', 2, 20 + len(text) + len(rest), len(text), 0x4e4f534a) + text + rest)


def rows_beside(pictures, width):
    """Pictures of one size from left to right."""
    step = 3 * width
    return b''.join(p[i:i + step] for i in range(0, len(pictures[0]), step) for p in pictures)


LINEAR = [to_linear(v) for v in range(256)]


def to_display(light):
    return 255 * (12.92 * light if light <= 0.0031308 else 1.055 * light ** (1 / 2.4) - 0.055)


def blocks(picture, width):
    """Squares of BLOCK pixels, three channels each: the mean of their light, as it is displayed. That of what is displayed is too dark where there is noise."""
    sums = [0] * (len(picture) // BLOCK ** 2)
    per_row = width // BLOCK
    for i in range(0, len(picture), 3):
        y, x = divmod(i // 3, width)
        at = 3 * (y // BLOCK * per_row + x // BLOCK)
        for c in range(3):
            sums[at + c] += LINEAR[picture[i + c]]
    return [to_display(v / BLOCK ** 2) for v in sums]


def within_shapes(shapes, width):
    """Pixels whose neighbours show the same Shape: at edges pictures differ in how they mix what is on both sides."""
    row = 3 * width
    for i in range(row, len(shapes) - row, 3):
        mine = shapes[i:i + 3]
        if mine != b'\0\0\0' and all(shapes[k:k + 3] == mine for k in (i - 3, i + 3, i - row, i + row)):
            yield i


def difference(a, b, shapes, width):
    """Of blocks the mean of all channels and the 99th percentile of their worst channels; by how much the farthest Shape as a whole is off."""
    apart = [abs(x - y) for x, y in zip(blocks(a, width), blocks(b, width))]
    block = sorted(max(apart[i:i + 3]) for i in range(0, len(apart), 3))
    sums = {}  # by Shape: light of both pictures, pixels
    for i in within_shapes(shapes, width):
        s = sums.setdefault(shapes[i:i + 3], [0] * 7)
        s[6] += 1
        for c in range(3):
            s[c] += LINEAR[a[i + c]]
            s[3 + c] += LINEAR[b[i + c]]
    large = [s for s in sums.values() if s[6] >= SMALLEST * len(a) / 3]
    off = [max(abs(to_display(s[c] / s[6]) - to_display(s[3 + c] / s[6])) for c in range(3)) for s in large]
    return {'mean': sum(apart) / len(apart), 'p99': block[int(0.99 * len(block))], 'shape': max(off, default=0)}


class Studio:
    def __init__(self, options):
        self.wrlkit, self.folder = options.wrlkit, Path(options.output)
        self.width, self.height, self.samples = options.width, options.height, options.samples
        self.qualities = options.qualities.split(',')
        self.bakes = {}  # by world and quality: several rooms are in one house

    def draw(self, world, room, name, *more, keep=False):
        out = self.folder / f'{room.name}_{name}.png'
        if not (keep and out.exists()):
            run(self.wrlkit, 'render', '-q', world, out, '--width', self.width, '--height', self.height, *room.camera, *more)
        return pixels(out)[1]

    def bake(self, room, quality):
        """The baked world, CPU seconds, what the pass counted."""
        key = (room.file, room.options, quality)
        if key not in self.bakes:
            out = self.folder / f'{room.name}_{quality}.glb'
            how = f'expand,lightmap{{quality={quality}{room.options}}}'
            said, seconds = run(self.wrlkit, 'convert', room.file, out, '-p', how, '--stats')
            self.bakes[key] = out, seconds, {k: int(v) for v, k in re.findall(r'(\d+)\s+lightmap\.(\S+)', said)}
        return self.bakes[key]

    def figures(self, room):
        """A row for each quality; a sheet."""
        path = self.draw(room.file, room, f'path_{self.width}_{self.samples}', '--mode', 'path', '--samples', self.samples, keep=True)
        plain, numbered = self.folder / f'{room.name}_plain.glb', self.folder / f'{room.name}_shapes.glb'
        run(self.wrlkit, 'convert', '-q', room.file, plain)
        number_shapes(plain, numbered)
        shapes = self.draw(numbered, room, 'shapes', '--samples', 1, '--background', 0, 0, 0)
        rows, sheet = [], [path]
        for quality in self.qualities:
            baked, seconds, counts = self.bake(room, quality)
            picture = self.draw(baked, room, quality)
            rows.append({'room': room.name, 'quality': quality, **difference(path, picture, shapes, self.width), 'cpu': seconds, 'bytes': baked.stat().st_size, **counts})
            sheet.append(picture)
        write(self.folder / f'{room.name}.png', len(sheet) * self.width, rows_beside(sheet, self.width))
        return rows


COLUMNS = ['mean', 'p99', 'shape', 'cpu', 'bytes', 'leaks', 'holes', 'black', 'jumps', 'texels']


def text(row):
    numbers = (f'{row.get(c, 0):.2f}' if isinstance(row.get(c), float) else str(row.get(c, 0)) for c in COLUMNS)
    return f'| {row["room"]} | {row["quality"]} | ' + ' | '.join(numbers) + ' |'


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--wrlkit', required=True)
    parser.add_argument('-o', '--output', required=True)
    parser.add_argument('--qualities', default='normal,draft')
    parser.add_argument('--width', type=int, default=320)
    parser.add_argument('--height', type=int, default=240)
    parser.add_argument('--samples', type=int, default=4, help='along each side of a pixel, path-traced')
    parser.add_argument('--limits', action='store_true')
    parser.add_argument('names', nargs='*', help='rooms; all')
    options = parser.parse_args()
    Path(options.output).mkdir(parents=True, exist_ok=True)
    studio, off = Studio(options), 0
    lines = ['| room | quality | ' + ' | '.join(COLUMNS) + ' |', '|---' * (len(COLUMNS) + 2) + '|']
    for room in ROOMS:
        if options.names and room.name not in options.names:
            continue
        if not room.file.exists():
            print(f'skipped: there is no {room.file}')
            continue
        for row in studio.figures(room):
            lines.append(text(row))
            print(lines[-1], flush=True)
            off += row['quality'] == 'normal' and any(row[k] > most for k, most in LIMITS.items())
    Path(options.output, 'table.md').write_text('\n'.join(lines) + '\n')
    return 1 if options.limits and off else 0


if __name__ == '__main__':
    sys.exit(main())
