"""What the command line does, from Python: options of save, recipes, info, documentation and types of the package."""
import inspect
import pathlib
import re
import shutil
import subprocess
import sys

import numpy as np
import pytest
import wrlkit

ROOT = pathlib.Path(__file__).resolve().parents[2]
PUMP_ROOM = str(ROOT / 'corpus/plant/pump_room_faces.wrl')


def bytes_of(tmp_path, *words):
    out = tmp_path / 'by_program' / words[0]  # the name is in urls of files that come along
    subprocess.run([sys.executable, '-m', 'wrlkit', 'convert', PUMP_ROOM, str(out), *words[1:]], check=True, capture_output=True)
    return out.read_bytes()


@pytest.mark.parametrize('name, options, words', [
    ('small.glb', dict(compress='meshopt', tolerance='1mm', extras='none'), ('--compress', 'meshopt', '--tolerance', '1mm', '--extras', 'none')),
    ('cesium.glb', dict(profile='cesium'), ('--profile', 'cesium')),
    ('short.wrl', dict(precision=3), ('--precision', '3')),
    ('packed.wrz', {}, ()), ('packed.x3dz', dict(precision=4), ('--precision', '4'))])
def test_save_has_the_options_of_convert(tmp_path, name, options, words):
    target = tmp_path / name
    wrlkit.load(PUMP_ROOM).save(str(target), **options)
    assert target.read_bytes() == bytes_of(tmp_path, name, *words)


def test_options_may_be_numpys(tmp_path):
    world = wrlkit.load(PUMP_ROOM)
    counted = wrlkit.load(PUMP_ROOM).apply('lod', ratios=[0.5, 0.25], min_faces=100)
    assert world.apply('lod', ratios=np.array([0.5, 0.25]), min_faces=np.int64(100)) == counted
    world.apply('tessellate', triangles=np.True_, tolerance=np.float64(0.001))
    world.save(tmp_path / 'out.wrl', precision=np.int32(3))


def test_faults_of_options(tmp_path):
    world = wrlkit.load(PUMP_ROOM)
    with pytest.raises(TypeError, match="no option 'compres'; did you mean 'compress'"):
        world.save(str(tmp_path / 'a.glb'), compres='draco')
    for wrong in (dict(compress='zip'), dict(precision=99), dict(tolerance='soon')):
        with pytest.raises(ValueError):
            world.save(str(tmp_path / 'a.glb'), **wrong)
    assert not list(tmp_path.iterdir())


def test_recipes(tmp_path):
    recipe = str(ROOT / 'recipes/plant-web.toml')
    wrlkit.convert(PUMP_ROOM, str(tmp_path / 'a.glb'), recipe=recipe)
    assert (tmp_path / 'a.glb').read_bytes() == bytes_of(tmp_path, 'a.glb', '--recipe', recipe)
    wrlkit.convert(PUMP_ROOM, str(tmp_path / 'b.glb'), recipe=recipe, pipeline='weld', compress='none')
    assert (tmp_path / 'b.glb').read_bytes() == bytes_of(tmp_path, 'b.glb', '-p', 'weld', '--tolerance', '1mm')
    (tmp_path / 'faulty.toml').write_text('[output]\ncompres = "draco"\n')
    with pytest.raises(ValueError, match="faulty.toml:2:1: error: .*did you mean 'compress'"):
        wrlkit.convert(PUMP_ROOM, str(tmp_path / 'c.glb'), recipe=str(tmp_path / 'faulty.toml'))
    (tmp_path / 'no.wrl').write_text('nothing')
    with pytest.raises(wrlkit.Error, match='unknown-format'):
        wrlkit.convert(str(tmp_path / 'no.wrl'), str(tmp_path / 'c.glb'))


def test_info():
    facts = wrlkit.info(PUMP_ROOM)
    assert (facts['format'], facts['shapes'], facts['triangles'], facts['nodes']['Viewpoint']) == ('vrml97', 623, 29836, 4)
    assert facts['unique'] < facts['triangles'] and 'forms' not in facts
    assert wrlkit.info(PUMP_ROOM, recognise=True)['forms']['kinds']['cylinder'] > 400
    world = wrlkit.load(PUMP_ROOM, unit='mm', up='z')
    assert world.info()['bounds']['max'][0] == pytest.approx(0.016)
    assert len(world.nodes()) == len(wrlkit.load(PUMP_ROOM).nodes()) + 1    # looking has changed nothing


def test_every_public_name_is_documented():
    def undocumented(name, value):
        if not inspect.getdoc(value) and not isinstance(value, type(wrlkit)):
            yield name
        if inspect.isclass(value):
            for member, what in vars(value).items():
                if not member.startswith('_') and not inspect.getdoc(what):
                    yield f'{name}.{member}'
    assert wrlkit.__doc__ and [n for name in wrlkit.__all__ for n in undocumented(name, getattr(wrlkit, name))] == []
    assert all(doc for doc, fields in wrlkit.node_types().values())


def test_types(tmp_path):
    """The stubs that the build makes are what a checker wants: right use has no fault, wrong use has its own."""
    if not shutil.which('mypy'):
        pytest.skip('mypy is not installed')
    (tmp_path / 'right.py').write_text('''import pathlib
import wrlkit
from wrlkit import nodes

world: wrlkit.World = wrlkit.load('plant.wrl', allow=['textures'])
for material in world.nodes('Material'):
    red: float = material.diffuseColor[0]
    material.transparency = 0.5
points = world.nodes('Coordinate')[0].point * 2.0
lamp: nodes.PointLight = world.add('PointLight', on=True)
world.save('plant.glb', compress='meshopt')
counted: int = world.run('weld')['weld.points']
text: str = world.messages[0].text
facts = wrlkit.info('plant.wrl')
data: bytes = world.to_bytes('glb', compress='meshopt')
again: wrlkit.World = wrlkit.load_bytes(data)
shape: int = world.nodes('PixelTexture')[0].image.shape[2]
lines = [message.line for message in wrlkit.convert('plant.wrl', 'plant.glb')]
try:
    world.run('weld')
except wrlkit.Error as error:
    place: str = error.message.file if error.message else error.messages[0].file

@wrlkit.pass_
def paint(world: wrlkit.World, table: pathlib.Path = pathlib.Path('a.csv')) -> None:
    """Paint."""

paint(world)
''')
    (tmp_path / 'wrong.py').write_text('''import wrlkit

world = wrlkit.load(7)
world.nodes('Material')[0].transparency = 'much'
world.saves('plant.glb')
wrlkit.passes(1)
''')
    run = subprocess.run(['mypy', '--strict', '--cache-dir', str(tmp_path / 'cache'), '--python-executable', sys.executable, 'right.py', 'wrong.py'], cwd=tmp_path, capture_output=True, text=True,
                         env={'MYPYPATH': str(pathlib.Path(wrlkit.__file__).parents[1]), 'PATH': '/usr/bin:/bin'})
    faults = re.findall(r'^(\w+\.py):(\d+): error', run.stdout, re.MULTILINE)
    assert sorted(set(faults)) == [('wrong.py', line) for line in '3456'], run.stdout + run.stderr
