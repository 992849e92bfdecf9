#!/usr/bin/env python3
"""Gives nodes the names that a table has for them: rename_tags.py plant.wrl tags.csv out.wrl. A row of the table: old,new."""
import csv
import sys

import wrlkit


def rename(world, tags):
    """How many nodes have got a new name."""
    renamed = 0
    for node in world.nodes():
        if node.name in tags:
            node.name = tags[node.name]
            renamed += 1
    return renamed


if __name__ == '__main__':
    source, table, target = sys.argv[1:]
    with open(table, newline='') as rows:
        tags = dict(csv.reader(rows))
    world = wrlkit.load(source)
    print(rename(world, tags), 'renamed')
    world.save(target)
