"""Ctrl-C, other handlers of signals, and threads."""
import concurrent.futures
import math
import os
import pathlib
import signal
import subprocess
import sys
import textwrap
import threading
import time

import pytest
import wrlkit

CORPUS = pathlib.Path(__file__).resolve().parents[2] / 'corpus'
PUMP_ROOM = str(CORPUS / 'plant/pump_room_faces.wrl')
LONG = 'lightmap{quality=high,rays=2048}'  # minutes
SOON = 10                                  # seconds, on a slow machine
AT_ONCE = 0.7                              # of work, on all cores


class Later:
    """Sends a signal to this process, unless what it is to interrupt has ended before."""

    def __init__(self, seconds, number=signal.SIGINT):
        self.timer = threading.Timer(seconds, self.send)
        self.number, self.sent = number, None

    def send(self):
        self.sent = time.process_time()
        os.kill(os.getpid(), self.number)

    def seconds_of_work(self):
        """Since then."""
        return time.process_time() - self.sent

    def __enter__(self):
        self.timer.start()
        return self

    def __exit__(self, *_):
        self.timer.cancel()


@pytest.mark.parametrize('target', ['out.glb', 'out.wrl', 'out.x3d'])
def test_a_conversion_is_interrupted(tmp_path, target):
    with pytest.raises(KeyboardInterrupt), Later(0.5) as interrupt:
        wrlkit.convert(PUMP_ROOM, tmp_path / target, pipeline=LONG)
    assert interrupt.seconds_of_work() < AT_ONCE and list(tmp_path.iterdir()) == []


def test_packing_of_meshes_is_interrupted(tmp_path):
    """Draco's, which takes longer than all else."""
    n = 250
    with (tmp_path / 'waves.wrl').open('w') as out:
        out.write('#VRML V2.0 utf8\n')
        for part in range(40):
            points = ','.join(f'{x} {y} {math.sin(x * 0.2 + part) * math.cos(y * 0.13):.4f}' for y in range(n + 1) for x in range(n + 1))
            faces = ' '.join(f'{i} {i + 1} {i + n + 2} {i + n + 1} -1' for y in range(n) for i in range(y * (n + 1), y * (n + 1) + n))
            out.write(f'Shape {{ geometry IndexedFaceSet {{ coord Coordinate {{ point [ {points} ] }} coordIndex [ {faces} ] }} }}\n')
    with pytest.raises(KeyboardInterrupt), Later(1) as interrupt:
        wrlkit.convert(tmp_path / 'waves.wrl', tmp_path / 'out.glb', compress='draco')
    assert interrupt.seconds_of_work() < AT_ONCE and not (tmp_path / 'out.glb').exists()


def test_a_world_that_was_interrupted_is_valid(tmp_path):
    world = wrlkit.load(PUMP_ROOM)
    with pytest.raises(KeyboardInterrupt), Later(0.5):
        world.run('weld,' + LONG)
    world.save(tmp_path / 'out.glb')
    assert wrlkit.info(tmp_path / 'out.glb')['triangles'] > 29000


def test_other_handlers_run_while_the_library_works():
    """One that raises ends the work, one that does not leaves it alone."""
    class TimeIsUp(Exception):
        pass

    def up(*_):
        raise TimeIsUp
    seen = []
    before = signal.signal(signal.SIGUSR1, up)
    try:
        with pytest.raises(TimeIsUp), Later(0.5, signal.SIGUSR1):
            wrlkit.load(PUMP_ROOM).run(LONG)
        signal.signal(signal.SIGUSR1, lambda *_: seen.append(time.monotonic()))
        with Later(0.01, signal.SIGUSR1):
            wrlkit.load(PUMP_ROOM).run('inline,expand-protos,tessellate{triangles=true},weld,lod,lod')
            end = time.monotonic()
        assert len(seen) == 1 and seen[0] < end + SOON
    finally:
        signal.signal(signal.SIGUSR1, before)


