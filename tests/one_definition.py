#!/usr/bin/env python3
"""One name, one type: no class of a namespace that has a name is defined twice in the program (the one-definition rule, which
no compiler checks across files).

  tests/one_definition.py [FOLDER ...]     sources below these; all of the project's own when none is given
"""
import collections, pathlib, re, sys

root = pathlib.Path(__file__).resolve().parents[1]
folders = [pathlib.Path(f) for f in sys.argv[1:]] or [
    root / f for f in ('base', 'scenegraph', 'geometry', 'light', 'parsers', 'writers', 'passes', 'convert', 'tools')]
comment_or_text = re.compile(r'//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])\'', re.S)
token = re.compile(r'\bnamespace(?:\s+([\w:]+))?\s*\{|\b(?:class|struct|union|enum(?:\s+class)?)\s+((?:\w+::)*\w+)(?:\s+final)?\s*(?::[^;{}()=]*)?\{|([{}])')


def definitions(text):
    """Names of types of namespaces with a name, as wrlkit::light::World."""
    scopes = []  # a name; None: not a namespace; '': one without a name
    for m in token.finditer(comment_or_text.sub(' ', text)):
        if m[3] == '}':
            scopes and scopes.pop()
        elif m[3]:
            scopes.append(None)
        elif m[2]:
            if all(scopes):
                yield '::'.join([*scopes, m[2]])
            scopes.append(None)
        else:
            scopes.append(m[1] or '')


where = collections.defaultdict(set)
for folder in folders:
    for path in sorted(folder.rglob('*')):
        if path.suffix in ('.h', '.cpp'):
            for name in definitions(path.read_text()):
                where[name].add(str(path))
twice = {name: paths for name, paths in where.items() if len(paths) > 1}
for name, paths in sorted(twice.items()):
    print(f'{name} is defined in {" and in ".join(sorted(paths))}')
print(f'{len(where)} types')
sys.exit(bool(twice) or not where)
