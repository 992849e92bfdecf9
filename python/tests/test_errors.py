"""Errors say what has ended the work; messages and errors are values that leave a process."""
import concurrent.futures
import copy
import multiprocessing
import pathlib
import pickle
import subprocess
import sys

import pytest
import wrlkit

CORPUS = pathlib.Path(__file__).resolve().parents[2] / 'corpus'
PUMP_ROOM = CORPUS / 'plant/pump_room_faces.wrl'


def write(path, text):
    path.write_text('#VRML V2.0 utf8\n' + text)
    return path


def test_the_error_is_what_has_ended_the_work(tmp_path):
    """Not the first error, which a conversion may survive, nor the last message."""
    source = write(tmp_path / 'a.wrl', 'Inline { url "none.wrl" }\nShape { geometry Box { sizes 1 1 1 } }')
    (tmp_path / 'taken').write_text('')
    with pytest.raises(wrlkit.Error, match='cannot write') as error:
        wrlkit.convert(source, tmp_path / 'taken/out.glb')
    names = [m.name for m in error.value.messages]
    assert 'url-not-found' in names and 'unknown-field' in names and error.value.message.name == 'cannot-write'
    assert str(error.value) == str(error.value.message)

    @wrlkit.pass_
    def gives_up(world):
        world.report('error', 'the first of many', world.nodes('Box')[0])
        raise KeyError('pump')
    world = wrlkit.load(source)
    with pytest.raises(wrlkit.Error, match=r"pass 'gives-up' failed: KeyError: 'pump' \(test_errors.py:\d+\)") as error:
        world.run('gives-up')
    assert isinstance(error.value.__cause__, KeyError) and [m.name for m in error.value.messages] == ['python-error', 'python-failed']


def test_the_error_of_a_faulty_file_has_its_place(tmp_path):
    """That nothing is left is the end of it, where it begins is the reason."""
    source = write(tmp_path / 'a.wrl', '\n  Shapes [ } ')
    with pytest.raises(wrlkit.Error, match=r'a\.wrl:3:\d+: error') as error:
        wrlkit.convert(source, tmp_path / 'out.glb')
    assert (error.value.message.file, error.value.message.line) == (str(source), 3)
    assert error.value.messages[-1].name == 'nothing-to-write' and not (tmp_path / 'out.glb').exists()


def test_the_tenth_failure_says_as_much_as_the_first(tmp_path):
    world = wrlkit.load(PUMP_ROOM)
    (tmp_path / 'taken').write_text('')
    for attempt in range(10):
        with pytest.raises(wrlkit.Error, match='cannot write') as error:
            world.save(tmp_path / f'taken/{attempt}.glb')
        assert f'{attempt}.glb' in str(error.value)
        world.report('warning', f'attempt {attempt}')
    assert [m.text for m in world.messages if m.name == 'python-warning'] == [f'attempt {n}' for n in range(10)]


def test_messages_of_a_conversion_are_returned(tmp_path):
    source = write(tmp_path / 'a.wrl', 'Shape { geometry Box { sizes 1 1 1 } }\nScript { }')
    messages = wrlkit.convert(source, tmp_path / 'out.glb')
    assert ('warning', 'unknown-field', 2) in [(m.severity, m.name, m.line) for m in messages] and all(isinstance(m, wrlkit.Message) for m in messages)


def test_errors_and_messages_are_pickled(tmp_path):
    with pytest.raises(wrlkit.Error) as raised:
        wrlkit.load(tmp_path / 'none.wrl')
    error = raised.value
    for again in (pickle.loads(pickle.dumps(error)), copy.copy(error), copy.deepcopy(error)):
        assert type(again) is wrlkit.Error and str(again) == str(error) and str(again.message) == str(error.message)
        assert [str(m) for m in again.messages] == [str(m) for m in error.messages] != []
    message = error.message
    again = pickle.loads(pickle.dumps(message))
    assert all(getattr(again, name) == getattr(message, name) for name in ('severity', 'name', 'text', 'file', 'line', 'column'))
    assert str(wrlkit.Error('mine')) == 'mine' and wrlkit.Error('mine').message is None and wrlkit.Error('mine').messages == []


def test_what_cannot_be_copied_says_so():
    world = wrlkit.load(PUMP_ROOM)
    node = world.nodes('IndexedFaceSet')[0]
    for thing, why in ((world, 'a World cannot be copied or pickled; load'), (node.mesh(), 'a Mesh cannot be copied or pickled'), (node, 'a Node is a part of its World')):
        for operation in (pickle.dumps, copy.deepcopy, copy.copy):
            if thing is node and operation is copy.copy:
                continue
            with pytest.raises(TypeError, match=why):
                operation(thing)


