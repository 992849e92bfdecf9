"""Three ways in which a program writes the same body: as primitives, as shared polygons, as loose faces.

Each has one method, `shape(solid, paint, name)`; it gives the same Node for the same solid and paint, so that equal
parts become DEF and USE. The loose form is what a tessellator leaves behind: every face has its own vertices, big
polygons are cut up, and where `tint` is asked for each face has its own colour as well.
"""
from generator.vector import HERE, cross, dot, sub, unit
from generator.vrml import Node, group


class Variant:
    def __init__(self, random):
        self.random = random
        self.shapes, self.geometries = {}, {}

    def shape(self, solid, paint, name=None, tint=False):
        key = solid, id(paint)
        if key not in self.shapes:
            self.shapes[key] = self.build(solid, paint, name, tint)
        return self.shapes[key]

    def geometry(self, key, make):
        """Equal bodies of different paint share the geometry."""
        if key not in self.geometries:
            self.geometries[key] = make()
        return self.geometries[key]


class Primitives(Variant):
    label = 'primitives'
    text = True   # Text nodes, where the others spell with faces

    def build(self, solid, paint, name, tint):
        parts = self.geometry(solid, solid.parts)
        shapes = {}
        for _, geometry in parts:
            shapes.setdefault(id(geometry), Node('Shape', appearance=paint, geometry=geometry))
        if len(parts) == 1:
            (shape,) = shapes.values()
            shape.name = name
            return shape
        placed = [at(pose, shapes[id(geometry)]) for pose, geometry in parts]
        return group(placed, name)


class Faces(Variant):
    label = 'faces'
    text = False

    def build(self, solid, paint, name, tint):
        textured = 'texture' in paint.fields
        geometry = self.geometry((solid, textured), lambda: face_set(solid.mesh(), textured))
        return Node('Shape', name, appearance=paint, geometry=geometry)


class Loose(Variant):
    label = 'loose'
    text = False

    def build(self, solid, paint, name, tint):
        mesh = loose(solid.mesh())
        geometry = face_set(mesh, 'texture' in paint.fields)
        if tint:
            colours = [self.tinted(paint) for _ in mesh.faces]
            geometry.fields.update(colorPerVertex=False, color=Node('Color', color=colours))
        return Node('Shape', name, appearance=paint, geometry=geometry)

    def tinted(self, paint):
        shade = self.random.uniform(0.85, 1.1)
        return tuple(round(min(1, c * shade), 3) for c in paint.fields['material'].fields['diffuseColor'])


def at(pose, shape):
    return group([shape], at=pose.at, turn=pose.turn, scale=pose.scale) if pose != HERE else shape


def face_set(mesh, textured=False):
    node = Node('IndexedFaceSet', creaseAngle=mesh.crease or None, convex=None if mesh.convex else False,
                coord=Node('Coordinate', point=[tuple(round(c, 4) for c in p) for p in mesh.points]),
                coordIndex=[(*face, -1) for face in mesh.faces])
    if textured and mesh.uvs:
        corners = sorted({corner for uvs in mesh.uvs for corner in uvs})
        node.fields['texCoord'] = Node('TextureCoordinate', point=corners)
        node.fields['texCoordIndex'] = [(*map(corners.index, uvs), -1) for uvs in mesh.uvs]
    return node


# ---- loose faces -------------------------------------------------------------------------------------------------

def loose(mesh):
    """Every face with its own vertices, and none with more than four."""
    points, faces, uvs = [], [], []
    for f, face in enumerate(mesh.faces):
        corners = [mesh.points[i] for i in face]
        for piece in [range(len(face))] if len(face) < 5 else ears(corners):
            faces.append(tuple(range(len(points), len(points) + len(piece))))
            points += [corners[i] for i in piece]
            uvs.append(tuple(mesh.uvs[f][i] for i in piece) if mesh.uvs else None)
    return type(mesh)(points, faces, 0, True, uvs if mesh.uvs else None)


def ears(corners):
    """Triangulate a simple polygon by cutting ears; the normal is Newell's, so concave is fine."""
    normal = newell(corners)
    left, triangles = list(range(len(corners))), []
    while len(left) > 3:
        k = next(k for k in range(len(left)) if is_ear(corners, left, k, normal))
        triangles.append((left[k - 1], left[k], left[(k + 1) % len(left)]))
        del left[k]
    return [*triangles, tuple(left)]


def newell(corners):
    total = (0, 0, 0)
    for a, b in zip(corners, corners[1:] + corners[:1]):
        total = tuple(s + c for s, c in zip(total, cross(a, b)))
    return unit(total)


def is_ear(corners, left, k, normal):
    ids = left[k - 1], left[k], left[(k + 1) % len(left)]
    a, b, c = (corners[i] for i in ids)
    if dot(cross(sub(b, a), sub(c, b)), normal) <= 1e-12:
        return False
    return not any(inside(corners[i], a, b, c, normal) for i in left if i not in ids)


def inside(p, a, b, c, normal):
    return all(dot(cross(sub(v, u), sub(p, u)), normal) >= -1e-12 for u, v in ((a, b), (b, c), (c, a)))
