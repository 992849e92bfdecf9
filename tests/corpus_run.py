#!/usr/bin/env python3
"""wrlkit corpus run: the mirrored tree, exit codes, the journal, kill -9 and resume, shards, limits of workers."""
import argparse, hashlib, json, os, pathlib, pty, random, shutil, signal, subprocess, sys, tempfile, termios, time

ROOT = pathlib.Path(__file__).resolve().parents[1]
parser = argparse.ArgumentParser()
parser.add_argument('--wrlkit', required=True)
WRLKIT = str(pathlib.Path(parser.parse_args().wrlkit).resolve())
RECIPE = str(ROOT / 'recipes/plant-web.toml')
HAS_PYTHON = (pathlib.Path(WRLKIT).parent / 'python/wrlkit').exists()
BOX = '#VRML V2.0 utf8\nShape { geometry Box { } }\n'
faults = []


def check(what, good, *details):
    print('ok    ' if good else 'FAILED', what, *([] if good else details))
    if not good:
        faults.append(what)


def corpus(*words, verb='run', **more):
    """The verb with a recipe; the exit code, what it printed, and what it printed as errors."""
    r = subprocess.run([WRLKIT, 'corpus', verb, *map(str, words)], capture_output=True, text=True, **more)
    return r.returncode, r.stdout, r.stderr


def tree(folder):
    """Every output with its contents."""
    return {str(p.relative_to(folder)): hashlib.sha256(p.read_bytes()).hexdigest()
            for p in sorted(folder.rglob('*')) if p.is_file() and '.wrlkit' not in p.parts}


def journal(folder):
    lines = [l for j in sorted((folder / '.wrlkit').glob('journal-*')) for l in j.read_text().splitlines()]
    out = []
    for l in lines:
        try:
            out.append(json.loads(l))
        except json.JSONDecodeError:
            pass  # cut off by a kill
    return out


def write(path, text):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)


