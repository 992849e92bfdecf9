"""One world for each node type, every field away from its default, made from the node table.

A value comes from the field's default, type and range; where only thought helps it stands in SPECIAL. A node that may
not stand alone is wrapped in one that takes it, chosen from the table as well, until a child node is reached. A new
row in the table makes a new file.
"""
from math import inf, pi
from pathlib import Path
import re

from generator.vrml import Node, Raw, number, quoted, world

TABLE = Path(__file__).parents[2] / 'scenegraph' / 'nodes' / 'vrml97.nodes'
ROW = re.compile(r'\s+(init|inout|in|out)\s+([SM]F\w+)\s+(\w+)\s*(.*)$')
STORED = 'init', 'inout'   # the accesses that have a value in the file
RANGE = re.compile(r'([\[(])([^\[\](){}<>]+),([^\[\](){}<>]+)([\])])')


# ---- the table ---------------------------------------------------------------------------------------------------

class Field:
    def __init__(self, access, kind, name, rest):
        self.access, self.type = access, kind
        self.default, rest = default_of(rest) if access in STORED else ('', rest)
        self.name = option(rest, 'vrml97') or name
        self.kinds = bracketed(rest, '<', '>')
        self.words = bracketed(rest, '{', '}')
        self.range = RANGE.search(re.sub(r'<[^>]*>|{[^}]*}', '', rest))
        self.foreign = 'vrml97' not in (option(rest, 'only') or 'vrml97').split('|')


class Kind:
    """A row `base` or `node`."""

    def __init__(self, line):
        head = line.split('--')[0]
        _, self.name = head.split()[:2]
        clauses = re.search(r'\b(vrml1|vrml97|x3d)\b.*|\bcomponent=.*|\bcontainer=.*', head)
        self.container = option(head, 'container')
        names = head[:clauses.start()] if clauses else head
        self.bases = re.findall(r'\w+', names.partition(':')[2])
        self.in_vrml97 = re.search(r'\bvrml97\b', head) is not None
        self.fields = []


def default_of(rest):
    """(default, what follows it) of a row after the field's name."""
    match = re.match(r'(\[[^\]]*\]|"[^"]*"|[^\s\[({<=]+(\s+[-+.\d][^\s=]*)*(?=\s|$))\s*(.*)$', rest)
    return match.group(1), match.group(3)


def option(text, name):
    match = re.search(rf'\b{name}=(\S+)', text)
    return match and match.group(1)


def bracketed(text, left, right):
    match = re.search(rf'{left}([^{right}]*){right}', text)
    return match.group(1).split('|') if match else []


def read_table():
    kinds = {}
    for line in TABLE.read_text(encoding='utf-8').splitlines():
        if line.startswith(('base ', 'node ')):
            kind = Kind(line)
            kinds[kind.name] = kind
        elif match := ROW.match(line.partition(' -- ')[0].rstrip()):
            field = Field(*match.groups())
            if not field.foreign:
                kind.fields.append(field)
    return kinds


# ---- values ------------------------------------------------------------------------------------------------------

