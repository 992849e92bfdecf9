"""The models of the paper whose system this project rebuilds, rebuilt from its figures.

Figures 9 and 10: an ellipsoidal shape with a cylindrical hole, 452 faces. Figure 11: a room with stairs and two
lights. Figure 15: textured pipes. All are IndexedFaceSets; sizes in metres, Y up.
"""
from math import asin, cos, hypot, pi, sin, sqrt
import random

from generator import picture
from generator.solid import Mesh, prism
from generator.vector import add, aim, cross, dot, length, sub, times, unit
from generator.variant import face_set
from generator.view import viewpoint
from generator.vrml import Node, group, put, world


def shape(mesh, appearance, name=None):
    return Node('Shape', name, appearance=appearance, geometry=face_set(mesh, mesh.uvs is not None))


def plain(name, colour, **more):
    return Node('Appearance', name, material=Node('Material', diffuseColor=colour, **more))


# ---- the ellipsoid with a hole -----------------------------------------------------------------------------------

AXES = 1.3, 0.9, 1.1     # half axes in x, y, z; the hole runs along y
HOLE = 0.42
OUTER = 18, 22, 25, 26, 25, 22, 18   # vertices a ring between the rims
INNER = 14, 14, 14, 14, 14           # rim, inside, rim; with OUTER 226 vertices, and a torus has 2 faces a vertex


def ellipsoid_hole(finer):
    """Rings around the hole's axis: down the outside, up through the hole; neighbours are zipped together."""
    points, rings = [], []
    outer, inner = refined([INNER[0], *OUTER, INNER[0]], finer), refined(INNER, finer)
    places = [(outside, n, k / (len(outer) - 1), k % 2) for k, n in enumerate(outer)]
    places += [(through, n, 1 - k / (len(inner) - 1), k % 2) for k, n in enumerate(inner)][1:-1]   # without the rims
    for place, n, t, odd in places:
        angles = ring(n, odd)
        rings.append((angles, range(len(points), len(points) + n)))
        points += [place(angle, t) for angle in angles]
    faces = [face for a, b in zip(rings, rings[1:] + rings[:1]) for face in zipped(a, b)]
    return Mesh(points, faces, 0.6)


def refined(counts, finer):
    """As many rings between two of the coarse ones, and as many vertices on each, as `finer` says."""
    fine = []
    for a, b in zip(counts, counts[1:]):
        fine += [round(a * (finer - i) + b * i) for i in range(finer)]
    return fine + [counts[-1] * finer]


def ring(n, odd):
    """The angles of n vertices; every other ring is turned by half a step."""
    return [2 * pi * (i + odd / 2) / n for i in range(n)]


def outside(angle, t):
    a, b, c = AXES
    rim = asin(HOLE / hypot(a * cos(angle), c * sin(angle)))   # where the hole's wall leaves the ellipsoid
    polar = rim + (pi - 2 * rim) * t
    return (a * sin(polar) * cos(angle), b * cos(polar), -c * sin(polar) * sin(angle))


def through(angle, t):
    top, bottom = outside(angle, 0), outside(angle, 1)
    return (top[0], top[1] + (bottom[1] - top[1]) * t, top[2])