def inputs(tmp):
    a = tmp / 'in'
    write(a / 'one.wrl', BOX)
    write(a / 'unit 1/two.wrl', BOX.replace('Box', 'Cone'))
    write(a / 'unit 1/two.x3d', '<X3D version="3.3" profile="Interchange"><Scene><Shape><Box/></Shape></Scene></X3D>')
    write(a / 'notes.txt', 'no world')
    write(a / '.hidden.wrl', BOX)
    code, _, err = corpus(RECIPE, a, '-o', tmp / 'folder')
    check('a folder becomes a mirrored tree, names that collide keep their endings',
          code == 0 and set(tree(tmp / 'folder')) == {'one.glb', 'unit 1/two.wrl.glb', 'unit 1/two.x3d.glb'}, code, err)
    check('collisions are reported', err.count('several inputs would become') == 2, err)
    corpus(RECIPE, 'in/**/two.*', '-o', 'glob', cwd=tmp)
    check('globs cross folders', set(tree(tmp / 'glob')) == {'unit 1/two.wrl.glb', 'unit 1/two.x3d.glb'}, tree(tmp / 'glob'))
    write(tmp / 'list.txt', 'in/one.wrl\nin/unit 1/two.wrl\n')
    corpus(RECIPE, '@list.txt', '-o', 'list', cwd=tmp)
    check('lists are mirrored', set(tree(tmp / 'list')) == {'in/one.glb', 'in/unit 1/two.glb'}, tree(tmp / 'list'))
    corpus(RECIPE, '-', '-o', 'stdin', '--base', 'in', cwd=tmp, input='in/unit 1/two.wrl\n')
    check('a list on standard input, below --base', set(tree(tmp / 'stdin')) == {'unit 1/two.glb'}, tree(tmp / 'stdin'))
    corpus(RECIPE, a, '-o', tmp / 'some', '--include', '*.wrl', '--exclude', 'unit*/**')
    check('include and exclude', set(tree(tmp / 'some')) == {'one.glb'}, tree(tmp / 'some'))
    write(a / 'tex/a.png', 'a picture')
    write(a / 'tex/t.wrl', BOX.replace('geometry', 'appearance Appearance { texture ImageTexture { url "a.png" } } geometry'))
    corpus(ROOT / 'recipes/archive.toml', a, '-o', tmp / 'archive')
    check('VRML keeps its urls, and what they mean is next to it',
          (tmp / 'archive/tex/a.png').read_text() == 'a picture' and '"a.png"' in (tmp / 'archive/tex/t.wrl').read_text(), tree(tmp / 'archive'))
    p = tmp / 'parts'
    write(p / 'whole.wrl', '#VRML V2.0 utf8\nInline { url "sub/Part one.x3d#x" }\nInline { url [ "gone.wrz" "sub/PIPE.WRZ" ] }\nAnchor { url "whole.wrl" }\nInline { url "http://example.org/a.wrz" }\n'
          'EXTERNPROTO P [ ] "sub/pipe.wrz#P"\n')
    write(p / 'sub/Part one.x3d', '<X3D version="3.3" profile="Interchange"><Scene><Inline url=\'"../whole.wrl"\'/><Inline url=\'"pipe.wrz"\'/></Scene></X3D>')
    write(p / 'sub/pipe.wrz', BOX)
    corpus(ROOT / 'recipes/archive.toml', p, '-o', tmp / 'parts-out')
    whole, part = ((tmp / 'parts-out' / n).read_text() for n in ('whole.wrl', 'sub/Part one.wrl'))
    check('urls of files that get another name are those of what is written', all(w in whole for w in ('"sub/Part%20one.wrl#x"', '"gone.wrz" "sub/pipe.wrl"', '"whole.wrl"', '"http://example.org/a.wrz"', '"sub/pipe.wrl#P"'))
          and '"../whole.wrl"' in part and '"pipe.wrl"' in part, whole, part)
    for words, why in [((RECIPE, a, '-o', a), 'one of their own'), ((RECIPE, tmp / 'none', '-o', tmp / 'o'), 'no file or folder'), ((RECIPE, a, '-o', tmp / 'o', '--timeout', 'soon'), 'not a valid time'),
                       ((RECIPE, a, '-o', tmp / 'o', '--shard', '3/2'), 'not a valid shard'), ((tmp / 'no.toml', a, '-o', tmp / 'o'), 'no such file')]:
        code, _, err = corpus(*words)
        check(f'wrong usage: {why}', code == (3 if why == 'no file or folder' else 2) and why in err, code, err)


