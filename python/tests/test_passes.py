"""Passes that are Python functions: names, options, documentation, faults, and that they are given the scene itself."""
import pathlib
import subprocess
import sys
import textwrap
from typing import Annotated, List, Literal

import numpy as np
import pytest
import wrlkit

CORPUS = pathlib.Path(__file__).resolve().parents[2] / 'corpus'
PUMP_ROOM = str(CORPUS / 'plant/pump_room_faces.wrl')


@wrlkit.pass_
def number_shapes(world, prefix: str = 'S', first: Annotated[int, wrlkit.Range(0)] = 1, step=2.5, up: bool = True, kind: Literal['all', 'some'] = 'all', sizes: List[float] = [0.5, 2]):
    """Give every Shape a number.

    prefix: in front of the number
    """
    shapes = world.nodes('Shape')
    for i, shape in enumerate(shapes):
        shape.name = f'{prefix}{first + i}'
    number_shapes.seen = (prefix, first, step, up, kind, sizes)
    return {'named': len(shapes)}


def world_of(tmp_path, text, name='world.wrl'):
    path = tmp_path / name
    path.write_text('#VRML V2.0 utf8\n' + text)
    return wrlkit.load(str(path))


def test_a_function_is_a_pass_among_the_others():
    world = wrlkit.load(PUMP_ROOM)
    counted = world.run('inline,expand-protos,number-shapes{prefix=P_,first=10},weld')
    shapes = world.nodes('Shape')
    assert counted['number-shapes.named'] == len(shapes) and shapes[0].name == 'P_10'
    assert number_shapes.seen == ('P_', 10, 2.5, True, 'all', [0.5, 2])
    assert 'number-shapes' in wrlkit.passes() and number_shapes.pass_name == 'number-shapes'
    assert number_shapes(world, prefix='Q')['named'] == len(shapes) and shapes[0].name == 'Q1'    # it stays a function
    world.apply('number-shapes', first=3, step=0.25, up=False, kind='some', sizes=[1, 2, 3])
    assert number_shapes.seen == ('S', 3, 0.25, False, 'some', [1, 2, 3])


@pytest.mark.parametrize('options, fault', [
    ('prefx=A', "has no option 'prefx'; did you mean 'prefix'"), ('first=-1', "'-1' is not a valid value: integer at least 0"), ('first=2.5', 'integer'), ('step=fast', 'number'),
    ('step=nan', 'number'), ('up=yes', 'bool'), ('kind=none', 'all or some'), ('sizes=1:x', 'number each')])
def test_faults_of_options(options, fault):
    with pytest.raises(ValueError, match=fault):
        wrlkit.load(PUMP_ROOM).run('number-shapes{' + options + '}')


def test_faults_of_definitions():
    with pytest.raises(TypeError, match="option 'table' has no default"):
        @wrlkit.pass_
        def no_default(world, table: str):
            pass
    with pytest.raises(TypeError, match="option 'name' needs another name"):
        @wrlkit.pass_
        def name_of_the_pass(world, name: str = ''):
            pass
    with pytest.raises(TypeError, match='neither bool'):
        @wrlkit.pass_
        def strange_type(world, table: dict = {}):
            pass
    with pytest.raises(TypeError, match='no parameter for the world'):
        @wrlkit.pass_
        def nothing():
            pass
    with pytest.raises(ValueError, match="there is a pass 'weld' already"):
        @wrlkit.pass_
        def weld(world):
            pass
    with pytest.raises(TypeError, match="its default 'x' is no integer"):
        @wrlkit.pass_
        def wrong_default(world, n: int = 'x'):
            pass


def test_an_exception_is_the_cause(tmp_path):
    @wrlkit.pass_
    def ends_badly(world):
        return {}[3]
    with pytest.raises(wrlkit.Error, match=r"pass 'ends-badly' failed: KeyError: 3 \(test_passes.py:\d+\)") as error:
        world_of(tmp_path, 'Group { }').run('ends-badly')
    assert isinstance(error.value.__cause__, KeyError) and error.value.messages[-1].name == 'python-failed'

    @wrlkit.pass_
    def counts_badly(world):
        return 7
    with pytest.raises(wrlkit.Error, match='counts-badly'):
        world_of(tmp_path, 'Group { }').run('counts-badly')


def test_what_a_pass_says_has_a_place(tmp_path):
    @wrlkit.pass_
    def complain(world):
        world.report('lost', 'no pump', world.nodes('Sphere')[0])
        with pytest.raises(ValueError):
            world.report('fatal', 'no pump')
    world = world_of(tmp_path, 'Shape {\n  geometry Sphere { } }')
    world.run('complain')
    message = world.messages[-1]
    assert (message.severity, message.name, message.text, message.line, message.column) == ('lost', 'python-lost', 'no pump', 3, 12)


