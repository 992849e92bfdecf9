#!/usr/bin/env python3
"""Dictionaries for libFuzzer: of worlds, every node, field and word of the node table and what their grammars are made
of; of pipelines and recipes, every pass and option.

  tests/fuzz/dictionary.py scenegraph/nodes/vrml97.nodes scenegraph/nodes/vrml1.nodes vrml.dict
  tests/fuzz/dictionary.py passes passes.dict
"""
from pathlib import Path
import re
import sys

GRAMMAR = ['#VRML V2.0 utf8\n', '#VRML V1.0 ascii\n', '#Inventor V2.1 ascii\n', '#X3D V3.3 utf8\n', 'fields [ SFFloat a ]',
           'isA [ "Cube" ]', ' ~', ' = ', '(A | B)', 'DEF ', 'USE ', 'PROTO ', 'EXTERNPROTO ', 'ROUTE ', ' TO ', ' IS ',
           'IMPORT ', 'EXPORT ', ' AS ', 'NULL', 'TRUE', 'FALSE', 'field ', 'exposedField ', 'eventIn ', 'eventOut ', '{ ',
           ' }', '[ ', ' ]', '"', '\\"', '#', '-1', '1e9', '0x7f', 'nan', '2147483647', '-2147483648', '1e308', 'set_',
           '_changed', '.', ',']
PIPELINES = ['{', '}', '=', ',', '"', '\\"', 'true', 'false', 'auto', '0.5', '[[pass]]\nname = "', '[input]\n', '[output]\n',
             '[limits]\n', '[messages]\n', 'pipeline = "', 'summary = "', 'python = [', 'unit = "mm"', 'strict = true',
             'error = ["', 'timeout = "2m"', 'memory = "4G"']


def words_of_nodes(table):
    for line in table.splitlines():
        parts = line.split('--')[0].split()
        if not parts or parts[0] not in ('node', 'init', 'inout', 'in', 'out'):
            continue
        if parts[0] == 'node':
            yield f'{parts[1]} {{ }}'
        else:
            yield parts[1] + ' '
            yield (re.findall(r'vrml97=(\w+)', line) or [parts[2]])[0] + ' '


def words_of_passes(folder):
    for header in sorted(folder.glob('*/*.h')):
        yield from re.findall(r'\bf\("([\w-]+)"', header.read_text(encoding='utf-8'))
    yield from re.findall(r'^    (?:pass<.*?>\(|\{)"([\w-]+)"',
                          (folder / 'pipeline/registry.cpp').read_text(encoding='utf-8'), re.M)


def main():
    *sources, target = map(Path, sys.argv[1:])
    words = [*PIPELINES, *words_of_passes(sources[0])] if sources[0].is_dir() else \
        [*GRAMMAR, *(w for source in sources for w in words_of_nodes(source.read_text(encoding='utf-8')))]
    escaped = (e.replace('\\', '\\\\').replace('"', '\\"').replace('\n', '\\x0a') for e in dict.fromkeys(words))
    target.write_text(''.join(f'"{e}"\n' for e in escaped), encoding='utf-8')


if __name__ == '__main__':
    main()
