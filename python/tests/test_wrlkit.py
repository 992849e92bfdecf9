"""The Python package: fields as attributes, arrays without copies, passes, errors with places."""
import pathlib
import resource
import subprocess
import sys
import textwrap
import threading

import numpy as np
import pytest
import wrlkit

CORPUS = pathlib.Path(__file__).resolve().parents[2] / 'corpus'
PUMP_ROOM = str(CORPUS / 'plant/pump_room_faces.wrl')


def world_of(tmp_path, text, name='world.wrl'):
    path = tmp_path / name
    path.write_text('#VRML V2.0 utf8\n' + text)
    return wrlkit.load(str(path))


def test_fields_are_attributes(tmp_path):
    world = world_of(tmp_path, 'DEF Red Material { diffuseColor 1 0 0 }')
    red, = world.roots
    assert (red.type, red.name, red.diffuseColor, red.shininess) == ('Material', 'Red', (1, 0, 0), 0.2)
    red.diffuseColor = 0, 0.5, 1
    red.transparency = 0.25
    red.name = 'Blue'
    world.save(str(tmp_path / 'out.wrl'))
    text = (tmp_path / 'out.wrl').read_text()
    assert 'DEF Blue Material' in text and 'diffuseColor 0 0.5 1' in text and 'transparency 0.25' in text
    assert wrlkit.load(str(tmp_path / 'out.wrl')).find('Blue').transparency == 0.25


def test_faults_of_attributes(tmp_path):
    world = world_of(tmp_path, 'Material { }')
    material, = world.roots
    with pytest.raises(AttributeError, match="did you mean 'diffuseColor'"):
        material.difuseColor
    with pytest.raises(AttributeError):
        material.difuseColor = 1, 1, 1
    for value in ((1, 2), 'red', None):
        with pytest.raises((TypeError, ValueError)):
            material.diffuseColor = value
    other = world_of(tmp_path, 'Group { }', 'other.wrl')
    with pytest.raises(ValueError, match='another world'):
        other.roots[0].children = [material]


def test_nodes_can_be_made(tmp_path):
    world = world_of(tmp_path, '')
    shape = world.add('Shape', geometry=world.add('Box', size=(1, 2, 3)), appearance=world.add('Appearance', material=world.add('Material')))
    world.roots = [world.add('Transform', translation=(0, 1, 0), children=[shape])]
    assert sorted(n.type for n in world.nodes()) == ['Appearance', 'Box', 'Material', 'Shape', 'Transform']
    assert world.nodes('X3DGeometryNode')[0].size == (1, 2, 3)
    world.save(str(tmp_path / 'box.glb'))
    assert (tmp_path / 'box.glb').read_bytes()[:4] == b'glTF'
    with pytest.raises(ValueError):
        world.add('Boxx')


def test_arrays_are_the_memory_of_the_scene(tmp_path):
    world = world_of(tmp_path, 'Shape { geometry IndexedFaceSet { coord Coordinate { point [ 0 0 0, 1 0 0, 0 1 0 ] } coordIndex [ 0 1 2 -1 ] } }')
    faces = world.nodes('IndexedFaceSet')[0]
    points = faces.coord.point
    assert points.shape == (3, 3) and points.dtype == np.float64 and not points.flags.writeable
    assert points.ctypes.data == faces.coord.point.ctypes.data == faces.mesh().positions.ctypes.data
    assert faces.coordIndex.tolist() == [0, 1, 2, -1] and faces.mesh().corners.tolist() == [0, 1, 2]
    faces.coord.point = points * 2
    assert faces.coord.point.tolist() == [[0, 0, 0], [2, 0, 0], [0, 2, 0]]
    assert points.tolist() == [[0, 0, 0], [1, 0, 0], [0, 1, 0]]    # what was read stays what it was
    del faces, world
    assert points.sum() == 2                                       # and holds the world


def test_a_million_triangles_cost_no_copy(tmp_path):
    """Peak memory of a process that looks at all points ten times over is that of one that only loads them."""
    n = 700
    path = tmp_path / 'grid.wrl'
    with path.open('w') as out:
        out.write('#VRML V2.0 utf8\nShape { geometry IndexedFaceSet { coord Coordinate { point [\n')
        out.writelines(f'{x} {y} {x * y % 7},\n' for y in range(n + 1) for x in range(n + 1))
        out.write('] } coordIndex [\n')
        out.writelines(f'{i} {i + 1} {i + n + 1} -1 {i + 1} {i + n + 2} {i + n + 1} -1\n' for y in range(n) for i in range(y * (n + 1), y * (n + 1) + n))
        out.write('] } }\n')

    def peak(code):
        run = subprocess.run([sys.executable, '-c', textwrap.dedent(f'''
            import numpy, resource, wrlkit
            world = wrlkit.load({str(path)!r})
            coordinate = world.nodes('Coordinate')[0]
            {code}
            print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss)''')], capture_output=True, text=True, check=True)
        return int(run.stdout)
    kept = peak('kept = [coordinate.point for i in range(10)]; assert sum(float(k[:, 2].max()) for k in kept) == 60')
    assert kept - peak('pass') < 6000, 'one copy of the points is 11,800 kB'


