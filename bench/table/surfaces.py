"""Single surfaces: edge collapse against meshoptimizer, welding, unfolding."""
import re

from . import measure
from .measure import Row, Table, number, output, plant


def collapse(runs):
    lines, rows = [], []
    for faces, asked in (('1000000', 1.0), ('100000', 0.8)):
        rates = {}
        for _ in range(runs):
            for line in output(measure.PROGRAMS / 'simplify_bench', 'speed', faces).splitlines():
                if found := re.match(r'(\S+) .*ktriangles/s=(\d+)', line):
                    rates.setdefault(found[1], []).append(int(found[2]))
        rates = {name: sorted(list_)[len(list_) // 2] for name, list_ in rates.items()}
        peer = rates['meshopt']
        for name, rate in rates.items():
            lines.append([name, f'{int(faces):,}', f'{rate:,}', number(rate / peer)])
        rows.append(Row('surfaces', f'lindstrom-turk, torus of {int(faces):,} triangles to 10 %', rates['lindstrom-turk'] / peer,
                        "times meshoptimizer's speed", f'{rates["lindstrom-turk"]:,} thousand triangles a CPU s',
                        f'simplify_bench speed {faces}', asked, 'more'))
    return rows, [Table('Edge collapse', ['criterion', 'triangles', 'thousand triangles a CPU s', 'of meshoptimizer'], lines)]


def weld(_):
    path = plant('100M', '--soup')
    text = output(measure.PROGRAMS / 'wrlkit_bench', path, '--benchmark_filter=weld', '--benchmark_format=csv')
    rates = {name: float(rate) for name, rate in re.findall(r'"?weld_points/(\w+)"?,(?:[^,\n]*,){5}([\d.e+]+)', text)}
    rows = [Row('surfaces', f'weld, {name}, loose faces of 100 MB', rate / 1e6, 'million corners a CPU s', '',
                'wrlkit_bench plant.wrl --benchmark_filter=weld', 30 if name == 'exact' else None, 'more') for name, rate in rates.items()]
    return rows, []


def unfold(_):
    """No peer: the only xatlas that can be installed here runs in browsers alone."""
    lines = []
    for mesh in ('bunny', 'armadillo', 'plantC'):
        path = measure.DATA / f'{mesh}.wrl'
        measure.once([measure.WRLKIT, 'convert', '-q', measure.SHARED / 'meshes' / f'{mesh}.wrl.gz', path])
        found = dict(re.findall(r'(\w+)=(\S+)', output(measure.PROGRAMS / 'unwrap_bench', path, '2048')))
        lines.append([mesh, *(found[k] for k in ('faces', 'unfold', 'pack', 'charts', 'coverage', 'L2'))])
    head = ['mesh', 'triangles', 'unfold, CPU s', 'pack, CPU s', 'charts', 'coverage', 'stretch L2']
    return [], [Table('Unfolding and packing to one page of 2,048 x 2,048 texels', head, lines)]
