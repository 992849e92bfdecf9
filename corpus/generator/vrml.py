"""VRML97 scenes as Python objects, and their text.

The one idea: sharing is identity. A Node that hangs in two places of the tree is written once with DEF and after
that with USE, so a builder that keeps a part in a variable has instanced it.

Values: bool, number, str (quoted), tuple (one vector, colour, rotation), list (an MF value), Node, Raw (as it is).
"""

WIDTH = 110


class Raw(str):
    """Text that is VRML already."""


class Node:
    def __init__(self, kind, name=None, **fields):
        self.kind, self.name = kind, name
        self.fields = {key: value for key, value in fields.items() if value is not None}


def group(children, name=None, at=None, turn=None, scale=None):
    """A Transform, or a Group where nothing moves."""
    turn = turn if turn and turn[3] else None
    kind = 'Transform' if at or turn or scale else 'Group'
    return Node(kind, name, translation=at, rotation=turn, scale=scale, children=list(children))


def put(node, name=None, at=None, turn=None):
    """One node, moved."""
    return group([node], name, at, turn)


def world(comment, roots):
    """A whole file; the comment says what it shows, the manifest repeats it."""
    return f'#VRML V2.0 utf8\n# {comment}\n\n' + Writer(roots).text()


def number(value):
    if isinstance(value, bool):
        return 'TRUE' if value else 'FALSE'
    if isinstance(value, int):
        return str(value)
    return f'{round(value, 5) + 0.0:.7g}'  # + 0.0 turns -0.0 into 0


def quoted(text):
    return '"' + text.replace('\\', '\\\\').replace('"', '\\"') + '"'


class Writer:
    def __init__(self, roots):
        self.roots = roots
        self.names = {}      # id(node) -> its DEF name
        self.taken = set()
        self.written = set()
        self.name_nodes()

    def text(self):
        return '\n'.join(line for root in self.roots for line in self.value(root)) + '\n'

    def name_nodes(self):
        """A node has a name because the builder gave one, or because it is met again."""
        met = {}
        for node in walk(self.roots):
            met.setdefault(id(node), [node, 0])[1] += 1
        for key, (node, times) in met.items():
            if node.name or times > 1:
                self.names[key] = self.free_name(node.name or f'{node.kind}_1')

    def free_name(self, name):
        stem, n = name.removesuffix('_1'), 1
        while name in self.taken:
            n += 1
            name = f'{stem}_{n}'
        self.taken.add(name)
        return name

    def value(self, value):
        """The lines of a value."""
        if isinstance(value, Node):
            return self.node(value)
        if isinstance(value, list):
            return self.many(value)
        return [scalar(value)]

    def node(self, node):
        name = self.names.get(id(node))
        if id(node) in self.written:
            return [f'USE {name}']
        self.written.add(id(node))
        head = (f'DEF {name} ' if name else '') + node.kind + ' {'
        body = []
        for field, value in node.fields.items():
            first, *rest = self.value(value)
            body += [f'{field} {first}', *rest]
        return bracketed(head, body, '}')

    def many(self, values):
        if values and isinstance(values[0], (Node, Raw)):
            body = [line for value in values for line in self.value(value)]
        else:
            body = wrapped([scalar(value) for value in values])
        return bracketed('[', body, ']')


def scalar(value):
    if isinstance(value, Raw):
        return value
    if isinstance(value, str):
        return quoted(value)
    if isinstance(value, tuple):
        return ' '.join(map(number, value))
    return number(value)


def wrapped(items):
    """Items joined by commas, as many a line as fit."""
    lines, line = [], ''
    for item in items:
        if line and len(line) + len(item) > WIDTH - 2:
            lines.append(line)
            line = ''
        line += (' ' if line else '') + item + ','
    return lines + [line[:-1]] if line else []


def bracketed(head, body, tail):
    if len(body) < 8 and len(head) + sum(map(len, body)) + len(body) < WIDTH - 10:
        return [' '.join([head, *body, tail])]
    return [head, *('  ' + line for line in body), tail]


def walk(values):
    """Every occurrence of every node, but what hangs below a shared one only once."""
    entered, stack = set(), list(reversed(values))
    while stack:
        node = stack.pop()
        if not isinstance(node, Node):
            continue
        yield node
        if id(node) in entered:
            continue
        entered.add(id(node))
        below = [n for value in node.fields.values() for n in (value if isinstance(value, list) else [value])]
        stack += reversed(below)