def test_passes():
    world = wrlkit.load(str(CORPUS / 'plant/pump_room_primitives.wrl'))
    assert world.nodes('Cylinder') and len(world.nodes('Cylinder')[0].mesh().positions) == 0
    counted = world.run('inline,expand-protos,tessellate,weld')
    assert 'weld' in wrlkit.passes() and any(name.startswith('tessellate') for name in counted)
    assert not world.nodes('Cylinder') and all(len(f.mesh().positions) for f in world.nodes('IndexedFaceSet'))
    with pytest.raises(ValueError, match="did you mean 'weld'"):
        world.run('wedl')


def test_errors_have_places(tmp_path):
    (tmp_path / 'no.wrl').write_text('nothing')
    with pytest.raises(wrlkit.Error, match=r'no\.wrl.*unknown-format') as error:
        wrlkit.load(str(tmp_path / 'no.wrl'))
    assert error.value.messages[0].name == 'unknown-format'
    world = world_of(tmp_path, 'Shape { geometry Sphere {\n  radiuss 2 } }')
    message, = world.messages
    assert (message.severity, message.name, message.line, message.column) == ('warning', 'unknown-field', 3, 3)
    with pytest.raises(wrlkit.Error, match='is not a folder'):
        world.save(str(tmp_path / 'no.wrl/out.wrl'))
    world.save(tmp_path / 'nowhere/out.wrl')  # a pathlib.Path, in a folder that is made
    assert wrlkit.load(tmp_path / 'nowhere/out.wrl', allow=[tmp_path]).nodes('Sphere')
    with pytest.raises(ValueError, match="no node type 'Spere'; did you mean 'Sphere'"):
        world.nodes('Spere')
    with pytest.raises(ValueError):
        world.save(str(tmp_path / 'out.obj'))


def test_other_threads_go_on():
    done, beats = threading.Event(), []

    def beat():
        while not done.wait(0.001):
            beats.append(1)
    thread = threading.Thread(target=beat)
    thread.start()
    world = wrlkit.load(PUMP_ROOM)
    before = len(beats)
    world.run('inline,expand-protos,tessellate{triangles=true},weld,lod')
    during = len(beats) - before
    done.set()
    thread.join()
    assert during > 0


def test_fields_that_are_called_as_properties(tmp_path):
    navigation, = world_of(tmp_path, 'NavigationInfo { type "WALK" }').roots
    assert navigation.type == 'NavigationInfo' and navigation['type'] == ['WALK']
    navigation['type'] = 'FLY'
    assert navigation['type'] == ['FLY']
    with pytest.raises(AttributeError, match=r"Node.type cannot be set; the field of that name is node\['type'\]"):
        navigation.type = 'WALK'
    with pytest.raises(AttributeError, match='Node.world cannot be set$'):
        navigation.world = None


def test_what_a_file_would_be_warned_of_is_an_error():
    world = wrlkit.load(PUMP_ROOM)
    material = world.nodes('Material')[0]
    before = material.diffuseColor
    for value in ((float('nan'), 0, 0), (2, 0, 0)):
        with pytest.raises(ValueError, match='diffuseColor'):
            material.diffuseColor = value
    assert material.diffuseColor == before
    with pytest.raises(ValueError, match='Material'):
        world.nodes('Shape')[0].geometry = material
    with pytest.raises(TypeError, match='MFRotation'):
        world.add('OrientationInterpolator').keyValue = [[1, 2], [3, 4]]


def test_names_that_no_reader_would_take_are_changed_where_they_are_written(tmp_path):
    world = wrlkit.load(PUMP_ROOM)
    world.nodes('Shape')[0].name = 'TK 101 {A}'
    world.save(tmp_path / 'out.wrl')
    assert any(m.name == 'name-changed' for m in world.messages)
    assert wrlkit.load(tmp_path / 'out.wrl').find('TK_101__A_') is not None


def test_no_name_is_no_name(tmp_path):
    assert world_of(tmp_path, 'Shape { geometry Box { } }').find('') is None


def test_a_group_in_itself_is_not_written(tmp_path):
    world = wrlkit.load(PUMP_ROOM)
    group = world.add('Group')
    group.children = [group]
    world.roots = [*world.roots, group]
    with pytest.raises(wrlkit.Error):
        world.save(tmp_path / 'out.wrl')
    assert not (tmp_path / 'out.wrl').exists()


