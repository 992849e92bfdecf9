"""Thousands of small files: `corpus run` against the best shell loops over peers."""
import re
import sys

from . import measure
from .measure import Row, Table, output

ASKED = {'three.js': 25, 'Blender': 100}


def archive(_):
    text = output(sys.executable, measure.ROOT / 'bench' / 'corpus_peers.py', measure.WRLKIT, measure.SHARED / 'corpus', '200')
    lines = [[c.strip() for c in line.strip('|').split('|')] for line in text.splitlines() if re.match(r'\| (wrlkit|three|Blender)', line)]
    made = re.search(r'\d+ files that all.*', text)[0]
    rows = [Row('archive', f'corpus run, {made}', float(ratio), f"times {name}'s files a CPU second", f'{seconds} CPU s in {name}',
                'bench/corpus_peers.py wrlkit ../shared/corpus 200', ASKED[name], 'more')
            for name, seconds, _, ratio in lines if name in ASKED]
    return rows, [Table(f'Many files: {made}', ['program', 'CPU s', 'files a CPU second', 'wrlkit, times'], lines)]
