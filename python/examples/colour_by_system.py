#!/usr/bin/env python3
"""Colours everything below a node by the system that its name begins with: colour_by_system.py plant.wrl out.wrl Pump=ff0000 Pipe=0080ff

Also a pass: wrlkit convert plant.wrl out.wrl --python colour_by_system.py -p 'inline,expand-protos,colour-by-system{systems=Pump=ff0000:Pipe=0080ff}'
"""
import sys

import wrlkit


@wrlkit.pass_
def colour_by_system(world, systems: list[str] = []):
    """Colour everything below a node by the system that its name begins with.

    systems: beginnings of names with a colour each, Pump=ff0000; of several that fit the first counts
    """
    materials = {}  # new ones, so that what others share with them stays as it is
    for system in systems:
        prefix, colour = system.split('=')
        materials[prefix] = world.add('Material', diffuseColor=[byte / 255 for byte in bytes.fromhex(colour)])
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
    return {'coloured': coloured}


if __name__ == '__main__':
    source, target, *systems = sys.argv[1:]
    world = wrlkit.load(source)
    world.run('inline,expand-protos')
    print(colour_by_system(world, systems)['coloured'], 'coloured')
    world.save(target)
