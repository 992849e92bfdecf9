#!/usr/bin/env python3
"""Names the lines of C++ sources with more than 120 columns; fails when there are some.

  script/long_lines.py FILE...

Left out are lines of raw strings and of one string literal: other languages, and bytes of a file.
"""
import re
import sys

COLUMNS = 120
RAW_BEGIN = re.compile(r'R"(\w*)\(')


def long_lines(path):
    end = None  # of the raw string that the line is in
    for number, line in enumerate(open(path, encoding='utf-8').read().split('\n'), 1):
        in_raw = end is not None
        rest = line
        while True:
            if end is None:
                if not (found := RAW_BEGIN.search(rest)):
                    break
                in_raw, end, rest = True, f'){found[1]}"', rest[found.end():]
            elif end in rest:
                rest, end = rest.split(end, 1)[1], None
            else:
                break
        if len(line) > COLUMNS and not in_raw and not re.fullmatch(r'\s*"([^"\\]|\\.)*"s?[;,)]*', line):
            yield number, len(line)


faults = [f'{path}:{number}: {length} columns' for path in sys.argv[1:] for number, length in long_lines(path)]
print('\n'.join(faults))
sys.exit(bool(faults))