# Node.field, or *.field: a value that its type and range do not give.
SPECIAL = {
    '*.bboxSize': '8 8 8',
    '*.stopTime': '10',
    # four points, so that colours, normals and texture coordinates fit in every geometry
    'Coordinate.point': '[ -1 0 1, 1 0 1, 1 0.5 -1, -1 0 -1 ]',
    'Color.color': '[ 0.9 0.2 0.1, 0.2 0.7 0.2, 0.1 0.3 0.9, 0.9 0.8 0.2 ]',
    'Normal.vector': '[ 0 1 0, 0 0.8 0.6, 0.6 0.8 0, 0 0.6 -0.8 ]',
    'TextureCoordinate.point': '[ 0 0, 1 0, 1 1, 0 1 ]',
    'IndexedFaceSet.coordIndex': '[ 2 1 0 -1, 3 2 0 -1 ]',   # clockwise: ccw is FALSE
    'IndexedFaceSet.colorIndex': '[ 1, 2 ]',
    'IndexedFaceSet.normalIndex': '[ 0, 3 ]',
    'IndexedFaceSet.texCoordIndex': '[ 3 2 1 -1, 0 3 1 -1 ]',
    'IndexedLineSet.coordIndex': '[ 0 1 2 -1, 3 0 -1 ]',
    'IndexedLineSet.colorIndex': '[ 3, 1 ]',
    'ElevationGrid.xDimension': '2',
    'ElevationGrid.zDimension': '2',
    'ElevationGrid.height': '[ 0.1, 0.2, 0.3, 0.4 ]',
    'Extrusion.crossSection': '[ -0.3 0.5, 0.3 0.5, 0 0, 0.3 -0.5, -0.3 -0.5, -0.3 0.5 ]',   # clockwise and concave
    'Extrusion.spine': '[ 0 -1 0, 0 0 0, 0.5 1 0 ]',
    'Extrusion.scale': '[ 1 1, 0.75 0.75, 0.5 1 ]',
    'Extrusion.orientation': '[ 0 1 0 0, 0 1 0 0.3, 0 1 0 0.6 ]',
    'Background.groundAngle': '[ 0.8, 1.5 ]',
    'Background.skyAngle': '[ 0.8, 1.5 ]',
    'LOD.range': '[ 8 ]',
    'NormalInterpolator.keyValue': '[ 0 0 1, 0.6 0 0.8, 0 0.6 0.8 ]',
    'Transform.scaleOrientation': '0 0.6 0.8 0.75',
    'SpotLight.beamWidth': '0.5',
    'CylinderSensor.maxAngle': '1.5',
    'PlaneSensor.maxPosition': '1 2',
    'PixelTexture.image': '2 2 3 0xFF0000 0x00FF00 0x0000FF 0xFFFF00',
    'FontStyle.family': '[ "SANS", "SERIF" ]',
    'FontStyle.justify': '[ "MIDDLE", "END" ]',
    'FontStyle.language': '"en"',
    'Text.string': '[ "Pump", "P-101A" ]',
    'Text.length': '[ 2, 0 ]',
    'Text.maxExtent': '3',
    'Fog.visibilityRange': '40',
    'NavigationInfo.visibilityLimit': '50',
    'NavigationInfo.type': '[ "EXAMINE", "ANY" ]',
    'Anchor.url': '[ "Box.wrl" ]',
    'Anchor.parameter': '[ "target=_blank" ]',
    'Inline.url': '[ "Box.wrl" ]',
    'Script.url': '[ "javascript: function initialize() { }" ]',
    'AudioClip.url': '[ "media/beep.wav" ]',
    'MovieTexture.url': '[ "media/colour_bars.mpg" ]',
    'ImageTexture.url': '[ "media/arrows.png" ]',
    **{f'Background.{side}Url': '[ "media/arrows.png" ]'
       for side in ('back', 'bottom', 'front', 'left', 'right', 'top')},
}

# What is put in a node field for a node of some kind; elsewhere it is the first of the kind, in full.
LOOK = 'Appearance { material Material { diffuseColor 0.8 0.5 0.2 } }'
EXAMPLE = {'X3DAppearanceNode': Raw(LOOK), 'X3DGeometryNode': Raw('Box { }'),
           'X3DChildNode': Raw(f'Shape {{ appearance {LOOK} geometry Box {{ }} }}')}
FIRST = {'X3DTextureNode': 'PixelTexture'}


class Maker:
    def __init__(self, kinds):
        self.kinds = kinds
        self.nodes = [kind for kind in kinds.values() if kind.in_vrml97]

    def full(self, name, replaced=None, value=None, label=None):
        """The node with every field set; one field may be given."""
        node = Node(name, label)
        for field in self.kinds[name].fields:
            if field.access in STORED:
                node.fields[field.name] = value if field.name == replaced else self.value(name, field)
        return node

    def value(self, name, field):
        special = SPECIAL.get(f'{name}.{field.name}') or SPECIAL.get(f'*.{field.name}')
        if special:
            return Raw(special)
        if field.type == 'SFNode':
            return self.example(field)
        if field.type == 'MFNode':
            return [self.example(field)] * (2 if name == 'LOD' else 1)
        return Raw(plain_value(field))

    def example(self, field):
        kind = field.kinds[0]
        first = FIRST.get(kind) or next(k.name for k in self.nodes if kind in self.ancestors(k.name))
        return EXAMPLE.get(kind) or self.full(first)

    def ancestors(self, name):
        """The name itself and all its bases, the first base with all of its own before the second."""
        return [name, *(a for base in self.kinds[name].bases for a in self.ancestors(base))]

    def container(self, name):
        return next(self.kinds[a].container for a in self.ancestors(name) if self.kinds[a].container)

    def placed(self, name, node):
        """The node where it may stand: itself, or the nodes around it."""
        container = self.container(name)
        if container == 'children':
            return node
        parent, field = next((k.name, f.name) for k in self.nodes for f in k.fields
                             if f.name == container and f.type == 'SFNode' and set(f.kinds) & set(self.ancestors(name)))
        return self.placed(parent, self.full(parent, field, node))


