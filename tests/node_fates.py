#!/usr/bin/env python3
"""What becomes of every node of X3D 4.0 is what docs/nodes.md says: what is drawn changes the picture, what is animated or run is in the glTF,
and what is kept is in X3D output.

Of nodes that are drawn, animated or run there are two worlds in node_fates.txt: with the node, and without what stands between << and >>, or with
what stands behind || there. What is kept is the document of the node in corpus/x3d.
"""
import argparse, json, pathlib, re, subprocess, sys, tempfile
from concurrent.futures import ThreadPoolExecutor

ROOT = pathlib.Path(__file__).resolve().parents[1]
parser = argparse.ArgumentParser()
parser.add_argument('--wrlkit', required=True)
parser.add_argument('nodes', nargs='*', help='only these')
ARGUMENTS = parser.parse_args()
WRLKIT = str(pathlib.Path(ARGUMENTS.wrlkit).resolve())
HEAD, VIEWPOINT = '#X3D V4.0 utf8\nPROFILE Full\n', 'Viewpoint { position 0 0 8 }\n'
SMALL = ('-q', '--width', 96, '--height', 72, '--samples', 1)


def run(*words):
    return subprocess.run([WRLKIT, *map(str, words)], capture_output=True, text=True, errors='replace')


def put_in(text, words):
    """With what the words in capitals stand for, which may hold others."""
    for _ in range(8):
        text = re.sub(r'\b[A-Z]{3,}\b', lambda m: words.get(m[0], m[0]), text)
    return text


def worlds():
    """Of each node the text with it and that without."""
    words, out = {}, {}
    for line in (ROOT / 'tests/node_fates.txt').read_text().splitlines():
        if m := re.match(r'([A-Z]+) = (.*)', line):
            words[m[1]] = m[2]
        elif m := re.match(r'(\w+): (.*)', line):
            cut = re.compile(r'<<(.*?)(?:\|\|(.*?))?>>')
            out[m[1]] = tuple(HEAD + ('' if 'Viewpoint' in m[1] else VIEWPOINT) + put_in(cut.sub(lambda c: c[side] or '', m[2]), words) + '\n' for side in (1, 2))
    return out


class Nodes:
    def __init__(self, folder):
        self.folder, self.worlds = folder, worlds()
        (folder / 'inlined.x3dv').write_text(HEAD + 'Shape { geometry Box { } }\n')
        (folder / 'picture.png').write_bytes((ROOT / 'corpus/nodes/media/arrows.png').read_bytes())

    def files(self, name):
        out = []
        for side, text in zip(('with', 'without'), self.worlds[name]):
            out.append(self.folder / f'{name}_{side}.x3dv')
            out[-1].write_text(text)
        return out

    def fault(self, name, fate):
        """Why it is not so; None."""
        if 'drawn' in fate or fate.startswith(('what is below', 'cameras', 'a Transform', 'its world')):
            if 'Viewpoint' in name:  # a comparison is drawn from one place
                return self.not_in_gltf(name, lambda gltf: [gltf.get('cameras'), gltf['nodes']]) or self.not_kept(name)
            if name in self.worlds:
                return self.not_drawn(name) or self.not_kept(name)
            if not any(words in fate for words in ('drawn in their Shapes', 'what is below', 'drawn as groups')):
                return 'there is no world in node_fates.txt'
        elif 'no file has one' in fate:
            return None
        elif 'animations' in fate:
            return self.not_in_gltf(name, lambda gltf: gltf.get('animations')) or self.not_kept(name)
        elif 'interactivity' in fate:
            return self.not_in_gltf(name, lambda gltf: gltf.get('extensions', {}).get('KHR_interactivity')) or self.not_kept(name)
        return self.not_kept(name)

    def not_drawn(self, name):
        r = run('render', *self.files(name)[:1], self.folder / f'{name}.png', '--compare', self.folder / f'{name}_without.x3dv', '--json', *SMALL)
        if r.returncode > 1 or not r.stdout:
            return f'cannot be drawn: {r.stderr}'
        pixels = json.loads(r.stdout)['pixels']
        return None if pixels >= 10 else f'changes {pixels} pixels'

    def not_in_gltf(self, name, found):
        if name not in self.worlds:
            return 'there is no world in node_fates.txt'
        has = []
        for file in self.files(name):
            out = file.with_suffix('.gltf')
            r = run('convert', file, out, '-q', '--behaviour', 'interactivity', '--animation-pointer')
            if r.returncode > 1:
                return f'cannot be converted: {r.stderr}'
            has.append(json.dumps(found(json.loads(out.read_text()))))
        return None if has[0] not in ('null', '[]', has[1]) else 'the glTF is the same without it'

    def not_kept(self, name):
        """X3D that is made of its document in the corpus has it."""
        out = self.folder / f'{name}.x3d'
        r = run('convert', ROOT / f'corpus/x3d/{name}.x3d', out, '-q', '-p', 'none')
        if r.returncode > 1:
            return f'cannot be converted: {r.stderr}'
        return None if f'<{name}' in out.read_text() else 'is not in the X3D output'


def main():
    names = [p.stem for p in sorted((ROOT / 'corpus/x3d').glob('*.x3d'))]
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(2) as pool:
        nodes = Nodes(pathlib.Path(folder))
        unknown = sorted(set(nodes.worlds) - set(names))
        wanted = ARGUMENTS.nodes or names
        fates = pool.map(lambda name: json.loads(run('explain', name, '--json').stdout)['types'][0]['fate'], wanted)
        faults = {name: why for name, why in pool.map(lambda n: (n[0], nodes.fault(*n)), list(zip(wanted, fates))) if why}
    for name, why in faults.items():
        print(f'{name}: {why}')
    for name in unknown:
        print(f'{name}: X3D has no such node')
    print(f'{len(wanted)} nodes, {len(nodes.worlds)} worlds, {len(faults) + len(unknown)} faults')
    return bool(faults or unknown)


sys.exit(main())
