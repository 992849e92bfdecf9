"""Types of nodes for annotations, one for each row of the node table: def paint(material: nodes.Material). At run time each is Node."""
from ._wrlkit import Node, node_types


def __getattr__(name):
    if name in node_types():
        return Node
    raise AttributeError(f"there is no node type '{name}'")
