#!/usr/bin/env python3
"""Removes Shapes whose geometry is smaller than a size, as bolts and handles are: remove_small.py plant.wrl out.wrl 0.05

Also a pass: wrlkit convert plant.wrl out.wrl --python remove_small.py -p 'inline,expand-protos,tessellate,remove-small{size=0.05},prune'
"""
from typing import Annotated
import sys

import wrlkit


@wrlkit.pass_
def remove_small(world, size: Annotated[float, wrlkit.Range(0)] = 0.05):
    """Remove Shapes whose geometry is smaller than a size; `tessellate` comes before it and `prune` behind it.

    size: diagonal in metres, in the coordinates of the geometry itself
    """
    removed = 0
    for shape in world.nodes('Shape'):
        points = shape.geometry.mesh().positions if shape.geometry else ()
        if len(points) and ((points.max(axis=0) - points.min(axis=0)) ** 2).sum() ** 0.5 < size:
            shape.geometry = None
            removed += 1
    return {'removed': removed}


if __name__ == '__main__':
    source, target, size = sys.argv[1:]
    world = wrlkit.load(source)
    world.run('inline,expand-protos,tessellate')
    print(remove_small(world, float(size))['removed'], 'removed')
    world.run('prune')
    world.save(target)
