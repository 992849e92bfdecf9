"""A pump room: two tanks, a receiver, three pumps and their pipes, a platform, in metres, Y up.

One description, written three times: every shape is asked of a Variant. The tree is unit / equipment / part, the names
are plant tags with underscores. What is made once and hung in several places is shared.
The room spans x -6..6 and z -4..4; walls stand at the back (z = -4) and on the left (x = -6).
"""
from math import pi
import random

from generator.building import Building
from generator.equipment import Equipment
from generator.paint import AIR, FIRE, PRESSURE, STEEL, WATER, checker_plate, sign_danger
from generator.solid import Cylinder, assembly, hoop, i_beam, placed
from generator.vector import ALONG_Z, X, Y, Z
from generator.variant import Faces, Loose, Primitives
from generator.view import viewpoint
from generator.vrml import Node, group, put, world

WHAT = {'primitives': 'Box, Cylinder, Cone, Sphere, Extrusion, ElevationGrid and Text nodes; equal parts by USE',
        'faces': 'IndexedFaceSets with shared vertices, quads, n-gon caps and creaseAngle; equal parts by USE',
        'loose': 'loose faces: every face has its own vertices, some have a colour a face; equal parts by USE'}


class Room(Building, Equipment):

    def unit(self):
        pump = self.pump()
        pumps = [put(pump, tag, at=(x, 0, 0.8)) for tag, x in (('P_101A', -2.6), ('P_101B', 0), ('P_102', 2.2))]
        vessels = [self.tank('TK_201', (-3.6, 0, -2.4)), self.tank('TK_202', (-1.0, 0, -2.4)),
                   self.receiver('V_203', (-5.1, 0.95, 1.2))]
        lines = [self.suction(), self.discharge(), self.fire_main(), self.air_line()]
        access = [self.platform('PF_301'), self.stairs('ST_301'),
                  self.ladder('LD_302', (0.32, 0, -2.4), (0, 1, 0, pi / 2))]
        electric = [self.cable_tray('CT_401', (0, 4.35, -3.78)), self.panel('IP_101', (3.5, 0, 2.2))]
        return group([group(pumps, 'Pumps'), group(vessels, 'Vessels'), group(lines, 'Lines'), group(access, 'Access'),
                      group(electric, 'Electric')], 'U_100')

    def suction(self):
        """Both tanks' bottom nozzles into a header at y = 0.6, and from it to the pumps."""
        r, y, z = 0.08, 0.6, -0.75
        pipes = self.pipe(WATER, r, [(-3.6, 0.82, -2.4), (-3.6, y, -2.4), (-3.6, y, z), (2.2, y, z), (2.2, y, 0.44)])
        pipes += self.pipe(WATER, r, [(-1.0, 0.82, -2.4), (-1.0, y, -2.4), (-1.0, y, z)])
        pipes.append(self.tee(WATER, r, (-1.0, y, z), X, (0, 0, -1)))
        for x in (-2.6, 0):
            pipes += [self.straight(WATER, r, (x, y, z), (x, y, 0.44)), self.tee(WATER, r, (x, y, z), X, Z)]
        valves = [self.valve(f'XV_10{i}', r, (x, y, -0.05), Z, Y) for i, x in ((1, -2.6), (2, 0), (3, 2.2))]
        valves += [self.valve(f'XV_20{i}', r, (x, y, -1.35), Z, Y) for i, x in ((1, -3.6), (2, -1.0))]
        return group([*valves, group(pipes, 'L_150_pipe')], 'L_150_suction')

    def discharge(self):
        """P-101A and B into a header at y = 2.9; it leaves through the wall, and returns into TK-201."""
        r, small, y, z, back = 0.07, 0.05, 2.9, 0.8, 0.25
        pipes = self.pipe(PRESSURE, r, [(0, 1.0, z), (0, y, z), (0, y, back), (-5.0, y, back), (-5.0, y, -4.2)])
        pipes += self.pipe(PRESSURE, r, [(-2.6, 1.0, z), (-2.6, y, z), (-2.6, y, back)])
        pipes += self.pipe(PRESSURE, small, [(-3.6, y, back), (-3.6, 4.5, back), (-3.6, 4.5, -2.4), (-3.6, 4.12, -2.4)])
        pipes += [self.tee(PRESSURE, r, (-2.6, y, back), X, Z), self.tee(PRESSURE, r, (-3.6, y, back), X, Y),
                  self.flanged(r, (-1.3, y, back), X), self.flanged(r, (-5.0, y, -1.2), Z),
                  self.flanged(small, (-3.6, 4.5, -1), Z)]
        valves = [self.valve(f'XV_11{i}', r, (x, 1.55, z), Y, X) for i, x in ((1, -2.6), (2, 0))]
        valves.append(self.valve('XV_113', small, (-3.6, 3.6, back), Y, Z))
        supports = [part for x in (-4.4, -1.3) for part in self.pipe_support(x, y, back)]
        return group([*valves, group(pipes, 'L_125_pipe'), group(supports, 'L_125_supports')], 'L_125_discharge')

    def pipe_support(self, x, y, z):
        """A post, an arm along Z on it, a shoe under the pipe."""
        post = self.shape(i_beam(2.55, 0.14, 0.12), STEEL, 'Support_post')
        return [put(post, at=(x, 0, z)), self.beam((x, y - 0.25, z - 0.4), (x, y - 0.25, z + 0.4)),
                self.plate((x, y - 0.11, z), (0.16, 0.1, 0.1), STEEL)]

    def fire_main(self):
        """P-102 under the platform to a hydrant by the back wall; a hose reel next to it."""
        r, end = 0.07, (4.3, 0.9, -3.4)
        pipes = self.pipe(FIRE, r, [(2.2, 1.0, 0.8), (2.2, 1.95, 0.8), (2.2, 1.95, -3.4), (4.3, 1.95, -3.4), end])
        pipes += [self.straight(FIRE, r, end, (4.3, 0.02, -3.4)), self.tee(FIRE, r, end, Y, Z),
                  self.flanged(r, (4.3, 0.9, -3.18), Z), self.cap(FIRE, r, (4.3, 0.9, -3.1), Z),
                  self.flanged(r, (2.2, 1.95, -1.2), Z), self.flanged(r, (4.3, 0.05, -3.4), Y)]
        drum = assembly(placed(Cylinder(0.3, 0.03, 20), (0, -0.1, 0)), placed(Cylinder(0.3, 0.03, 20), (0, 0.1, 0)),
                        placed(Cylinder(0.17, 0.2)), placed(hoop(0.22, 0.05, 14, 6)))
        reel = put(self.shape(drum, FIRE, 'Hose_reel'), 'HR_102', at=(2.6, 1.1, -3.84), turn=ALONG_Z)
        valve = self.valve('XV_121', r, (2.2, 1.5, 0.8), Y, X)
        return group([valve, group(pipes, 'L_126_pipe'), reel], 'L_126_fire_main')

    def air_line(self):
        """From the receiver along the left wall."""
        pipes = self.pipe(AIR, 0.03, [(-5.1, 1.62, 0.9), (-5.1, 2.0, 0.9), (-5.9, 2.0, 0.9), (-5.9, 2.0, -3.9),
                                      (-4.9, 2.0, -3.9), (-4.9, 3.4, -3.9)])
        return group([self.valve('XV_131', 0.03, (-5.9, 2.0, -0.6), Z, X), group(pipes, 'L_050_pipe')], 'L_050_air')


