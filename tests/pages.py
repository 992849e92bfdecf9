#!/usr/bin/env python3
"""Runs what the pages for people show: every command of README.md, docs/examples.md and docs/tutorials, in an empty folder.

  tests/pages.py --wrlkit build/release/wrlkit                  all pages
  tests/pages.py --wrlkit ... docs/examples.md                  one
  tests/pages.py --wrlkit ... --update docs/examples.md         writes what is printed today into the page

In a block, a line that begins with '$ ' is a command for bash; what follows, up to the next one, is what it prints on both outputs. '...'
stands for any text in a line, a line of '...' for any lines; a command without output may print anything. `$ cat FILE` makes the
file, where there is none yet. A command has to end with exit code 0 or 1. `corpus/` is that of the project; plant.wrl, archive/
and tags.csv, which the pages speak of, are made before.
"""
import argparse
import os
from pathlib import Path
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = Path(__file__).resolve().parents[1]
PROGRESS = re.compile(r'\S.*, \d+ s( left)?')  # on a slow machine
BLOCK = re.compile(r'^```\n(\$ .*?)^```$', re.M | re.S)


def commands_of(block):
    """Pairs of a command and the lines that follow it."""
    out = []
    for line in block.splitlines():
        if line.startswith('$ '):
            out.append((line[2:], []))
        else:
            out[-1][1].append(line)
    return out


def matches(shown, printed):
    """Whether the lines are those, where '...' stands for any; how wide blanks are does not matter."""
    pattern = ''
    shown, printed = ([' '.join(line.split()) for line in lines] for lines in (shown, printed))
    for line in shown:
        pattern += r'(?:.*\n)*?' if line == '...' else re.escape(line).replace(r'\.\.\.', '.*') + r'\n'
    return re.fullmatch(pattern, ''.join(line + '\n' for line in printed)) is not None


def prepare(folder, wrlkit):
    (folder / 'corpus').symlink_to(ROOT / 'corpus')
    (folder / 'bin').mkdir()
    (folder / 'bin/wrlkit').symlink_to(wrlkit)
    plant = ROOT / 'corpus/plant/pump_room_primitives.wrl'
    shutil.copy(plant, folder / 'plant.wrl')
    shutil.copytree(ROOT / 'corpus/plant/textures', folder / 'textures')
    shutil.copytree(ROOT / 'corpus/plant', folder / 'archive')
    shutil.copy(ROOT / 'python/examples/rename_tags.py', folder)
    (folder / 'tags.csv').write_text('old,new\nTank_1,T-101\n')


def run_page(page, wrlkit, update):
    text = page.read_text()
    faults = []
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        prepare(folder, wrlkit)
        environment = {**os.environ, 'PATH': f'{folder}/bin:{os.environ["PATH"]}', 'COLUMNS': '100'}

        def run(block):
            lines = []
            for command, shown in commands_of(block.group(1)):
                lines.append('$ ' + command)
                file = re.fullmatch(r'cat (\S+)', command)
                if file and not (folder / file[1]).exists():
                    (folder / file[1]).write_text('\n'.join(shown) + '\n')
                done = subprocess.run(['bash', '-c', command], cwd=folder, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                      text=True, errors='replace', timeout=1200)
                printed = [line for line in done.stdout.splitlines() if not PROGRESS.fullmatch(line)]
                if done.returncode not in (0, 1):
                    faults.append(f'{command}\n  exit code {done.returncode}: {done.stdout[:400]}')
                elif shown and not matches(shown, printed):
                    faults.append(f'{command}\n  prints\n' + '\n'.join('    ' + line for line in printed[:40]))
                    shown = printed if update else shown
                lines += shown
            return '```\n' + '\n'.join(lines) + '\n```'

        after = BLOCK.sub(run, text)
    if update and after != text:
        page.write_text(after)
    return faults


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--wrlkit', required=True)
    parser.add_argument('--update', action='store_true')
    parser.add_argument('pages', nargs='*', type=Path)
    options = parser.parse_args()
    wrlkit = os.path.abspath(options.wrlkit)
    pages = options.pages or [ROOT / 'README.md', ROOT / 'docs/examples.md', *sorted((ROOT / 'docs/tutorials').glob('*.md'))]
    n = 0
    for page in pages:
        for fault in run_page(page, wrlkit, options.update):
            print(f'{page}: {fault}')
            n += 1
    print(f'{len(pages)} pages, {n} commands that do not do what the page shows')
    return 1 if n else 0


if __name__ == '__main__':
    sys.exit(main())
