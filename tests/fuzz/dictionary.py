#!/usr/bin/env python3
"""A dictionary for libFuzzer from the node table: every node, field and word of VRML97, and what its grammar is made of.

  tests/fuzz/dictionary.py scenegraph/nodes/vrml97.nodes vrml97.dict
"""
from pathlib import Path
import re
import sys

GRAMMAR = ['#VRML V2.0 utf8\n', 'DEF ', 'USE ', 'PROTO ', 'EXTERNPROTO ', 'ROUTE ', ' TO ', ' IS ', 'NULL', 'TRUE', 'FALSE',
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
    source, target = map(Path, sys.argv[1:])
    entries = dict.fromkeys([*GRAMMAR, *words(source.read_text(encoding='utf-8'))])
    escaped = (e.replace('\\', '\\\\').replace('"', '\\"').replace('\n', '\\x0a') for e in entries)
    target.write_text(''.join(f'"{e}"\n' for e in escaped), encoding='utf-8')


if __name__ == '__main__':
    main()
