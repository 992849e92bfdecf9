#!/usr/bin/env python3
"""Files per CPU second against the best that a shell loop over a peer could do: three.js in one Node.js process, Blender in one process.

  bench/corpus_peers.py WRLKIT FOLDER [N]     N worlds of VRML97 below FOLDER without textures and Inlines, evenly chosen

Every program converts the files that all three of them can convert, to GLB, in one start; CPU seconds are of the process with all its
children. Blender and Node.js with three (script/bootstrap) must be there; without one of them its line is missing.
"""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]


def run(words, **more):
    """What it printed, and its CPU seconds."""
    process = subprocess.Popen([str(w) for w in words], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, **more)
    text = process.stdout.read().decode('utf-8', 'replace')
    _, _, usage = os.wait4(process.pid, 0)
    return text, usage.ru_utime + usage.ru_stime


def plain(path):
    """VRML97 without what a peer would fetch."""
    text = path.read_bytes()
    return text.startswith(b'#VRML V2.0') and len(text) < 300_000 and not any(w in text for w in (b'Inline', b'ImageTexture', b'MovieTexture', b'EXTERNPROTO', b'AudioClip'))


def peers(wrlkit, tmp):
    """Name to command, what converts the files of a list into a folder."""
    (tmp / 'plain.toml').write_text('summary = "a plain conversion"\n')
    def ours(*more):
        return lambda listed, out: run([wrlkit, 'corpus', 'run', tmp / 'plain.toml', f'@{listed}', '-o', out, '--base', '/', '--jobs', '2', '-q', *more])
    found = {'wrlkit': ours(), 'wrlkit --bundle 1': ours('--bundle', '1')}
    browser = ROOT / 'tests/browser'
    if shutil.which('node') and (browser / 'node_modules/three').exists():
        found['three.js'] = lambda listed, out: run(['node', '--input-type=module', '-e', (ROOT / 'bench/peer_three.mjs').read_text().replace('slice(2)', 'slice(1)'), listed, out], cwd=browser)
    if shutil.which('blender'):
        found['Blender'] = lambda listed, out: run(['blender', '--background', '--factory-startup', '--python', ROOT / 'bench/peer_blender.py', '--', listed, out], env=os.environ | {'PATH': '/usr/bin:/bin'})
    return found


def main():
    wrlkit, folder, n = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve(), int((*sys.argv, 200)[3])
    files = [p for p in sorted(folder.rglob('*.wrl')) if 'broken' not in p.parts and plain(p)]
    files = files[::max(1, len(files) // n)][:n]
    with tempfile.TemporaryDirectory() as tmp:
        tmp = pathlib.Path(tmp)

        def convert(name, command, files, turn):
            out = tmp / f'{name}-{turn}'
            out.mkdir()
            text, seconds, left = '', 0, list(map(str, files))
            while left:
                (tmp / 'list').write_text(''.join(f'{f}\n' for f in left))
                more, used = command(tmp / 'list', out)
                text, seconds = text + more, seconds + used
                begun = [line.removeprefix('begun ') for line in more.splitlines() if line.startswith('begun ')]
                left = left[left.index(begun[-1]) + 1:] if begun else []  # a file on which a peer has crashed
            made = {str(p).removesuffix('.glb') + '.wrl' for p in ('/' / q.relative_to(out) for q in out.rglob('*.glb'))} if name.startswith('wrlkit') else {line.removeprefix('made ') for line in text.splitlines()}
            return made & set(map(str, files)), seconds
        commands = peers(wrlkit, tmp)
        common = set(map(str, files))
        for name, command in commands.items():
            made, _ = convert(name, command, files, 'all')
            print(f'{name}: {len(made)} of {len(files)} files')
            common &= made
        common = sorted(common)
        size = sum(pathlib.Path(p).stat().st_size for p in common)
        print(f'\n{len(common)} files that all of them convert, {size / 1e6:.1f} MB\n\n| program | CPU s | files per CPU second | |\n|---|---|---|---|')
        rates = {}
        for name, command in commands.items():
            made, seconds = convert(name, command, common, 'common')
            rates[name] = len(made) / seconds
            print(f"| {name} | {seconds:.2f} | {rates[name]:.1f} | {rates['wrlkit'] / rates[name]:.1f} |")


if len(sys.argv) < 3:
    sys.exit(__doc__)
main()
