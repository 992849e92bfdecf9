"""Measures groups of work against their bounds, in one run, and writes docs/performance.md from them.

  script/bench [GROUP...]                 the figures of these groups, all by default, as they are measured
  script/bench --publish [GROUP...]       docs/performance.md, its plots, and bench/published.json; groups that are not named keep their figures
  script/bench --check [GROUP...]         ratios against those of bench/published.json: 10 % of margin, three tries
"""
import argparse
import dataclasses
import datetime
import json
import os
import sys

from . import archive, light, measure, page, peers, plot, road, surfaces
from .measure import Row, Table, number

GROUPS = {
    'plants': road.plants,
    'formats': road.formats,
    'start': road.start,
    'peers': peers.readers,
    'archive': archive.archive,
    'collapse': surfaces.collapse,
    'weld': surfaces.weld,
    'unfold': surfaces.unfold,
    'bake': light.bake,
    'threads': light.threads,
    'page': page.page,
}
QUIET = 1  # load at which wall time means something on two cores
PUBLISHED = measure.ROOT / 'bench' / 'published.json'
PAGE = measure.ROOT / 'docs' / 'performance.md'
MARK = '<!-- what follows is written by script/bench --publish -->'


def markdown(head, lines):
    return '\n'.join(['| ' + ' | '.join(map(str, line)) + ' |' for line in (head, ['---'] * len(head), *lines)]) + '\n'


def row_line(row):
    asked = '' if row.reach is None else f'{"at least" if row.better == "more" else "at most"} {row.reach:g}{"" if row.holds() else ": **not met**"}'
    return [row.work, f'{number(row.ratio)} {row.bound}', asked, row.figures, f'`{row.command}`']


def page_text(groups):
    parts = []
    for name, group in groups.items():
        parts.append(f'## {name.capitalize()}\n\n*{group["when"]}, load {group["load"]:.1f}*\n')
        rows = [Row(**r) for r in group['rows']]
        if rows:
            parts.append(markdown(['work', 'ratio', 'asked', 'figures', 'command'], map(row_line, rows)))
        for i, table in enumerate(Table(**t) for t in group['tables']):
            parts.append(f'{table.title}:\n\n' + markdown(table.head, table.rows))
            if table.plot:
                parts.append(f'![{table.title}: {" against ".join(table.plot["axes"])}](pictures/performance_{name}_{i}.svg)\n')
    return '\n'.join(parts)


def publish(groups):
    PUBLISHED.write_text(json.dumps(groups, indent=1) + '\n')
    for name, group in groups.items():
        for i, table in enumerate(group['tables']):
            if table['plot']:
                (measure.ROOT / 'docs' / 'pictures' / f'performance_{name}_{i}.svg').write_text(plot.log_log(**table['plot']))
    prose = PAGE.read_text().split(MARK)[0]
    PAGE.write_text(f'{prose}{MARK}\n\n{page_text(groups)}')


def run(names, runs):
    out = {}
    for name in names:
        load = os.getloadavg()[0]
        rows, tables = GROUPS[name](runs)
        if not rows and not tables:
            print(f'{name}: skipped, a program that it needs is not installed', flush=True)
            continue
        if load > QUIET:
            rows = [row for row in rows if not row.wall]
        for row in rows:
            print(f'{name}: {row.work}: {number(row.ratio)} {row.bound}; {row.figures}', flush=True)
        out[name] = {'when': datetime.date.today().isoformat(), 'load': load,
                     'rows': [dataclasses.asdict(r) for r in rows], 'tables': [dataclasses.asdict(t) for t in tables]}
    return out


def worse(rows, published, load):
    """Published rows that are missing, or more than a tenth worse. Without wall time on a busy machine."""
    now = {r['work']: r['ratio'] for r in rows}

    def is_worse(row):
        if row['work'] not in now:
            return not (row['wall'] and load > QUIET)
        return (now[row['work']] / row['ratio']) ** (1 if row['better'] == 'less' else -1) > 1.1

    return [r for r in published if is_worse(r)]


def check(names, runs):
    published = json.loads(PUBLISHED.read_text())
    failed = False
    for name in names:
        if name not in published:
            continue
        for _ in range(3):
            measured = run([name], runs).get(name, {'rows': [], 'load': 0})
            bad = worse(measured['rows'], published[name]['rows'], measured['load'])
            if not bad:
                break
        for row in bad:
            print(f'{name}: {row["work"]}: {number(row["ratio"])} {row["bound"]} was published: more than 10 % worse now, or not measured')
        failed |= bool(bad)
    return 1 if failed else 0


def main():
    p = argparse.ArgumentParser(prog='script/bench', description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument('groups', nargs='*', metavar='GROUP', help=', '.join(GROUPS))
    p.add_argument('--publish', action='store_true')
    p.add_argument('--check', action='store_true')
    p.add_argument('--runs', type=int, default=5)
    a = p.parse_args()
    if unknown := [g for g in a.groups if g not in GROUPS]:
        p.error(f'there is no group {unknown[0]}; there are {", ".join(GROUPS)}')
    if not (measure.SHARED / 'bench' / 'gen_plant.py').exists():
        return print('skipped: ../shared/bench is not there') or 77
    names = a.groups or list(GROUPS)
    if a.check:
        return check(names, a.runs)
    measured = run(names, a.runs)
    if a.publish:
        known = json.loads(PUBLISHED.read_text()) if PUBLISHED.exists() else {}
        publish({name: (known | measured)[name] for name in GROUPS if name in known | measured})
    return 0


if __name__ == '__main__':
    sys.exit(main())
