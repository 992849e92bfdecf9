"""wrlkit: worlds of VRML, X3D and glTF from Python.

    import wrlkit
    world = wrlkit.load('plant.wrl')
    for material in world.nodes('Material'):
        material.diffuseColor = 0.8, 0.1, 0.1
    world.run('weld,lod{ratios=0.3}')
    world.save('plant.glb')
"""
from ._wrlkit import Error, Mesh, Message, Node, World, load, passes

__all__ = ['Error', 'Mesh', 'Message', 'Node', 'World', 'load', 'passes']
