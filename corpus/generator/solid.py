"""Solids that know two forms of themselves: VRML's geometry nodes, and polygons.

`parts()` lists (pose, geometry node); most solids are one node. `mesh()` is the same body as a Mesh. Both stand in
the same local frame, Y up; what turns about an axis turns about Y. Faces are counter-clockwise seen from outside.
"""
from dataclasses import dataclass
from math import acos, cos, pi, sin

from generator.vector import ALONG_Z, HERE, Pose, add, cross, dot, length, rotated, sub, times, unit
from generator.vrml import Node


# ---- polygons ----------------------------------------------------------------------------------------------------

@dataclass
class Mesh:
    points: list
    faces: list           # tuples of indices into points
    crease: float = 0     # the creaseAngle that shows the body as it is
    convex: bool = True
    uvs: list = None      # a tuple of (u, v) a face, when the body has them

    def moved(self, pose):
        return Mesh([pose.apply(p) for p in self.points], self.faces, self.crease, self.convex, self.uvs)

    def triangles(self):
        return sum(len(face) - 2 for face in self.faces)


def merged(meshes):
    points, faces = [], []
    for mesh in meshes:
        faces += [tuple(i + len(points) for i in face) for face in mesh.faces]
        points += mesh.points
    return Mesh(points, faces, max(m.crease for m in meshes), all(m.convex for m in meshes))


def revolved(profile, n, crease):
    """Turn (radius, height) pairs, listed upwards, about Y; open ends get an n-gon."""
    points, rings = [], []
    for radius, height in profile:
        angles = [2 * pi * i / n for i in range(n)] if radius else [0]
        rings.append(range(len(points), len(points) + len(angles)))
        points += [(radius * cos(a), height, -radius * sin(a)) for a in angles]
    faces = [face for low, high in zip(rings, rings[1:]) for face in band(low, high)]
    if len(rings[0]) > 1:
        faces.append(tuple(reversed(rings[0])))
    if len(rings[-1]) > 1:
        faces.append(tuple(rings[-1]))
    return Mesh(points, faces, crease)


def band(low, high):
    """The faces between two rings of n points, or between a ring and a pole."""
    n = max(len(low), len(high))
    for i in range(n):
        k = (i + 1) % n
        if len(high) == 1:
            yield (low[i], low[k], high[0])
        elif len(low) == 1:
            yield (low[0], high[k], high[i])
        else:
            yield (low[i], low[k], high[k], high[i])


def spine_frames(spine, closed):
    """(x, z) of the cross-section plane at each spine point, by clause 6.18.3 of the standard."""
    n = len(spine)

    def neighbours(i):
        if closed:
            return spine[(i - 1) % (n - 1)], spine[(i + 1) % (n - 1)]
        return spine[max(i - 1, 0)], spine[min(i + 1, n - 1)]

    ys = [unit(sub(after, before)) for before, after in map(neighbours, range(n))]
    zs = []
    for i in range(n):
        before, after = neighbours(i)
        zs.append(cross(sub(after, spine[i]), sub(before, spine[i])))
    zs = filled(zs, ys[0])
    return [(cross(y, z), z) for y, z in zip(ys, zs)]


def filled(zs, direction):
    """Unit z axes; where the spine is straight the last one holds, and none turns over."""
    bent = [unit(z) for z in zs if length(z) > 1e-9]
    last = bent[0] if bent else aim_z(direction)
    result = []
    for z in zs:
        z = unit(z) if length(z) > 1e-9 else last
        last = z if dot(z, last) >= 0 else times(z, -1)
        result.append(last)
    return result


def aim_z(direction):
    """Z after the shortest rotation from Y to the direction of a straight spine."""
    axis = cross((0, 1, 0), direction)
    if length(axis) < 1e-9:
        return (0, 0, 1)
    return rotated((0, 0, 1), (*axis, acos(max(-1, min(1, direction[1])))))


# ---- the solids --------------------------------------------------------------------------------------------------

@dataclass(frozen=True)
class Box:
    x: float
    y: float
    z: float

    def parts(self):
        return [(HERE, Node('Box', size=(self.x, self.y, self.z)))]

    def mesh(self):
        x, y, z = self.x / 2, self.y / 2, self.z / 2
        points = [(-x, -y, -z), (x, -y, -z), (x, y, -z), (-x, y, -z), (-x, -y, z), (x, -y, z), (x, y, z), (-x, y, z)]
        # each face begins where the standard puts texture coordinate (0, 0)
        faces = [(4, 5, 6, 7), (1, 0, 3, 2), (5, 1, 2, 6), (0, 4, 7, 3), (7, 6, 2, 3), (0, 1, 5, 4)]
        return Mesh(points, faces, uvs=[((0, 0), (1, 0), (1, 1), (0, 1))] * 6)


