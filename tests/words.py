#!/usr/bin/env python3
"""Phrases that read as translated German stand in nothing that users read: pages, messages, help texts, Python docstrings.

  tests/words.py
"""
import pathlib, re, sys

root = pathlib.Path(__file__).resolve().parents[1]
banned = {  # what it should be
    r'as a rule': 'usually; the default',
    r'is no (word|world|name|size|length)': 'is not a valid ...',
    r'so many': 'N, this many',
    r'anew': 'again',
    r'beside': 'next to',
    r'(is|are|was|were) (told|said)': 'reported',
    r'g(oes|one) on with': 'continues',
    r'does without': 'has none',
}
pattern = re.compile(rf"\b({'|'.join(banned)})\b", re.IGNORECASE)
text = re.compile(r'"((?:[^"\\]|\\.)*)"')
quoted = {'.cpp', '.h', '.def', '.ts'}  # only strings are read by users, comments are not
left_out = {'base/text/json_reader.cpp', 'parsers/gltf/accessors.cpp',  # "so many" is a demonstrative there
            'docs/nodes.md'}  # not looked at yet: made of scenegraph/nodes


def sources():
    yield from (root / name for name in ('README.md', 'CHANGELOG.md', 'SECURITY.md', 'base/diagnostics.def'))
    yield from sorted((root / 'docs').rglob('*.md'))
    for folder in ('base', 'scenegraph', 'geometry', 'light', 'parsers', 'writers', 'passes', 'convert', 'tools', 'python', 'viewer/src'):
        yield from (p for p in sorted((root / folder).rglob('*')) if p.suffix in quoted)


def read_by_users(path, line):
    return ' '.join(text.findall(line)) if path.suffix in quoted else line


def faults():
    for path in dict.fromkeys(sources()):
        if str(path.relative_to(root)) in left_out:
            continue
        for number, line in enumerate(path.read_text().splitlines(), 1):
            for found in pattern.findall(read_by_users(path, line)):
                phrase = found[0].lower()
                better = next(b for p, b in banned.items() if re.fullmatch(p, phrase))
                yield f"{path.relative_to(root)}:{number}: '{phrase}': {better}"


found = list(faults())
print('\n'.join(found))
sys.exit(1 if found else 0)
