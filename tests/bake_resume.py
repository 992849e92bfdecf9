#!/usr/bin/env python3
"""A bake that is killed and called again gives the bytes of one that was left alone.

  tests/bake_resume.py --wrlkit build/release/wrlkit

Bakes corpus/paper/stairs_room.wrl three times: undisturbed; with a checkpoint, killed when a tenth of the work, some tiles, is kept; and the same
call again. Then once more after the end of the checkpoint's file was cut off and its last tile damaged, as a full disk or a crash of
the machine leaves it. Each time the world and its pictures must be the same, the second call must have traced fewer rays than the
first, and no checkpoint may be left.

What is kept is of no use to another world of the same shape, nor to other options: after a change of a colour, of a lamp's
cutOffAngle or of `directional` the bytes are those of a bake without a checkpoint.

Then corpus/paper/pipes.wrl with levels of detail, of which each is baked with a checkpoint of its own: killed in the second one, no light
of the first is traced again.
"""
import argparse, pathlib, re, signal, subprocess, sys, tempfile, time

project = pathlib.Path(__file__).resolve().parents[1]
room, pipes = project / 'corpus/paper/stairs_room.wrl', project / 'corpus/paper/pipes.wrl'


def command(wrlkit, world, folder, checkpoint, more=''):
    options = 'quality=draft,max-size=512' + more + (f',checkpoint={checkpoint}' if checkpoint else '')
    return [wrlkit, 'convert', world, folder / 'lit.wrl', '-p', ('lod,' if world == pipes else '') + f'lightmap{{{options}}}', '--stats']


def bake(wrlkit, folder, checkpoint=None, world=room, more=''):
    """The bytes of all files that it wrote, and the rays that it traced."""
    folder.mkdir(exist_ok=True)
    r = subprocess.run(command(wrlkit, world, folder, checkpoint, more), capture_output=True, text=True, timeout=300)
    if r.returncode != 0:
        sys.exit(f'bake-resume: exit code {r.returncode}: {r.stderr[-500:]}')
    rays = re.search(r'(\d+)\s+lightmap\.rays', r.stdout + r.stderr)
    return {p.name: p.read_bytes() for p in sorted(folder.iterdir())}, int(rays[1]) if rays else 0


def interrupted(wrlkit, folder, checkpoint, size, world=room, of_view=''):
    """Kills a bake once that much is kept, of a view. False when it was done before."""
    kept = checkpoint.with_name(checkpoint.name + of_view)
    folder.mkdir(exist_ok=True)
    p = subprocess.Popen(command(wrlkit, world, folder, checkpoint), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    while p.poll() is None and not (kept.exists() and kept.stat().st_size > size):
        time.sleep(0.002)
    p.send_signal(signal.SIGKILL)
    p.wait()
    return checkpoint.exists()


def main():
    a = argparse.ArgumentParser()
    a.add_argument('--wrlkit', default='build/release/wrlkit')
    wrlkit = pathlib.Path(a.parse_args().wrlkit).resolve()
    faults = []
    with tempfile.TemporaryDirectory() as t:
        folder, checkpoint = pathlib.Path(t), pathlib.Path(t) / 'kept'
        whole, rays = bake(wrlkit, folder / 'whole')

        def check(what, found, least=1):
            files, again = found
            if files != whole:
                faults.append(f'{what}: other bytes in {[n for n in whole if files.get(n) != whole[n]] or sorted(files)}')
            if not least <= again < rays:
                faults.append(f'{what}: {again} rays of {rays}')
            if checkpoint.exists():
                faults.append(f'{what}: the checkpoint is left')

        for damaged in (False, True):
            if not any(interrupted(wrlkit, folder / 'part', checkpoint, size) for size in (4_000_000, 1_500_000)):
                sys.exit('bake-resume: the bake was done before it could be killed')
            if damaged:
                kept = checkpoint.read_bytes()
                checkpoint.write_bytes(kept[:-1000] + bytes(b ^ 0x55 for b in kept[-1000:-500]))
            check('damaged' if damaged else 'killed', bake(wrlkit, folder / 'part', checkpoint))
        spot = folder / 'spot.wrl'
        spot.write_text(room.read_text() + 'SpotLight { location 0 3 0 direction 0 -1 0 radius 20 cutOffAngle 0.5 }')
        for change in (('0.52 0.42 0.32', '0.9 0.1 0.1'), ('cutOffAngle 0.5', 'cutOffAngle 0.7'), ('', '')):
            if not interrupted(wrlkit, folder / 'part', checkpoint, 1_500_000, spot):
                sys.exit('bake-resume: the bake was done before it could be killed')
            other, more = folder / 'spot' / 'spot.wrl', '' if change[0] else ',directional=true'
            other.parent.mkdir(exist_ok=True)
            other.write_text(spot.read_text().replace(*change))
            if bake(wrlkit, folder / 'after_another', checkpoint, other, more)[0] != bake(wrlkit, folder / 'of_its_own', None, other, more)[0]:
                faults.append(f'changed {change[0] or "directional"}: tiles of another bake were taken')
            of_another = checkpoint.with_name(checkpoint.name + '.bak')
            if not of_another.exists():
                faults.append(f'changed {change[0] or "directional"}: the checkpoint of another bake is gone')
            of_another.unlink(missing_ok=True)
        whole, rays = bake(wrlkit, folder / 'whole_pipes', world=pipes)
        if not interrupted(wrlkit, folder / 'part_pipes', checkpoint, 0, pipes, '.2'):
            sys.exit('bake-resume: the levels were done before they could be killed')
        rays //= 2  # of the first view are more
        # All of the second view may have the light of the first.
        check('killed in the second view', bake(wrlkit, folder / 'part_pipes', checkpoint, pipes), least=0)
        if left := sorted(p.name for p in folder.glob('kept*')):
            faults.append(f'left: {left}')
    print('\n'.join(faults) or f'a killed bake goes on: {len(whole)} files alike')
    sys.exit(bool(faults))


main()
