"""A second opinion: a small reader of VRML97 that counts what a world shows.

The manifest's numbers come from here and not from the program that is tested with them. The grammar is read without
a node table (a field's name is a word, its value shows what it is), PROTOs are expanded by copying their first node.
As shown means: instances multiplied out, the chosen child of a Switch, the finest level of a LOD, no proxies.
"""
import copy
import re
from pathlib import Path

TOKEN = re.compile(r'"(?:[^"\\]|\\.)*"|#[^\n]*|[{}\[\]]|[^\s,"#{}\[\]]+')
NUMBER = re.compile(r'[-+]?(\d+\.?\d*([eE][-+]?\d+)?|\.\d+([eE][-+]?\d+)?|0[xX][0-9a-fA-F]+)$')
ACCESS = 'eventIn', 'eventOut', 'field', 'exposedField'
CHILDREN = {'Group': 'children', 'Transform': 'children', 'Anchor': 'children', 'Billboard': 'children',
            'Collision': 'children', 'Switch': 'choice', 'LOD': 'level'}


class Node:
    def __init__(self, kind, proto=None):
        self.kind, self.proto, self.fields = kind, proto, {}


class Is(str):
    """The value of a field is that of the PROTO's field of this name."""


class Proto:
    def __init__(self, defaults, body=None, url=None):
        self.defaults, self.body, self.url = defaults, body, url


class Reader:
    """Reads one file; `roots` are its nodes, `protos` its definitions."""

    def __init__(self, path):
        self.path = Path(path)
        text = self.path.read_bytes().decode('utf-8')
        assert text.startswith('#VRML V2.0 utf8\n'), f'{path}: header'
        self.tokens = [t for t in TOKEN.findall(text) if t[0] != '#']
        self.next = 0
        self.names, self.protos = {}, {}
        self.roots = self.statements(None)

    def peek(self):
        return self.tokens[self.next] if self.next < len(self.tokens) else None

    def take(self, expected=None):
        token = self.peek()
        assert token is not None and (expected is None or token == expected), f'{self.path}: {token}, not {expected}'
        self.next += 1
        return token

    def statements(self, end):
        nodes = []
        while self.peek() != end:
            if not self.definition():
                nodes.append(self.node())
        return nodes

    def definition(self):
        """PROTO, EXTERNPROTO or ROUTE, when one stands here."""
        keyword = self.peek()
        if keyword not in ('PROTO', 'EXTERNPROTO', 'ROUTE'):
            return False
        self.take()
        {'PROTO': self.proto, 'EXTERNPROTO': self.extern_proto, 'ROUTE': self.route}[keyword]()
        return True

    def route(self):
        for end in self.take(), self.take('TO') and self.take():
            assert end.split('.')[0] in self.names, f'{self.path}: ROUTE {end}'

    def proto(self):
        name = self.take()
        defaults = self.interface()
        self.take('{')
        outer = self.names, self.protos
        self.names, self.protos = {}, dict(self.protos)
        body = self.statements('}')
        self.names, self.protos = outer
        self.take('}')
        self.protos[name] = Proto(defaults, body)

    def extern_proto(self):
        name = self.take()
        self.interface(extern=True)
        urls = self.value()
        self.protos[name] = Proto({}, url=many(urls))

    def interface(self, extern=False):
        defaults = {}
        self.take('[')
        while self.peek() != ']':
            access, _, name = self.take(), self.take(), self.take()
            assert access in ACCESS, f'{self.path}: {access}'
            if access in ACCESS[2:] and not extern:
                defaults[name] = self.value()
        self.take(']')
        return defaults

    def node(self):
        word = self.take()
        if word == 'NULL':
            return None
        if word == 'USE':
            return self.names[self.take()]
        if word != 'DEF':
            return self.body(Node(word, self.protos.get(word)))
        name, kind = self.take(), self.take()
        node = self.names[name] = Node(kind, self.protos.get(kind))
        return self.body(node)

    def body(self, node):
        self.take('{')
        while self.peek() != '}':
            if self.definition():
                continue
            name = self.take()
            if name in ACCESS and self.tokens[self.next][:2] in ('SF', 'MF'):
                self.take()
                access, name = name, self.take()
                if access in ACCESS[:2] and self.peek() != 'IS':
                    continue
            node.fields[name] = self.value()
        self.take('}')
        return node

    def value(self):
        token = self.peek()
        if token == '[':
            return self.many()
        if token == 'IS':
            self.take()
            return Is(self.take())
        if token[0] == '"' or token in ('TRUE', 'FALSE'):
            return self.take().strip('"')
        if NUMBER.match(token):
            return self.numbers()
        return self.node()

    def many(self):
        self.take('[')
        values = []
        while self.peek() != ']':
            values.append(self.value())
        self.take(']')
        return values

    def numbers(self):
        values = []
        while NUMBER.match(self.peek() or ''):
            token = self.take()
            values.append(int(token, 16) if token[:2] in ('0x', '0X') else float(token))
        return tuple(values)


