"""Values of fields: the shape and the type of each, what is read only, what is written, and texts that are no UTF-8."""
import operator
import pathlib

import numpy as np
import pytest
import wrlkit

SINGLE = {'SFBool': True, 'SFInt32': 3, 'SFFloat': 0.5, 'SFDouble': 0.5, 'SFTime': 0.5, 'SFString': 'text', 'SFEnum': 'text', 'SFBitMask': 'text'}
VECTORS = {'SFVec2f': 2, 'SFVec2d': 2, 'SFVec3f': 3, 'SFVec3d': 3, 'SFVec4f': 4, 'SFVec4d': 4, 'SFColor': 3, 'SFColorRGBA': 4, 'SFRotation': 4, 'SFMatrix3f': 9, 'SFMatrix4f': 16}


def world_of(tmp_path, text, name='world.wrl'):
    path = tmp_path / name
    path.write_text('#VRML V2.0 utf8\n' + text)
    return wrlkit.load(path)


def holds(kind, value):
    """Whether a field of that type may be read so."""
    if kind in SINGLE:
        return type(value) is type(SINGLE[kind])
    if kind in VECTORS:
        return type(value) is tuple and len(value) == VECTORS[kind] and all(type(v) is float for v in value)
    if kind == 'SFNode':
        return value is None or isinstance(value, wrlkit.Node)
    if kind in ('MFNode', 'MFString', 'MFImage'):
        return isinstance(value, list)
    if value.flags.writeable:
        return False
    if kind == 'SFImage':
        return value.dtype == np.uint8 and value.ndim == 3
    if kind in ('MFInt32', 'MFBool'):
        return value.dtype == {'MFInt32': np.int32, 'MFBool': bool}[kind] and value.ndim == 1
    width = VECTORS.get('S' + kind[1:], 1)
    return value.dtype == np.float64 and (value.ndim == 1 if width == 1 else value.shape[1:] == (width,))


def test_every_field_of_the_node_table_is_read_so_and_written_back(tmp_path):
    """The value that a field is read as can be written to it."""
    world = world_of(tmp_path, '')
    kinds = set()
    for name, (_, fields) in wrlkit.node_types().items():
        try:
            node = world.add(name)
        except ValueError:
            continue    # an abstract type
        for field, kind in fields:
            value = node[field]
            assert holds(kind, value), (name, field, kind, value)
            node[field] = value
            kinds.add(kind)
    assert len(kinds) > 25


@pytest.mark.parametrize('node, field, value, read', [
    ('Coordinate', 'point', [[1, 2, 3], [4, 5, 6]], [[1, 2, 3], [4, 5, 6]]),
    ('Coordinate', 'point', [1, 2, 3, 4, 5, 6], [[1, 2, 3], [4, 5, 6]]),
    ('Coordinate', 'point', np.ones((1, 3), np.float32), [[1, 1, 1]]),
    ('Coordinate', 'point', np.arange(12.).reshape(6, 2).T[:, ::2].copy(), [[0, 4, 8], [1, 5, 9]]),
    ('Coordinate', 'point', [], []),
    ('TextureCoordinate', 'point', [(0, 1)], [[0, 1]]),
    ('IndexedFaceSet', 'coordIndex', np.array([0, 1, 2, -1]), [0, 1, 2, -1]),
    ('IndexedFaceSet', 'coordIndex', [0., 1., 2.], [0, 1, 2]),
    ('IndexedFaceSet', 'coordIndex', np.arange(6)[::2], [0, 2, 4]),
    ('ElevationGrid', 'height', (1, 2), [1, 2]),
    ('BooleanSequencer', 'keyValue', [True, 0, np.True_], [True, False, True]),
    ('ImageTexture', 'url', ('a', 'b'), ['a', 'b']),
    ('ImageTexture', 'url', 'a', ['a']),
    ('ImageTexture', 'url', (name for name in 'ab'), ['a', 'b']),
    ('PointLight', 'on', np.False_, False),
    ('Material', 'transparency', np.float32(0.5), 0.5),
    ('Switch', 'whichChoice', np.int64(2), 2)])
def test_what_may_be_written(tmp_path, node, field, value, read):
    made = world_of(tmp_path, '').add(node)
    made[field] = value
    assert (made[field].tolist() if isinstance(made[field], np.ndarray) else made[field]) == read


