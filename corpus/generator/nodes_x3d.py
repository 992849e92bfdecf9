"""One X3D document for each node type of X3D, every field away from its default, made from the node table as nodes.py does.

The text is written here from the same values: attributes for plain values, elements with containerField for nodes.
"""
from xml.sax.saxutils import escape

from generator import nodes
from generator.vrml import Node, Raw

TABLES = nodes.TABLE, *(nodes.TABLE.with_name(name) for name in ('x3d.nodes', 'x3d_components.nodes', 'x3d_geo.nodes', 'x3d_nurbs.nodes'))

SPECIAL = {
    **{key: value.replace('"media/', '"../nodes/media/').replace('"Box.wrl', '"../nodes/Box.wrl') for key, value in nodes.SPECIAL.items()},
    '*.autoRefresh': '10',
    'ColorRGBA.color': '[ 0.9 0.2 0.1 1, 0.2 0.7 0.2 0.75, 0.1 0.3 0.9 0.5, 0.9 0.8 0.2 0.25 ]',
    '*.index': '[ 0 1 2 3 ]',
    'IndexedTriangleSet.index': '[ 0 1 2 0 2 3 ]',
    '*.fanCount': '[ 4 ]', '*.stripCount': '[ 4 ]', '*.vertexCount': '[ 2 2 ]',
    'IndexedLineSet.normalIndex': '[ 0 1 2 -1 3 0 -1 ]',
    'Polyline2D.lineSegments': '[ 0 0, 1 0, 1 1 ]', 'Polypoint2D.point': '[ 0 0, 1 0, 1 1 ]',
    'TriangleSet2D.vertices': '[ 0 0, 1 0, 1 1 ]', 'Disk2D.innerRadius': '0.5',
    'OrthoViewpoint.fieldOfView': '[ -2 -1.5 2 1.5 ]',
    'FogCoordinate.depth': '[ 0 0.2 0.4 0.6 ]', 'ClipPlane.plane': '0 -1 0 0.5',
    'CADLayer.visible': '[ TRUE FALSE ]', 'LayerSet.order': '[ 0 1 ]', 'Viewport.clipBoundary': '[ 0 0.5 0 0.5 ]',
    'MetadataDouble.value': '[ 0.1 2 ]', 'NavigationInfo.type': '[ "FLY" "ANY" ]', 'NavigationInfo.transitionType': '[ "TELEPORT" ]',
    'LineProperties.linetype': '2', 'MultiTexture.mode': '[ "MODULATE" ]', 'TextureBackground.groundAngle': '[ 0.8, 1.5 ]',
    'TextureBackground.skyAngle': '[ 0.8, 1.5 ]', 'TextureProperties.borderWidth': '1', 'Viewpoint.viewAll': 'FALSE',
    'SplinePositionInterpolator.keyVelocity': '[ 0 0 0, 0 1 0, 0 0 0 ]',
    # four control points: curves of degree 3, and patches of two by two, near a place of zone 33
    '*.order': '4', '*.knot': '[ 0 0 0 0 1 1 1 1 ]', '*.weight': '[ 1 2 1 1 ]', '*.uOrder': '2', '*.vOrder': '2',
    '*.uDimension': '2', '*.vDimension': '2', '*.uKnot': '[ 0 0 1 1 ]', '*.vKnot': '[ 0 0 1 1 ]',
    **{f'{name}.controlPoint': '[ 0 0, 1 0, 1 1, 0.5 1 ]' for name in ('ContourPolyline2D', 'NurbsCurve2D', 'NurbsTextureCoordinate')},
    'CoordinateDouble.point': '[ -1 0 1, 1 0 1, -1 0 -1, 1 0.5 -1 ]',
    '*.geoSystem': '[ "UTM" "Z33" ]', 'GeoCoordinate.point': '[ 5762000 392000 30, 5762000 392010 30, 5762010 392010 31, 5762010 392000 31 ]',
    **{f'*.{name}': '5762000 392000 30' for name in ('geoCoords', 'geoCenter', 'geoGridOrigin')},
    'GeoViewpoint.position': '5761950 392000 60', 'GeoViewpoint.centerOfRotation': '5762000 392000 30', 'GeoLOD.center': '5762000 392000 30',
    'GeoPositionInterpolator.keyValue': '[ 5762000 392000 30, 5762010 392000 30, 5762000 392000 30 ]',
    **{f'GeoElevationGrid.{name}': '2' for name in ('xDimension', 'zDimension')}, 'GeoElevationGrid.height': '[ 0.1, 0.2, 0.3, 0.4 ]',
    '*.rootUrl': '[ "../nodes/Box.wrl" ]', **{f'*.child{i}Url': '[ "../nodes/Box.wrl" ]' for i in range(1, 5)},
    '*.inertia': '2 0 0 0 2 0 0 0 2', 'TextureTransformMatrix3D.matrix': '2 0 0 0 0 2 0 0 0 0 2 0 0 0 0 1',
    'Matrix3VertexAttribute.value': '[ 2 0 0 0 2 0 0 0 2 ]', 'Matrix4VertexAttribute.value': '[ 2 0 0 0 0 2 0 0 0 0 2 0 0 0 0 1 ]',
    'TextureCoordinate4D.point': '[ 0 0 0 1, 1 0 0 1, 1 1 0 1, 0 1 0 1 ]', 'Tangent.vector': '[ 1 0 0 1, 1 0 0 1, 1 0 0 1, 1 0 0 1 ]',
    'PixelTexture3D.image': '[ 1 2 1 1 0 255 ]', 'PolylineEmitter.coordIndex': '[ 0 1 -1 ]', 'VolumeEmitter.coordIndex': '[ 0 1 2 -1 ]',
    'HAnimDisplacer.coordIndex': '[ 0 1 2 ]', 'ShaderPart.type': '"FRAGMENT"', 'ShaderProgram.type': '"FRAGMENT"',
    '*.closureType': '"CHORD"', '*.visible': 'TRUE', '*.load': 'TRUE',
}
# Nodes that would hold each other without end, and what only shaders need.
LEFT_OUT = {'attrib', 'shaders', 'tangent', 'acousticProperties', 'navigationInfo', 'backMaterial', 'mapping', 'metadata', 'body1', 'body2', 'outputs'}
FIRST = {**nodes.FIRST, 'X3DSingleTextureNode': 'PixelTexture', 'X3DUrlObject': 'Inline', 'X3DMetadataObject': 'MetadataString',
         'X3DViewpointNode': 'Viewpoint', 'X3DLayerNode': 'Layer', 'X3DViewportNode': 'Viewport', 'X3DGroupingNode': 'Group',
         'X3DParticleEmitterNode': 'PointEmitter', 'X3DVolumeRenderStyleNode': 'OpacityMapVolumeStyle', 'X3DRigidJointNode': 'BallJoint',
         'X3DTextureNode': 'PixelTexture', 'X3DShapeNode': 'Shape', 'X3DOneSidedMaterialNode': 'Material'}


