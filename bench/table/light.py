"""Baked light against Blender's Cycles, over the same texels (bench/cycles_bake.py)."""
import re
import shutil
import sys

from . import measure
from .measure import Row, Table, number, output

ASKED = {'stairs': 100, 'box': 100, 'hall': 60}


def as_good(table):
    """(CPU s of Cycles with the most samples, CPU s and settings of the cheapest bake of ours whose error is no larger)."""
    cost = lambda line: (float(line[1]), float(line[2].split()[0]))
    theirs = [line for line in table if line[0].startswith('Cycles')][-1]
    ours = [line for line in table if line[0].startswith('wrlkit') and cost(line)[1] <= cost(theirs)[1]]
    best = min(ours, key=cost, default=None)
    return theirs, best


def bake(_):
    if not shutil.which('blender'):
        return [], []
    rows, tables = [], []
    for room, asked in ASKED.items():
        text = output(sys.executable, measure.ROOT / 'bench' / 'cycles_bake.py', measure.WRLKIT, measure.DATA / 'cycles', room, '16,64,256')
        table = [[c.strip() for c in line.strip('|').split('|')] for line in text.splitlines() if re.match(r'\| (Cycles|wrlkit)', line)]
        tables.append(Table(f'Baked light, {room}', ['who', 'CPU s', 'relative RMSE'], table))
        theirs, best = as_good(table)
        if best:
            rows.append(Row('light', f'bake, {room}, no worse than {theirs[0]}', float(theirs[1]) / float(best[1]), "of Cycles' CPU time, 1 /",
                            f'{best[0]}: {best[1]} CPU s, {best[2]}; Cycles {theirs[1]} s, {theirs[2]}', f'bench/cycles_bake.py wrlkit WORK {room}', asked, 'more'))
    return rows, tables


def threads(runs):
    """A bake on two threads against one."""
    world = measure.ROOT / 'corpus' / 'paper' / 'stairs_room.wrl'
    command = [measure.WRLKIT, 'convert', '-q', world, measure.DATA / 'lit.glb', '-p', 'lightmap{quality=normal}', '--jobs']
    costs = measure.in_turn({'one': [*command, '1'], 'two': [*command, '2']}, runs)
    return [Row('light', 'bake, stairs room at normal, two threads', costs['one'].wall / costs['two'].wall, 'times as fast as one',
                f'{number(costs["two"].wall)} s', "wrlkit convert -p 'lightmap{quality=normal}' --jobs N", 1.9, 'more', wall=True)], []
