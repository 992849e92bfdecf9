#!/usr/bin/env python3
"""Gives nodes the names that a table has for them: rename_tags.py plant.wrl tags.csv out.wrl. A row of the table: old,new.

Also a pass, as in tags.toml: wrlkit convert plant.wrl out.wrl --python rename_tags.py -p 'rename-tags{table=tags.csv}'
"""
import csv
import pathlib
import sys

import wrlkit


@wrlkit.pass_
def rename_tags(world, table: pathlib.Path = pathlib.Path('tags.csv')):
    """Give nodes the names that a table has for them.

    table: CSV, a row of old and new name for each
    """
    with open(table, newline='') as rows:
        tags = dict(csv.reader(rows))
    renamed = [node for node in world.nodes() if node.name in tags]
    for node in renamed:
        node.name = tags[node.name]
    return {'renamed': len(renamed)}


if __name__ == '__main__':
    source, table, target = sys.argv[1:]
    world = wrlkit.load(source)
    print(rename_tags(world, table)['renamed'], 'renamed')
    world.save(target)
