"""Baked light (MOZ_lightmap): a second UV map, and nodes of the material that multiply the light with the base colour.

What a surface shows is then its light alone, without lamps, whose light is in the picture. The Principled BSDF stays in the node tree, not connected;
`unlit` connects it for an export."""
import contextlib
import math

import bpy
import numpy

UV_MAP = 'Lightmap'
MIX, SHADER = 'Baked light', 'Baked light shader'
IMAGE, INTENSITY = 'wrlkit_light', 'wrlkit_light_intensity'


def add(file, materials, meshes):
    """Gives the materials ({number in the file: materials}) of the meshes their light. Returns how many have some."""
    pictures, infos = {}, {}
    for i, made in materials.items():
        info = file.get('materials')[i].get('extensions', {}).get('MOZ_lightmap')
        if info and (image := _picture(file, info['index'], pictures)):
            for m in made:
                infos[m] = info
                _wire(m, image, info.get('intensity', 1))
    for mesh in meshes:
        _uv_map(mesh, [infos.get(m) for m in mesh.materials])
    return len(infos)


def _picture(file, texture, pictures):
    if texture not in pictures:
        pictures[texture] = None
        if found := file.picture(texture):
            name, data = found
            image = bpy.data.images.new(name, 8, 8)  # the size is that of the data
            image.pack(data=data, data_len=len(data))
            image.source = 'FILE'
            pictures[texture] = image
    return pictures[texture]


def _uv_map(mesh, infos):
    """infos: of each material slot. The transformation that glTF has in the material goes into the coordinates."""
    if not any(infos):
        return
    layers = mesh.uv_layers
    corners = len(mesh.loops)
    maps = [numpy.empty(2 * corners, numpy.float32) for _ in layers]
    for layer, values in zip(layers, maps):
        layer.data.foreach_get('uv', values)
    maps = [m.reshape(-1, 2) for m in maps]
    slots = numpy.empty(len(mesh.polygons), numpy.int32)
    sizes = numpy.empty(len(mesh.polygons), numpy.int32)
    mesh.polygons.foreach_get('material_index', slots)
    mesh.polygons.foreach_get('loop_total', sizes)
    slot_of_corner = numpy.repeat(slots, sizes)
    out = numpy.zeros((corners, 2), numpy.float32)
    for slot, info in enumerate(infos):
        transform = (info or {}).get('extensions', {}).get('KHR_texture_transform', {})
        source = transform.get('texCoord', (info or {}).get('texCoord', 0))
        if info and source < len(maps):
            chosen = slot_of_corner == slot
            out[chosen] = _transformed(maps[source][chosen], transform)
    layer = layers[1] if len(layers) > 1 else layers.new(name=UV_MAP, do_init=False)
    layer.name = UV_MAP
    layer.data.foreach_set('uv', out.ravel())


def _transformed(uv, transform):
    """KHR_texture_transform; Blender has v from the lower edge, glTF from the upper one."""
    ox, oy = transform.get('offset', (0, 0))
    sx, sy = transform.get('scale', (1, 1))
    angle = transform.get('rotation', 0)
    c, s = math.cos(angle), math.sin(angle)
    u, v = uv[:, 0] * sx, (1 - uv[:, 1]) * sy
    return numpy.stack((ox + c * u + s * v, 1 - (oy - s * u + c * v)), axis=1)


def _wire(material, image, intensity):
    tree = material.node_tree
    material[IMAGE] = image.name
    material[INTENSITY] = float(intensity)
    principled = _first(tree, 'BSDF_PRINCIPLED')
    emission = tree.nodes.new('ShaderNodeEmission') if principled else _first(tree, 'EMISSION')
    socket = principled.inputs['Base Color'] if principled else emission.inputs['Color']
    mix = tree.nodes.new('ShaderNodeMixRGB')
    mix.name = mix.label = MIX
    mix.blend_type = 'MULTIPLY'
    mix.inputs['Fac'].default_value = 1
    mix.location = (300, -100)
    tree.links.new(mix.inputs['Color1'], _source(tree, socket))
    tree.links.new(mix.inputs['Color2'], _texture(tree, image).outputs['Color'])
    tree.links.new(emission.inputs['Color'], mix.outputs['Color'])
    emission.inputs['Strength'].default_value = intensity
    if principled:
        emission.location = (500, -100)
        tree.links.new(_output(tree).inputs['Surface'], _with_alpha(tree, principled, emission))


def _first(tree, kind):
    return next(n for n in [*tree.nodes, None] if n is None or n.type == kind)


def _output(tree):
    return next(n for n in tree.nodes if n.type == 'OUTPUT_MATERIAL' and n.is_active_output)


def _source(tree, socket):
    """The socket that a colour comes from; one of a new node where it is a value."""
    if not socket.is_linked:
        node = tree.nodes.new('ShaderNodeRGB')
        node.outputs[0].default_value = socket.default_value
        node.location = (-200, 300)
        tree.links.new(socket, node.outputs[0])
    return socket.links[0].from_socket


def _texture(tree, image):
    uv = tree.nodes.new('ShaderNodeUVMap')
    uv.uv_map = UV_MAP
    uv.location = (-300, -300)
    texture = tree.nodes.new('ShaderNodeTexImage')
    texture.image = image
    texture.extension = 'EXTEND'
    texture.location = (-50, -300)
    tree.links.new(texture.inputs['Vector'], uv.outputs['UV'])
    return texture


def _with_alpha(tree, principled, emission):
    alpha = principled.inputs['Alpha']
    last = emission
    if alpha.is_linked or alpha.default_value < 1:
        last = tree.nodes.new('ShaderNodeMixShader')
        last.location = (700, -100)
        clear = tree.nodes.new('ShaderNodeBsdfTransparent')
        clear.location = (500, -250)
        if alpha.is_linked:
            tree.links.new(last.inputs['Fac'], alpha.links[0].from_socket)
        else:
            last.inputs['Fac'].default_value = alpha.default_value
        tree.links.new(last.inputs[1], clear.outputs[0])
        tree.links.new(last.inputs[2], emission.outputs[0])
    last.name = last.label = SHADER
    return last.outputs[0]


@contextlib.contextmanager
def unlit(materials):
    """Materials without their light, as they were before `add`: an exporter of glTF finds their colours then."""
    changed = []
    for m in materials:
        mix = m.node_tree.nodes.get(MIX) if m.use_nodes else None
        if mix and mix.outputs[0].is_linked:
            principled = _first(m.node_tree, 'BSDF_PRINCIPLED')
            to = _output(m.node_tree).inputs['Surface'] if principled else mix.outputs[0].links[0].to_socket
            changed.append((m.node_tree, to, to.links[0].from_socket))
            m.node_tree.links.new(to, principled.outputs[0] if principled else mix.inputs['Color1'].links[0].from_socket)
    try:
        yield
    finally:
        for tree, to, was in changed:
            tree.links.new(to, was)


def write(file):
    """Puts the light that materials of an exported file tell of into that file."""
    textures = {}
    for m in file.get('materials'):
        extras = m.get('extras', {})
        name, intensity = extras.pop(IMAGE, None), extras.pop(INTENSITY, 1)
        image = bpy.data.images.get(name) if name else None
        if not image or not image.packed_file:
            continue
        if name not in textures:
            textures[name] = file.add_picture(image.packed_file.data)
        m.setdefault('extensions', {})['MOZ_lightmap'] = {'index': textures[name], 'texCoord': 1, 'intensity': intensity}
    if textures:
        file.json['extensionsUsed'] = sorted({*file.get('extensionsUsed'), 'MOZ_lightmap'})
