"""Errors for wrong arguments, in words: what was given, and what is expected. pybind11 only lists the signature."""
import difflib
import functools
import inspect
import numbers
import os
import re

RAW = 'incompatible function arguments'  # of pybind11
PATH = 'a path (str or pathlib.Path)'
# Types of signatures: what they are called, and the classes of Python that fit.
KINDS = {'str': ('a str', str), 'bytes': ('bytes', bytes), 'os.PathLike': (PATH, (str, os.PathLike)), 'bool': ('True or False', bool), 'int': ('an int', numbers.Integral),
         'float': ('a number', numbers.Real), 'wrlkit._wrlkit.Node': ('a Node', ()), 'wrlkit._wrlkit.World': ('a World', ())}
PLURALS = {'os.PathLike': 'paths', 'str': 'texts', 'wrlkit._wrlkit.Node': 'Nodes'}


def shown(value):
    """A value in a message: its type, and what it is where that is short."""
    text = repr(value)
    kind = type(value).__name__
    return 'None' if value is None else f'{kind} {text}' if len(text) < 60 and kind not in text else f'a {kind}'


def kind_of(annotation):
    """What an argument of that type is, in words."""
    if match := re.fullmatch(r'Optional\[(.*)\]', annotation):
        return kind_of(match[1]) + ' or None'
    if match := re.fullmatch(r'List\[(.*)\]', annotation):
        return 'a list of ' + PLURALS.get(match[1], match[1])
    return KINDS.get(annotation, (annotation,))[0]


def fits(annotation, value):
    """Whether the value may be what pybind11 wants there."""
    if match := re.fullmatch(r'Optional\[(.*)\]', annotation):
        return value is None or fits(match[1], value)
    if match := re.fullmatch(r'List\[(.*)\]', annotation):
        return not isinstance(value, (str, bytes)) and hasattr(value, '__iter__') and all(fits(match[1], v) for v in value)
    classes = KINDS.get(annotation, ('', ()))[1]
    return annotation.split('.')[-1] == type(value).__name__ or (isinstance(value, classes) if classes else annotation not in KINDS)


def parameters_of(signature):
    """Name, type and whether there is a default, of "load(path: os.PathLike, unit: str = '') -> World"; True when keywords may follow."""
    inside = signature[signature.index('(') + 1:signature.rindex(')', 0, signature.rindex('->'))]
    parts = re.findall(r'(\*\*\w+|\w+): ?([\w.]+(?:\[[\w., \[\]]*\])?)( = )?|(\*\*\w+)', inside)
    return [(name, kind, bool(default)) for name, kind, default, _ in parts if name], any(more for *_, more in parts)


def fault(name, signature, args, keywords):
    """What is wrong with a call, in a sentence."""
    parameters, takes_more = parameters_of(signature)
    names = [n for n, _, _ in parameters]
    own = 1 if names[:1] == ['self'] else 0
    if len(args) > len(parameters):
        most = len(parameters) - own
        return f'{name}() takes no arguments' if most == 0 else f'{name}() takes at most {most} arguments by position, not {len(args) - own}'
    given = dict(zip(names, args))
    for keyword, value in keywords.items():
        if keyword in given:
            return f"{name}(): '{keyword}' is given twice"
        if keyword not in names and not takes_more:
            near = difflib.get_close_matches(keyword, names, 1)
            return f"{name}() has no parameter '{keyword}'" + (f"; did you mean '{near[0]}'?" if near else f"; it has {', '.join(names[own:])}")
        given[keyword] = value
    for parameter, kind, has_default in parameters:
        if parameter not in given:
            if not has_default:
                return f"{name}() needs '{parameter}': {kind_of(kind)}"
        elif not fits(kind, given[parameter]):
            return f"{name}(): '{parameter}' should be {kind_of(kind)}, not {shown(given[parameter])}"
    return f'{name}(): wrong arguments; see help(wrlkit.{name})'


def explained(function, name):
    """The function, with such errors."""
    signature = (function.__doc__ or '').partition('\n')[0]

    @functools.wraps(function)
    def call(*args, **keywords):
        try:
            return function(*args, **keywords)
        except TypeError as raw:
            if RAW not in str(raw):
                raise
        raise TypeError(fault(name, signature, args, keywords))
    return call


def renamed(function, name):
    """A function that has such errors, with errors that speak of another one, which calls it."""
    return explained(function.__wrapped__, name)


def explain_field(node, operator):
    """An operator of nodes, with an error for what is no name of a field."""
    function = getattr(node, operator)

    @functools.wraps(function)
    def call(self, name, *value):
        if not isinstance(name, str):
            raise TypeError(f'{node.__name__}[...]: the name of a field is expected, a str, not {shown(name)}')
        return function(self, name, *value)
    setattr(node, operator, call)


def explain(*owners):
    """Gives all functions of modules and classes such errors."""
    for owner in owners:
        for name, function in list(vars(owner).items()):
            if inspect.isroutine(function) and not name.startswith('_'):
                label = f'{owner.__name__}.{name}' if inspect.isclass(owner) else name
                setattr(owner, name, explained(function, label))
            elif name in ('__getitem__', '__setitem__'):
                explain_field(owner, name)
