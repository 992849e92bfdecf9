"""Floor, walls, steel, and the ways to get up: the part of a Room that is built before the equipment comes."""
from math import cos, pi, radians, sin

from generator.paint import (CABLES, CHECKER, CONCRETE, EARTH, FASCIA, GALVANISED, GLOW, INK, PRESSURE, SAFETY, SIGN,
                             STEEL, TREAD, WALL, WATER)
from generator.piping import Piping
from generator.solid import Ball, Box, Cone, Cylinder, Ground, Panel, assembly, i_beam, placed, prism, rod, rounded
from generator.vector import ALONG_X, X, Y, add, aim, cross, length, sub, times, unit
from generator.vrml import group, put


class Building(Piping):

    # ---- the shell -----------------------------------------------------------------------------------------------

    def building(self):
        slab = put(self.shape(Box(12.5, 0.2, 8.5), CONCRETE, 'Floor'), at=(0, -0.1, 0))
        back = put(self.shape(Box(12.25, 5.2, 0.25), WALL, 'Wall_back'), at=(-0.125, 2.6, -4.125))
        left = put(self.shape(Box(0.25, 5.2, 8), WALL, 'Wall_left'), at=(-6.125, 2.6, 0))
        skirting = [self.plate((0, 0.06, -3.99), (12, 0.12, 0.02), FASCIA),
                    self.plate((-5.99, 0.06, 0), (0.02, 0.12, 8), FASCIA)]
        cover = self.shape(Box(1.18, 0.012, 0.6), CHECKER, 'Trench_cover')
        covers = [put(cover, at=(-5.1 + 1.2 * i, 0.006, 3.35)) for i in range(9)]
        lines = [self.plate((0.4, 0.003, z), (9.6, 0.006, 0.08)) for z in (2.75, 3.9)]
        return group([slab, back, left, *skirting, self.door(), group(covers, 'Trench'), group(lines, 'Walkway'),
                      self.portals()], 'Building')

    def door(self):
        leaf = self.plate((-5.985, 1.05, 3.1), (0.04, 2.1, 0.95), PRESSURE)
        lintel = self.plate((-5.98, 2.13, 3.1), (0.06, 0.06, 1.07), FASCIA)
        posts = [self.plate((-5.98, 1.05, z), (0.06, 2.1, 0.06), FASCIA) for z in (2.595, 3.605)]
        handle = self.plate((-5.94, 1.05, 2.75), (0.06, 0.03, 0.12), GALVANISED)
        return group([leaf, lintel, *posts, handle], 'Door')

    def portals(self):
        """Two that would carry the roof; their front columns stand free."""
        column = self.shape(i_beam(4.9, 0.24, 0.2), STEEL, 'Portal_column')
        foot = self.shape(Box(0.4, 0.03, 0.4), STEEL, 'Portal_foot')
        parts = [self.beam((-5.7, 4.7, 3.85), (5.7, 4.7, 3.85))]
        for x in (-5.7, 5.7):
            parts += [put(column, at=(x, 0, 3.85), turn=(0, 1, 0, pi / 2)), put(foot, at=(x, 0.015, 3.85)),
                      self.beam((x, 4.9, -4.0), (x, 4.9, 3.97))]
        return group(parts, 'Portals')

    def ground(self, random):
        """Uneven outside, even where the slab lies."""
        def height(x, z):
            outside = max(abs(x) - 7, abs(z) - 5, 0)
            wave = sin(0.5 * x + 1) * cos(0.4 * z) * 0.35 + random.uniform(-0.08, 0.08)
            return round(-0.22 + min(1, outside / 5) * (0.25 + wave), 3)
        grid = tuple(tuple(height(-16 + 1.6 * i, -13.6 + 1.6 * j) for i in range(21)) for j in range(18))
        return put(self.shape(Ground(grid, 1.6), EARTH, 'Ground', tint=True), at=(-16, 0, -13.6))

    def lamps(self):
        shade = self.shape(Cone(0.28, 0.22, 20), WATER, 'Lamp_shade')
        bulb = self.shape(Ball(0.09, 12), GLOW, 'Lamp_bulb')
        wire = self.straight(INK, 0.012, (0, 0.1, 0), (0, 0.75, 0))
        lamp = group([shade, put(bulb, at=(0, -0.11, 0)), wire], 'Lamp')
        return group([put(lamp, 'LX_1', at=(-3, 3.9, 3.85)), put(lamp, 'LX_2', at=(2, 3.9, 3.85))], 'Lamps')

    def signs(self):
        sign = self.shape(Panel(0.9, 0.6), SIGN, 'Sign')
        return group([put(sign, 'SG_1', at=(-5.985, 2.3, 0.9), turn=(0, 1, 0, pi / 2)),
                      put(sign, 'SG_2', at=(4.2, 3.8, -3.985))], 'Signs')

    def cable_tray(self, tag, at):
        """A ladder tray along X, three cables in it, brackets to the wall behind."""
        side = self.shape(Box(11.6, 0.08, 0.01), GALVANISED, 'Tray_side')
        rung = self.shape(Box(0.03, 0.015, 0.3), GALVANISED, 'Tray_rung')
        bracket = self.shape(prism([(0, 0), (0.36, 0.3), (0.36, 0.34), (0, 0.34)], 0.03), STEEL, 'Tray_bracket')
        rungs = [put(rung, at=(-5.7 + 0.3 * i, -0.03, 0)) for i in range(39)]
        brackets = [put(bracket, at=(x, -0.38, -0.21), turn=(0, 1, 0, -pi / 2)) for x in (-5.2, -2.6, 0, 2.6, 5.2)]
        cables = [self.cable(z, skin) for z, skin in zip((-0.08, 0, 0.08), CABLES)]
        return group([*(put(side, at=(0, 0, z)) for z in (-0.15, 0.15)), group(rungs, f'{tag}_rungs'),
                      group(brackets, f'{tag}_brackets'), group(cables, f'{tag}_cables')], tag, at=at)

    def cable(self, z, skin):
        path = [(-5.8 + 0.58 * i, 0, z + 0.018 * sin(1.3 * i + 9 * z)) for i in range(21)]
        return self.shape(rod(path, 0.022, 5), skin)

    # ---- steel ---------------------------------------------------------------------------------------------------

    def beam(self, a, b):
        return put(self.shape(i_beam(round(length(sub(b, a)), 4)), STEEL, 'Beam'), at=a, turn=aim(sub(b, a), Y))

    def plate(self, at, size, skin=SAFETY):
        return put(self.shape(Box(*size), skin), at=at)

    def platform(self, tag):
        """Grating at y = 2.4 over x 1.3..5.3, z -3.9..-1.9, on six columns."""
        panel = self.grating()
        deck = [put(panel, at=(1.8 + i, 2.38, -3.4 + j)) for i in range(4) for j in range(2)]
        foot = self.shape(Box(0.26, 0.02, 0.26), STEEL, 'Column_foot')
        column = group([self.shape(i_beam(2.16, 0.16, 0.14), STEEL), put(foot, at=(0, 0.01, 0))], 'Column')
        frame = [put(column, at=(x, 0, z)) for x in (1.4, 3.3, 5.2) for z in (-3.75, -2.0)]
        frame += [self.beam((1.3, 2.26, z), (5.3, 2.26, z)) for z in (-3.75, -2.0)]
        frame += [self.beam((x, 2.26, -3.67), (x, 2.26, -2.08)) for x in (1.4, 3.3, 5.2)]
        toes = [self.plate((x, 2.46, -2.9), (0.012, 0.12, 2.0)) for x in (1.31, 5.29)]
        toes.append(self.plate((2.95, 2.46, -1.91), (3.3, 0.12, 0.012)))
        return group([group(deck, f'{tag}_deck'), group(frame, f'{tag}_frame'), group(toes, f'{tag}_toe_boards'),
                      group(self.platform_rails(), f'{tag}_rails')], tag)

    def platform_rails(self):
        """Along the left and the front, up to the stairs, and on the right."""
        corner = [(1.33, 2.4, -3.85), (1.33, 2.4, -1.93), (4.5, 2.4, -1.93)]
        posts = [(1.33, 2.4, z) for z in (-3.85, -2.9)] + [(x, 2.4, -1.93) for x in (1.48, 2.5, 3.5, 4.5)]
        right = [(5.27, 2.4, z) for z in (-3.85, -2.9, -1.95)]
        return self.rail(corner, posts) + self.rail([right[0], right[-1]], right)

    def grating(self):
        """One square metre: bearing bars along Z, cross rods along X, a frame."""
        bars = [placed(Box(0.006, 0.03, 1), (-0.42 + 0.06 * i, 0, 0)) for i in range(15)]
        rods = [placed(Box(1, 0.01, 0.008), (0, 0.008, -0.3 + 0.2 * i)) for i in range(4)]
        frame = [placed(Box(0.02, 0.04, 1), (x, 0, 0)) for x in (-0.49, 0.49)]
        frame += [placed(Box(0.96, 0.04, 0.02), (0, 0, z)) for z in (-0.49, 0.49)]
        return self.shape(assembly(*bars, *rods, *frame), GALVANISED, 'Grating_panel')

    # ---- ways up -------------------------------------------------------------------------------------------------

    def rail(self, path, posts):
        """Top and knee rail along a path, posts at the given points."""
        post = self.shape(Cylinder(0.021, 1.1, 6), SAFETY, 'Rail_post')
        rails = []
        for up, radius in (1.1, 0.024), (0.55, 0.018):
            raised = [add(p, (0, up, 0)) for p in path]
            rails.append(self.shape(rod(rounded(raised, 0.12), radius), SAFETY))
        return rails + [put(post, at=add(p, (0, 0.55, 0))) for p in posts]

    def stairs(self, tag):
        """Eleven treads from the platform's edge (z = -1.9) down to the front."""
        tread = self.shape(Box(0.76, 0.03, 0.27), TREAD, 'Tread')
        steps = [put(tread, at=(4.9, 2.2 - 0.2 * i, -1.78 + 0.26 * i)) for i in range(11)]
        slope = unit((0, -0.2, 0.26))
        stringer = self.shape(Box(0.012, 3.42, 0.22), STEEL, 'Stringer')
        sides = [put(stringer, at=(x, 1.17, -0.44), turn=aim(slope, cross(slope, X))) for x in (4.51, 5.29)]
        rails = []
        for x in (4.5, 5.3):
            foot, head = (x, 0.12, 0.94), (x, 2.28, -1.87)
            rails += self.rail([foot, head], [add(foot, times(sub(head, foot), i / 3)) for i in range(4)])
        return group([group(steps, f'{tag}_treads'), *sides, group(rails, f'{tag}_rails')], tag)

    def ladder(self, tag, at, turn):
        """A ladder 4.6 m high, climbed on its +Z side, with hoops above 2.2 m."""
        sides = [self.shape(rod(rounded([(x, 0, 0), (x, 4.6, 0), (x, 4.6, -0.35)], 0.15), 0.022), SAFETY)
                 for x in (-0.22, 0.22)]
        stays = [self.straight(SAFETY, 0.016, (x, y, -0.3), (x, y, 0)) for x in (-0.22, 0.22) for y in (1.5, 3.2)]
        rung = self.shape(Cylinder(0.013, 0.44, 6), SAFETY, 'Rung')
        rungs = [put(rung, at=(0, 0.3 * i + 0.3, 0), turn=ALONG_X) for i in range(14)]
        return group([group(sides + stays, f'{tag}_sides'), group(rungs, f'{tag}_rungs'),
                      group(self.cage(), f'{tag}_cage')], tag, at=at, turn=turn)

    def cage(self):
        arc = [(0.36 * cos(a), 0, 0.33 + 0.36 * sin(a)) for a in (radians(-40 + 20 * i) for i in range(14))]
        ring = self.shape(rod([(0.22, 0, 0), *arc, (-0.22, 0, 0)], 0.014, 4), SAFETY, 'Hoop')
        strap = self.shape(Box(0.03, 2.1, 0.006), SAFETY, 'Strap')
        straps = [put(strap, at=(0.36 * sin(a), 3.35, 0.33 + 0.36 * cos(a)), turn=(0, 1, 0, a))
                  for a in map(radians, (-100, -50, 0, 50, 100))]
        return [put(ring, at=(0, y, 0)) for y in (2.3, 3.0, 3.7, 4.4)] + straps
