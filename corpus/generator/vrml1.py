"""One world for each node type of VRML 1.0 and Inventor, every field away from its default, made from the node table.

The node stands in a Separator behind what it needs (coordinates, materials) and before a Cube, which shows what it does
to the state. Values are made as in nodes.py.
"""
from pathlib import Path

from generator import media
from generator.nodes import Field, Kind, ROW, plain_value
from generator.vrml import quoted

TABLE = Path(__file__).parents[2] / 'scenegraph' / 'nodes' / 'vrml1.nodes'

SPECIAL = {
    '*.bboxSize': '8 8 8',
    '*.coordIndex': '[ 0, 1, 2, -1, 0, 2, 3, -1 ]',
    '*.materialIndex': '[ 1, 0, 2, -1, 1, 2, 0, -1 ]',
    '*.normalIndex': '[ 2, 1, 0, -1, 2, 0, 3, -1 ]',
    '*.textureCoordIndex': '[ 3, 2, 1, -1, 3, 1, 0, -1 ]',
    '*.vertexProperty': 'VertexProperty { vertex [ 0 0 0, 2 0 0, 2 2 0, 0 2 0 ] }',
    '*.startIndex': '1',
    '*.numPoints': '2',
    '*.numVertices': '[ 3 ]',
    '*.knotVector': '[ 0, 0, 1, 1 ]',
    '*.image': '2 2 3 0xFF0000 0x00FF00 0x0000FF 0xFFFF00',
    '*.matrix': '1 0 0 0, 0 2 0 0, 0 0 1 0, 3 0 0 1',
    'MultipleCopy.matrix': '[ 1 0 0 0 0 1 0 0 0 0 1 0 3 0 0 1, 1 0 0 0 0 1 0 0 0 0 1 0 6 0 0 1 ]',
    '*.orderedRGBA': '[ 0xff0000ff, 0x00ff0080, 0x0000ffff ]',
    'Coordinate4.point': '[ -1 0 1 1, 2 0 2 2, 1 0.5 -1 1, -1 0 -1 1 ]',
    'WWWInline.name': 'Cube.wrl',
    'File.name': '"Cube.wrl"',
    'WWWAnchor.name': '"Cube.wrl"',
    'Texture2.filename': '"arrows.png"',
    'Switch.whichChild': '1',
    'Blinker.whichChild': '0',
    'QuadMesh.verticesPerRow': '2',
    'QuadMesh.verticesPerColumn': '2',
    'QuadMesh.startIndex': '0',
    'ClipPlane.plane': '0 1 0 0.5',
    'VertexProperty.vertex': '[ 0 0 0, 2 0 0, 2 2 0, 0 2 0 ]',
    'VertexProperty.normal': '[ 0 0 1, 0 0.6 0.8, 0.6 0 0.8, 0 0 1 ]',
    'VertexProperty.texCoord': '[ 0 0, 1 0, 1 1, 0 1 ]',
    'Array.numElements1': '3',
}

STATE = """  Coordinate3 { point [ -1 0 1, 1 0 1, 1 0.5 -1, -1 0 -1 ] }
  Normal { vector [ 0 1 0, 0 0.8 0.6, 0.6 0.8 0, 0 0.6 -0.8 ] }
  TextureCoordinate2 { point [ 0 0, 1 0, 1 1, 0 1 ] }
  Material { diffuseColor [ 0.9 0.2 0.1, 0.2 0.7 0.2, 0.1 0.3 0.9 ] }
  MaterialBinding { value PER_FACE_INDEXED }
"""


def read_table():
    kinds, clauses = [], {}
    for line in TABLE.read_text(encoding='utf-8').splitlines():
        if line.startswith(('base ', 'node ')):
            kind = Kind(line)
            if line.startswith('node '):
                kinds.append(kind)
                clauses[kind.name] = line.split('vrml1', 1)[1].strip()
        elif match := ROW.match(line.partition(' -- ')[0].rstrip()):
            kind.fields.append(Field(*match.groups()))
    return kinds, clauses


def value(name, field):
    special = SPECIAL.get(f'{name}.{field.name}') or SPECIAL.get(f'*.{field.name}')
    if special:
        return special
    if field.type in ('SFEnum', 'SFBitMask'):
        return next(word for word in field.words if word != field.default)
    if field.type == 'SFString':
        return quoted(f'the {field.name}')
    return plain_value(field)


def node_text(kind):
    lines = [f'    {f.name} {value(kind.name, f)}' for f in kind.fields if f.name != 'children']
    if any(f.name == 'children' for f in kind.fields):
        lines += ['    Sphere { }', '    Translation { translation 3 0 0 }', '    Cone { }']
    return '\n'.join([f'  DEF Tested {kind.name} {{', *lines, '  }']) if lines else f'  DEF Tested {kind.name} {{ }}'


def node_world(kind, inventor):
    header = '#Inventor V2.1 ascii' if inventor else '#VRML V1.0 ascii'
    tested = node_text(kind)
    if kind.name == 'VertexProperty':   # is allowed in a field only
        tested = '  IndexedFaceSet { coordIndex [ 0, 1, 2, 3, -1 ]\n  vertexProperty\n' + tested + '\n  }'
    return (f'{header}\n# {kind.name}: every field away from its default\n\nSeparator {{\n'
            f'  PerspectiveCamera {{ position 0 1 9 }}\n{STATE}{tested}\n  Cube {{ width 0.5 }}\n}}\n')


def files(seed):
    kinds, clauses = read_table()
    worlds = [(f'vrml1/{kind.name}.wrl', node_world(kind, clauses[kind.name] == 'Inventor')) for kind in kinds]
    return worlds + [('vrml1/arrows.png', dict(media.files(seed))['nodes/media/arrows.png'])]
