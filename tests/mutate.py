#!/usr/bin/env python3
"""Breaks the files of a corpus in ways that disks, mail and people do, and shows that no verb crashes, hangs or leaves half a file.

  tests/mutate.py --wrlkit build/release/wrlkit                 30 files of corpus/, one mutation of each kind
  tests/mutate.py --wrlkit ... --found --files 0 --each 20      every file of ../shared/corpus, 20 of each kind: hours
  tests/mutate.py --wrlkit ... --seed 7 --keep DIR              other mutations; files that break a promise are kept there

Kinds: cut (the end is missing), flip (20 bytes changed), brackets (one deleted), numbers (one made extreme), swap (the halves change
places), splice (the beginning of one file and the end of another). Each mutant goes through one verb, chosen by chance as well, in 10
processor seconds and 1 GB of address space. It breaks a promise when the verb ends by a signal, takes longer, ends with another
exit code than 0, 1 or 3, or leaves an output that is not whole.
"""
import argparse
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
import gzip
import os
from pathlib import Path
import random
import re
import resource
import shutil
import struct
import subprocess
import sys
import tempfile
import time

ROOT = Path(__file__).resolve().parents[1]
ENDINGS = ('.wrl', '.wrz', '.iv', '.x3d', '.x3dv', '.gltf', '.glb', '.gz', '.vrml')
LARGEST = 1 << 20     # bytes of a file that is mutated
SECONDS = 10          # of the processor
MEMORY = 1 << 30      # of address space
PATIENCE = 20         # times as much on the clock, for machines that are busy
EXTREMES = [b'1e39', b'-1e309', b'nan', b'4294967296', b'-2147483648', b'1e-320', b'99999999999999999999', b'0', b'-0.0', b'2000000000']
VERBS = {
    'glb': ['convert', 'IN', 'OUT.glb'],
    'wrl': ['convert', 'IN', 'OUT.wrl'],
    'x3d': ['convert', 'IN', 'OUT.x3d'],
    'lod': ['convert', 'IN', 'OUT.glb', '-p', 'weld,lod'],
    'lightmap': ['convert', 'IN', 'OUT.glb', '-p', 'lightmap{quality=draft,density=1,max-size=64}'],
    'optimize': ['optimize', 'IN', 'OUT.glb'],
    'recognise': ['optimize', 'IN', 'OUT.glb', '--recognise', '--profile', 'cesium'],
    'tiles': ['tiles', 'IN', '-o', 'OUT.tiles'],
    'info': ['info', 'IN'],
}


def cut(data, rng, _):
    return data[:rng.randrange(len(data))]


def flip(data, rng, _):
    out = bytearray(data)
    for _ in range(20):
        out[rng.randrange(len(out))] = rng.randrange(256)
    return bytes(out)


def delete_bracket(data, rng, _):
    places = [i for i, byte in enumerate(data) if byte in b'[]{}<>()"']
    at = rng.choice(places) if places else rng.randrange(len(data))
    return data[:at] + data[at + 1:]


def extreme_number(data, rng, _):
    numbers = list(re.finditer(rb'-?\d+(\.\d*)?', data))
    if not numbers:
        return cut(data, rng, _)
    number = rng.choice(numbers)
    return data[:number.start()] + rng.choice(EXTREMES) + data[number.end():]


def swap(data, rng, _):
    at = rng.randrange(len(data))
    return data[at:] + data[:at]


def splice(data, rng, other):
    return data[:rng.randrange(len(data))] + other[rng.randrange(len(other)):]


KINDS = {'cut': cut, 'flip': flip, 'brackets': delete_bracket, 'numbers': extreme_number, 'swap': swap, 'splice': splice}


@dataclass
class Result:
    fault: str
    seconds: float
    code: int


def plain(path):
    """The bytes of a file, unpacked."""
    data = path.read_bytes()
    try:
        return gzip.decompress(data) if data.startswith(b'\x1f\x8b') else data
    except (OSError, EOFError):
        return data


def is_whole(path):
    data = path.read_bytes()
    if path.suffix == '.glb':
        return len(data) >= 12 and struct.unpack('<4sII', data[:12]) == (b'glTF', 2, len(data))
    if path.suffix == '.x3d':
        return data.rstrip().endswith(b'</X3D>')
    return data.startswith(b'#VRML V2.0 utf8')