@dataclass(frozen=True)
class Cylinder:
    radius: float
    height: float
    n: int = 10

    def parts(self):
        return [(HERE, Node('Cylinder', radius=self.radius, height=self.height))]

    def mesh(self):
        r, h = self.radius, self.height / 2
        return revolved([(r, -h), (r, h)], self.n, 2 * pi / self.n + 0.1)


@dataclass(frozen=True)
class Cone:
    radius: float
    height: float
    n: int = 10

    def parts(self):
        return [(HERE, Node('Cone', bottomRadius=self.radius, height=self.height))]

    def mesh(self):
        return revolved([(self.radius, -self.height / 2), (0, self.height / 2)], self.n, 2 * pi / self.n + 0.1)


@dataclass(frozen=True)
class Ball:
    radius: float
    n: int = 12

    def parts(self):
        return [(HERE, Node('Sphere', radius=self.radius))]

    def mesh(self):
        stacks = self.n // 2
        angles = [pi * i / stacks for i in range(stacks + 1)]
        profile = [(0 if i in (0, stacks) else self.radius * sin(a), -self.radius * cos(a))
                   for i, a in enumerate(angles)]
        return revolved(profile, self.n, 2)


@dataclass(frozen=True)
class Vessel:
    """A shell with two dished (half elliptic) heads: a Cylinder and two squeezed Spheres, or one closed surface."""
    radius: float
    height: float   # of the shell, without the heads
    dish: float
    n: int = 32

    def parts(self):
        ball = Node('Sphere', radius=self.radius)
        squeeze = (1, self.dish / self.radius, 1)
        return [(HERE, Node('Cylinder', radius=self.radius, height=self.height, top=False, bottom=False)),
                (Pose((0, self.height / 2, 0), None, squeeze), ball),
                (Pose((0, -self.height / 2, 0), None, squeeze), ball)]

    def mesh(self):
        steps = 2 + self.n // 10
        arc = [pi / 2 * i / steps for i in range(steps)]
        head = [(self.radius * cos(a), self.height / 2 + self.dish * sin(a)) for a in arc]
        head.append((0, self.height / 2 + self.dish))
        return revolved([(r, -y) for r, y in reversed(head)] + head, self.n, 1)


@dataclass(frozen=True)
class Sweep:
    """A closed cross-section, counter-clockwise in (x, z) seen from +Y, carried along a spine."""
    section: tuple
    spine: tuple
    smooth: bool = True
    convex: bool = True

    @property
    def closed(self):
        return length(sub(self.spine[0], self.spine[-1])) < 1e-9

    def crease(self):
        return 1.2 if self.smooth else 0

    def parts(self):
        section = [*self.section, self.section[0]]
        return [(HERE, Node('Extrusion', crossSection=section, spine=list(self.spine), creaseAngle=self.crease(),
                            convex=None if self.convex else False, beginCap=not self.closed, endCap=not self.closed))]

    def mesh(self):
        n, m = len(self.section), len(self.spine) - self.closed
        frames = spine_frames(self.spine, self.closed)
        points = [add(s, add(times(x, a), times(z, b)))
                  for s, (x, z) in zip(self.spine[:m], frames) for a, b in self.section]
        rings = [range(i * n, i * n + n) for i in range(m)]
        ends = [rings[0]] if self.closed else []
        faces = [face for low, high in zip(rings, rings[1:] + ends) for face in band(low, high)]
        if not self.closed:
            faces += [tuple(reversed(rings[0])), tuple(rings[-1])]
        return Mesh(points, faces, self.crease(), self.convex)


@dataclass(frozen=True)
class Ground:
    """A height field, its corner at the origin."""
    heights: tuple   # rows along z, each along x
    spacing: float

    def parts(self):
        rows = self.heights
        return [(HERE, Node('ElevationGrid', xDimension=len(rows[0]), zDimension=len(rows), xSpacing=self.spacing,
                            zSpacing=self.spacing, creaseAngle=1.5, height=[h for row in rows for h in row]))]

    def mesh(self):
        nx, nz = len(self.heights[0]), len(self.heights)
        points = [(i * self.spacing, h, j * self.spacing)
                  for j, row in enumerate(self.heights) for i, h in enumerate(row)]
        faces = [(k, k + nx, k + nx + 1, k + 1) for j in range(nz - 1) for k in range(j * nx, j * nx + nx - 1)]
        return Mesh(points, faces, 1.5)