def test_a_pass_in_python_is_interrupted(tmp_path):
    """It runs on the thread of the caller, where Python raises KeyboardInterrupt, and it does not become an Error."""
    threads = []

    @wrlkit.pass_
    def never_ends(world):
        threads.append(threading.current_thread())
        while True:
            pass
    with pytest.raises(KeyboardInterrupt), Later(0.3):
        wrlkit.convert(PUMP_ROOM, tmp_path / 'out.glb', pipeline='never-ends')
    assert threads == [threading.current_thread()] and list(tmp_path.iterdir()) == []

    @wrlkit.pass_
    def leaves(world):
        sys.exit(7)
    with pytest.raises(SystemExit, match='7'):
        wrlkit.load(PUMP_ROOM).run('leaves,weld')

    @wrlkit.pass_
    def works_long(world):
        world.run(LONG)
    with pytest.raises(KeyboardInterrupt), Later(0.5):
        wrlkit.convert(PUMP_ROOM, tmp_path / 'out.glb', pipeline='works-long')
    assert list(tmp_path.iterdir()) == []


def test_the_program_in_python_is_interrupted(tmp_path):
    """As every other program, by the signal itself."""
    (tmp_path / 'p.py').write_text(textwrap.dedent('''
        import time
        import wrlkit

        @wrlkit.pass_
        def never_ends(world):
            open(__file__ + '.begun', 'w').close()
            time.sleep(60)
    '''))
    run = subprocess.Popen([sys.executable, '-m', 'wrlkit', 'convert', PUMP_ROOM, str(tmp_path / 'out.glb'), '--python', str(tmp_path / 'p.py'), '-p', 'never-ends'])
    while not (tmp_path / 'p.py.begun').exists() and run.poll() is None:
        time.sleep(0.05)
    run.send_signal(signal.SIGINT)
    assert run.wait(SOON) == -signal.SIGINT and not (tmp_path / 'out.glb').exists()


def test_a_process_ends_while_a_thread_works():
    run = subprocess.run([sys.executable, '-c', textwrap.dedent(f'''
        import threading, time, wrlkit
        world = wrlkit.load({PUMP_ROOM!r})
        threading.Thread(target=lambda: world.run({LONG!r}), daemon=True).start()
        time.sleep(0.3)''')], capture_output=True, text=True, timeout=60)
    assert (run.returncode, run.stdout, run.stderr) == (0, '', '')


def test_a_world_is_for_one_thread_at_a_time():
    """What would read a scene while it is changed is an error, not a crash."""
    world = wrlkit.load(PUMP_ROOM)
    material = world.nodes('Material')[0]
    faults, done = [], threading.Event()

    def look():
        while not done.is_set():
            for call in (world.nodes, lambda: material.diffuseColor, lambda: world.run('weld'), lambda: world.to_bytes('wrl')):
                try:
                    call()
                except RuntimeError as fault:
                    faults.append(str(fault))
            time.sleep(0.001)
    threads = [threading.Thread(target=look) for n in range(2)]
    for thread in threads:
        thread.start()
    for n in range(20):
        try:
            world.run('weld,lod,dedup')
        except RuntimeError as fault:
            faults.append(str(fault))
    done.set()
    for thread in threads:
        thread.join()
    assert set(faults) == {'the world is being worked on by another thread; a world is for one thread at a time'}
    world.to_bytes('wrl')


def test_worlds_in_threads(tmp_path):
    """Each its own, with the exceptions of its own passes."""
    @wrlkit.pass_
    def fails_with(world, number: int = 0):
        time.sleep(0.01)
        raise ValueError(number)

    def work(n):
        world = wrlkit.load(PUMP_ROOM)
        with pytest.raises(wrlkit.Error) as error:
            world.apply('fails-with', number=n)
        world.run('weld')
        world.save(tmp_path / f'{n}.glb')
        return error.value.__cause__.args[0], f'ValueError: {n} ' in str(error.value)
    with concurrent.futures.ThreadPoolExecutor(8) as pool:
        assert list(pool.map(work, range(16))) == [(n, True) for n in range(16)]
    assert len({p.read_bytes() for p in tmp_path.iterdir()}) == 1
