#!/usr/bin/env python3
"""Colours everything below a node by the system that its name begins with: colour_by_system.py plant.wrl out.wrl Pump=1,0,0 Pipe=0,0.5,1"""
import sys

import wrlkit


def colour(world, systems):
    """`systems`: beginning of a name to a colour. Materials are new, so that what others share with them stays as it is."""
    materials = {prefix: world.add('Material', diffuseColor=rgb) for prefix, rgb in systems.items()}
    coloured = 0

    def below(node, material):
        nonlocal coloured
        material = next((m for prefix, m in materials.items() if node.name.startswith(prefix)), material)
        if node.type == 'Shape' and material:
            node.appearance = world.add('Appearance', material=material)
            coloured += 1
        for child in node.children if 'children' in node.fields else ():
            below(child, material)
    for root in world.roots:
        below(root, None)
    return coloured


if __name__ == '__main__':
    source, target, *words = sys.argv[1:]
    world = wrlkit.load(source)
    world.run('inline,expand-protos')
    print(colour(world, {prefix: tuple(map(float, rgb.split(','))) for prefix, rgb in (w.split('=') for w in words)}), 'coloured')
    world.save(target)
