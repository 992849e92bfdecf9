"""What docs/python.md shows is run, and what it lists is compared with the package."""
import contextlib
import io
import os
import pathlib
import re
import shutil
import stat
import subprocess
import sys

import pytest
import wrlkit

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE = (ROOT / 'docs/python.md').read_text()
BLOCKS = re.findall(r'^```(python)?\n(.*?)^```$', PAGE, re.MULTILINE | re.DOTALL)


@pytest.fixture
def project(tmp_path, monkeypatch):
    """A folder with the files that the page speaks of, and `wrlkit` on the path."""
    plant = (ROOT / 'corpus/plant/pump_room_faces.wrl').read_text()
    (tmp_path / 'plant.wrl').write_text(plant + '\nDEF Pump Transform { children Shape { geometry Box { sizes 1 1 1 } } }\n')
    for folder in ('textures', 'plant/textures'):
        shutil.copytree(ROOT / 'corpus/plant/textures', tmp_path / folder)
    shutil.copytree(ROOT / 'recipes', tmp_path / 'recipes')
    (tmp_path / 'tags.csv').write_text('Pump,P-101\n')
    shutil.copy(tmp_path / 'plant.wrl', tmp_path / 'plant')
    program = tmp_path / 'bin/wrlkit'
    program.parent.mkdir()
    program.write_text(f'#!/bin/sh\nexec {sys.executable} -m wrlkit "$@"\n')
    program.chmod(program.stat().st_mode | stat.S_IXUSR)
    monkeypatch.setenv('PATH', f'{program.parent}:{os.environ["PATH"]}')
    monkeypatch.setenv('PYTHONPATH', str(pathlib.Path(wrlkit.__file__).parents[1]))
    monkeypatch.chdir(tmp_path)
    return tmp_path


def snippet(beginning):
    found, = [text for kind, text in BLOCKS if kind and text.startswith(beginning)]
    return found


def run(text):
    """What it prints."""
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        exec(compile(text, 'docs/python.md', 'exec'), {'__name__': 'snippet'})
    return printed.getvalue()


def test_every_block_has_a_test():
    first_lines = [text.splitlines()[0] for _, text in BLOCKS]
    assert first_lines == ['export PYTHONPATH=build/release/python', 'import wrlkit', 'try:', 'import csv, pathlib, wrlkit', first_lines[-1]] and first_lines[-1].startswith('$ wrlkit convert')


def test_the_tour(project):
    printed = run(snippet('import wrlkit\n\nworld'))
    assert 'warning unknown-field plant.wrl ' in printed and re.search(r'^plant\.wrl:\d+:\d+: warning: .* \[unknown-field\]$', printed, re.MULTILINE)
    assert 'lod.levels' in printed and (project / 'plant.glb').read_bytes()[:4] == b'glTF'


def test_errors(project):
    (project / 'plant.wrl').write_text('#VRML V2.0 utf8\n\nShapes [ }')
    printed = run('import wrlkit\n' + snippet('try:'))
    assert re.match(r'plant\.wrl:3:\d+: error: .* \[[a-z-]+\]\n', printed) and printed.count('\n') > 2


def test_passes_in_python(project):
    """The file of the page, the commands, and the recipe that `cat` shows."""
    (project / 'rename_tags.py').write_text(snippet('import csv'))
    *_, (_, shell) = BLOCKS
    commands = []
    for line in shell.splitlines():
        if line.startswith('$ '):
            commands.append((line[2:], []))
        else:
            commands[-1][1].append(line)
    printed = []
    for command, shown in commands:
        if command.startswith('cat '):
            (project / command.split()[1]).write_text('\n'.join(shown) + '\n')
        else:
            done = subprocess.run(['bash', '-c', command], capture_output=True, text=True)
            assert done.returncode == 0, done.stderr
            printed.append(done.stdout + done.stderr)
    assert 'rename-tags.renamed' in printed[0] and 'CSV, a row of old and new name for each' in printed[1]
    for made in ('plant.glb', 'web/plant.glb'):
        assert wrlkit.load(project / made).find('P-101') and not wrlkit.load(project / made).find('Pump')


def test_where_a_pass_runs(project):
    (project / 'rename_tags.py').write_text(snippet('import csv'))
    done = subprocess.run(['wrlkit', 'convert', 'plant.wrl', 'plant.glb', '--python', 'rename_tags.py', '-p', 'rename-tags', '--print-pipeline'], capture_output=True, text=True, check=True)
    places = [done.stdout.index(name) for name in ('expand{', 'rename-tags{', 'tessellate{')]
    assert places == sorted(places)


def test_vrml1():
    world = wrlkit.load_bytes(b'#VRML V1.0 ascii\nSeparator { Material { diffuseColor 1 0 0 } Cube { } }')
    assert world.nodes('Material')[0].diffuseColor.tolist() == [[1, 0, 0]]
    world.run('lower-vrml1')
    assert world.nodes('Material')[0].diffuseColor == (1, 0, 0)


def test_the_examples_and_pages_that_it_names_are_there():
    links = re.findall(r'\]\((.*?)\)', PAGE)
    assert len(links) >= 5 and [link for link in links if not (ROOT / 'docs' / link).exists()] == []


def test_keywords_are_the_keys_of_recipes(project):
    """As the page says, all but those that it names."""
    recipes = (ROOT / 'docs/recipes.md').read_text()

    def keys(section):
        return set(re.findall(r'^\| ([a-z-]+) \|', recipes.split(f'## [{section}]')[1].split('\n## ')[0], re.MULTILINE)) - {'key'}
    world = wrlkit.load('plant.wrl')

    def takes(call, key):
        try:
            call(**{key.replace('-', '_'): 'no value'})
        except (ValueError, wrlkit.Error):
            return True
        except TypeError as fault:
            assert 'there is no option' in str(fault)
            return False
        return True
    text = PAGE.split('Keywords of `save`')[1].split('\n- ')[0]
    left_out, further = (set(re.findall(r'`([a-z_-]+)`', part)) for part in text.split('with `_` for `-`, but')[1].split('`convert` also'))
    assert {key for key in keys('output') if not takes(lambda **o: world.save('out.glb', **o), key)} == left_out
    mine = {key for key in keys('output') | keys('input') | keys('messages') if takes(lambda **o: wrlkit.convert('plant.wrl', 'out.glb', **o), key)}
    assert mine == (keys('output') - left_out) | {key.replace('_', '-') for key in further}