def odd(tmp):
    """Names and folders as they are not in books."""
    a = tmp / 'odd'
    names = ['a b', 'ü€', 'new\nline', '-dash', "quo'te\"", 'star*[x]', 'tab\t', '#100%25']
    for n in names:
        write(a / f'{n}.wrl', BOX)
    (a / os.fsdecode(b'no-utf-8-\xff.wrl')).write_text(BOX)
    (a / 'sub').mkdir()
    for n, to in (('round', '.'), ('sub/up', '..'), ('gone.wrl', 'nowhere')):
        (a / n).symlink_to(to)
    os.mkfifo(a / 'pipe.wrl')
    code, _, err = corpus(RECIPE, a, '-o', tmp / 'odd-out', '--joblog', tmp / 'odd-log', timeout=60)
    check('odd names, links that go round, pipes; a link that leads nowhere is said', code == 1 and "gone.wrl' is a link to a file that is not there" in err and set(tree(tmp / 'odd-out')) == {f'{n}.glb' for n in [*names, os.fsdecode(b'no-utf-8-\xff')]}, code, err, tree(tmp / 'odd-out'))
    check('each has one line of the joblog', all(l.count('\t') == 8 for l in (tmp / 'odd-log').read_text(errors='replace').splitlines()))
    code, _, err = corpus(RECIPE, a, '-o', tmp / 'odd-out', timeout=60)
    check('and is not done again', code == 1 and len(journal(tmp / 'odd-out')) == len(names) + 1, err)
    code, _, _ = corpus(tmp / 'odd-out', '--looks', 2, '-o', tmp / 'odd.csv', '-o', tmp / 'odd.html', verb='report')
    check('a report of them', code == 0 and 'star*[x]' in (tmp / 'odd.csv').read_text(errors='replace'), code)
    b, recipe = tmp / 'faults', tmp / 'faults.toml'
    write(b / 'in/a.wrl', BOX)
    for text, why in (('passs = 1', "did you mean 'pass'"), ('[output]\nprecision = 99', 'is not in the range 0 to 17'), ('[limits]\ntimeout = "soon"', 'faults.toml:2:11: error: \'soon\' is not a valid time'),
                      ('[limits]\nmemory = "much"', "'much' is not a valid size"), ('[[pass]]\nname = "weld"\ntolerence = 1', "did you mean 'tolerance'"), ('[input', 'parsing table header'),
                      ('[limits]\njobs = 3', "'jobs' is an option of the command line: wrlkit corpus run --jobs")):
        write(recipe, text + '\n')
        code, _, err = corpus(recipe, b / 'in', '-o', b / 'out')
        check(f'a recipe with {text.split(chr(10))[-1]}', code == 2 and why in err and not (b / 'out').exists(), code, err)
    write(recipe, 'pipeline = ""\n')
    check('a recipe of no passes', corpus(recipe, b / 'in', '-o', b / 'out')[0] == 0 and set(tree(b / 'out')) == {'a.glb'})
    if os.getuid() == 0:
        return print('skipped: folders that may not be read, for root may read all')
    (b / 'in/shut').mkdir(0)
    code, _, err = corpus(RECIPE, b / 'in', '-o', b / 'out2')
    (b / 'in/shut').chmod(0o700)
    check('a folder that may not be read is said, and the rest is done', code == 1 and "shut': Permission denied" in err and set(tree(b / 'out2')) == {'a.glb'}, code, err)


def exit_codes(tmp):
    a = tmp / 'codes'
    write(a / 'good.wrl', BOX)
    write(a / 'bad.wrl', 'nothing of a world')
    code, _, err = corpus(RECIPE, a, '-o', tmp / 'c1')
    check('1 when some failed, and they are named', code == 1 and 'bad.wrl' in err and err.count('bad.wrl') == 1 and set(tree(tmp / 'c1')) == {'good.glb'}, code, err)
    write(a / 'part/of.wrl', BOX + 'Shape { appearance Appearance { texture ImageTexture { url "absent.png" } } geometry Box { } }')
    code, _, err = corpus(RECIPE, a / 'part', '-o', tmp / 'c0')
    check('what an output lacks is said by name', code == 1 and '1 file: 1 made' in err and 'url-not-found in 1' in err and f"'wrlkit corpus report {tmp / 'c0'}'" in err, code, err)
    shutil.rmtree(a / 'part')
    code, _, _ = corpus(RECIPE, a / 'bad.wrl', '-o', tmp / 'c2')
    check('3 when all failed', code == 3, code)
    code, _, err = corpus(RECIPE, a, '-o', tmp / 'c1')
    check('what failed before is remembered, and is still a failure', code == 1 and len(journal(tmp / 'c1')) == 2, code, err)
    corpus(RECIPE, a, '-o', tmp / 'c1', '--retry')
    check('--retry tries it again, and nothing else', len(journal(tmp / 'c1')) == 3)
    write(a / 'good.wrl', 'no longer one')
    made = tree(tmp / 'c1')
    code, _, err = corpus(RECIPE, a, '-o', tmp / 'c1')
    check('what can no longer be made fails, and what was made before stays',
          code == 3 and 'what was there before is untouched' in err and tree(tmp / 'c1') == made, code, err)


