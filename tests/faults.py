#!/usr/bin/env python3
"""What a machine does to a run: full and read-only disks, signals at any moment, little memory, pipes that close or come in pieces,
files that change while they are read, two runs at once, names of any bytes.

  tests/faults.py --wrlkit build/release/wrlkit [NAME...]      NAME: only these cases

Each case: the program ends by itself with exit code 0, 1 or 3 and one line for what failed (or by the signal that was sent to it),
an output is either whole or as it was before, and nothing else is left next to it. Disks are file systems in memory, which takes a
mount namespace; where there is none these cases are skipped.
"""
import argparse
import os
from pathlib import Path
import random
import resource
import signal
import subprocess
import sys
import tempfile
import time

ROOT = Path(__file__).resolve().parents[1]
ROOM = ROOT / 'corpus/plant/pump_room_loose.wrl'
BOX = ROOT / 'tests/text/cli/inputs/box.wrl'


class Fault(Exception):
    pass


def require(good, *what):
    if not good:
        raise Fault(' '.join(map(str, what)))


class Runs:
    """The program, and what it should write."""

    def __init__(self, wrlkit, folder):
        self.wrlkit, self.folder = str(wrlkit), folder
        self.whole = folder / 'whole.glb'
        self.run('convert', ROOM, self.whole)

    def run(self, *words, **more):
        return subprocess.run([self.wrlkit, *map(str, words), '-q'], capture_output=True, timeout=300, check=False, **more)

    def ends(self, done, *codes):
        """One of the exit codes, and one line on the error output where it is not 0."""
        text = done.stderr.decode(errors='replace')
        require(done.returncode in codes, 'exit code', done.returncode, text)
        require(done.returncode != 3 or text.count('error') == 1, 'messages:', text)

    def all_or_nothing(self, out, before=None):
        """The output is whole, or as it was; there is nothing else in its folder."""
        require([p for p in out.parent.iterdir() if p != out] == [], 'left behind:', list(out.parent.iterdir()))
        if out.exists():
            contents = out.read_bytes()
            require(contents in (self.whole.read_bytes(), before), 'half a file of', len(contents))


def on_disk(runs, options, words, prepare=''):
    """The verb in a namespace whose folder disk/ is a file system in memory with those options."""
    disk = runs.folder / 'disk'
    disk.mkdir(exist_ok=True)
    script = f'mount -t tmpfs -o size=64k tmpfs "$0" && cd "$0" && {prepare or ":"} && mount -o remount,{options} "$0" && "$@"; code=$?; ' \
             'ls -A "$0" >&2; cat "$0/out.glb" >&2; exit $code'
    return subprocess.run(['unshare', '--mount', 'bash', '-c', script, disk, runs.wrlkit, *map(str, words)], capture_output=True, check=False)


def disks(runs):
    """A disk that is full, and one that is read-only: exit code 3, what was there stays."""
    probe = subprocess.run(['unshare', '--mount', 'mount', '-t', 'tmpfs', 'tmpfs', runs.folder], capture_output=True, check=False)
    if probe.returncode != 0:
        return 'skipped: there are no mount namespaces'
    out = runs.folder / 'disk/out.glb'
    for options in 'size=64k', 'ro':
        done = on_disk(runs, options, ['convert', '-q', ROOM, out], 'echo before > out.glb')
        lines = done.stderr.decode().splitlines()
        require(done.returncode == 3, options, done.returncode, lines)
        require(lines[-2:] == ['out.glb', 'before'] and sum('error' in line for line in lines) == 1, options, lines)
    return ''


def signals(runs):
    """SIGINT, SIGTERM and SIGKILL at random moments: the output is not there, or as it was, or whole. Only where SIGKILL comes between two
    system calls, one that names the new file and one that puts it in the place of another, is a whole file left that is called .tmp."""
    chance = random.Random(1)
    start = time.monotonic()
    runs.run('convert', ROOM, runs.folder / 'whole.glb')
    usual = time.monotonic() - start
    for i in range(50):
        folder = runs.folder / f'signal{i}'
        folder.mkdir()
        out, before = folder / 'out.glb', b'before' if i % 2 else None
        if before:
            out.write_bytes(before)
        which = (signal.SIGINT, signal.SIGTERM, signal.SIGKILL)[i % 3]
        process = subprocess.Popen([runs.wrlkit, 'convert', '-q', ROOM, out], stderr=subprocess.DEVNULL)
        time.sleep(chance.random() * 1.2 * usual)
        process.send_signal(which)
        code = process.wait()
        require(code in (0, -which), 'ended with', code, 'after', which.name)
        for left in folder.glob('.wrlkit-*.tmp') if before and which == signal.SIGKILL else ():
            require(left.read_bytes() == runs.whole.read_bytes(), 'half a temporary file')
            left.unlink()
        runs.all_or_nothing(out, before)
    return ''


