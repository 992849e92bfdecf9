"""Passes that are Python functions: the decorator pass_, and the reading of files that define some."""
import importlib.machinery
import importlib.util
import inspect
import math
import numbers
import os
import pathlib
import re
import sys
import traceback
import typing

from . import _wrlkit, arguments

__all__ = ['Range', 'pass_']


class Range:
    """The least and the most that a number may be: Annotated[float, Range(0, 1)]. None: any."""

    def __init__(self, least: typing.Optional[float] = None, most: typing.Optional[float] = None) -> None:
        for name, value in (('least', least), ('most', most)):
            if value is not None and not isinstance(value, numbers.Real):
                raise TypeError(f"Range(): '{name}' should be a number or None, not {arguments.shown(value)}")
        self.least, self.most = least, most

    def __str__(self) -> str:
        if self.most is None:
            return '' if self.least is None else f'at least {self.least:g}'
        return f'at most {self.most:g}' if self.least is None else f'{self.least:g} to {self.most:g}'

    def has(self, value: float) -> bool:
        """Whether a number lies in it."""
        return (self.least is None or value >= self.least) and (self.most is None or value <= self.most)


WORDS = {bool: 'bool', int: 'integer', float: 'number', str: 'text', pathlib.Path: 'file'}


class Option:
    """A parameter of a pass behind the world, as an option of pipelines: its text, and the value of a text."""

    def __init__(self, function, parameter, hint, doc):
        self.parameter, self.name = parameter.name, parameter.name.replace('_', '-')
        where = f"pass '{function.__name__}': option '{self.parameter}'"
        if parameter.kind in (parameter.VAR_POSITIONAL, parameter.VAR_KEYWORD, parameter.POSITIONAL_ONLY):
            raise TypeError(f'{where} has to be a parameter that can be named')
        if self.name == 'name':
            raise TypeError(f'{where} needs another name: below [[pass]] that is the name of the pass')
        if parameter.default is parameter.empty:
            raise TypeError(f'{where} has no default')
        default = parameter.default
        self.range, self.help = Range(), doc
        if typing.get_origin(hint) is typing.Annotated:
            for more in hint.__metadata__:
                self.range = more if isinstance(more, Range) else self.range
                self.help = more if isinstance(more, str) else self.help
            hint = hint.__origin__
        if hint is parameter.empty:
            hint = type(default)
        self.is_list = (typing.get_origin(hint) or hint) in (list, tuple)
        if self.is_list:
            items = [a for a in typing.get_args(hint) if a is not Ellipsis]
            hint = items[0] if items else type(default[0]) if default else str
        self.choices = typing.get_args(hint) if typing.get_origin(hint) is typing.Literal else ()
        self.type = str if self.choices else pathlib.Path if isinstance(hint, type) and issubclass(hint, pathlib.PurePath) else hint
        if self.type not in WORDS or not all(isinstance(c, str) for c in self.choices):
            raise TypeError(f'{where} is neither bool, int, float, str, pathlib.Path or a Literal of texts, nor a list of those')
        try:
            self.default = self.text(self.value(self.text(default)))
        except (TypeError, ValueError) as fault:
            raise TypeError(f'{where}: its default {default!r} is no {self.kind()}') from fault

    def kind(self):
        """What values there are, in words."""
        word = ' or '.join(self.choices) if self.choices else WORDS[self.type]
        return ' '.join(filter(None, [word, str(self.range), 'each, with ":" between them' if self.is_list else '']))

    def text(self, value):
        """As pipelines write it."""
        if self.is_list:
            return ':'.join(map(self._item_text, value))
        return self._item_text(value)

    def value(self, text):
        """The content of a text; ValueError when it has none."""
        if self.is_list:
            return [self._item(t) for t in text.split(':')] if text else []
        return self._item(text)

    def _item_text(self, value):
        if self.type is bool:
            return 'true' if value else 'false'
        return str(value).removesuffix('.0') if self.type is float else str(value)

    def _item(self, text):
        if self.type is bool:
            if text not in ('true', 'false'):
                raise ValueError(text)
            return text == 'true'
        value = self.type(text)
        if self.choices and value not in self.choices:
            raise ValueError(text)
        if self.type in (int, float) and not (math.isfinite(value) and self.range.has(value)):
            raise ValueError(text)
        return value


def helps(doc):
    """Lines of a docstring that tell of one parameter, "table: rows of old and new names"."""
    return {name: text for name, text in re.findall(r'^\s*(\w+):\s+(.+?)\s*$', doc, re.MULTILINE)}


