#!/usr/bin/env python3
"""The layer law: data flows one way, so a folder sees itself and what lies below it, by its includes and by the symbols of
its objects. Third-party headers stand in sources only, and in none of the scene graph. A source includes its header first.

  tests/layers.py [--objects DIR]     DIR: where the library's objects lie, in the tree of its sources
"""
import argparse, collections, pathlib, re, subprocess, sys

root = pathlib.Path(__file__).resolve().parents[1]
below = {'base': [], 'scenegraph': ['base']}
below['geometry'] = ['scenegraph', *below['scenegraph']]
for sibling in ('light', 'parsers', 'writers'):
    below[sibling] = ['geometry', *below['geometry']]
below['passes'] = ['light', *below['light']]
below['convert'] = ['parsers', 'writers', 'passes', *below['passes']]
for user in ('tools', 'python', 'bench'):
    below[user] = ['convert', *below['convert']] + (['tools'] if user != 'tools' else [])
doors = ('geometry/openmesh/openmesh.h',)  # components that speak another library's types
third_party = re.compile(r'^(fmt|toml|xxhash|pybind11|zlib|fast_float|embree3|OpenImageIO|CLI|tbb|ft2build|freetype'
                         r'|nlohmann|pugixml|catch2|meshoptimizer|draco|tiny_gltf|OpenMesh|duktape)\b')


def include_faults():
    for folder in below:
        for path in sorted((root / folder).rglob('*')):
            if path.suffix not in ('.h', '.cpp'):
                continue
            for number, line in enumerate(path.read_text().splitlines(), 1):
                m = re.match(r'#include ["<]([^">]+)[">]', line)
                if not m:
                    continue
                top = m[1].split('/')[0]
                where = f'{path.relative_to(root)}:{number}'
                if top in below and top != folder and top not in below[folder]:
                    yield f'{where}: {folder} may not include {m[1]}'
                if third_party.match(m[1]) and (
                        path.suffix == '.h' and folder != 'python' and where.split(':')[0] not in doors or folder == 'scenegraph'):
                    yield f'{where}: third-party header {m[1]}'


def order_faults():
    """A header is complete by itself: where it has a source of its name, that includes it before all others."""
    for folder in below:
        for path in sorted((root / folder).rglob('*.cpp')):
            own = path.with_suffix('.h').relative_to(root).as_posix()
            first = re.search(r'^#include (.*)$', path.read_text(), re.MULTILINE)
            if (root / own).exists() and first and first[1] != f'"{own}"':
                yield f'{path.relative_to(root)}: its first include is {first[1]}, not "{own}"'


def symbols(objects, option):
    """Symbols of wrlkit's own by object: those it defines, or those it asks others for."""
    out = subprocess.run(['nm', '-A', option, *map(str, objects)], capture_output=True, text=True, check=True).stdout
    for line in out.splitlines():
        name, rest = line.split(':', 1)
        kind, symbol = rest.split()[-2:]
        if 'wrlkit' in symbol:
            yield pathlib.Path(name), kind, symbol


def symbol_faults(folder_of_objects):
    objects = sorted(o for o in folder_of_objects.rglob('*.o') if o.relative_to(folder_of_objects).parts[0] in below)
    folder_of = {o: o.relative_to(folder_of_objects).parts[0] for o in objects}
    # Inline functions (kinds W and V) are defined wherever they are used; they belong to the header that includes saw.
    defined = collections.defaultdict(set)
    for o, kind, symbol in symbols(objects, '--defined-only'):
        if kind not in 'WwVvu':
            defined[symbol].add(folder_of[o])
    for o, _, symbol in symbols(objects, '--undefined-only'):
        homes = defined.get(symbol)
        folder = folder_of[o]
        if homes and folder not in homes and not homes & set(below[folder]):
            plain = subprocess.run(['c++filt', symbol], capture_output=True, text=True).stdout.strip()
            yield f'{o.relative_to(folder_of_objects)}: {folder} may not use {plain}, which is defined in {", ".join(sorted(homes))}'


arguments = argparse.ArgumentParser()
arguments.add_argument('--objects', type=pathlib.Path)
objects = arguments.parse_args().objects
faults = [*include_faults(), *order_faults(), *(symbol_faults(objects) if objects else [])]
print('\n'.join(faults) or 'all includes and symbols go the right way')
sys.exit(bool(faults))