def test_a_copy_of_a_node_is_another_node_of_its_world():
    world = wrlkit.load(PUMP_ROOM)
    material = next(m for m in world.nodes('Material') if m.diffuseColor != (1, 0, 1))
    other = copy.copy(material)
    assert other != material and other.world is world and other.name == '' and all(other[f] == material[f] for f in material.fields)
    other.diffuseColor = 1, 0, 1
    assert material.diffuseColor != (1, 0, 1)
    assert type(copy.copy(world.roots)) is list and copy.copy(world.roots) == world.roots


def triangles(path):
    """For other processes."""
    wrlkit.load(path).apply('lod', ratios=[0.5])
    return wrlkit.load(path).info()['triangles']


@pytest.mark.parametrize('method', ['fork', 'spawn', 'forkserver'])
def test_processes(method):
    """Also those that are forks of one that has used threads of the library; errors come back from them."""
    wrlkit.load(PUMP_ROOM).apply('lod', ratios=[0.5])
    with concurrent.futures.ProcessPoolExecutor(2, mp_context=multiprocessing.get_context(method)) as pool:
        assert list(pool.map(triangles, [PUMP_ROOM] * 4, timeout=60)) == [29836] * 4
        with pytest.raises(wrlkit.Error, match='cannot read') as error:
            pool.submit(triangles, 'none.wrl').result(timeout=60)
        assert error.value.message.name == 'cannot-read'


def test_the_command_line_is_no_function_of_the_package():
    """It may end the process: its place is python3 -m wrlkit, and the script of the wheel."""
    assert not hasattr(wrlkit, 'main')
    run = subprocess.run([sys.executable, '-c', 'import sys, wrlkit.__main__; sys.argv = ["wrlkit", "--version"]; wrlkit.__main__.run()'], capture_output=True, text=True)
    assert run.returncode == 0 and wrlkit.__version__ in run.stdout


def test_worlds_in_notebooks(tmp_path, capfd):
    """Short, and nothing is printed past Python."""
    world = wrlkit.load(write(tmp_path / 'a<b>.wrl', 'Shape { geometry Box { sizes 1 1 1 } } Shape { }'))
    assert repr(world) == '<World a<b>.wrl: 3 nodes, 1 warning>'
    shown = world._repr_html_()
    assert 'a&lt;b&gt;.wrl: 3 nodes' in shown and '<th style="text-align:left">Shape</th><td style="text-align:left">2</td>' in shown and 'unknown-field' in shown
    large = wrlkit.load(PUMP_ROOM)
    assert len(large._repr_html_()) < 4000 and 'other types' in large._repr_html_() and len(repr(large)) < 80
    large.run('weld,lod')
    large.save(tmp_path / 'out.glb')
    with pytest.raises(wrlkit.Error):
        wrlkit.load(tmp_path / 'none.wrl')
    assert capfd.readouterr() == ('', '')


def test_bytes(tmp_path):
    """What save writes to files."""
    world = wrlkit.load(PUMP_ROOM)
    for name, options in (('a.glb', dict(compress='meshopt')), ('a.x3d', dict(precision=4)), ('a.wrl', {})):
        world.save(tmp_path / name, **options)
        made = world.to_bytes(name[2:], **options)
        assert made[:20] == (tmp_path / name).read_bytes()[:20]
        assert wrlkit.load_bytes(made, name).info()['triangles'] == 29836
    assert b'"textures/' in world.to_bytes('wrl') and b'"textures/' not in world.to_bytes('wrl', embed=True)
    small = wrlkit.load_bytes(b'#VRML V2.0 utf8\nPointLight { location 0 3 0 } Shape { appearance Appearance { material Material { } } geometry Box { } }')
    small.apply('lightmap', rays=4)
    for format in ('wrl', 'x3d'):
        made = small.to_bytes(format)    # there is no place for baked light next to them
        assert b'data:image/' in made and b'wrlkit:' not in made
    for format in ('gltf', 'x3dz', ''):
        with pytest.raises(ValueError, match="'format' is 'glb', 'wrl' or 'x3d', not"):
            world.to_bytes(format)
    with pytest.raises(TypeError, match="no option 'compres'"):
        world.to_bytes('glb', compres='draco')
    with pytest.raises(wrlkit.Error, match='^pump.wrl:?.*unknown-format'):
        wrlkit.load_bytes(b'nothing', 'pump.wrl')
    with pytest.raises(TypeError, match="'data' should be"):
        wrlkit.load_bytes('text')
    assert wrlkit.load_bytes(b'#VRML V2.0 utf8\nShape { geometry Sphere { radius 1 } }', unit='mm').info()['bounds']['max'][0] == pytest.approx(0.001)
