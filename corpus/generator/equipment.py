"""Tanks, pumps with their motors, and the operator's desk: the part of a Room that Piping joins."""
from math import cos, pi, sin

from generator.paint import (AIR, BOLT, CABINET, CAST, DIAL, FASCIA, GALVANISED, GUARD, INK, LAMPS, LETTER, MOTOR,
                             PLINTH, PUMP, STEEL, TANK, WHEEL)
from generator.piping import Piping
from generator.picture import lettering
from generator.solid import Ball, Box, Cylinder, Plates, Vessel, assembly, hoop, lying, placed, prism
from generator.vector import ALONG_X, ALONG_Z, X, Y, Z, aim
from generator.vrml import Node, group, put


class Equipment(Piping):
    def __init__(self, variant):
        super().__init__(variant)
        self.gauge = self.new_gauge()

    # ---- vessels -------------------------------------------------------------------------------------------------

    def tank(self, tag, at):
        """A vertical vessel on four legs; nozzles at the bottom and on top."""
        corners = [(x, z) for x in (-0.62, 0.62) for z in (-0.62, 0.62)]
        leg = self.shape(Cylinder(0.06, 1.35, 8), TANK, 'Tank_leg')
        foot = self.shape(Box(0.24, 0.03, 0.24), CAST, 'Tank_foot')
        legs = [put(leg, at=(x, 0.675, z)) for x, z in corners] + [put(foot, at=(x, 0.015, z)) for x, z in corners]
        ring = self.shape(hoop(1.0, 0.018, 28, 3), GALVANISED, 'Tank_ring')
        shell = [put(self.shape(Vessel(1.0, 2.4, 0.36, 28), TANK, 'Tank_shell', tint=True), at=(0, 2.4, 0)),
                 *(put(ring, at=(0, y, 0)) for y in (1.25, 3.55))]
        man_way = [put(self.shape(Cylinder(0.26, 0.2, 20), TANK, 'Man_way'), at=(0, 1.75, 1.04), turn=ALONG_Z),
                   self.flanged(0.17, (0, 1.75, 1.15), Z)]
        nozzles = [self.straight(TANK, 0.09, (0, 0.84, 0), (0, 1.0, 0)), self.flanged(0.08, (0, 0.84, 0), Y),
                   self.straight(TANK, 0.06, (0, 3.9, 0), (0, 4.1, 0)), self.flanged(0.05, (0, 4.1, 0), Y)]
        return group([group(shell, f'{tag}_shell'), group(legs, f'{tag}_legs'), group(man_way, f'{tag}_manway'),
                      group(nozzles, f'{tag}_nozzles')], tag, at=at)

    def receiver(self, tag, at):
        """The air receiver: a vessel that lies along Z on two saddles."""
        outline = [(-0.5, -0.95), (0.5, -0.95), (0.5, -0.85), (0.35, -0.3), (-0.35, -0.3), (-0.5, -0.85)]
        saddle = self.shape(prism(outline, 0.14), STEEL, 'Saddle')
        shell = put(self.shape(Vessel(0.55, 1.9, 0.22, 24), AIR, 'Receiver_shell', tint=True), turn=ALONG_Z)
        gauge = group([self.straight(AIR, 0.015, (0, 0.5, 0.6), (0, 0.72, 0.6)),
                       put(self.gauge, at=(0, 0.8, 0.6), turn=aim(X, Y))], f'{tag}_gauge')
        nozzle = [self.flanged(0.03, (0, 0.62, -0.3), Y), self.straight(AIR, 0.03, (0, 0.5, -0.3), (0, 0.62, -0.3))]
        return group([shell, *(put(saddle, at=(0, 0, z)) for z in (-0.65, 0.65)), gauge, *nozzle], tag, at=at)

    # ---- pumps ---------------------------------------------------------------------------------------------------

    def pump(self):
        """A pump and its motor on a base, shaft along Z at y = 0.6; the discharge points up at the origin."""
        guard = self.shape(Cylinder(0.14, 0.24, 16), GUARD, 'Coupling_guard')
        return group([self.pump_base(), self.pump_end(), put(guard, at=(0, 0.6, 0.6), turn=ALONG_Z), self.motor()],
                     'Pump_unit')

    def pump_base(self):
        return group([put(self.shape(Box(0.72, 0.24, 2.0), PLINTH, 'Plinth'), at=(0, 0.12, 0.55)),
                      put(self.shape(Box(0.52, 0.07, 1.8), STEEL, 'Base_plate'), at=(0, 0.275, 0.55)),
                      *(put(self.bolt, at=(x, 0.31, z)) for x in (-0.22, 0.22) for z in (-0.28, 0.55, 1.38))],
                     'Pump_base')

    def pump_end(self):
        casing = assembly(lying(Cylinder(0.2, 0.16, 16)), lying(hoop(0.19, 0.075, 16, 8)),
                          lying(Cylinder(0.085, 0.32), -0.2), placed(Cylinder(0.07, 0.26), (0, 0.27, 0)),
                          placed(Box(0.3, 0.3, 0.1), (0, -0.16, 0)))
        bearing = assembly(lying(Cylinder(0.16, 0.05, 16), 0.1), lying(Cylinder(0.1, 0.36), 0.28),
                           lying(Cylinder(0.12, 0.04, 12), 0.45), placed(Box(0.14, 0.3, 0.06), (0, -0.16, 0.36)))
        return group([self.shape(casing, PUMP, 'Pump_casing', tint=True), self.shape(bearing, PUMP, 'Bearing_housing'),
                      self.flanged(0.08, (0, 0, -0.36), Z), self.flanged(0.07, (0, 0.4, 0), Y)],
                     'Pump_end', at=(0, 0.6, 0))

    def motor(self):
        body = assembly(lying(Cylinder(0.19, 0.54, 16)), lying(Cylinder(0.215, 0.04, 16), -0.28),
                        lying(Cylinder(0.215, 0.04, 16), 0.28), lying(Vessel(0.2, 0.12, 0.05, 12), 0.36),
                        *(placed(Box(0.08, 0.16, 0.1), (x, -0.22, z)) for x in (-0.15, 0.15) for z in (-0.2, 0.2)))
        fins = assembly(*(placed(Box(0.012, 0.05, 0.5), (0.205 * cos(a), 0.205 * sin(a), 0), (0, 0, 1, a - pi / 2))
                          for a in (pi / 9 * i for i in range(18))))
        box = put(self.shape(Box(0.16, 0.1, 0.2), MOTOR, 'Terminal_box'), at=(0, 0.27, -0.05))
        eye = put(self.shape(hoop(0.035, 0.009, 10), BOLT, 'Lifting_eye'), at=(0, 0.25, 0.2), turn=ALONG_X)
        return group([self.shape(body, MOTOR, 'Motor_body'), self.shape(fins, MOTOR, 'Motor_fins'), box, eye],
                     'Pump_motor', at=(0, 0.6, 1.05))

    # ---- instruments ---------------------------------------------------------------------------------------------

    def new_gauge(self):
        """A dial that looks along Y; the needle lies in its plane."""
        needle = put(self.shape(Box(0.006, 0.004, 0.05), WHEEL), at=(0.012, 0.031, 0.012), turn=(0, 1, 0, 0.8))
        face = put(self.shape(Cylinder(0.066, 0.004, 12), DIAL), at=(0, 0.026, 0))
        return group([self.shape(Cylinder(0.075, 0.05, 12), CAST), face, needle], 'Gauge')

    def panel(self, tag, at):
        """The operator's desk, looking along Z."""
        outline = [(-0.3, 0), (0.4, 0), (0.4, 0.72), (0.1, 0.98), (-0.3, 0.98)]
        desk = put(self.shape(prism(outline, 1.6), CABINET, 'Desk'), turn=(0, 1, 0, -pi / 2))
        board = put(self.shape(Box(1.6, 0.75, 0.12), FASCIA, 'Board'), at=(0, 1.355, -0.22))
        dials = [put(self.gauge, at=(-0.55 + 0.22 * i, 1.28, -0.14), turn=ALONG_Z) for i in range(6)]
        bulbs = [self.shape(Ball(0.025, 8), skin) for skin in LAMPS]
        lights = [put(bulbs[(i * i + 1) % 3], at=(-0.56 + 0.16 * i, 1.1, -0.155)) for i in range(8)]
        knob, slope = self.shape(Cylinder(0.03, 0.03, 12), INK, 'Knob'), aim((0, 0.3, 0.26), (0, 0.26, -0.3))
        knobs = [put(knob, at=(-0.6 + 0.3 * i, 0.85, 0.255), turn=slope) for i in range(5)]
        labels = [put(self.label('PUMP ROOM 1', 0.1), at=(0, 1.6, -0.155)),
                  put(self.label('P-101A/B   P-102', 0.05), at=(0, 1.44, -0.155))]
        return group([desk, board, group(dials, 'PI_101'), group(lights, 'XL_101'), group(knobs, 'HS_101'), *labels],
                     tag, at=at)

    def label(self, text, size):
        """Centred on the origin's X, from the base line up."""
        if not self.spells_with_text:
            return self.shape(spelled(text, size), LETTER)
        style = Node('FontStyle', size=size, family=['SANS'], style='BOLD', justify=['MIDDLE'])
        return Node('Shape', appearance=LETTER, geometry=Node('Text', string=[text], fontStyle=style))


def spelled(text, size):
    """A line of text as flat faces, one a row of dots that touch."""
    dots, width = lettering(text)
    dot = size / 7
    rows = []
    for x, y in sorted(dots, key=lambda d: (d[1], d[0])):
        if (x - 1, y) in dots:
            continue
        run = next(n for n in range(1, 9) if (x + n, y) not in dots)
        left, low = (x - width / 2) * dot, (6 - y) * dot
        rows.append((left, low, left + run * dot, low + dot))
    return Plates(tuple(rows))
