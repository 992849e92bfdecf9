"""Viewpoints that look from here to there."""
from generator.vector import Y, aim, cross, sub, unit
from generator.vrml import Node


def viewpoint(name, description, eye, target, field_of_view=0.9):
    """The horizon stays level; a viewpoint looks along its -Z."""
    back = unit(sub(eye, target))
    up = cross(back, unit(cross(Y, back)))
    return Node('Viewpoint', name, position=eye, orientation=aim(up, back), fieldOfView=field_of_view,
                description=description)