# ---- what is shown -----------------------------------------------------------------------------------------------

def shown(node, path):
    """The Shape nodes below a node, each as often as it is seen."""
    if node is None:
        return
    if node.proto:
        yield from shown(*expanded(node, path))
    elif node.kind == 'Shape':
        yield node
    elif node.kind == 'Inline':
        part, _ = first_found(many(node.fields.get('url')), path)
        yield from shapes(part) if part else ()
    elif node.kind in CHILDREN:
        for child in chosen(node, many(node.fields.get(CHILDREN[node.kind]))):
            yield from shown(child, path)


def chosen(node, children):
    if node.kind == 'Switch':
        which = int(node.fields.get('whichChoice', (-1,))[0])
        return children[which:which + 1] if which >= 0 else []
    return children[:1] if node.kind == 'LOD' else children


def many(value):
    return value if isinstance(value, list) else [] if value is None else [value]


def expanded(node, path):
    """What an instance stands for, and the file that it is written in."""
    proto, values = node.proto, node.fields
    if proto.url:
        path, wanted = first_found(proto.url, path)
        protos = Reader(path).protos
        proto = protos[wanted] if wanted else next(iter(protos.values()))
    return replaced(proto.body[0], {**proto.defaults, **values}, {}), path


def first_found(urls, path):
    """The first of the files that exists, and what stands behind its '#'."""
    for url in urls:
        name, _, part = url.partition('#')
        if (path.parent / name).is_file():
            return path.parent / name, part
    return None, ''


def replaced(value, values, done):
    """A copy in which every IS has its value."""
    if isinstance(value, Is):
        return values.get(value)
    if isinstance(value, list):
        return [replaced(v, values, done) for v in value]
    if not isinstance(value, Node):
        return value
    if id(value) not in done:
        done[id(value)] = twin = copy.copy(value)
        twin.fields = {}
        fields = {name: replaced(v, values, done) for name, v in value.fields.items()}
        twin.fields = {name: v for name, v in fields.items() if v is not None}
    return done[id(value)]


def shapes(path):
    return [shape for root in Reader(path).roots for shape in shown(root, Path(path))]


def geometry(shape):
    node = shape.fields.get('geometry')
    while node and node.proto and node.proto.body:
        node = replaced(node.proto.body[0], {**node.proto.defaults, **node.fields}, {})
    return node


def triangles(node):
    """None where a tessellator decides."""
    if node is None or node.kind in ('IndexedLineSet', 'PointSet'):
        return 0
    if node.kind == 'IndexedFaceSet':
        return sum(max(0, corners - 2) for corners in polygons(many(node.fields.get('coordIndex'))))
    if node.kind == 'ElevationGrid':
        columns, rows = (max(0, int(node.fields.get(name, (0,))[0]) - 1) for name in ('xDimension', 'zDimension'))
        return 2 * columns * rows
    return None


def polygons(indices):
    """The number of corners of each."""
    corners = 0
    for part in indices:
        for index in part:
            if index < 0:
                yield corners
            corners = corners + 1 if index >= 0 else 0
    yield corners


def census(path):
    """(shapes, triangles), the latter None unless every shape says it."""
    seen = shapes(path)
    counts = [triangles(geometry(shape)) for shape in seen]
    return len(seen), None if None in counts else sum(counts)
