#!/usr/bin/env python3
"""A dictionary for libFuzzer from the node table: every node, field and word of VRML97 and VRML 1.0, and what
their grammars are made of.

  tests/fuzz/dictionary.py scenegraph/nodes/vrml97.nodes scenegraph/nodes/vrml1.nodes vrml.dict
"""
from pathlib import Path
import re
import sys

GRAMMAR = ['#VRML V2.0 utf8\n', '#VRML V1.0 ascii\n', '#Inventor V2.1 ascii\n', 'fields [ SFFloat a ]', 'isA [ "Cube" ]', ' ~', ' = ', '(A | B)', 'DEF ', 'USE ', 'PROTO ', 'EXTERNPROTO ', 'ROUTE ', ' TO ', ' IS ', 'NULL', 'TRUE', 'FALSE',
           'field ', 'exposedField ', 'eventIn ', 'eventOut ', '{ ', ' }', '[ ', ' ]', '"', '\\"', '#', '-1', '1e9', '0x7f',
           'nan', '2147483647', '-2147483648', '1e308', 'set_', '_changed', '.', ',']


def words(table):
    for line in table.splitlines():
        parts = line.split('--')[0].split()
        if not parts or parts[0] not in ('node', 'init', 'inout', 'in', 'out'):
            continue
        if parts[0] == 'node':
            yield f'{parts[1]} {{ }}'
        else:
            yield parts[1] + ' '
            yield (re.findall(r'vrml97=(\w+)', line) or [parts[2]])[0] + ' '


def main():
    *sources, target = map(Path, sys.argv[1:])
    entries = dict.fromkeys([*GRAMMAR, *(w for source in sources for w in words(source.read_text(encoding='utf-8')))])
    escaped = (e.replace('\\', '\\\\').replace('"', '\\"').replace('\n', '\\x0a') for e in entries)
    target.write_text(''.join(f'"{e}"\n' for e in escaped), encoding='utf-8')


if __name__ == '__main__':
    main()
