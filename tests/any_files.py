#!/usr/bin/env python3
"""Every verb with every kind of input and output, drawn at random with a seed: it ends with an exit code of docs, says why where that is not 0, harms
no file that it was not told to write, and with --json prints one document when nothing was made."""
import argparse, json, os, pathlib, random, shutil, subprocess, sys, tempfile

parser = argparse.ArgumentParser()
parser.add_argument('--wrlkit', required=True)
parser.add_argument('--runs', type=int, default=400)
parser.add_argument('--seed', type=int, default=1)
ARGUMENTS = parser.parse_args()
WRLKIT = str(pathlib.Path(ARGUMENTS.wrlkit).resolve())

BOX = '#VRML V2.0 utf8\nDEF A Shape { appearance Appearance { material Material { } } geometry Box { } }\nPointLight { }\n'
FILES = {'whole.wrl': BOX, 'cut.wrl': BOX + 'Group { children [ Shape { geom', 'junk.wrl': 'junk', 'empty.wrl': '', 'sky.wrl': '#VRML V2.0 utf8\nBackground { }',
         'folder/whole.wrl': BOX, 'file': 'x', 'recipe.toml': 'pipeline = "weld"\n', 'list': 'whole.wrl\nabsent.wrl\n'}
INPUTS = ('whole.wrl', 'absent.wrl', 'empty.wrl', 'junk.wrl', 'cut.wrl', 'sky.wrl', 'folder', 'hollow', '-', '@list', 'folder/*.wrl', 'none*.wrl', '')
OUTPUTS = ('out.glb', 'out.gltf', 'out.wrl', 'out.x3d', 'out.png', 'out.html', 'out.json', 'out.xml', 'out.csv', 'out', 'folder', 'file/out.glb', 'new/deep/out.glb',
           '/dev/null', '/dev/full', '-', '')
SMALL = ['--width', '16', '--height', '16']
# Inputs at most, where the output stands (None: there is none), what else is needed.
VERBS = {'info': (2, None, []), 'check': (2, None, []), 'diff': (2, None, []), 'convert': (1, '', []), 'optimize': (1, '', []), 'render': (2, '', SMALL),
         'illuminate': (1, '', ['--samples', '1']), 'cat': (1, '-o', []), 'simplify': (1, '-o', ['--ratios', '0.5']), 'compare-lod': (1, '-o', []),
         'tiles': (2, '-o', []), 'view': (2, '-o', []), 'corpus run': (2, '-o', []), 'corpus plan': (2, '-o', []), 'corpus report': (1, '', [])}
FITTING = {'render': 'out.png', 'view': 'out.html', 'illuminate': 'out.xml', 'compare-lod': 'out.html', 'tiles': 'out', 'simplify': 'out', 'cat': 'out.wrl',
           'corpus run': 'out', 'corpus plan': 'out'}
TALKS = ('info', 'check', 'diff')  # about what they read, on standard output


def command(chance):
    verb = chance.choice(list(VERBS))
    most, place, more = VERBS[verb]
    words = verb.split() + (['recipe.toml'] if verb in ('corpus run', 'corpus plan') else [])
    words += [chance.choice(INPUTS) for _ in range(chance.randint(1, most))]
    if place:
        words.append(place)
    if place is not None:
        words.append(FITTING.get(verb, 'out.glb') if chance.random() < 0.6 else chance.choice(OUTPUTS))
    words += more
    if chance.random() < 0.4:
        words.append('--json')
    if chance.random() < 0.2:
        words += ['--report', chance.choice(('report.json', 'whole.wrl', '/dev/full', 'file/report.json', '-', ''))]
    return verb, words


def faults_of(verb, words, result):
    if result.returncode not in (0, 1, 2, 3):
        yield f'exit code {result.returncode}'
    if result.returncode and not result.stderr and verb not in TALKS:
        yield 'nothing is said'
    for name, text in FILES.items():
        path = pathlib.Path(name)
        if not path.is_file() or path.read_text() != text:
            yield f'{name} is no longer what it was'
    if result.returncode == 3 and '--json' in words:
        try:
            json.loads(result.stdout)
        except ValueError:
            yield f'no JSON: {result.stdout[:80]}'


def fill():
    for name in os.listdir():
        shutil.rmtree(name) if os.path.isdir(name) else os.remove(name)
    for name, text in FILES.items():
        path = pathlib.Path(name)
        path.parent.mkdir(exist_ok=True)
        path.write_text(text)
    os.mkdir('hollow')


def main():
    chance, wrong = random.Random(ARGUMENTS.seed), 0
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        for _ in range(ARGUMENTS.runs):
            fill()
            verb, words = command(chance)
            result = subprocess.run([WRLKIT, *words], input=BOX.encode(), capture_output=True, timeout=60)
            for fault in faults_of(verb, words, result):
                print(f'{fault}: wrlkit {" ".join(w or repr(w) for w in words)}: {result.stderr[:200]}')
                wrong += 1
        os.chdir('/')
    print(f'{ARGUMENTS.runs} runs, {wrong} faults')
    return wrong > 0


sys.exit(main())