def look():
    return Node('Appearance', material=Node('Material', diffuseColor=Raw('0.8 0.5 0.2')))


def shape():
    return Node('Shape', appearance=look(), geometry=Node('Box'))


EXAMPLE = {'X3DAppearanceNode': look, 'X3DGeometryNode': lambda: Node('Box'), 'X3DChildNode': shape, 'X3DShapeNode': shape, 'CADFace': lambda: Node('CADFace', shape=shape())}


class Field(nodes.Field):
    def __init__(self, access, kind, name, rest):
        super().__init__(access, kind, name, rest)
        self.name = name
        self.foreign = nodes.option(rest, 'only') == 'wrlkit'


def read_tables():
    kinds = {}
    for table in TABLES:
        for line in table.read_text(encoding='utf-8').splitlines():
            if line.startswith(('base ', 'node ')):
                kind = nodes.Kind(line)
                kind.in_x3d = ' x3d ' in line
                kinds[kind.name] = kind
            elif match := nodes.ROW.match(line.partition(' -- ')[0].rstrip()):
                field = Field(*match.groups())
                if not field.foreign:
                    kind.fields.append(field)
    return kinds


class Maker(nodes.Maker):
    def __init__(self, kinds):
        self.kinds = kinds
        self.nodes = [kind for kind in kinds.values() if kind.in_x3d]
        self.open = []

    def full(self, name, replaced=None, value=None, label=None):
        node = Node(name, label)
        self.open.append(name)
        for field in self.kinds[name].fields:
            if field.access not in nodes.STORED or (field.name in LEFT_OUT and field.name != replaced):
                continue
            made = value if field.name == replaced else self.value(name, field)
            if made is not None:
                node.fields[field.name] = made
        self.open.pop()
        return node

    def value(self, name, field):
        if name == 'CADLayer' and field.name == 'children':
            return [shape(), shape()]
        special = SPECIAL.get(f'{name}.{field.name}') or SPECIAL.get(f'*.{field.name}')
        if special:
            return Raw(special)
        if field.type in ('SFNode', 'MFNode') and len(self.open) > 2:
            return None
        if field.type == 'SFNode':
            return self.example(field)
        if field.type == 'MFNode':
            return [self.example(field)] * (2 if name == 'LOD' else 1)
        return Raw(plain_value(field))

    def example(self, field):
        kind = field.kinds[0]
        if kind in EXAMPLE:
            return EXAMPLE[kind]()
        return self.full(FIRST.get(kind) or next(k.name for k in self.nodes if kind in self.ancestors(k.name)))

    def container(self, name):
        return next((self.kinds[a].container for a in self.ancestors(name) if self.kinds[a].container), 'children')

    def placed(self, name, node):
        container = self.container(name)
        if container == 'children' or name == 'LayerSet':
            return node
        fits = lambda f: set(f.kinds) & set(self.ancestors(name))
        named = [(k, f) for k in self.nodes for f in k.fields
                 if f.name == container and fits(f) and self.container(k.name) != container]
        parent, field = named[0] if named else next((k, f) for k in self.nodes for f in k.fields if fits(f))
        inner = [node] if field.type == 'MFNode' else node
        return self.placed(parent.name, self.full(parent.name, field.name, inner))

    # ---- the text ----

    def xml(self, node, field, depth):
        indent = ' ' * depth
        head, children = f'{indent}<{node.kind}', []
        if node.name:
            head += f" DEF='{node.name}'"
        for f in self.kinds[node.kind].fields:
            value = node.fields.get(f.name)
            if isinstance(value, (Node, list)):
                children += [(f.name, child) for child in (value if isinstance(value, list) else [value])]
            elif value is not None:
                head += f" {f.name}='{attribute(f, value)}'"
        if field != self.container(node.kind):
            head += f" containerField='{field}'"
        if not children:
            return head + '/>\n'
        return head + '>\n' + ''.join(self.xml(child, name, depth + 1) for name, child in children) + f'{indent}</{node.kind}>\n'