class Definition:
    """What the program knows of a function that is a pass."""

    def __init__(self, function, name):
        if not callable(function):
            raise TypeError(f'pass_(): a function is expected, not {arguments.shown(function)}')
        if name is not None and not isinstance(name, str):
            raise TypeError(f"pass_(): 'name' should be a str, not {arguments.shown(name)}")
        self.function, self.name = function, name or function.__name__.replace('_', '-')
        if not re.fullmatch(r'[A-Za-z][\w.-]*', self.name):
            raise ValueError(f"'{self.name}' is not a valid name for a pass")
        self.doc = inspect.getdoc(function) or ''
        self.summary = self.doc.split('\n')[0].rstrip('.')
        hints, about = typing.get_type_hints(function, include_extras=True), helps(self.doc)
        parameters = list(inspect.signature(function).parameters.values())
        if not parameters:
            raise TypeError(f"pass '{function.__name__}' has no parameter for the world")
        self.options = {o.name: o for o in (Option(function, p, hints.get(p.name, p.empty), about.get(p.name, '')) for p in parameters[1:])}
        source = inspect.getsourcefile(function)
        self.path = os.path.realpath(source) if source else ''  # typed in, it has none

    def described(self):
        """Name, type, default and help of each option."""
        return [[o.name, o.kind(), o.default, o.help] for o in self.options.values()]

    def read(self, option, text):
        """The text of an option as it is printed; ValueError when it is not a value."""
        return self.options[option].text(self.options[option].value(text))

    def call(self, world, texts):
        """Runs the function; what it counted."""
        values = {self.options[name].parameter: self._resolved(self.options[name].value(text)) for name, text in texts.items()}
        return self.function(world, **values) or {}

    def files(self, texts):
        """Files that the outcome depends on: where the function stands, what it imports from there, and what its options name."""
        named = []
        for name, text in texts.items():
            value = self.options[name].value(text)
            named += [str(self._resolved(v)) for v in (value if isinstance(value, list) else [value]) if isinstance(v, pathlib.Path)]
        return sources_beside(self.path) + named

    def describe(self, exception):
        """An exception in one line, with the line of the file that it comes from."""
        return describe(exception, self.path)

    def _resolved(self, value):
        """A path that is relative is one from the folder of the Python file."""
        if isinstance(value, list):
            return [self._resolved(v) for v in value]
        return pathlib.Path(self.path).parent / value if isinstance(value, pathlib.Path) else value


F = typing.TypeVar('F', bound=typing.Callable[..., typing.Any])


@typing.overload
def pass_(function: F) -> F: ...
@typing.overload
def pass_(*, name: typing.Optional[str] = None) -> typing.Callable[[F], F]: ...
def pass_(function: typing.Any = None, *, name: typing.Optional[str] = None) -> typing.Any:
    """Makes a pass of a function, which pipelines, recipes and the command line then know by its name, with "-" for "_".

        @wrlkit.pass_
        def rename_tags(world, table: pathlib.Path = pathlib.Path('tags.csv'), prefix: str = ''):
            '''Give nodes the names that a table has for them.

            table: rows of old and new name
            prefix: put in front of each new name
            '''
            ...
            return {'renamed': n}

    The first parameter is the World. The others are the options of the pass; their types are bool, int, float, str, pathlib.Path,
    Literal['a', 'b'] or lists of those, by annotation or by the default, which each must have; Annotated[float, Range(0, 1)] limits
    a number. A relative path is one from the folder of the file that the function stands in. The first line of the docstring is the
    summary of the pass, and lines "name: text" tell of options. What is returned, if anything, is a dict of counts for --stats.
    An exception ends the pass, and so the conversion of that world. The function itself stays what it is.
    """
    def define(f):
        definition = Definition(f, name)
        if defined.setdefault(definition.name, definition.path) != definition.path:
            raise ValueError(f"the pass '{definition.name}' is in {defined[definition.name]} already")
        _wrlkit._define(definition)
        f.pass_name = definition.name
        return f
    return define if function is None else define(function)


defined = {}  # name of a pass: its file
loaded = {}   # file: module


def load(path):
    """Runs a file, once, so that the passes in it are known. It can import what lies next to it."""
    path = os.path.realpath(path)
    if path in loaded:
        return
    if not os.path.isfile(path):
        raise FileNotFoundError(f"there is no file '{path}'")
    folder = os.path.dirname(path)
    if folder not in sys.path:
        sys.path.insert(0, folder)
    name = f'wrlkit_file_{len(loaded)}_{pathlib.Path(path).stem}'
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(name, importlib.machinery.SourceFileLoader(name, path)))
    sys.modules[name] = module
    module.__spec__.loader.exec_module(module)
    loaded[path] = module


def sources_beside(path):
    """The file and all modules that were imported from its folder or from below it."""
    if not path:
        return []
    folder = os.path.join(os.path.dirname(path), '')
    files = {os.path.realpath(f) for m in list(sys.modules.values()) if isinstance(f := getattr(m, '__file__', None), str)}
    return [path] + sorted(f for f in files if f.startswith(folder) and f != path)


def describe(exception, path):
    """An exception in one line, with the innermost line of that file that it comes from."""
    if isinstance(exception, SyntaxError) and exception.filename:
        place = f'{os.path.basename(exception.filename)}:{exception.lineno}'
    else:
        own = [f.lineno for f in traceback.extract_tb(exception.__traceback__) if os.path.realpath(f.filename) == os.path.realpath(path)]
        place = f'{os.path.basename(path)}:{own[-1]}' if own else ''
    text = ' '.join(''.join(traceback.format_exception_only(type(exception), exception)).split('\n')[-2].split())
    return f'{text} ({place})' if place else text