def memory(runs):
    """Address space from 16 MB on, in ten sizes: out of memory is reported in one line."""
    good = 0
    for size in (16, 24, 32, 48, 64, 96, 128, 192, 256, 512):
        folder = runs.folder / f'memory{size}'
        folder.mkdir()
        limit = lambda: resource.setrlimit(resource.RLIMIT_AS, (size << 20, size << 20))
        done = runs.run('convert', ROOM, folder / 'out.glb', '--jobs', 1, preexec_fn=limit)
        if done.returncode == 127 and b'loading shared libraries' in done.stderr:
            continue  # the program itself has no room
        runs.ends(done, 0, 3)
        runs.all_or_nothing(folder / 'out.glb')
        good += done.returncode == 0
    require(good > 0, 'never enough memory')
    return ''


def pipes(runs):
    """Standard input that comes in pieces, and standard output that closes."""
    folder = runs.folder / 'pipes'
    folder.mkdir()
    text = ROOM.read_bytes()
    process = subprocess.Popen([runs.wrlkit, 'convert', '-q', '-', folder / 'out.glb'], stdin=subprocess.PIPE, cwd=ROOM.parent)
    for i in range(0, len(text), 99_991):
        process.stdin.write(text[i:i + 99_991])
        process.stdin.flush()
        time.sleep(0.01)
    process.stdin.close()
    require(process.wait() == 0, 'pieces: exit code', process.returncode)
    require((folder / 'out.glb').read_bytes() == runs.whole.read_bytes(), 'pieces: other bytes')
    process = subprocess.Popen([runs.wrlkit, 'cat', '-q', ROOM], stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    process.stdout.read(100)
    process.stdout.close()
    text = process.stderr.read()
    code = process.wait()
    require(code in (3, -signal.SIGPIPE) and text.count(b'\n') <= 1, 'closed:', code, text)
    return ''


def changed(runs):
    """A file that is cut or replaced while it is read: what was read is used, or the file is given up; no crash."""
    text = ROOM.read_bytes()
    large = text + text[text.index(b'\n'):] * (24 * 2**20 // len(text))  # such are mapped
    chance = random.Random(2)
    for i in range(20):
        folder = runs.folder / f'changed{i}'
        folder.mkdir()
        world = runs.folder / f'changed{i}.wrl'
        world.write_bytes(large if i % 4 > 1 else text)
        process = subprocess.Popen([runs.wrlkit, 'convert', '-q', world, folder / 'out.glb'], stderr=subprocess.DEVNULL)
        time.sleep(chance.random() * (0.3 if i % 4 > 1 else 0.05))
        if i % 2:
            os.truncate(world, 0)
        else:
            world.write_bytes(text[:1000])
        code = process.wait()
        require(code in (0, 1, 3), 'ended with', code)
        world.unlink()
        require([p.name for p in folder.iterdir()] in ([], ['out.glb']), 'left behind', list(folder.iterdir()))
    return ''


def together(runs):
    """Two runs that write the same file: it is whole."""
    folder = runs.folder / 'together'
    folder.mkdir()
    out = folder / 'out.glb'
    for _ in range(5):
        both = [subprocess.Popen([runs.wrlkit, 'convert', '-q', ROOM, out]) for _ in range(2)]
        require([p.wait() for p in both] == [0, 0], 'exit codes', [p.returncode for p in both])
        require(out.exists(), 'no output')
        runs.all_or_nothing(out)
    return ''


def names(runs):
    """Names that are not UTF-8, that begin with a dash, that have line ends and quotes."""
    for name in (b'\xff\xfe', b'-dash', b'new\nline', b'quo"te\'s', b'a b', b'%41', 'Ünïcödé'.encode()):
        folder = os.fsencode(runs.folder) + b'/names' + name
        os.mkdir(folder)
        world = folder + b'/' + name + b'.wrl'
        Path(os.fsdecode(world)).write_bytes(BOX.read_bytes())
        for ending in b'.glb', b'.gltf', b'.wrl', b'.x3d':
            out = folder + b'/out' + name + ending
            done = subprocess.run([os.fsencode(runs.wrlkit), b'convert', b'-q', world, out], capture_output=True, check=False)
            require(done.returncode == 0, name, ending, done.stderr)
            again = subprocess.run([os.fsencode(runs.wrlkit), b'info', b'--json', out], capture_output=True, check=False)
            require(again.returncode == 0 and b'"triangles"' in again.stdout, name, ending, again.stderr)
    return ''


CASES = (disks, signals, memory, pipes, changed, together, names)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument('--wrlkit', required=True, type=Path)
    parser.add_argument('cases', nargs='*')
    options = parser.parse_args()
    failed = 0
    with tempfile.TemporaryDirectory() as folder:
        runs = Runs(options.wrlkit.resolve(), Path(folder))
        for case in CASES:
            if options.cases and case.__name__ not in options.cases:
                continue
            start = time.monotonic()
            try:
                result = case(runs) or 'ok'
            except Fault as fault:
                result = f'FAILED: {fault}'
                failed += 1
            print(f'{case.__name__:10} {time.monotonic() - start:5.1f} s  {result}', flush=True)
    sys.exit(1 if failed else 0)


if __name__ == '__main__':
    main()