def resume(tmp):
    a, out = tmp / 'keys', tmp / 'keys-out'
    write(a / 'a.wrl', '#VRML V2.0 utf8\nInline { url "part.wrl" }\n')
    write(a / 'b.wrl', BOX)
    done = lambda: [l['input'].split('/')[-1] for l in journal(out)]
    corpus(RECIPE, a, '-o', out)
    check('an Inline that is missing is an error of that file', sorted(done()) == ['a.wrl', 'b.wrl'])
    corpus(RECIPE, a, '-o', out)
    check('nothing is done twice', len(done()) == 2, done())
    write(a / 'part.wrl', BOX)
    corpus(RECIPE, a, '-o', out)
    check('what refers to a file that has come is done again', done()[2:].count('a.wrl') == 1 and 'b.wrl' not in done()[2:], done())
    write(a / 'part.wrl', BOX.replace('Box', 'Sphere'))
    corpus(RECIPE, a, '-o', out)
    check('and when that file changes', done()[4:].count('a.wrl') == 1 and 'b.wrl' not in done()[4:], done())
    os.utime(a / 'b.wrl', (1, 1))
    before = len(done())
    corpus(RECIPE, a, '-o', out)
    check('the time of a file does not matter', len(done()) == before, done())
    (out / 'b.glb').unlink()
    corpus(RECIPE, a, '-o', out)
    check('an output that is gone is made again', done()[before:] == ['b.wrl'] and (out / 'b.glb').exists(), done())
    write(tmp / 'other.toml', 'pipeline = "weld"\n')
    before = len(done())
    corpus(tmp / 'other.toml', a, '-o', out)
    check('another recipe is other work', len(done()) == before + 3, done())


