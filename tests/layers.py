#!/usr/bin/env python3
"""Who may include whom: parsers, passes and writers see the scene graph and themselves, nothing else; third-party headers
stand in sources only, and in none of the scene graph."""
import pathlib, re, sys

root = pathlib.Path(__file__).resolve().parents[1]
folders = ['scenegraph', 'parsers', 'passes', 'writers', 'tools']
allowed = {'scenegraph': ['scenegraph'], 'parsers': ['scenegraph', 'parsers'], 'passes': ['scenegraph', 'passes'],
           'writers': ['scenegraph', 'writers'], 'tools': folders}
third_party = re.compile(r'^(fmt|toml|xxhash|pybind11|zlib|fast_float|embree3|OpenImageIO|CLI|tbb|ft2build|freetype|nlohmann|pugixml|catch2|meshoptimizer|draco)\b')
faults = []
for folder in folders:
    for path in sorted((root / folder).rglob('*')):
        if path.suffix not in ('.h', '.cpp'):
            continue
        for number, line in enumerate(path.read_text().splitlines(), 1):
            m = re.match(r'#include ["<]([^">]+)[">]', line)
            if not m:
                continue
            top = m[1].split('/')[0]
            where = f'{path.relative_to(root)}:{number}'
            if top in folders and top not in allowed[folder]:
                faults.append(f'{where}: {folder} may not include {m[1]}')
            if third_party.match(m[1]) and (path.suffix == '.h' or folder == 'scenegraph'):
                faults.append(f'{where}: third-party header {m[1]}')
print('\n'.join(faults) or 'all includes go the right way')
sys.exit(bool(faults))