def plain_value(field):
    kind = field.type[2:]
    if kind in ('Double', 'Time'):
        field.type = field.type[:2] + 'Float'
    if kind == 'Vec4f' or kind == 'ColorRGBA':
        return '0.1 0.2 0.3 0.4' if field.type[0] == 'S' else '[ 0.1 0.2 0.3 0.4 ]'
    if field.type == 'MFBool':
        return '[ TRUE FALSE TRUE ]'
    return nodes.plain_value(field)


def attribute(field, value):
    text = str(value).strip()
    if field.type[0] == 'M' and text.startswith('['):
        text = text[1:-1].strip()
    if field.type == 'SFString':
        text = text[1:-1]
    if field.type in ('SFBool', 'MFBool'):
        text = text.lower()
    return escape(text, {"'": '&apos;'})


def document(maker, kind):
    roots = [maker.placed(kind.name, maker.full(kind.name, label='Tested'))]
    if not nodes.draws(roots[0]):
        roots.append(shape())
    routes = ''.join(f"  <ROUTE fromNode='Tested' fromField='{f.name}' toNode='Listener' toField='from_{f.name}'/>\n"
                     for f in kind.fields if f.access == 'out')
    fields = ''.join(f"   <field name='from_{f.name}' type='{f.type}' accessType='inputOnly'/>\n" for f in kind.fields if f.access == 'out')
    script = f"  <Script DEF='Listener'>\n{fields}   <![CDATA[ecmascript:\nfunction initialize() {{ if (1 < 2 && true) print('ready'); }}\n]]>\n  </Script>\n"
    body = ''.join(maker.xml(root, 'children', 2) for root in roots)
    return (f'<?xml version="1.0" encoding="UTF-8"?>\n<!-- {kind.name}: every field away from its default -->\n'
            f"<X3D profile='Full' version='4.0'>\n <Scene>\n{body}{script + routes if routes else ''} </Scene>\n</X3D>\n")


def files(seed):
    maker = Maker(read_tables())
    for kind in maker.nodes:
        yield f'x3d/{kind.name}.x3d', document(maker, kind)
