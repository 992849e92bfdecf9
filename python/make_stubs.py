#!/usr/bin/env python3
"""Writes the types of the package for checkers and editors: make_stubs.py FOLDER, that of the package, of which the module is built.

_wrlkit.pyi has the signatures that pybind11 gives, and nodes.pyi a class for each row of the node table, with its fields.
"""
import inspect
import keyword
import pathlib
import re
import sys

HEAD = '''"""Made by make_stubs.py when the package is built."""
from typing import Any, Dict, List, Literal, Optional, Tuple, Union, overload
import os
import numpy
import numpy.typing
'''
# Fields by their types. Nodes are Any as well, so that node.material.diffuseColor can be written without a question at every dot.
FIELDS = {'SFBool': 'bool', 'SFInt32': 'int', 'SFString': 'str', 'SFEnum': 'str', 'SFBitMask': 'str', 'SFNode': 'Union[Node, Any]', 'MFNode': 'List[Node]', 'MFString': 'List[str]',
          'SFImage': 'numpy.typing.NDArray[numpy.uint8]', 'MFImage': 'List[numpy.typing.NDArray[numpy.uint8]]', 'MFInt32': 'numpy.typing.NDArray[numpy.int32]', 'MFBool': 'numpy.typing.NDArray[numpy.bool_]',
          'SFFloat': 'float', 'SFDouble': 'float', 'SFTime': 'float'}
TUPLES = {'SFVec2f': 2, 'SFVec2d': 2, 'SFVec3f': 3, 'SFVec3d': 3, 'SFColor': 3, 'SFRotation': 4, 'SFColorRGBA': 4, 'SFVec4f': 4, 'SFVec4d': 4}


def field_type(name):
    """As Python has a field of that type."""
    if name in TUPLES:
        return f'Tuple[{", ".join(["float"] * TUPLES[name])}]'
    return FIELDS.get(name, 'numpy.typing.NDArray[numpy.float64]' if name.startswith('MF') else 'Any')


def plain(signature):
    """A signature of pybind11's in terms of typing."""
    signature = re.sub(r'\bwrlkit\._wrlkit\.', '', signature).replace('numpy.ndarray', 'numpy.typing.NDArray[Any]').replace('kwargs)', 'kwargs: Any)').replace('os.PathLike', "Union[str, 'os.PathLike[str]']")
    signature = re.sub(r'\b(object|handle)\b', 'Any', signature)
    return re.sub(r'\bdict\b', 'Dict[str, Any]', signature)


def documented(doc, indent):
    """A docstring that stands below its signature."""
    text = doc.strip().replace('\\', '\\\\').replace('"""', "'''")
    return f'{indent}"""{text}"""\n' if text else f'{indent}...\n'


def function(name, value, indent=''):
    """A function, by the first line of its docstring by pybind11."""
    signature, _, doc = (value.__doc__ or '').partition('\n')
    found = re.fullmatch(r'\w+(\(.*\)) -> (.*)', signature)
    arguments, result = plain(found[1]), plain(found[2])
    arguments = re.sub(r'\(self: \w+', '(self', arguments)
    arguments = re.sub(r': (\w+) = None', r': Optional[\1] = None', arguments)
    return f'{indent}def {name}{arguments} -> {result}:\n{documented(doc, indent + "    ")}'


def attribute(name, value, indent):
    """A property; its type is what the getter gives."""
    getter = re.search(r'-> (.*)', value.fget.__doc__ or '')
    result = plain(getter[1]) if getter else 'Any'
    out = f'{indent}@property\n{indent}def {name}(self) -> {result}:\n{documented(value.__doc__ or "", indent + "    ")}'
    if value.fset:
        out += f'{indent}@{name}.setter\n{indent}def {name}(self, value: {result}) -> None: ...\n'
    return out


def a_class(name, value, types):
    """A class with what it has of its own."""
    out = f'\nclass {name}:\n{documented(value.__doc__ or "", "    ")}'
    for member, what in sorted(vars(value).items()):
        if isinstance(what, property):
            out += attribute(member, what, '    ')
        elif member in ('nodes', 'add') and name == 'World':
            out += typed(member, what, types)
        elif inspect.isroutine(what) and not member.startswith('_'):
            out += function(member, what, '    ')
    if name == 'Node':
        out += '    def __getattr__(self, name: str) -> Any: ...\n    def __setattr__(self, name: str, value: Any) -> None: ...\n'
        out += '    def __getitem__(self, name: str) -> Any: ...\n    def __setitem__(self, name: str, value: Any) -> None: ...\n'
    return out


def typed(member, what, types):
    """A method that gives nodes of the type that its argument names."""
    out = ''
    for t in types:
        arguments, result = (', **fields: Any', f'nodes.{t}') if member == 'add' else ('', f'List[nodes.{t}]')
        out += f"    @overload\n    def {member}(self, type: Literal['{t}']{arguments}) -> {result}: ...\n"
    return out + '    @overload\n' + function(member, what, '    ')


def main(folder):
    """Writes both files."""
    sys.path.insert(0, str(folder.parent))
    import wrlkit
    from wrlkit import _wrlkit
    table = _wrlkit.node_types()
    out = HEAD + 'from . import nodes\n'
    for name, value in sorted(vars(_wrlkit).items()):
        if inspect.isclass(value):
            out += a_class(name, value, table)
        elif inspect.isroutine(value):
            out += '\n' + function(name, value)
    (folder / '_wrlkit.pyi').write_text(out)
    out = HEAD + 'from ._wrlkit import Node\n'
    taken = {n for n in dir(_wrlkit.Node) if not n.startswith('__')}
    for name, (doc, fields) in table.items():
        out += f'\nclass {name}(Node):\n{documented(doc, "    ")}'
        out += ''.join(f'    {f}: {field_type(t)}\n' for f, t in fields if f.isidentifier() and not keyword.iskeyword(f) and f not in taken)
    (folder / 'nodes.pyi').write_text(out)
    (folder / 'py.typed').write_text('')


if __name__ == '__main__':
    main(pathlib.Path(sys.argv[1]))
