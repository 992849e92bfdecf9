"""Other programs that read VRML, on the same plants: speed, memory, and what is lost. One that is not installed is left
out: apt-get install assimp-utils occt-draw libcoin-dev meshlab view3dscene blender python3-numpy xvfb; npm: three (script/bootstrap), x3d-tidy."""
import json
import os
import shutil

from ..glb import glb_json, n_triangles
from . import measure
from .measure import Row, Table, megabytes, number, once, plant

PEERS = measure.SHARED / 'bench' / 'peers'
MODULES = measure.ROOT / 'tests' / 'browser' / 'node_modules'
TIDY = measure.DATA / 'npm' / 'node_modules' / 'x3d-tidy' / 'bin' / 'x3d-tidy.js'


def programs():
    """name: (command, ending); {in} and {out} are filled in."""
    found = {'wrlkit': ([measure.WRLKIT, 'convert', '-q', '--jobs', '1', '{in}', '{out}'], '.glb')}
    coin = measure.SHARED / 'bench' / 'src' / 'coin_ref.cpp'
    if os.path.exists('/usr/include/Inventor/SoDB.h'):
        found['Coin 4, reads only'] = ([measure.compiled('coin_ref', coin, '-lCoin'), '--parse-only', '{in}'], None)
    if shutil.which('occt-draw'):
        found['OCCT 7.6'] = (['env', f'LD_LIBRARY_PATH={occt_libraries()}', 'PEER_IN={in}', 'PEER_OUT={out}', 'occt-draw', '-b', '-f',
                              PEERS / 'occt_convert.tcl'], '.glb')
    if shutil.which('assimp'):
        found['assimp 5.2'] = (['sh', '-c', 'tovrmlx3d --encoding xml "$1" > "$2.x3d" && assimp export "$2.x3d" "$2" -fglb2', 'x', '{in}', '{out}'], '.glb')
    if shutil.which('tovrmlx3d'):
        found["Castle's tovrmlx3d, to X3D"] = (['sh', '-c', 'tovrmlx3d --encoding xml "$1" > "$2"', 'x', '{in}', '{out}'], '.x3d')
    if (MODULES / 'three').exists():
        found['three.js in Node.js'] = (['env', f'PEERS_NODE_MODULES={MODULES}', 'node', '--max-old-space-size=12000', PEERS / 'three_convert.mjs', '{in}', '{out}'], '.glb')
    if shutil.which('meshlabserver') and shutil.which('xvfb-run'):
        found['MeshLab 2020.09, to OBJ'] = (['xvfb-run', '-a', 'meshlabserver', '-i', '{in}', '-o', '{out}'], '.obj')
    if shutil.which('blender'):
        found['Blender 3.4'] = (['env', 'PATH=/usr/bin:/bin', 'blender', '-b', '--factory-startup', '-P', PEERS / 'blender_convert.py', '--', '{in}', '{out}'], '.glb')
    if TIDY.exists():
        found['x3d-tidy, to X3D'] = (['node', '-r', PEERS / 'f16.cjs', TIDY, '-i', '{in}', '-o', '{out}'], '.x3dv')
    return found


def occt_libraries():
    """DRAW opens its toolkits by names without a version, which Debian has in the packages for development only."""
    folder = measure.DATA / 'occt'
    folder.mkdir(parents=True, exist_ok=True)
    for library in (l for l in os.listdir('/usr/lib/x86_64-linux-gnu') if l.startswith('libTK') and '.so.' in l):
        link = folder / (library.split('.so.')[0] + '.so')
        if not link.exists():
            link.symlink_to(f'/usr/lib/x86_64-linux-gnu/{library}')
    return folder


def shown(document):
    """Triangles drawn, named nodes, and materials in use of a glTF."""
    meshes, nodes = (document.get(k, []) for k in ('meshes', 'nodes'))
    used = [n['mesh'] for n in nodes if 'mesh' in n]
    triangles, materials = 0, set()
    for mesh in used:
        for p in meshes[mesh]['primitives']:
            triangles += n_triangles(document, p)
            materials.add(json.dumps(document['materials'][p['material']].get('pbrMetallicRoughness')) if 'material' in p else '')
    return triangles, len({n['name'] for n in nodes if 'name' in n}), len(materials)


def run(command, ending, source):
    out = measure.DATA / f'peer{ending or ""}'
    out.unlink(missing_ok=True)
    filled = [str(c).replace('{in}', str(source)).replace('{out}', str(out)) for c in command]
    code, cost = once(filled, timeout=900)
    if code != 0 or (ending and not out.exists()):
        return None, ''
    return cost, shown(glb_json(out)) if ending == '.glb' else ''


def readers(_):
    """Rows: how many times wrlkit's CPU time each peer takes for the larger plant that it can do."""
    small, large = plant('1M'), plant('10M')
    rows, lines, curves, ours = [], [], {}, {}
    for name, (command, ending) in programs().items():
        line, curves[name], in_glb = [name], [], ''
        for source in (small, large):
            cost, seen = run(command, ending, source)
            mb = megabytes(source)
            if not cost:
                line += ['failed or over 900 s', '']
                continue
            line += [number(mb / cost.cpu), number(cost.peak / mb)]
            curves[name].append((mb, cost.cpu))
            ours.setdefault(source, cost)
            last, in_glb = (cost.cpu / ours[source].cpu, cost, source), seen
        line.append(in_words(in_glb))
        lines.append(line)
        if name != 'wrlkit' and curves[name]:
            ratio, cost, source = last
            rows.append(Row('peers', f'{name}, plant of {number(megabytes(source))} MB', ratio, "times wrlkit's CPU time",
                            f'{number(cost.cpu)} CPU s, {number(cost.peak)} MB', f'{source.name} to {ending or "memory"}', None, 'more'))
    head = ['program', '1.4 MB: MB a CPU s', 'peak, times the file', '10.6 MB: MB a CPU s', 'peak, times the file', 'in its GLB']
    return rows, [Table('Programs that read VRML', head, lines, {'axes': ('MB', 'CPU s'), 'curves': {k: v for k, v in curves.items() if v}})]


def in_words(seen):
    if not seen:
        return ''
    triangles, names, materials = seen
    return f'{triangles:,} triangles, {names} different names, {materials} materials'