def zipped(upper, lower):
    """Triangles between two rings of whatever counts: always step on the side that lags."""
    (angles, above), (angles_below, below) = upper, lower
    n, m = len(above), len(below)
    i = j = 0
    while i < n or j < m:
        next_i = angles[i % n] + 2 * pi * (i // n) + pi / n
        next_j = angles_below[j % m] + 2 * pi * (j // m) + pi / m
        if j == m or (i < n and next_i <= next_j):
            yield (above[i % n], below[j % m], above[(i + 1) % n])
            i += 1
        else:
            yield (above[i % n], below[j % m], below[(j + 1) % m])
            j += 1


def ellipsoid_world(finer, what):
    metal = plain('Clay', (0.72, 0.70, 0.66), specularColor=(0.2, 0.2, 0.2), shininess=0.3)
    mesh = ellipsoid_hole(finer)
    view = viewpoint('View', 'Above', (2.1, 3.0, 2.6), (0, -0.05, 0), 0.7)
    return world(f'{what}: {len(mesh.faces)} triangles, a closed manifold with one hole, sharp at its rims',
                 [view, shape(mesh, metal, 'Ellipsoid')])


# ---- the room with stairs ----------------------------------------------------------------------------------------

WHITE = plain('White_wash', (0.86, 0.86, 0.84), ambientIntensity=0.3)
RED = plain('Red_wall', (0.75, 0.16, 0.12), ambientIntensity=0.3)
FLOOR = plain('Floor_boards', (0.52, 0.42, 0.32), ambientIntensity=0.3)
STONE = plain('Stairs_stone', (0.66, 0.66, 0.68), ambientIntensity=0.3)
IRON = plain('Rail_iron', (0.16, 0.17, 0.19), specularColor=(0.4, 0.4, 0.4), shininess=0.4)


def rectangle(corner, u, v):
    return Mesh([corner, add(corner, u), add(add(corner, u), v), add(corner, v)], [(0, 1, 2, 3)])


def walls(x, y, z):
    """The inner faces of a box that stands on y = 0, centred; each is one rectangle that looks inwards."""
    a, c = x / 2, z / 2
    return {'Floor': rectangle((-a, 0, c), (x, 0, 0), (0, 0, -z)),
            'Ceiling': rectangle((-a, y, -c), (x, 0, 0), (0, 0, z)),
            'Wall_back': rectangle((-a, 0, -c), (x, 0, 0), (0, y, 0)),
            'Wall_front': rectangle((a, 0, c), (-x, 0, 0), (0, y, 0)),
            'Wall_left': rectangle((-a, 0, c), (0, 0, -z), (0, y, 0)),
            'Wall_right': rectangle((a, 0, -c), (0, 0, z), (0, y, 0))}


def stairs(steps, rise, run, width, landing):
    """One closed body: its side is a polygon of 2 * steps + 2 corners, its top goes up and over."""
    outline = [(0, 0), (steps * run + landing - run, 0), (steps * run + landing - run, steps * rise)]
    for i in reversed(range(steps)):
        outline += [(i * run, (i + 1) * rise)] + ([(i * run, i * rise)] if i else [])
    return prism(outline, width).mesh()


def box(low, high):
    """A closed box between two corners."""
    (a, b, c), (d, e, f) = low, high
    points = [(x, y, z) for z in (c, f) for y in (b, e) for x in (a, d)]
    return Mesh(points, [(4, 5, 7, 6), (1, 0, 2, 3), (5, 1, 3, 7), (0, 4, 6, 2), (6, 7, 3, 2), (0, 1, 5, 4)])


def stairs_room():
    paint = {'Floor': FLOOR, 'Wall_left': RED}
    surfaces = [shape(mesh, paint.get(name, WHITE), name) for name, mesh in walls(6, 3.2, 5).items()]
    steps = put(shape(stairs(8, 0.18, 0.28, 1.1, 1.3), STONE, 'Stairs'), at=(-0.24, 0, -1.95))
    view = viewpoint('View', 'From the corner', (2.6, 1.9, 2.3), (-0.5, 1.1, -1.3), 1.1)
    return world('A closed room with stairs, white-washed walls, one red wall and two point lights',
                 [Node('NavigationInfo', headlight=False, type=['WALK', 'ANY']), view,
                  lamp('Light_by_stairs', (0.9, 2.6, 0.4), 0.8, 0.06),
                  lamp('Light_by_table', (-1.7, 2.2, 0.9), 0.6, 0.1, (1, 0.92, 0.78)),
                  group(surfaces, 'Room'), group([steps, group(stair_rail(), 'Rail')], 'Staircase'),
                  group(table(), 'Table')])


def lamp(name, at, intensity, falloff, colour=None):
    return Node('PointLight', name, location=at, intensity=intensity, radius=20, attenuation=(1, 0, falloff),
                color=colour)


def stair_rail():
    """Posts on three of the steps and at the end, a rail aslant and one along the landing."""
    feet = (-0.1, 0.18), (0.74, 0.72), (1.58, 1.26), (2.9, 1.44)
    posts = [shape(box((x - 0.02, y, -1.44), (x + 0.02, y + 0.9, -1.40)), IRON) for x, y in feet]
    level = shape(box((1.84, 2.31, -1.45), (2.98, 2.36, -1.39)), IRON)
    aslant = shape(box((-1.2, -0.025, -0.03), (1.2, 0.025, 0.03)), IRON)
    return [*posts, level, put(aslant, at=(0.86, 1.7, -1.42), turn=aim((-0.54, 0.84, 0), (0, 0, 1)))]


def table():
    top = shape(box((-2.3, 0.72, 0.5), (-1.1, 0.77, 1.3)), FLOOR, 'Table_top')
    feet = [(x, z) for x in (-2.25, -1.21) for z in (0.55, 1.19)]
    return [top, *(shape(box((x, 0, z), (x + 0.06, 0.72, z + 0.06)), FLOOR) for x, z in feet)]


# ---- textured pipes ----------------------------------------------------------------------------------------------

def tube(path, radius, n, around, along):
    """A pipe along a path in space, with texture coordinates: u around, v along; open at both ends."""
    rings, points, texture_points = [], [], []
    normal, reached = None, 0.0
    for k, p in enumerate(path):
        tangent = unit(sub(path[min(k + 1, len(path) - 1)], path[max(k - 1, 0)]))
        normal = carried(normal, tangent)
        side = cross(tangent, normal)
        reached += length(sub(p, path[k - 1])) if k else 0
        points += [add(p, add(times(normal, radius * cos(a)), times(side, radius * sin(a)))) for a in turn(n)[:-1]]
        texture_points += [(around * i / n, reached * along) for i in range(n + 1)]
    faces, uvs = [], []
    for k in range(len(path) - 1):
        for i in range(n):
            j = (i + 1) % n
            faces.append((k * n + i, k * n + j, (k + 1) * n + j, (k + 1) * n + i))
            corners = (k, i), (k, i + 1), (k + 1, i + 1), (k + 1, i)
            uvs.append(tuple(texture_points[row * (n + 1) + column] for row, column in corners))
    return Mesh(points, faces, 1.0, True, uvs)


def turn(n):
    return [2 * pi * i / n for i in range(n + 1)]


def carried(normal, tangent):
    """The normal of the ring before, moved into this ring's plane: no twist."""
    if normal is None:
        normal = (1, 0, 0) if abs(tangent[0]) < 0.9 else (0, 1, 0)
    return unit(sub(normal, times(tangent, dot(normal, tangent))))


def routed(corners, bend, steps=6, pieces=4):
    """A path of straight legs in `pieces` parts and quarter bends in `steps`."""
    path, start = [], corners[0]
    angles = [pi / 2 * i / steps for i in range(steps)]
    for before, corner, after in zip(corners, corners[1:], corners[2:]):
        inward, outward = unit(sub(corner, before)), unit(sub(after, corner))
        end = sub(corner, times(inward, bend))
        path += [add(start, times(sub(end, start), i / pieces)) for i in range(pieces)]
        centre = add(end, times(outward, bend))
        path += [add(centre, add(times(outward, -bend * cos(a)), times(inward, bend * sin(a)))) for a in angles]
        start = add(corner, times(outward, bend))
    return path + [add(start, times(sub(corners[-1], start), i / pieces)) for i in range(pieces + 1)]


def collar(at, direction, radius, n=20):
    """A flange as a short closed cylinder."""
    y, x = unit(direction), carried(None, unit(direction))
    z = cross(x, y)
    rim = [add(times(x, radius * cos(a)), times(z, radius * sin(a))) for a in turn(n)[:-1]]
    points = [add(at, add(times(y, h), p)) for h in (-0.03, 0.03) for p in rim]
    sides = [(i, n + i, n + (i + 1) % n, (i + 1) % n) for i in range(n)]
    return Mesh(points, [*sides, tuple(range(n)), tuple(reversed(range(n, 2 * n)))], 0.6)


def textured(name, file):
    material = Node('Material', diffuseColor=(0.9, 0.9, 0.9), specularColor=(0.2, 0.2, 0.2), shininess=0.2)
    return Node('Appearance', name, material=material, texture=Node('ImageTexture', url=[f'textures/{file}.png']))


def pipes():
    view = viewpoint('View', 'The pipes', (2.3, 1.9, 2.9), (-0.4, 1.15, -0.7), 0.95)
    return world('Three textured pipes with bends and flanges in the corner of a room, two point lights',
                 [Node('NavigationInfo', headlight=False), view,
                  lamp('Light_right', (1.6, 2.6, 1.2), 0.8, 0.04),
                  lamp('Light_left', (-1.6, 2.7, 0.6), 0.6, 0.06, (1, 0.93, 0.8)),
                  group(pipe_room(), 'Room'), group(pipe_lines(), 'Pipes'), group(pipe_flanges(), 'Flanges')])


def pipe_room():
    """Floor and two walls; one tile of the texture is 0.8 m wide."""
    tiled, surfaces = textured('Tiles', 'tiles'), walls(5, 3, 4)
    for mesh in surfaces.values():
        origin, right, _, up = mesh.points
        u, v = length(sub(right, origin)) / 0.8, length(sub(up, origin)) / 0.8
        mesh.uvs = [((0, 0), (u, 0), (u, v), (0, v))]
    seen = ('Floor', tiled), ('Wall_back', WHITE), ('Wall_left', WHITE)
    return [shape(surfaces[name], paint, name) for name, paint in seen]


def pipe_lines():
    lagging, rusty = textured('Lagging', 'lagging'), textured('Rust', 'rust')
    big = [(-2.5, 1.9, -1.2), (0.6, 1.9, -1.2), (0.6, 0.45, -1.2), (0.6, 0.45, 1.2), (0.6, -0.05, 1.2)]
    middle = [(-2.5, 1.2, -0.7), (-0.6, 1.2, -0.7), (-0.6, 3.0, -0.7)]
    small = [(-1.6, 0.0, -1.5), (-1.6, 2.5, -1.5), (2.5, 2.5, -1.5)]
    return [shape(tube(routed(big, 0.45), 0.28, 24, 2, 1.1), lagging, 'L_500_lagged'),
            shape(tube(routed(middle, 0.3), 0.16, 20, 1, 1), rusty, 'L_300_rusty'),
            shape(tube(routed(small, 0.2), 0.09, 16, 1, 1), rusty, 'L_150_rusty')]


def pipe_flanges():
    steel = plain('Flange_steel', (0.45, 0.46, 0.48), specularColor=(0.3, 0.3, 0.3), shininess=0.3)
    places = [((-1.4, 1.2, -0.7), (1, 0, 0), 0.26), ((-0.6, 2.1, -0.7), (0, 1, 0), 0.26),
              ((0.6, 0.45, 0.3), (0, 0, 1), 0.4), ((0.8, 2.5, -1.5), (1, 0, 0), 0.16)]
    return [shape(collar(at, direction, radius), steel) for at, direction, radius in places]


# ---- textures ----------------------------------------------------------------------------------------------------

def periodic(random, waves, size):
    """Smooth noise in -1..1 that repeats after `size` pixels."""
    terms = [(random.randint(-4, 4), random.randint(-4, 4), random.uniform(0, 2 * pi)) for _ in range(waves)]

    def noise(x, y):
        return sum(sin(2 * pi * (a * x + b * y) / size + c) for a, b, c in terms) / sqrt(waves)
    return noise


def rust(seed):
    source = random.Random(seed)
    patches = periodic(source, 9, 64)
    def colour(x, y):
        p = patches(x, y) + source.uniform(-0.25, 0.25)
        return (132 + 22 * p, 70 + 16 * p, 42 + 8 * p) if p > 0.1 else (118 + 14 * p, 104 + 12 * p, 92 + 10 * p)
    return picture.png(picture.drawn(64, 64, colour))


def lagging(seed):
    """Sheet metal over insulation: a seam along, a lapped joint across, a row of rivets."""
    source = random.Random(seed)

    def colour(x, y):
        grey = 176 + source.uniform(-4, 4) + 8 * sin(2 * pi * x / 64)
        if y < 3 or x in (0, 1):
            grey -= 60 - 15 * y if y < 3 else 40
        if (x % 16 - 8) ** 2 + (y - 8) ** 2 < 4:
            grey -= 45
        return (grey, grey, grey + 4)
    return picture.png(picture.drawn(64, 64, colour))


def tiles(seed):
    source = random.Random(seed)
    shade = [[source.uniform(-10, 10) for _ in range(2)] for _ in range(2)]

    def colour(x, y):
        if x % 32 < 1 or y % 32 < 1:
            return (92, 88, 84)
        s = shade[y // 32][x // 32] + source.uniform(-5, 5)
        return (158 + s, 128 + s, 108 + s)
    return picture.png(picture.drawn(64, 64, colour))


def files(seed):
    yield 'paper/ellipsoid_hole.wrl', ellipsoid_world(1, 'An ellipsoidal shape with a cylindrical hole')
    yield 'paper/ellipsoid_hole_fine.wrl', ellipsoid_world(5, 'The ellipsoidal shape with a cylindrical hole, fine')
    yield 'paper/stairs_room.wrl', stairs_room()
    yield 'paper/pipes.wrl', pipes()
    for draw in rust, lagging, tiles:
        yield f'paper/textures/{draw.__name__}.png', draw(seed)
