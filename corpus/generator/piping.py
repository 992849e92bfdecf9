"""Pipes, flanges, valves: the part of a Room that joins its equipment.

Whatever has an axis is made along Y and then aimed. `self.shape` makes a shape in the form the world is written in.
"""
from math import cos, pi, sin

from generator.paint import BOLT, CAST, WHEEL
from generator.solid import Cylinder, Vessel, assembly, elbow, hoop, lying, placed
from generator.vector import ALONG_Z, Z, add, aim, cross, length, rotated, sub, times, unit
from generator.vrml import group, put


class Piping:
    def __init__(self, variant):
        self.spells_with_text = variant.text
        self.shape = variant.shape
        self.bolt = self.shape(Cylinder(0.014, 0.1, 6), BOLT, 'Bolt_M16')
        self.flanges, self.valves = {}, {}

    def pipe(self, skin, radius, path):
        """Straights between the corners of a path of axis-parallel legs, and elbows in them."""
        bend = radius * 2.5
        bow = self.shape(elbow(bend, radius, sides(radius)), skin, 'Elbow')
        parts, start = [], path[0]
        for corner, after in zip(path[1:], path[2:]):
            inward, outward = unit(sub(corner, start)), unit(sub(after, corner))
            end = sub(corner, times(inward, bend))
            parts.append(self.straight(skin, radius, start, end))
            parts.append(put(bow, at=end, turn=aim(inward, cross(outward, inward))))
            start = add(corner, times(outward, bend))
        return parts + [self.straight(skin, radius, start, path[-1])]

    def straight(self, skin, radius, a, b):
        pipe = self.shape(Cylinder(radius, round(length(sub(b, a)), 4), sides(radius)), skin, 'Pipe')
        return put(pipe, at=times(add(a, b), 0.5), turn=aim(sub(b, a)))

    def tee(self, skin, radius, at, run, branch):
        """The sleeve where a branch leaves a run."""
        wide = radius * 1.18
        sleeve = assembly(placed(Cylinder(wide, radius * 5)), lying(Cylinder(wide, radius * 2.6), radius * 1.3))
        return put(self.shape(sleeve, skin, 'Tee'), at=at, turn=aim(run, branch))

    def cap(self, skin, radius, at, direction):
        """A dished end."""
        cap = Vessel(radius * 1.05, radius, radius * 0.6, 12)
        return put(self.shape(cap, skin, 'Pipe_cap'), at=at, turn=aim(direction))

    def flanged(self, radius, at, direction):
        return put(self.flange(radius), at=at, turn=aim(direction))

    def flange(self, radius):
        """A pair of flanges, a gap for the gasket between them, bolts through both."""
        if radius not in self.flanges:
            big, thick, bolts = radius * 1.75, 0.03, 6 if radius > 0.1 else 4
            disc = self.shape(Cylinder(big, thick, 16 if radius > 0.1 else 10), CAST, 'Flange_disc')
            parts = [put(disc, at=(0, side * (thick / 2 + 0.003), 0)) for side in (-1, 1)]
            circle = [(big * 0.84 * cos(a), 0, big * 0.84 * sin(a)) for a in (2 * pi * i / bolts for i in range(bolts))]
            parts += [put(self.bolt, at=place) for place in circle]
            self.flanges[radius] = group(parts, f'Flange_{diameter(radius)}')
        return self.flanges[radius]

    def valve(self, tag, radius, at, direction, stem):
        if radius not in self.valves:
            self.valves[radius] = self.gate_valve(radius)
        return put(self.valves[radius], tag, at=at, turn=aim(direction, stem))

    def gate_valve(self, radius):
        """Its stem along Z; a flange pair at each end."""
        half = radius * 2.4
        body = assembly(placed(Cylinder(radius * 1.15, half * 1.6)),
                        lying(Vessel(radius * 1.1, radius * 1.2, radius * 0.5, 10), radius * 1.3),
                        lying(Cylinder(radius * 1.6, 0.03), radius * 2.1),
                        lying(Cylinder(radius * 0.6, radius * 1.8, 6), radius * 3))
        stem = self.shape(Cylinder(0.012, radius * 3, 6), BOLT, 'Valve_stem')
        return group([self.shape(body, CAST, 'Valve_body'),
                      put(stem, at=(0, 0, radius * 4.6), turn=ALONG_Z),
                      put(self.hand_wheel(radius * 1.8), at=(0, 0, radius * 5.2), turn=ALONG_Z),
                      *(put(self.flange(radius), at=(0, end, 0)) for end in (half, -half))],
                     f'Gate_valve_{diameter(radius)}')

    def hand_wheel(self, radius):
        spokes = [rotated(Z, (0, 1, 0, angle)) for angle in (0, 2 * pi / 3, 4 * pi / 3)]
        wheel = assembly(placed(hoop(radius, radius * 0.09)), placed(Cylinder(radius * 0.2, radius * 0.3, 8)),
                         *(placed(Cylinder(radius * 0.06, radius, 4), times(way, radius / 2), aim(way))
                           for way in spokes))
        return self.shape(wheel, WHEEL, 'Handwheel')


def sides(radius):
    return 8 if radius < 0.05 else 10


def diameter(radius):
    """The nominal diameter that a radius stands for."""
    return f'DN{round(radius * 2000 / 25) * 25}'