def limited():
    resource.setrlimit(resource.RLIMIT_CPU, (SECONDS, SECONDS + 1))
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def run(wrlkit, mutant, verb, folder):
    words = [str(mutant) if w == 'IN' else str(folder / w) if w.startswith('OUT') else w for w in VERBS[verb]]
    began = time.monotonic()
    try:
        code = subprocess.run([wrlkit, *words, '-q', '--jobs', '1'], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, preexec_fn=limited,
                              timeout=SECONDS * PATIENCE).returncode
    except subprocess.TimeoutExpired:
        code = None
    seconds = time.monotonic() - began
    fault = ''
    if code is None or code < 0:
        fault = 'no end' if code in (None, -24, -9) else f'signal {-code}'
    elif code not in (0, 1, 3):
        fault = f'exit code {code}'
    for left in folder.iterdir():
        if left == mutant or not left.is_file():
            continue
        if not left.name.startswith('OUT') or code == 3 or not is_whole(left):
            fault = fault or f'half a file: {left.name}'
    return Result(fault, seconds, code)


def files_of(folder, n, rng):
    files = [f for f in sorted(folder.rglob('*')) if f.name.lower().endswith(ENDINGS) and f.is_file() and 0 < f.stat().st_size <= LARGEST]
    return files if n == 0 or n >= len(files) else rng.sample(files, n)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--wrlkit', required=True)
    parser.add_argument('--found', action='store_true')
    parser.add_argument('--files', type=int, default=30, help='that many, by chance; 0: all')
    parser.add_argument('--each', type=int, default=1, help='mutations of each kind of each file')
    parser.add_argument('--all-verbs', action='store_true', help='each mutant through every verb')
    parser.add_argument('--seed', type=int, default=1)
    parser.add_argument('--jobs', type=int, default=os.cpu_count())
    parser.add_argument('--keep', type=Path)
    options = parser.parse_args()
    wrlkit = os.path.abspath(options.wrlkit)
    folder = ROOT.parent / 'shared/corpus' if options.found else ROOT / 'corpus'
    if not folder.is_dir():
        print(f'skipped: there is no {folder}')
        return 77
    files = files_of(folder, options.files, random.Random(options.seed))

    def judge(task):
        path, kind, turn = task
        rng = random.Random(f'{options.seed} {path.relative_to(folder)} {kind} {turn}')
        data = KINDS[kind](plain(path), rng, plain(rng.choice(files)))
        verbs = list(VERBS) if options.all_verbs else [rng.choice(list(VERBS))]
        out = []
        for verb in verbs:
            with tempfile.TemporaryDirectory() as place:
                mutant = Path(place) / ('mutant' + (path.suffix if path.suffix != '.gz' else '.wrl'))
                mutant.write_bytes(data)
                result = run(wrlkit, mutant, verb, Path(place))
                if result.fault and options.keep:
                    options.keep.mkdir(parents=True, exist_ok=True)
                    shutil.copy(mutant, options.keep / f'{path.stem}.{kind}.{turn}.{verb}{mutant.suffix}')
            out.append((verb, result))
        return path, kind, turn, out

    tasks = [(f, kind, turn) for f in files for kind in KINDS for turn in range(options.each)]
    faults, codes, slowest = [], Counter(), []
    with ThreadPoolExecutor(options.jobs) as pool:
        for path, kind, turn, results in pool.map(judge, tasks):
            for verb, result in results:
                codes[result.code] += 1
                slowest = sorted([*slowest, (result.seconds, f'{path.name} {kind} {turn} {verb}')], reverse=True)[:3]
                if result.fault:
                    faults.append(f'{path.relative_to(folder)} {kind} {turn} {verb}: {result.fault}')
    print(f'{sum(codes.values())} runs of mutants of {len(files)} files, seed {options.seed}: ' +
          ', '.join(f'{n} with exit code {code}' for code, n in sorted(codes.items(), key=str)))
    print('slowest: ' + ', '.join(f'{seconds:.1f} s {what}' for seconds, what in slowest))
    for fault in faults:
        print(fault)
    return 1 if faults else 0


if __name__ == '__main__':
    sys.exit(main())