@pytest.mark.parametrize('node, field, value, fault', [
    ('IndexedFaceSet', 'coordIndex', [[0, 1, 2], [2, 3, 0]], r'coordIndex is an MFInt32: a list of ints, not list \[\[0, 1, 2\], \[2, 3, 0\]\]'),
    ('IndexedFaceSet', 'coordIndex', np.zeros((2, 3), int), r'a list of ints, not an array of shape \(2, 3\) of int64'),
    ('IndexedFaceSet', 'coordIndex', np.array([0.5]), r'not an array of shape \(1,\) of float64'),
    ('Coordinate', 'point', np.zeros((3, 2)), r'Coordinate.point is an MFVec3f: a list of 3 numbers each, not an array of shape \(3, 2\) of float64'),
    ('Coordinate', 'point', np.zeros((2, 2, 3)), r'shape \(2, 2, 3\)'),
    ('Coordinate', 'point', [1, 2, 3, 4], r'3 numbers each, not list \[1, 2, 3, 4\]'),
    ('Coordinate', 'point', ['1', '2', '3'], 'not list'),
    ('Coordinate', 'point', [[1, 2, 3], [4, 5]], 'not list'),
    ('Coordinate', 'point', None, 'not None'),
    ('ElevationGrid', 'height', np.zeros((2, 2)), r'a list of numbers, not an array of shape \(2, 2\)'),
    ('BooleanSequencer', 'keyValue', [2], 'a list of True and False, not list'),
    ('PointLight', 'on', None, 'True or False, not None'),
    ('PointLight', 'on', 0.5, 'True or False, not float 0.5'),
    ('PointLight', 'on', 'no', "True or False, not str 'no'"),
    ('PointLight', 'on', [True], 'True or False, not list'),
    ('Switch', 'whichChoice', 1.0, 'an int, not float 1.0'),
    ('ImageTexture', 'url', [b'a'], 'a list of texts, not list'),
    ('ImageTexture', 'url', 7, 'a list of texts, not int 7'),
    ('Material', 'transparency', '0.5', "a number, not str '0.5'"),
    ('PixelTexture', 'image', np.zeros((2, 2, 5), np.uint8), r'an array of bytes \(height, width, components\), not an array of shape \(2, 2, 5\)'),
    ('PixelTexture', 'image', np.zeros((2, 2, 3)), 'of float64'),
    ('PixelTexture', 'image', [2, 2, 3, 0], 'PixelTexture.image is an SFImage'),
    ('PixelTexture', 'image', [-1, 2, 3], 'SFImage')])
def test_what_may_not_be_written(tmp_path, node, field, value, fault):
    made = world_of(tmp_path, '').add(node)
    before = repr(made[field])
    with pytest.raises(TypeError, match=fault):
        made[field] = value
    assert repr(made[field]) == before


def test_what_a_faulty_file_has_may_be_written_back(tmp_path):
    font, = world_of(tmp_path, 'FontStyle { justify "CENTRE" }').roots
    font.justify = font.justify
    with pytest.raises(ValueError, match='FontStyle.justify'):
        font.justify = ['RIGTH']
    assert font.justify == ['CENTRE']


def test_pictures(tmp_path):
    """As NumPy, Pillow and matplotlib have them: the top row first, which is the last in the file."""
    world = world_of(tmp_path, 'PixelTexture { image 2 2 3 0xff0000 0x00ff00 0x0000ff 0x010203 } PixelTexture { image 1 2 1 5 7 } PixelTexture { image 2 2 4 0 }')
    colours, grey, short = world.roots
    assert colours.image.tolist() == [[[0, 0, 255], [1, 2, 3]], [[255, 0, 0], [0, 255, 0]]] and grey.image.tolist() == [[[7]], [[5]]]
    assert short.image.shape == world.add('PixelTexture').image.shape == (0, 0, 0)
    colours.image = colours.image[::-1]
    grey.image = np.array([[1, 2, 255]])    # height and width alone: one component
    short.image = [1, 1, 4, 0xff00ff80]     # as the standard has it
    assert short.image.tolist() == [[[255, 0, 255, 128]]]
    world.save(tmp_path / 'out.wrl')
    again = wrlkit.load(tmp_path / 'out.wrl').roots
    assert again[0].image.tolist() == [[[255, 0, 0], [0, 255, 0]], [[0, 0, 255], [1, 2, 3]]]
    assert again[1].image.tolist() == [[[1], [2], [255]]] and again[2].image.tolist() == [[[255, 0, 255, 128]]]
    colours.image = np.zeros((0, 4, 3), np.uint8)
    assert colours.image.shape == (0, 0, 0)