def surroundings(label):
    info = Node('WorldInfo', title='Pump room', info=[f'Unit 100, {label}', 'Metres, Y up'])
    sky = Node('Background', skyAngle=[0.9, 1.5], skyColor=[(0.25, 0.45, 0.75), (0.60, 0.75, 0.90), (0.90, 0.93, 0.95)],
               groundAngle=[1.4], groundColor=[(0.30, 0.28, 0.22), (0.55, 0.55, 0.45)])
    walk = Node('NavigationInfo', type=['EXAMINE', 'ANY'], avatarSize=[0.25, 1.7, 0.5], headlight=False, speed=2)
    views = [viewpoint('View_overview', 'Overview', (4.4, 6.3, 11.2), (-0.3, 1.5, -0.6)),
             viewpoint('View_operator', 'Operator', (4.3, 1.75, 4.9), (1.7, 1.25, 0)),
             viewpoint('View_platform', 'Platform', (5.0, 4.0, -2.8), (-1.2, 2.0, -0.4)),
             viewpoint('View_pumps', 'Pumps', (-0.9, 2.0, 3.7), (-1.5, 0.8, 0.2))]
    return [info, sky, walk, *views, *lights()]


def lights():
    """The sun and what the sky scatters; a point light a little below each lamp."""
    sun = Node('DirectionalLight', 'Sun', direction=(-0.45, -0.8, -0.55), intensity=0.65, ambientIntensity=0.45,
               color=(1, 0.98, 0.94))
    sky = Node('DirectionalLight', 'Skylight', direction=(0.7, -0.3, 0.3), intensity=0.15)
    lamps = [Node('PointLight', location=(x, 3.7, 3.85), intensity=0.5, radius=40, attenuation=(1, 0, 0.03),
                  color=(1, 0.95, 0.82)) for x in (-3, 2)]
    return [sun, sky, *lamps]


def pump_room(variant, seed):
    room = Room(variant)
    roots = [*surroundings(variant.label), room.ground(random.Random(seed)), room.building(), room.lamps(),
             room.signs(), room.unit()]
    return world(f'A pump room as {WHAT[variant.label]}', roots)


def files(seed):
    for form in (Primitives, Faces, Loose):
        variant = form(random.Random(seed))
        yield f'plant/pump_room_{variant.label}.wrl', pump_room(variant, seed)
    yield 'plant/textures/checker_plate.png', checker_plate()
    yield 'plant/textures/sign_danger.png', sign_danger()
