"""Vectors are tuples of three; a turn is a VRML rotation, axis and angle."""
from dataclasses import dataclass
from math import acos, cos, pi, sin, sqrt


def add(a, b):
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def sub(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def times(a, k):
    return (a[0] * k, a[1] * k, a[2] * k)


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def length(a):
    return sqrt(dot(a, a))


def unit(a):
    return times(a, 1 / length(a))


def across(a):
    """Some direction square to a; up where that is possible."""
    side = cross(a, (0, 1, 0))
    return unit(cross(side, a)) if length(side) > 1e-6 else (0, 0, 1)


def rotated(p, turn):
    """Rodrigues' formula; turn is a VRML rotation."""
    axis, angle = unit(turn[:3]), turn[3]
    along = times(axis, dot(axis, p) * (1 - cos(angle)))
    return add(add(times(p, cos(angle)), times(cross(axis, p), sin(angle))), along)


def aim(direction, up=None):
    """The rotation that takes local Y to direction and local Z to up."""
    y = unit(direction)
    z = unit(up) if up else across(y)
    x = cross(y, z)
    angle = acos(max(-1, min(1, (x[0] + y[1] + z[2] - 1) / 2)))
    if angle < 1e-6:
        return (0, 0, 1, 0)
    if angle > pi - 1e-6:
        return (*half_turn_axis(x, y, z), pi)
    return (*unit((y[2] - z[1], z[0] - x[2], x[1] - y[0])), angle)


def half_turn_axis(x, y, z):
    """R + I = 2 a a^T: any column of it that is not zero is the axis."""
    columns = add(x, (1, 0, 0)), add(y, (0, 1, 0)), add(z, (0, 0, 1))
    return unit(max(columns, key=length))


@dataclass(frozen=True)
class Pose:
    at: tuple = None
    turn: tuple = None
    scale: tuple = None

    def apply(self, p):
        if self.scale:
            p = tuple(a * b for a, b in zip(p, self.scale))
        if self.turn:
            p = rotated(p, self.turn)
        return add(p, self.at) if self.at else p


HERE = Pose()


X, Y, Z = (1, 0, 0), (0, 1, 0), (0, 0, 1)
ALONG_X, ALONG_Z = aim(X, Y), aim(Z, Y)