def killed(tmp, recipe=RECIPE, words=(ROOT / 'corpus/nodes', ROOT / 'corpus/paper', '--exclude', '*Texture*')):
    """kill -9 at random moments; shards; numbers of jobs: always the same bytes."""
    words = (recipe, *words)
    code, _, err = corpus(*words, '-o', tmp / 'whole', '--jobs', 1)
    whole = tree(tmp / 'whole')
    check('an undisturbed run', code == 0 and len(whole) >= 20, code, err)
    rng = random.Random(7)
    for i in range(3):
        run = subprocess.Popen([WRLKIT, 'corpus', 'run', *map(str, words), '-o', str(tmp / 'killed'), '--jobs', '2'], stderr=subprocess.DEVNULL)
        enough = len(journal(tmp / 'killed')) + rng.randint(len(whole) // 10, len(whole) // 5)
        while run.poll() is None and len(journal(tmp / 'killed')) < enough:
            time.sleep(0.005)
        run.send_signal(signal.SIGKILL)
        run.wait()
        part = tree(tmp / 'killed') if (tmp / 'killed').exists() else {}
        check(f'after kill {i + 1} there is no half file ({len(part)} outputs)', all(whole.get(n) == h for n, h in part.items()))
    code, _, err = corpus(*words, '-o', tmp / 'killed', '--jobs', 2, '--bundle', 7)
    check('three times killed and resumed, two jobs: the same bytes', code == 0 and tree(tmp / 'killed') == whole, code, err)
    inputs = [l['input'] for l in journal(tmp / 'killed')]
    check('finished work is not done twice', len(inputs) == len(set(inputs)), len(inputs), len(set(inputs)))
    parts = []
    for i in (3, 1, 2):
        code, _, err = corpus(*words, '-o', tmp / 'shards', '--shard', f'{i}/3')
        parts.append(len(tree(tmp / 'shards')))
    check('three shards: the same bytes', code == 0 and tree(tmp / 'shards') == whole, parts)
    plan = corpus(*words, '-o', tmp / 'shards', '--shard', '1/3', '--json', verb='plan')[1]
    check('the plan of a shard has a third', abs(len(json.loads(plan)) - len(whole) / 3) < len(whole) / 10, len(json.loads(plan)))
    for env, n in (({'SLURM_ARRAY_TASK_ID': '5', 'SLURM_ARRAY_TASK_MIN': '4', 'SLURM_ARRAY_TASK_COUNT': '3'}, 'auto'), ({'JOB_COMPLETION_INDEX': '1'}, 'auto/3')):
        out = corpus(*words, '-o', tmp / 'shards', '--shard', n, verb='plan', env=os.environ | env)[1]
        check(f'the shard of {sorted(env)[0]}', out.splitlines()[1].startswith('2/3\t'), out[:200])


def limits(tmp):
    a = tmp / 'limits'
    write(a / 'small.wrl', BOX)
    faces = ''.join(f'{i} {i * 7 % 1000} {i % 13}, ' for i in range(1000000))
    write(a / 'large.wrl', f'#VRML V2.0 utf8\nShape {{ geometry PointSet {{ coord Coordinate {{ point [ {faces} ] }} }} }}\n')
    code, _, err = corpus(RECIPE, a, '-o', tmp / 'l1', '--memory', '40M')
    states = {l['output']: l['state'] for l in journal(tmp / 'l1')}
    check('not enough memory ends one file and no other', code == 1 and states == {'small.glb': 'made', 'large.glb': 'no-memory'} and '40 MiB' in err, code, err, states)
    code, _, err = corpus(RECIPE, a, '-o', tmp / 'l2', '--timeout', '0.03s')
    states = {l['output']: l['state'] for l in journal(tmp / 'l2')}
    check('a file that takes too long is ended', states.get('large.glb') == 'timeout' and 'longer than 0.03s' in err, code, err, states)
    code, _, err = corpus(RECIPE, a, '-o', tmp / 'l3', '--joblog', tmp / 'log')
    lines = [l.split('\t') for l in (tmp / 'log').read_text().splitlines()]
    check('the joblog is that of GNU parallel', lines[0] == 'Seq Host Starttime JobRuntime Send Receive Exitval Signal Command'.split() and len(lines) == 3
          and all(len(l) == 9 and l[6:8] == ['0', '0'] for l in lines[1:]), lines)


def killed_in_python(tmp):
    """The same with a pass whose outcome would depend on the order of a set of texts."""
    if not HAS_PYTHON:
        return print('skipped: passes in Python, which this build has not')
    write(tmp / 'sets.py', 'import wrlkit\n\n@wrlkit.pass_\ndef sets(world):\n    for node in world.roots:\n        node.name = "_".join({"alpha", "beta", "gamma", "delta", node.type})\n')
    write(tmp / 'sets.toml', 'python = "sets.py"\npipeline = "sets,weld"\n[output]\nformat = "wrl"\n')
    killed(tmp / 'sets', tmp / 'sets.toml', (ROOT / 'corpus/nodes', '--include', '*[m-z].wrl', '--exclude', '*Texture*'))


POISON = '''import ctypes, os, pathlib, subprocess, time, wrlkit

@wrlkit.pass_
def poison(world, table: pathlib.Path = pathlib.Path('table.txt')):
    """Do to the worker what the world is called."""
    what = world.roots[0].name
    if what in ('loops', 'fine'):
        other = subprocess.Popen(['sleep', '1000'])
        pathlib.Path(table.parent, what + '.pid').write_text(str(other.pid))
    if what == 'loops':
        while True:
            time.sleep(0.01)
    kept = []
    while what == 'eats':
        kept.append(bytearray(1 << 20))
    if what == 'sleeps':
        time.sleep(2.5)
    if what == 'aborts':
        os.abort()
    if what == 'faults':
        ctypes.string_at(0)
    if what == 'leaves':
        os._exit(7)
    if what == 'raises':
        raise ValueError('no pump')
    world.roots[0].name = table.read_text().strip()
'''


def alive(pid_file):
    """Whether the process of that number is more than an entry not yet waited for."""
    stat = pathlib.Path('/proc', pid_file.read_text(), 'stat')
    try:
        return stat.read_text().rpartition(')')[2].split()[0] not in 'ZX'
    except OSError:
        return False


def on_a_terminal(*words):
    """What is shown there, 60 columns wide."""
    ours, theirs = pty.openpty()
    termios.tcsetwinsize(theirs, (24, 60))
    with subprocess.Popen([WRLKIT, 'corpus', 'run', *map(str, words)], stderr=theirs) as run:
        os.close(theirs)
        shown = b''
        while True:
            try:
                shown += os.read(ours, 65536)
            except OSError:  # nobody has it any more
                break
        run.wait()
    os.close(ours)
    return shown.decode()


def gone(pid_file):
    """Whether it ends soon: a signal takes effect when its process has its turn."""
    for _ in range(200):
        if not alive(pid_file):
            return True
        time.sleep(0.05)
    return False


def poisoned(tmp):
    """What a pass in Python does to one file it does to no other, and the run reports what it was."""
    if not HAS_PYTHON:
        return print('skipped: passes in Python, which this build has not')
    a, out, recipe = tmp / 'poison', tmp / 'poison-out', tmp / 'poison.toml'
    write(tmp / 'poison.py', POISON)
    write(tmp / 'table.txt', 'P-101')
    write(recipe, 'python = "poison.py"\n[[pass]]\nname = "poison"\n[output]\nformat = "wrl"\n')
    ends = {'loops': ('timeout', 'it took longer than 15s'), 'eats': ('no-memory', 'it needs more than 300 MiB'), 'aborts': ('crashed', 'SIGABRT'), 'faults': ('crashed', 'SIGSEGV'),
            'leaves': ('crashed', 'exit code 7'), 'raises': ('failed', "pass 'poison' failed: ValueError: no pump (poison.py:")}
    for name in [*ends, 'good', 'fine', 'well']:
        write(a / f'{name}.wrl', BOX.replace('Shape', f'DEF {name} Shape', 1))
    words = (recipe, a, '-o', out, '--memory', '300M', '--timeout', '15s')
    code, _, err = corpus(*words)
    lines = {l['output'].removesuffix('.wrl'): l for l in journal(out)}
    for name, (state, cause) in ends.items():
        check(f'a pass that {name}', name in lines and lines[name]['state'] == state and cause in lines[name]['cause'] and cause in err, lines.get(name), err)
    made = tree(out)
    check('and the rest is done', code == 1 and set(made) == {'good.wrl', 'fine.wrl', 'well.wrl'} and 'DEF P-101' in (out / 'good.wrl').read_text(), code, made, err)
    corpus(*words)
    code, _, err = corpus(recipe, a, '-o', tmp / 'bundled', '--memory', '300M', '--jobs', 1, '--bundle', 9, '--exclude', 'loops.wrl')
    bundled = {l['output'].removesuffix('.wrl'): (l['state'], l.get('cause', '').split('\n')[0]) for l in journal(tmp / 'bundled')}
    alone = {n: (l['state'], l.get('cause', '').split('\n')[0]) for n, l in lines.items() if n != 'loops'}
    check('who shares a worker with them is done all the same, and nobody else is blamed', code == 1 and bundled == alone and tree(tmp / 'bundled') == made, bundled, err)
    check('what workers have started has ended with them', all(gone(tmp / f'{name}.pid') for name in ('loops', 'fine')))
    check('nothing of it is done twice', len(journal(out)) == len(lines), len(journal(out)))
    words = (recipe, a, '-o', out, '--include', '*[ld].wrl')
    for path, old, new in ((tmp / 'table.txt', 'P-101', 'P-102'), (tmp / 'poison.py', 'strip()', 'strip() + "A"')):
        before = len(journal(out))
        path.write_text(path.read_text().replace(old, new))
        corpus(*words)
        corpus(*words)
        check(f'other contents of {path.name} are other work', len(journal(out)) == before + 2, len(journal(out)) - before)
    check('which is done', 'DEF P-102A' in (out / 'good.wrl').read_text())
    code, _, err = corpus(out, '--looks', 0, '--json', verb='report')
    check('a report needs no passes', code == 0, code, err)
    write(tmp / 'long/sleeps.wrl', BOX.replace('Shape', 'DEF sleeps Shape', 1))
    write(tmp / f'long/{"long" * 30}.wrl', BOX.replace('Shape', 'DEF sleeps Shape', 1))
    shown = on_a_terminal(recipe, tmp / 'long', '-o', tmp / 'long-out', '--jobs', 2)
    lines = shown.split('\r')
    check('on a terminal one line is written over, and the last one stays', len(lines) > 2 and all(len(l) < 60 + len('\x1b[K') for l in lines) and lines[-2].startswith('\x1b[K2 files: 2 made'), shown)
    (tmp / 'loops.pid').unlink()
    run = subprocess.Popen([WRLKIT, 'corpus', 'run', recipe, a, '-o', tmp / 'interrupted'], stderr=subprocess.PIPE)
    while not (tmp / 'loops.pid').exists() or not alive(tmp / 'loops.pid'):
        time.sleep(0.05)
    run.send_signal(signal.SIGINT)
    err = run.communicate(timeout=60)[1]
    check('a run that is interrupted ends by that, with all that was at work', run.returncode == -signal.SIGINT and gone(tmp / 'loops.pid'), run.returncode, err)


def report(tmp):
    a, out = tmp / 'report-in', tmp / 'report-out'
    write(a / 'ball.wrl', '#VRML V2.0 utf8\nSound { }\n' + BOX.replace('Box', 'Sphere').split('\n', 1)[1])
    write(a / 'bad <b>.wrl', 'nothing')
    corpus(RECIPE, a, '-o', out)
    code, _, err = corpus(out, '-o', tmp / 'r.html', '-o', tmp / 'r.csv', '-o', tmp / 'r.json', verb='report')
    data = json.loads((tmp / 'r.json').read_text())
    files = {f['output']: f for f in data['files']}
    check('a report counts states', code == 0 and data['states']['made'] == 1 and data['states']['failed'] == 1, code, err, data)
    check('what was lost, by kind', any(k['severity'] == 'lost' and 'Sound' in k['example'] for k in data['messages']), data['messages'])
    check('how far the surface has moved', 0 <= files['ball.glb']['max'] < 1e-3, files)
    csv = (tmp / 'r.csv').read_text().splitlines()
    write(tmp / 'two/whole/whole.wrl', '#VRML V2.0 utf8\nInline { url "../parts/part.wrl" }\n')
    write(tmp / 'two/parts/part.wrl', BOX)
    write(tmp / 'same.toml', '[output]\nformat = "wrl"\n')
    corpus(tmp / 'same.toml', tmp / 'two', '-o', tmp / 'same')
    same = {f['output']: f for f in json.loads(corpus(tmp / 'same', '--json', verb='report')[1])['files']}
    check('and of what stands in another folder of the run', same['whole/whole.wrl']['max'] == 0, same)
    check('a table', len(csv) == 3 and csv[0].startswith('input,output,state,cause') and all(l.count(',') >= 14 for l in csv), csv)
    page = (tmp / 'r.html').read_text()
    check('a page with pictures and nothing from elsewhere', page.count('/9j/') == 2 and 'http' not in page.replace('http-equiv', '') and 'bad &lt;b&gt;.wrl' in page, len(page))
    shutil.copytree(out, tmp / 'report-before')
    write(a / 'ball.wrl', 'no longer a world')
    write(a / 'new.wrl', BOX)
    corpus(RECIPE, a, '-o', out)
    code, text, err = corpus(out, '--looks', 0, '--json', '--compare', tmp / 'report-before', verb='report')
    changes = {c['output']: c for c in json.loads(text)['changes']}
    check('what became worse since another run', code == 1 and changes['ball.glb']['worse'] and not changes['new.glb']['worse'], code, err, changes)
    code, _, err = corpus(tmp, verb='report')
    check('wrong usage: no run there', code == 3 and 'no corpus run' in err, code, err)


def main():
    with tempfile.TemporaryDirectory() as tmp:
        for part in (inputs, odd, exit_codes, resume, killed, killed_in_python, limits, poisoned, report):
            part(pathlib.Path(tmp))
    print(f'{len(faults)} failed')
    return bool(faults)


sys.exit(main())