def test_what_a_pass_keeps_of_a_world_stays(tmp_path):
    """The scene of a conversion is gone after it; nodes and arrays that are still held are not."""
    kept = {}

    @wrlkit.pass_
    def keeps(world):
        kept.update(world=world, node=world.find('C'), points=world.find('C').point)
    source = tmp_path / 'world.wrl'
    world_of(tmp_path, 'DEF C Coordinate { point [ 1 2 3, 4 5 6 ] }')
    wrlkit.convert(str(source), str(tmp_path / 'out.wrl'), pipeline='keeps')
    assert kept['points'].tolist() == kept['node'].point.tolist() == [[1, 2, 3], [4, 5, 6]]
    kept['node'].point = [[7, 8, 9]]
    assert kept['world'].find('C').point.tolist() == [[7, 8, 9]] and kept['points'].sum() == 21
    kept['world'].save(str(tmp_path / 'kept.wrl'))
    assert '7 8 9' in (tmp_path / 'kept.wrl').read_text() and '7 8 9' not in (tmp_path / 'out.wrl').read_text()


def test_a_pass_is_given_the_world_that_runs_it(tmp_path):
    """Nodes that it has found are those of the caller, who may go on with them."""
    world = world_of(tmp_path, 'DEF A Group { } DEF B Material { }')
    found = []

    @wrlkit.pass_
    def finds(given):
        assert given is world and given.find('A') == world.find('A')
        found.extend(given.nodes('Material'))
        given.report('warning', 'found')
        assert given.messages[-1].text == 'found'
        given.run('weld')

    @wrlkit.pass_
    def runs_another(given):
        given.run('finds')
    world.run('runs-another')
    found[0].transparency = 0.5
    assert world.find('B').transparency == 0.5 and [m.text for m in world.messages] == ['found']

    @wrlkit.pass_
    def is_lent(given):
        assert given is not world
    world.save(tmp_path / 'again.wrl')
    wrlkit.convert(tmp_path / 'again.wrl', tmp_path / 'out.wrl', pipeline='is-lent')


def test_a_pass_sees_the_memory_of_the_scene(tmp_path):
    """By address: what the pass sees is what the world has, before and behind it."""
    world = world_of(tmp_path, 'Shape { geometry IndexedFaceSet { coord DEF C Coordinate { point [ 0 0 0, 1 0 0, 0 1 0 ] } coordIndex [ 0 1 2 -1 ] } }')
    seen = []

    @wrlkit.pass_
    def looks(world):
        seen.append(world.find('C').point.ctypes.data)
        seen.append(world.nodes('IndexedFaceSet')[0].mesh().positions.ctypes.data)
    world.run('looks')
    assert set(seen) == {world.find('C').point.ctypes.data}


def test_a_million_triangles_in_a_pass_cost_no_copy(tmp_path):
    """Peak memory of a conversion with a pass that works on all points of a large mesh is that of one with a pass that does nothing."""
    n = 700
    with (tmp_path / 'grid.wrl').open('w') as out:
        out.write('#VRML V2.0 utf8\nShape { geometry IndexedFaceSet { coord Coordinate { point [\n')
        out.writelines(f'{x} {y} {x * y % 7},\n' for y in range(n + 1) for x in range(n + 1))
        out.write('] } coordIndex [\n')
        out.writelines(f'{i} {i + 1} {i + n + 1} -1 {i + 1} {i + n + 2} {i + n + 1} -1\n' for y in range(n) for i in range(y * (n + 1), y * (n + 1) + n))
        out.write('] } }\n')
    (tmp_path / 'work.py').write_text(textwrap.dedent('''
        import resource
        import wrlkit

        @wrlkit.pass_
        def work(world, much: bool = False):
            faces = world.nodes('IndexedFaceSet')[0]
            if much:
                views = [(faces.coord.point, faces.coordIndex) for i in range(10)]
                assert sum(float(points.max()) for points, index in views) == 7000 and sum(int(index.max()) for points, index in views) == 4914000
            print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss)
        '''))

    def peak(much):
        run = subprocess.run([sys.executable, '-m', 'wrlkit', 'cat', str(tmp_path / 'grid.wrl'), '-o', str(tmp_path / 'out.wrl'), '--python', str(tmp_path / 'work.py'), '-p', f'work{{much={much}}}'],
                             capture_output=True, text=True, check=True)
        return int(run.stderr.split()[0])
    assert peak('true') - peak('false') < 6000, 'one copy of the points is 11,800 kB, of the indices 15,700 kB'


def test_light_of_a_patch_file(tmp_path):
    text = '#VRML V2.0 utf8\nPointLight { location 0 3 0 } Shape { appearance Appearance { material Material { } } geometry Box { } }'
    path = tmp_path / 'room.wrl'
    path.write_text(text)
    patches = str(tmp_path / 'room.xml')
    subprocess.run([sys.executable, '-m', 'wrlkit', 'illuminate', str(path), patches, '--samples', '4', '--max-edge', '0.5'], check=True, capture_output=True)
    world = wrlkit.load(str(path))
    counted = world.apply('lightmap', patches=patches, smooth=True)
    assert counted['lightmap.patches'] == 384 and counted['lightmap.orphans'] == 0
    with pytest.raises(wrlkit.Error, match='not a patch file'):
        wrlkit.load(str(path)).apply('lightmap', patches=str(path))
