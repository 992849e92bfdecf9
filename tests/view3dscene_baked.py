#!/usr/bin/env python3
"""view3dscene (Castle Game Engine) shows VRML with baked light as `wrlkit render` does.

  tests/view3dscene_baked.py --wrlkit build/release/wrlkit            two rooms of corpus/paper, and every tenth found plant and world
  tests/view3dscene_baked.py --wrlkit ... --match . --keep FOLDER     for people: all found plants and worlds whose name matches; pictures stay

Bakes them as VRML97 and compares the pictures of both programs, of the rooms from the first Viewpoint, of the others from where all of it is seen.
Bounds: 2 of 255 levels in the mean, and one pixel in fifty by more than 24 (edges, which they smooth in different ways). EXCEPTIONS says where that
cannot hold. Skipped without view3dscene and xvfb-run (Debian packages view3dscene and xvfb).
"""
import argparse
import csv
import json
import math
import os
from pathlib import Path
import re
import shutil
import subprocess
import sys
import tempfile

from same_picture import pixels

ROOT = Path(__file__).resolve().parents[1]
SHARED = Path(os.environ.get('WRLKIT_SHARED', ROOT.parent / 'shared')) / 'corpus'
OWN = ('corpus/paper/stairs_room.wrl', 'corpus/paper/pipes.wrl')
WIDTH, HEIGHT = 400, 300
MOST_MEAN, MOST_FAR = 2, 0.02
EXCEPTIONS = (  # names, mean and share, why
    ('nist-steelvis/IBC', 3, 0.06, 'bars thinner than a pixel'),
    ('/vzome/.*(80|heptahedron|compound_of|bookball|icosahedron)', 5, 0.1, 'edges are lines, which are narrower there'),
    ('house/vase', 3, 0.1, 'glass, of which the faces are drawn in another order'),
)


def rows(name):
    with open(SHARED / name, newline='') as file:
        return list(csv.DictReader(file, delimiter='\t'))


def found():
    """Plants and worlds in which an independent reader saw something to draw."""
    if not (SHARED / 'MANIFEST.tsv').exists():
        return []
    drawn = {r['path'] for r in rows('reference.tsv') if r['ok'] == '1' and int(r['triangles']) > 0}
    return sorted(r['path'] for r in rows('MANIFEST.tsv') if re.match('(plant|worlds)/', r['path']) and r['path'] in drawn)


def rgb(path):
    step, data = pixels(path)
    return [data[i:i + 3] for i in range(0, len(data), step)]


def unit(v):
    length = math.hypot(*v)
    return [c / length for c in v]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def viewpoint(low, high):
    """From the front, the right and above, at a distance from which the box is well in the picture."""
    middle = [(a + b) / 2 for a, b in zip(low, high)]
    size = math.dist(low, high) or 1
    back = unit([0.5, 0.4, 1.1])
    right = unit(cross([0, 1, 0], back))
    up = cross(back, right)
    # The turn whose matrix has right, up and back as columns.
    angle = math.acos((right[0] + up[1] + back[2] - 1) / 2)
    axis = unit([up[2] - back[1], back[0] - right[2], right[1] - up[0]])
    position = [m + 1.3 * size * b for m, b in zip(middle, back)]
    number = lambda values: ' '.join(f'{v:.9g}' for v in values)
    # avatarSize says what is too near to be seen.
    return (f'Viewpoint {{ position {number(position)} orientation {number([*axis, angle])} }}\n'
            f'NavigationInfo {{ avatarSize [ {number([size / 100, size / 10, size / 100])} ] type [ "EXAMINE" "ANY" ] }}\n')


class Judge:
    def __init__(self, wrlkit, folder):
        self.wrlkit, self.folder = wrlkit, folder

    def run(self, verb, *words):
        return subprocess.run([self.wrlkit, verb, '-q', *map(str, words)], capture_output=True, text=True, errors='replace', timeout=600)

    def bake(self, source, lit, from_viewpoint):
        done = self.run('convert', source, lit, '-p', 'expand,lightmap{quality=draft,max-size=256}', '--allow-path', source.parent.parent)
        if done.returncode not in (0, 1) or not lit.exists():
            return f'exit code {done.returncode}: {done.stderr.strip()[:200]}'
        text = lit.read_text(errors='surrogateescape')
        if 'Background' not in text:  # where the file has none, view3dscene's is grey
            text += 'Background { }\n'
        bounds = json.loads(self.run('info', lit, '--json').stdout).get('bounds') or {}
        if not from_viewpoint and bounds.get('min'):
            header, _, body = text.partition('\n')
            text = f"{header}\n{viewpoint(bounds['min'], bounds['max'])}{body}"
        lit.write_text(text, errors='surrogateescape')
        return ''

    def compare(self, name, source, from_viewpoint):
        """(mean, share of pixels that are far off), or what went wrong."""
        stem = self.folder / name.replace('/', '_')
        lit, theirs, ours = (Path(f'{stem}{end}') for end in ('.lit.wrl', '.theirs.png', '.ours.png'))
        if fault := self.bake(source, lit, from_viewpoint):
            return fault
        self.run('render', lit, ours, '--width', WIDTH, '--height', HEIGHT, '--allow-path', source.parent.parent)
        subprocess.run(['xvfb-run', '-a', '-s', '-screen 0 1280x1024x24', 'view3dscene', '--hide-extras', '--hide-menu', '--no-sound', '--geometry',
                        f'{WIDTH}x{HEIGHT}', '--anti-alias', '2', lit, '--screenshot', '0', theirs], capture_output=True, timeout=250)
        if not theirs.exists() or not ours.exists():
            return None
        far, total, a, b = 0, 0, rgb(theirs), rgb(ours)
        for p, q in zip(a, b, strict=True):
            d = [abs(x - y) for x, y in zip(p, q)]
            far, total = far + (max(d) > 24), total + sum(d)
        return total / 3 / len(a), far / len(a)


def judge(name, result):
    if isinstance(result, str):
        return result
    mean, share = result
    most_mean, most_far, why = next((e[1:] for e in EXCEPTIONS if re.search(e[0], name)), (MOST_MEAN, MOST_FAR, ''))
    print(f'{name}: {mean:.2f} levels in the mean, {share:.2%} of the pixels by more than 24{why and f" ({why})"}', flush=True)
    return 'view3dscene shows another picture' if mean > most_mean or share > most_far else ''


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--wrlkit', required=True)
    parser.add_argument('--match', help='all found plants and worlds whose name has this regular expression')
    parser.add_argument('--keep', help='folder for the pictures')
    args = parser.parse_args()
    if not shutil.which('view3dscene') or not shutil.which('xvfb-run'):
        print('skipped: needs view3dscene and xvfb')
        return 77
    names = [n for n in found() if re.search(args.match, n)] if args.match else [*OWN, *found()[::10]]
    faults = []
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(args.keep or temporary)
        folder.mkdir(parents=True, exist_ok=True)
        for name in names:
            own = name in OWN
            result = Judge(args.wrlkit, folder).compare(name, (ROOT if own else SHARED) / name, own)
            if result is None and own:
                print('skipped: view3dscene has drawn nothing; it needs OpenGL')
                return 77
            if fault := judge(name, 'nothing was drawn' if result is None else result):
                faults.append(f'{name}: {fault}')
    print('\n'.join(faults))
    return 1 if faults else 0


if __name__ == '__main__':
    sys.exit(main())