@dataclass(frozen=True)
class Panel:
    """One textured rectangle that faces +Z; no geometry node is flat, so it is a face set in every form."""
    x: float
    y: float

    def parts(self):
        mesh = self.mesh()
        corners = Node('TextureCoordinate', point=list(mesh.uvs[0]))
        return [(HERE, Node('IndexedFaceSet', coord=Node('Coordinate', point=mesh.points),
                            coordIndex=[(0, 1, 2, 3, -1)], texCoord=corners))]

    def mesh(self):
        x, y = self.x / 2, self.y / 2
        points = [(-x, -y, 0), (x, -y, 0), (x, y, 0), (-x, y, 0)]
        return Mesh(points, [(0, 1, 2, 3)], uvs=[((0, 0), (1, 0), (1, 1), (0, 1))])


@dataclass(frozen=True)
class Plates:
    """Rectangles (left, low, right, high) in the plane z = 0, facing +Z."""
    rectangles: tuple

    def mesh(self):
        points = [p for a, b, c, d in self.rectangles for p in ((a, b, 0), (c, b, 0), (c, d, 0), (a, d, 0))]
        return Mesh(points, [tuple(range(i, i + 4)) for i in range(0, len(points), 4)])


@dataclass(frozen=True)
class Assembly:
    """Several solids of one material: ((solid, pose), ...)."""
    solids: tuple

    def parts(self):
        made = {}
        for solid, _ in self.solids:
            made.setdefault(solid, solid.parts())
        return [(pose, node) for solid, pose in self.solids for _, node in made[solid]]

    def mesh(self):
        return merged([solid.mesh().moved(pose) for solid, pose in self.solids])


def assembly(*placed):
    return Assembly(tuple(placed))


def placed(solid, at=None, turn=None):
    """A solid of an assembly and where it is."""
    return solid, Pose(at, turn)


def lying(solid, z=0):
    """The same for a solid whose axis shall be Z."""
    return solid, Pose((0, 0, z) if z else None, ALONG_Z)


# ---- shapes often wanted -----------------------------------------------------------------------------------------

def circle(radius, n):
    return tuple((radius * cos(2 * pi * i / n), -radius * sin(2 * pi * i / n)) for i in range(n))


def rod(points, radius, n=6):
    return Sweep(circle(radius, n), tuple(points))


def hoop(big, small, n=14, m=4):
    """A torus about Y."""
    spine = [(big * cos(2 * pi * i / n), 0, big * sin(2 * pi * i / n)) for i in range(n)]
    return Sweep(circle(small, m), (*spine, spine[0]))


def elbow(bend, radius, n=10, steps=4):
    """A quarter bend: in at the origin along +Y, out along +X."""
    angles = [pi / 2 * i / steps for i in range(steps + 1)]
    return rod([(bend * (1 - cos(a)), bend * sin(a), 0) for a in angles], radius, n)


def i_beam(span, height=0.2, width=0.1, web=0.012, flange=0.016):
    """Along Y from the origin; the web stands along Z."""
    h, w, t, g = height / 2, width / 2, web / 2, height / 2 - flange
    section = ((w, h), (w, g), (t, g), (t, -g), (w, -g), (w, -h),
               (-w, -h), (-w, -g), (-t, -g), (-t, g), (-w, g), (-w, h))
    return Sweep(section, ((0, 0, 0), (0, span, 0)), smooth=False, convex=False)


def prism(outline, depth):
    """An outline in (x, y), counter-clockwise, with depth along Z, centred; along Z the section's z is -Y."""
    section = tuple((x, -y) for x, y in outline)
    return Sweep(section, ((0, 0, -depth / 2), (0, 0, depth / 2)), smooth=False, convex=False)


def rounded(points, bend, steps=2):
    """A path whose corners are arcs (quadratic: near enough for a hand rail)."""
    path = [points[0]]
    for before, corner, after in zip(points, points[1:], points[2:]):
        a = add(corner, times(unit(sub(before, corner)), bend))
        b = add(corner, times(unit(sub(after, corner)), bend))
        for i in range(steps + 1):
            t = i / steps
            path.append(add(add(times(a, (1 - t) ** 2), times(corner, 2 * t * (1 - t))), times(b, t * t)))
    return path + [points[-1]]
