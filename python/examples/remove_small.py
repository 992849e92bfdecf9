#!/usr/bin/env python3
"""Removes Shapes whose geometry is smaller than a size, as bolts and handles are: remove_small.py plant.wrl out.wrl 0.05"""
import sys

import wrlkit


def remove_small(world, size):
    """The diagonal of a geometry, in its own coordinates, decides. Returns how many are gone."""
    removed = 0
    for shape in world.nodes('Shape'):
        points = shape.geometry.mesh().positions if shape.geometry else ()
        if len(points) and ((points.max(axis=0) - points.min(axis=0)) ** 2).sum() ** 0.5 < size:
            shape.geometry = None
            removed += 1
    return removed


if __name__ == '__main__':
    source, target, size = sys.argv[1:]
    world = wrlkit.load(source)
    world.run('inline,expand-protos,tessellate')
    print(remove_small(world, float(size)), 'removed')
    world.run('prune')
    world.save(target)
