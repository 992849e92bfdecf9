#!/usr/bin/env python3
"""3D Tiles that are made in pieces have the bytes of those made at once: by runs that were killed at random moments, by shards, and by updates.

  tests/tiles_resume.py --wrlkit build/release/wrlkit [--seed 1]
"""
import argparse
from pathlib import Path
import json
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

from names_table import with_bolts
from tiles_world import bytes_of, round_parts

FILES, KILLS, SHARDS = 4, 3, 4
LEAST = '200'  # triangles a tile


class Test:
    def __init__(self, wrlkit, folder, seed):
        self.wrlkit, self.folder, self.random, self.faults = wrlkit, folder, random.Random(seed), []
        self.plant = folder / 'in'
        self.plant.mkdir()
        for i in range(FILES):
            self.write(f'unit_{i}', round_parts(6) if i % 2 else with_bolts(30, 50)[0], (300 * i, 0, 40 * i * i))

    def write(self, name, text, at):
        """A file whose parts are Inlined at a place."""
        (self.plant / 'parts').mkdir(exist_ok=True)
        (self.plant / 'parts' / f'{name}.inl').write_text(text)
        (self.plant / f'{name}.wrl').write_text(f'#VRML V2.0 utf8\nTransform {{ translation {at[0]} {at[1]} {at[2]} children Inline {{ url "parts/{name}.inl" }} }}\n')

    def command(self, out, *flags):
        return [self.wrlkit, 'tiles', self.plant, '-o', self.folder / out, '--triangles', LEAST, *flags]

    def make(self, out, *flags, code=0):
        made = subprocess.run(self.command(out, '--json', *flags), capture_output=True, text=True)
        self.expect(made.returncode == code, f'{out} {flags}: exit code {made.returncode}: {made.stderr}')
        return json.loads(made.stdout) if made.returncode == 0 else made.stderr

    def expect(self, good, fault):
        if not good:
            self.faults.append(fault)

    def same(self, out, reference, what):
        a, b = bytes_of(self.folder / out), bytes_of(self.folder / reference)
        differ = sorted(set(a) ^ set(b)) + sorted(name for name in set(a) & set(b) if a[name] != b[name])
        self.expect(not differ, f'{what}: other bytes than at once: {differ[:4]}')

    def killed(self, jobs):
        """A run that is killed again and again, each time farther on."""
        out, kept = f'killed-{jobs}', 0
        begin = time.monotonic()
        self.make(f'timed-{jobs}', '--jobs', jobs)
        whole = time.monotonic() - begin
        self.same(f'timed-{jobs}', 'once', f'{jobs} threads')
        for i in range(KILLS):
            run = subprocess.Popen(self.command(out, '--jobs', jobs), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            time.sleep(whole * self.random.uniform(0.5, 0.95))
            run.send_signal(signal.SIGKILL)
            run.wait()
            kept = len(list((self.folder / out / '.wrlkit').glob('*.glb')))  # none when it had ended before
        made = self.make(out, '--jobs', jobs)
        self.expect(made['kept'] > 0 or kept == 0, f'{out}: nothing of {kept} tiles was gone on with')
        self.same(out, 'once', f'{jobs} threads, killed {KILLS} times')
        return made['kept'], len(made['tiles'])

    def other_options(self):
        """What was left by a run with other options is not used."""
        run = subprocess.Popen(self.command('other', '--compress', 'none'), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        time.sleep(0.6)
        run.kill()
        run.wait()
        made = self.make('other')
        self.expect(made['kept'] == 0, 'tiles with other options were taken')
        self.same('other', 'once', 'after a run with other options')

    def shards(self):
        runs = [subprocess.Popen(self.command('shards', '--json', '--shard', f'{i + 1}/{SHARDS}'), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) for i in range(SHARDS)]
        said = [(run.communicate(), run.returncode) for run in runs]
        self.expect(all(code == 0 for _, code in said), f'shards: {said}')
        whole = [json.loads(out)['whole'] for (out, _), code in said if code == 0]
        self.expect(sum(whole) == 1, f'shards: {whole} of them have written tileset.json')
        self.same('shards', 'once', f'{SHARDS} shards at a time')
        # One after the other, and one of them is killed and run again.
        for i in (2, 0, 3):
            self.expect(not self.make('turns', '--shard', f'{i + 1}/{SHARDS}')['whole'], 'a set is whole without all shards')
        self.expect(not (self.folder / 'turns' / 'tileset.json').exists(), 'tileset.json before the last shard')
        run = subprocess.Popen(self.command('turns', '--shard', f'2/{SHARDS}'), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        time.sleep(0.1)
        run.kill()
        run.wait()
        turns = self.folder / 'turns'
        if not (turns / 'tileset.json').exists() or (turns / '.wrlkit').exists():
            self.expect(self.make('turns', '--shard', f'2/{SHARDS}')['whole'], 'the last shard writes no tileset.json')
        for left in turns.glob('.unfinished-*'):  # by a run that was killed in its last step; the next one removes it
            shutil.rmtree(left)
        self.same('turns', 'once', f'{SHARDS} shards in turn')

    def update(self):
        self.make('update', '--update')
        again = self.make('update', '--update')
        n = len(again['tiles'])
        self.expect(again['kept'] == n, f'{again["kept"]} of {n} tiles were kept when nothing had changed')
        inl = self.plant / 'parts' / 'unit_1.inl'
        text = inl.read_text()
        inl.write_text(text.replace('diffuseColor 0 0.5 1', 'diffuseColor 1 0.5 0'))
        self.expect(inl.read_text() != text, 'nothing was changed')
        changed = self.make('update', '--update')
        self.expect(0 < changed['kept'] < n, f'{changed["kept"]} of {n} tiles were kept when one file had changed')
        # A part comes: cells elsewhere are cut where they were.
        (self.plant / 'parts' / 'unit_1.inl').write_text(inl.read_text() + 'DEF New Transform { translation 5000010 250 -2999990 children Shape { geometry Sphere { } } }\n')
        more = self.make('update', '--update')
        self.expect(more['kept'] > n / 2, f'{more["kept"]} of {n} tiles were kept when a part had come')
        self.make('changed')
        (self.folder / 'update' / '.wrlkit').rename(self.folder / 'aside')
        self.same('update', 'changed', 'updates')
        inl.write_text(text)
        return changed['kept'], more['kept'], n

    def removed(self):
        """A file that has left leaves nothing behind, and the tiles far from it stay."""
        gone = self.plant / 'unit_3.wrl'
        self.make('fewer', '--update')
        gone.rename(self.folder / 'unit_3.wrl')
        made = self.make('fewer', '--update')
        self.expect(0 < made['kept'] < len(made['tiles']), f'{made["kept"]} of {len(made["tiles"])} tiles were kept when a file had left')
        self.make('without')
        shutil.rmtree(self.folder / 'fewer' / '.wrlkit')
        self.same('fewer', 'without', 'an update without one of the files')
        # The set of a run before, of other files, is replaced.
        (self.folder / 'unit_3.wrl').rename(gone)
        self.make('without')
        self.same('without', 'once', 'a run in the folder of another one')

    def hostile(self):
        """One clear line, and nothing that is half written."""
        (self.folder / 'file').write_text('')
        said = self.make('file/out', code=3)
        self.expect(len(said.strip().splitlines()) == 1 and 'file' in said, f'below a file: {said!r}')
        run = subprocess.Popen(self.command('busy'), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        while not (self.folder / 'busy' / '.wrlkit' / 'lock').exists() and run.poll() is None:
            time.sleep(0.01)
        os.kill(run.pid, signal.SIGSTOP)
        said = self.make('busy', code=3)
        os.kill(run.pid, signal.SIGCONT)
        self.expect('another run is at work there' in said and len(said.strip().splitlines()) == 1, f'two runs in one folder: {said!r}')
        self.expect(run.wait() == 0, 'the run that was there first fails')
        self.same('busy', 'once', 'a run that another one wanted to join')

    def small_disk(self):
        """A disk that is too small, for whom may make one: one line, and a set that was there stays."""
        small = self.folder / 'small'
        small.mkdir()
        if subprocess.run(['mount', '-t', 'tmpfs', '-o', 'size=600k', 'tmpfs', small], capture_output=True).returncode:
            return 'not tried'
        try:
            before = '{"asset":{"generator":"wrlkit"}}'
            (small / 'tileset.json').write_text(before)
            said = self.make('small', code=3)
            self.expect(len(said.strip().splitlines()) == 1 and ('full' in said or 'space' in said), f'a full disk: {said!r}')
            self.expect((small / 'tileset.json').read_text() == before, 'a full disk costs the set that was there')
        finally:
            subprocess.run(['umount', small])
        return 'tried'


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--wrlkit', required=True)
    parser.add_argument('--seed', type=int, default=1)
    args = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        test = Test(args.wrlkit, Path(name), args.seed)
        test.make('once')
        test.expect(any(b'EXT_mesh_gpu_instancing' in data for data in bytes_of(Path(name) / 'once').values()), 'no surface is stored once for several places')
        for jobs in ('1', '2'):
            print('killed: kept {} of {} tiles'.format(*test.killed(jobs)))
        test.other_options()
        test.shards()
        print('updated: kept {} and {} of {} tiles'.format(*test.update()))
        test.removed()
        test.hostile()
        print('a full disk:', test.small_disk())
    print('\n'.join(test.faults) or 'the same bytes, however they were made')
    return 1 if test.faults else 0


if __name__ == '__main__':
    sys.exit(main())
