"""The main road: bytes of VRML97 to a scene, and to GLB, against the floor; other formats against it; the start."""
from . import measure
from .measure import Row, Table, in_turn, megabytes, number, plant

SIZES = ['1M', '10M', '100M', '500M']
KINDS = {'one Shape a face': '--explode', 'loose faces': '--soup', 'nothing repeats': '--world'}


def commands(path, glb):
    convert = [measure.WRLKIT, 'convert', '-q', path, glb, '--jobs']
    return {
        'floor': [measure.floor(), 'floats_store', path],
        'parse': [measure.WRLKIT, 'check', '--parse-only', '-q', '--jobs', '1', path],
        'one': [*convert, '1'],
        'two': [*convert, '2'],
    }


def line(name, path, costs):
    mb = megabytes(path)
    return [name, number(mb), number(mb / costs['floor'].cpu), number(mb / costs['parse'].cpu), number(mb / costs['one'].cpu),
            number(costs['floor'].cpu / costs['parse'].cpu), number(costs['one'].cpu / costs['floor'].cpu),
            number(costs['one'].wall / costs['two'].wall), number(costs['one'].peak / mb)]


def rows_of(name, path, costs, reach):
    mb = megabytes(path)
    parse, glb, threads, peak = reach
    said = 'wrlkit convert -q --jobs N plant.wrl out.glb'
    return [
        Row('road', f'parse, {name}, one thread', costs['floor'].cpu / costs['parse'].cpu, "times the floor's speed",
            f'{number(mb / costs["parse"].cpu)} MB a CPU s', 'wrlkit check --parse-only -q --jobs 1 plant.wrl', parse, 'more'),
        Row('road', f'to GLB, {name}, one thread', costs['one'].cpu / costs['floor'].cpu, "times the floor's CPU time",
            f'{number(costs["one"].cpu)} CPU s', said, glb),
        Row('road', f'to GLB, {name}, two threads', costs['one'].wall / costs['two'].wall, 'times as fast as one',
            f'{number(costs["two"].wall)} s', said, threads, 'more', wall=True),
        Row('road', f'peak memory, {name}', costs['one'].peak / mb, 'times the file', f'{number(costs["one"].peak)} MB', said, peak),
    ]


def plants(runs):
    """Rows and a table of plants that grow, and of 100 MB in the other habits of exporters."""
    glb = measure.DATA / 'out.glb'
    rows, lines = [], []
    curves = {'floor': [], 'wrlkit, parse': [], 'wrlkit, to GLB': []}
    for size in SIZES:
        path = plant(size)
        costs = in_turn(commands(path, glb), runs if size != '500M' else 3)
        lines.append(line('plant', path, costs))
        for curve, key in zip(curves, ('floor', 'parse', 'one')):
            curves[curve].append((megabytes(path), costs[key].cpu))
        if size in ('100M', '500M'):
            rows += rows_of(f'plant of {size[:-1]} MB', path, costs, (1.2, 2.2, 1.75, 1.3))
    for name, option in KINDS.items():
        path = plant('100M', option)
        costs = in_turn(commands(path, glb), runs)
        lines.append(line(name, path, costs))
        rows += rows_of(f'{name}, 100 MB', path, costs, (0.9 if option == '--explode' else None, None, None, None))
    head = ['file', 'MB', 'floor, MB a CPU s', 'parse', 'to GLB', 'parse, of the floor', 'GLB, times the floor', 'two threads', 'peak, times the file']
    return rows, [Table('Plants, and the habits of exporters', head, lines, {'axes': ('MB', 'CPU s'), 'curves': curves})]


def formats(runs):
    """The same plant from and to other formats."""
    source = plant('100M')
    x3d, glb, out = (measure.DATA / name for name in ('plant_100M.x3d', 'plant_100M.glb', 'out'))
    for made in (x3d, glb):
        if not made.exists():
            measure.output(measure.WRLKIT, 'convert', '-q', source, made)
    ways = {
        'VRML97 to GLB': [source, f'{out}.glb'],
        'VRML97 to VRML97': [source, f'{out}.wrl'],
        'X3D to GLB': [x3d, f'{out}.glb'],
        'GLB to GLB': [glb, f'{out}.glb'],
    }
    costs = in_turn({name: [measure.WRLKIT, 'convert', '-q', '--jobs', '1', *files] for name, files in ways.items()}, runs)
    base = costs['VRML97 to GLB'].cpu
    return [Row('road', f'{name}, plant of 100 MB', costs[name].cpu / base, 'times VRML97 to GLB', f'{number(costs[name].cpu)} CPU s',
                f'wrlkit convert -q --jobs 1 {files[0].name} out{files[1][-4:]}', 1.5)
            for name, files in list(ways.items())[1:]], []


def start(runs):
    """What a small world costs: the start of the process."""
    small, glb = measure.DATA / 'small.wrl', measure.DATA / 'small.glb'
    shape = 'Shape { appearance Appearance { material Material { diffuseColor 0.8 0.2 0.1 } } geometry Box { size 1 2 3 } }\n'
    small.write_text('#VRML V2.0 utf8\n' + shape * 18)
    empty = measure.DATA / 'empty.cpp'
    empty.write_text('#include <cstdio>\nint main() { std::puts("x"); }\n')
    costs = in_turn({'wrlkit': [measure.WRLKIT, 'convert', '-q', small, glb], 'empty': [measure.compiled('empty', empty)]}, 40 * runs)
    return [Row('road', 'a world of 2 kB to GLB', 1000 * costs['wrlkit'].cpu, 'ms of CPU',
                f'a C++ program that prints one letter: {number(1000 * costs["empty"].cpu)} ms', 'wrlkit convert -q small.wrl out.glb', 3)], []
