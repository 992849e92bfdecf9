"""The examples, on a world of the corpus."""
import pathlib
import subprocess
import sys

import wrlkit

ROOT = pathlib.Path(__file__).resolve().parents[2]
PUMP_ROOM = str(ROOT / 'corpus/plant/pump_room_faces.wrl')


def example(name, *words):
    return subprocess.run([sys.executable, str(ROOT / 'python/examples' / name), *map(str, words)], capture_output=True, text=True, check=True).stdout


def test_rename_tags(tmp_path):
    names = sorted({n.name for n in wrlkit.load(PUMP_ROOM).nodes('Transform') if n.name})[:2]
    (tmp_path / 'tags.csv').write_text(''.join(f'{n},TAG-{i}\n' for i, n in enumerate(names)))
    assert example('rename_tags.py', PUMP_ROOM, tmp_path / 'tags.csv', tmp_path / 'out.wrl') == '2 renamed\n'
    renamed = wrlkit.load(str(tmp_path / 'out.wrl'))
    assert renamed.find('TAG-0').type == 'Transform' and renamed.find(names[0]) is None


def test_colour_by_system(tmp_path):
    name = next(n.name for n in wrlkit.load(PUMP_ROOM).nodes('Transform') if n.name and n.children)
    words = example('colour_by_system.py', PUMP_ROOM, tmp_path / 'out.wrl', f'{name}=ff0000').split()
    assert int(words[0]) > 0 and words[1] == 'coloured'
    assert any(m.diffuseColor == (1, 0, 0) for m in wrlkit.load(str(tmp_path / 'out.wrl')).nodes('Material'))


def test_remove_small(tmp_path):
    before = len(wrlkit.load(PUMP_ROOM).nodes('X3DGeometryNode'))
    removed = int(example('remove_small.py', PUMP_ROOM, tmp_path / 'out.wrl', 0.3).split()[0])
    assert 0 < removed < before
    assert len(wrlkit.load(str(tmp_path / 'out.wrl')).nodes('X3DGeometryNode')) < before


def test_a_recipe_with_passes_in_python(tmp_path):
    """By corpus run, in workers of its own."""
    run = subprocess.run([sys.executable, '-m', 'wrlkit', 'corpus', 'run', str(ROOT / 'python/examples/tags.toml'), PUMP_ROOM, '-o', str(tmp_path / 'out')], capture_output=True, text=True)
    assert run.returncode == 0, run.stderr
    world = wrlkit.load(str(tmp_path / 'out/pump_room_faces.glb'))
    assert world.find('Pump_101A') and not world.find('P_101A')
    assert 0 < world.info()['shapes'] < wrlkit.info(PUMP_ROOM)['shapes']
