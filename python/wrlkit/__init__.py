"""wrlkit: worlds of VRML, X3D and glTF from Python.

    import wrlkit
    world = wrlkit.load('plant.wrl')
    for material in world.nodes('Material'):
        material.diffuseColor = 0.8, 0.1, 0.1
    world.run('weld,lod{ratios=0.3}')
    world.save('plant.glb', compress='meshopt', tolerance='1mm')
"""
from typing import Any, Dict, Sequence

try:
    import numpy  # noqa: F401
except ImportError as fault:
    raise ImportError('wrlkit needs NumPy (Debian: python3-numpy)') from fault

from . import _wrlkit, arguments, nodes, notebook
arguments.explain(_wrlkit, _wrlkit.World, _wrlkit.Node)
from ._wrlkit import __version__, Mesh, Message, Node, World, convert, load, load_bytes, node_types, passes
from .errors import Error
from .definitions import Range, pass_

World._repr_html_ = notebook.world_html
_load_for_info = arguments.renamed(load, 'info')

__all__ = ['__version__', 'Error', 'Mesh', 'Message', 'Node', 'Range', 'World', 'convert', 'info', 'load', 'load_bytes', 'node_types', 'nodes', 'pass_', 'passes']


def info(path: str, allow: Sequence[str] = (), unit: str = '', up: str = '', recognise: bool = False) -> Dict[str, Any]:
    """What is inside a world, as `wrlkit info --json` says it: a dict of format, nodes, triangles, bounds, textures and more. With `recognise` what the parts are, too: 'forms'."""
    return _load_for_info(path, list(allow), unit, up).info(recognise)