def test_what_a_field_holds_cannot_be_changed_in_place(tmp_path):
    """A change of a copy would be silent."""
    world = world_of(tmp_path, 'DEF G Group { children [ Shape { } Shape { appearance Appearance { texture ImageTexture { url [ "a" "b" ] } } } ] }')
    group, texture = world.find('G'), world.nodes('ImageTexture')[0]
    light = world.add('PointLight')
    changes = {
        r'Group.children is read as a copy, which cannot be changed; write it as a whole': [lambda: group.children.append(light), lambda: group.children.pop(), lambda: operator.setitem(group.children, 0, light)],
        r'ImageTexture.url is read as a copy': [lambda: texture.url.extend(['c']), lambda: texture.url.sort(), lambda: operator.delitem(texture.url, 0)],
        r'World.roots is read as a copy': [lambda: world.roots.append(light), lambda: world.roots.clear()],
        r"'tuple' object does not support item assignment": [lambda: operator.setitem(light.location, 0, 1)]}
    for message, calls in changes.items():
        for call in calls:
            with pytest.raises(TypeError, match=message):
                call()
    coordinate = world.add('Coordinate', point=[[1, 2, 3]])
    with pytest.raises(ValueError, match='read-only'):
        coordinate.point[0] = 4, 5, 6
    with pytest.raises(ValueError):
        coordinate.point += 1
    with pytest.raises(ValueError):
        coordinate.point.flags.writeable = True
    assert coordinate.point.tolist() == [[1, 2, 3]] and len(group.children) == 2 and texture.url == ['a', 'b']


def test_lists_are_lists_otherwise(tmp_path):
    world = world_of(tmp_path, 'DEF G Group { children [ Shape { } Shape { } ] }')
    group = world.find('G')
    light = world.add('PointLight')
    kept = group.children
    group.children += [light]
    group.children = group.children + [world.add('Group')]
    assert [n.type for n in group.children] == ['Shape', 'Shape', 'PointLight', 'Group'] and len(kept) == 2
    own = list(group.children)
    own.append(light)
    assert type(group.children[:2]) is type(group.children.copy()) is list and isinstance(group.children, list)
    world.roots += [light]
    assert [n.type for n in world.roots] == ['Group', 'PointLight']
    texture = world.add('ImageTexture', url='a')
    texture.url *= 2
    assert texture.url == ['a', 'a'] and repr(texture.url) == "['a', 'a']"


def test_texts_that_are_no_utf8(tmp_path):
    """Files: ISO 8859-1 is repaired. Programs: bytes are what os.fsdecode makes of them, and come back."""
    (tmp_path / 'latin.wrl').write_bytes(b'#VRML V2.0 utf8\nDEF K\xfchler Transform { children WorldInfo { title "\xe9t\xe9" info [ "\xff" ] } }')
    world = wrlkit.load(tmp_path / 'latin.wrl')
    assert world.find('Kühler').children[0].title == 'été' and world.nodes('WorldInfo')[0].info == ['ÿ']
    assert {m.name for m in world.messages} == {'encoding-repaired'}
    info = world.nodes('WorldInfo')[0]
    info.title = 'a\udcffb'
    info.name = 'n\udcff'
    assert info.title == 'a\udcffb' and info.name == 'n\udcff' and world.find('n\udcff') == info
    assert repr(info) == '<WorldInfo n\\xff>'
    world.save(tmp_path / 'out.wrl')
    assert wrlkit.load(tmp_path / 'out.wrl').nodes('WorldInfo')[0].title == 'aÿb'
    with pytest.raises(UnicodeEncodeError):
        info.title = '\ud800'
    with pytest.raises(AttributeError, match='has no field'):
        info['\udcff']


def test_names_of_files_that_are_no_utf8(tmp_path):
    path = tmp_path / 'pl\udcffnt.wrl'
    path.write_text('#VRML V2.0 utf8\nShape { geometry Sphere { radiuss 1 } }')
    world = wrlkit.load(path)
    message, = world.messages
    assert message.file == world.path == str(path) and pathlib.Path(message.file).exists()
    assert 'pl\\xffnt.wrl:2:27: warning' in str(message) and str(message).isascii() and 'pl\\xffnt.wrl' in repr(world)
    world.save(tmp_path / 'o\udcffut.glb')
    assert wrlkit.convert(path, tmp_path / 'o\udcffut.x3d')[0].name == 'unknown-field'
    assert sorted(p.name for p in tmp_path.iterdir()) == ['o\udcffut.glb', 'o\udcffut.x3d', 'pl\udcffnt.wrl']
    with pytest.raises(wrlkit.Error, match=r"cannot read '.*no\\xff.wrl'"):
        wrlkit.load(tmp_path / 'no\udcff.wrl')
    with pytest.raises(ValueError, match=r'\\xff.obj'):
        world.save(tmp_path / '\udcff.obj')


def test_long_names_in_messages_are_cut_between_characters(tmp_path):
    """A message shows the beginning of a name; half a character is no text."""
    world = world_of(tmp_path, 'Shape { geometry Sphere { ' + 'x' + 'ü' * 100 + ' 2 } }')
    text = world.messages[0].text
    assert 'xüü' in text and '\\x' not in text
