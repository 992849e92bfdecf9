"""Costs of whole processes, and the worlds they are measured on."""
import dataclasses
import os
import pathlib
import statistics
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
SHARED = pathlib.Path(os.environ.get('WRLKIT_SHARED', ROOT.parent / 'shared'))
BUILD = ROOT / 'build' / 'bench'
DATA = BUILD / 'data'
WRLKIT = BUILD / 'wrlkit'
PROGRAMS = BUILD / 'bench'


@dataclasses.dataclass
class Cost:
    """Medians of runs: CPU seconds (user and system, with all children), wall seconds; the largest peak in MB."""
    cpu: float
    wall: float
    peak: float


@dataclasses.dataclass
class Row:
    """A line of the page: what was done, the ratio to a bound that is measured in the same run, and what is asked."""
    group: str
    work: str
    ratio: float
    bound: str
    figures: str
    command: str
    reach: float | None = None
    better: str = 'less'  # or 'more'
    wall: bool = False    # of wall time, which means nothing on a busy machine

    def holds(self):
        return self.reach is None or (self.ratio <= self.reach if self.better == 'less' else self.ratio >= self.reach)


@dataclasses.dataclass
class Table:
    """More figures of a group, for those who want them."""
    title: str
    head: list
    rows: list
    plot: dict | None = None


def once(command, timeout=None, **more):
    """(exit code, Cost) of one run; the code is None when it took too long."""
    before = time.monotonic()
    out = subprocess.DEVNULL
    process = subprocess.Popen([str(c) for c in command], stdin=out, stdout=out, stderr=out, start_new_session=True, **more)
    while True:
        pid, status, usage = os.wait4(process.pid, os.WNOHANG if timeout else 0)
        if pid:
            break
        if time.monotonic() - before > timeout:
            os.killpg(process.pid, 9)
            os.wait4(process.pid, 0)
            process.returncode = -9
            return None, None
        time.sleep(0.01)
    process.returncode = os.waitstatus_to_exitcode(status)
    cost = Cost(usage.ru_utime + usage.ru_stime, time.monotonic() - before, usage.ru_maxrss / 1024)
    return process.returncode, cost


def middle(costs):
    of = lambda pick, name: pick(getattr(c, name) for c in costs)
    return Cost(of(statistics.median, 'cpu'), of(statistics.median, 'wall'), of(max, 'peak'))


def cost(command, runs):
    """Cost of a command; None when it fails."""
    costs = []
    for _ in range(runs):
        code, one = once(command)
        if code not in (0, 1):
            return None
        costs.append(one)
    return middle(costs)


def in_turn(commands, runs=5):
    """Cost of each of some commands, by name. They run in turn, so that a machine that slows down slows all of them;
    one round before is not counted. A command that fails ends the measurement."""
    costs = {name: [] for name in commands}
    for i in range(runs + 1):
        for name, command in commands.items():
            code, one = once(command)
            if code not in (0, 1):
                sys.exit(f'exit code {code}: {" ".join(map(str, command))}')
            if i:
                costs[name].append(one)
    return {name: middle(list_) for name, list_ in costs.items()}


def plant(size, *options):
    """A generated plant of about a size such as 10M, made once."""
    name = '_'.join(['plant', size, *(o.strip('-') for o in options)])
    path = DATA / f'{name}.wrl'
    if not path.exists():
        DATA.mkdir(parents=True, exist_ok=True)
        made = path.with_suffix('.part')
        subprocess.run([sys.executable, SHARED / 'bench' / 'gen_plant.py', made, '--size', size, *options],
                       check=True, stdout=subprocess.DEVNULL)
        made.rename(path)
    return path


def megabytes(path):
    return os.path.getsize(path) / 1e6


def compiled(name, source, *flags):
    """A C++ program of one source, compiled once."""
    program = DATA / name
    if not program.exists():
        DATA.mkdir(parents=True, exist_ok=True)
        made = program.with_suffix('.part')
        subprocess.run(['g++', '-O3', '-march=native', '-std=c++20', source, '-o', made, *flags], check=True)
        made.rename(program)
    return program


def floor():
    """The bare fast_float loop over the same bytes that stores every number."""
    return compiled('floor', SHARED / 'bench' / 'src' / 'floor.cpp')


def output(*command, **more):
    return subprocess.run([str(c) for c in command], check=True, capture_output=True, text=True, **more).stdout


def number(x):
    """Three digits, as people write them."""
    if x >= 100:
        return f'{x:,.0f}'
    return f'{x:.3g}' if x >= 0.001 else f'{x:.2g}'