def test_wrong_arguments_are_named(tmp_path):
    """What was given and what is expected, where pybind11 lists its signatures."""
    world = world_of(tmp_path, 'DEF Red Material { }')
    calls = {
        r"load\(\): 'path' should be a path \(str or pathlib.Path\), not int 5": lambda: wrlkit.load(5),
        r"load\(\): 'allow' should be a list of paths, not str 'textures'": lambda: wrlkit.load('a.wrl', 'textures'),
        r"load\(\) has no parameter 'units'; did you mean 'unit'\?": lambda: wrlkit.load('a.wrl', units='mm'),
        r"load\(\) needs 'path': a path": lambda: wrlkit.load(),
        r"World.run\(\): 'pipeline' should be a str, not list \['weld'\]": lambda: world.run(['weld']),
        r"World.find\(\): 'name' should be a str, not None": lambda: world.find(None),
        r'World.find\(\) takes at most 1 arguments by position, not 2': lambda: world.find('a', 'b'),
        r"World.save\(\): 'path' should be a path": lambda: world.save(None),
        r"convert\(\): 'target' should be a path .* not None": lambda: wrlkit.convert('a.wrl', None),
        r'Material.diffuseColor is an SFColor: 3 numbers, not str .red.': lambda: setattr(world.roots[0], 'diffuseColor', 'red'),
        r'Group.children is an MFNode: a list of Nodes, not int 5': lambda: world.add('Group', children=5),
        r'Group.children is an MFNode: a list of Nodes, not list \[None\]': lambda: world.add('Group', children=[None]),
        r'IndexedFaceSet.coordIndex is an MFInt32: a list of ints, not list \[0.5, 1\]': lambda: world.add('IndexedFaceSet', coordIndex=[0.5, 1]),
        r'IndexedFaceSet.coordIndex is an MFInt32: a list of ints, not list \[4294967296\]': lambda: world.add('IndexedFaceSet', coordIndex=[2**32]),
        r"IndexedFaceSet.coordIndex is an MFInt32: a list of ints, not list \['1'\]": lambda: world.add('IndexedFaceSet', coordIndex=['1']),
        r"World.report\(\): 'node' should be a Node, not str 'x'": lambda: world.report('warning', 'text', 'x'),
        r'World.roots is a list of Nodes, not int 5': lambda: setattr(world, 'roots', 5),
        r'Node.name is a str, not int 5': lambda: setattr(world.roots[0], 'name', 5),
        r'Node\[...\]: the name of a field is expected, a str, not int 5': lambda: world.roots[0][5],
        r'Node\[...\]: the name of a field is expected, a str, not int 6': lambda: world.roots[0].__setitem__(6, 1),
        r'pass_\(\): a function is expected, not int 5': lambda: wrlkit.pass_(5),
        r"pass_\(\): 'name' should be a str, not int 5": lambda: wrlkit.pass_(name=5)(print),
        r"info\(\): 'path' should be a path .* not int 5": lambda: wrlkit.info(5),
        r'a Node comes from World.nodes\(\), find\(\) or add\(\)': lambda: wrlkit.Node('Box'),
        r'a World comes from wrlkit.load\(path\)': lambda: wrlkit.World(),
        r'a Mesh comes from Node.mesh\(\)': lambda: wrlkit.Mesh(),
        r'a Message comes from World.messages or from an Error': lambda: wrlkit.Message('text'),
        r'Node.mesh\(\) takes no arguments': lambda: world.roots[0].mesh(1),
        r"Range\(\): 'most' should be a number or None, not str '1'": lambda: wrlkit.Range(0, '1'),
    }
    for message, call in calls.items():
        with pytest.raises(TypeError, match=message) as error:
            call()
        assert 'incompatible' not in str(error.value) and error.value.__context__ is None


def test_lengths_have_units(tmp_path):
    """Options of passes take lengths as the command line does."""
    points = '[ 0 0 0, 1 0 0, 0 1 0, 1.0004 0 0, 1 1 0, 0 1.0004 0 ]'
    for tolerance, left in (('1mm', 4), (0.001, 4), ('0.1mm', 6)):
        world = world_of(tmp_path, f'Shape {{ geometry IndexedFaceSet {{ coord Coordinate {{ point {points} }} coordIndex [ 0 1 2 -1 3 4 5 -1 ] }} }}')
        world.apply('weld', tolerance=tolerance)
        assert len(world.nodes('Coordinate')[0].point) == left
    with pytest.raises(ValueError, match="'1 parsec' is not a valid value: length or auto, as 0.5mm"):
        world.apply('weld', tolerance='1 parsec')
    world.apply('lod', errors=['1mm', '5mm'])
    world.apply('tessellate', tolerance='1 cm')