def plain_value(field):
    kind, default = field.type[2:], field.default
    if kind == 'Bool':
        return 'FALSE' if default == 'TRUE' else 'TRUE'
    if kind == 'String':
        return strings(field)
    if kind == 'Rotation':
        return '0.6 0 0.8 0.5' if field.type[0] == 'S' else '[ 0 1 0 0.25, 0.6 0 0.8 0.5, 1 0 0 0.75 ]'
    if field.type[0] == 'S':
        return ' '.join(moved(float(d), i, kind, field.range) for i, d in enumerate(default.split()))
    return '[ ' + ', '.join(tuple_of(kind, k, default, field.range) for k in range(3)) + ' ]'


def strings(field):
    other = [word for word in field.words if quoted(word) not in field.default]
    text = quoted(other[0] if other else f'the {field.name}')
    return text if field.type[0] == 'S' else f'[ {text} ]'


def tuple_of(kind, k, default, bounds):
    """The k-th element of a list: next to the default's, when that has one."""
    width = {'Vec2f': 2, 'Vec3f': 3, 'Color': 3}.get(kind, 1)
    given = [float(d) for d in re.findall(r'[-+.\d][^\s,\]]*', default)][k * width:(k + 1) * width]
    if given:
        return ' '.join(moved(d, i, kind, bounds) for i, d in enumerate(given))
    return ' '.join(number((0.25 * (k + i + 1) - 0.125) % 1) for i in range(width))


def moved(default, i, kind, bounds):
    """A number near the default, not equal, within the range; `i` makes neighbours differ."""
    if kind == 'Int32':
        return str(int(default) + 1)
    step = 0.25 * (i + 1)
    tries = default * (1 + step), default + step, default - step
    return number(next(t for t in tries if t != default and within(t, bounds)))


def within(value, bounds):
    if not bounds:
        return True
    left, low, high, right = bounds.groups()
    low, high = bound(low), bound(high)
    return (low < value or left == '[' and low == value) and (value < high or right == ']' and value == high)


def bound(text):
    names = {'inf': inf, '-inf': -inf, 'pi': pi, 'pi/2': pi / 2, '2pi': 2 * pi, '-2pi': -2 * pi}
    text = text.strip()
    return names[text] if text in names else float(text)


# ---- events ------------------------------------------------------------------------------------------------------

def listener(kind):
    """A Script that hears every event the node sends and feeds every one it takes, and the routes between them."""
    heard = [field for field in kind.fields if field.access == 'out']
    fed = [field for field in kind.fields if field.access == 'in']
    if not heard:
        return []
    body = [f'  eventIn {field.type} from_{field.name}' for field in heard]
    body += [f'  eventOut {field.type} to_{field.name}' for field in fed]
    routes = [f'ROUTE Tested.{field.name} TO Listener.from_{field.name}' for field in heard]
    routes += [f'ROUTE Listener.to_{field.name} TO Tested.{field.name}' for field in fed]
    return [Raw('\n'.join(['DEF Listener Script {', *body, '}', *routes]))]


def node_world(maker, kind):
    events = listener(kind)
    roots = [maker.placed(kind.name, maker.full(kind.name, label='Tested'))]
    if not draws(roots[0]):
        roots.append(EXAMPLE['X3DChildNode'])
    view = [] if kind.name == 'Viewpoint' else [Raw('Viewpoint { position 0 1 9 }')]
    note = ', its events joined to a Script' if events else ''
    return world(f'{kind.name}: every field away from its default{note}', roots + view + events)


def draws(value):
    """Whether a Shape or an Inline is somewhere in a value."""
    if isinstance(value, list):
        return any(map(draws, value))
    if isinstance(value, Node):
        return value.kind in ('Shape', 'Inline') or any(map(draws, value.fields.values()))
    return value == EXAMPLE['X3DChildNode']


def files(seed):
    maker = Maker(read_table())
    for kind in maker.nodes:
        yield f'nodes/{kind.name}.wrl', node_world(maker, kind)
