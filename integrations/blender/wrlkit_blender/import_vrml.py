"""File > Import > VRML/X3D/Inventor."""
import json
import pathlib
import tempfile

import bpy
from bpy_extras.io_utils import ImportHelper

from . import glb, gltf_addon, groups, light, program

UNITS = (('m', 'Metres', ''), ('cm', 'Centimetres', ''), ('mm', 'Millimetres', ''), ('in', 'Inches', ''), ('ft', 'Feet', ''))
AXES = (('y', 'Y', 'as VRML says'), ('z', 'Z', ''), ('x', 'X', ''))
LEVELS = (('HIDDEN', 'Hidden', 'the finest one is shown, the others are in a hidden collection'),
          ('FINEST', 'Finest', 'the others are left out'))


class ImportVrml(bpy.types.Operator, ImportHelper):
    """Read VRML97, VRML 1.0, X3D or Inventor by the program wrlkit"""
    bl_idname = 'import_scene.wrlkit'
    bl_label = 'Import VRML/X3D/Inventor'
    bl_options = {'REGISTER', 'UNDO'}

    filter_glob: bpy.props.StringProperty(default='*.wrl;*.wrz;*.wrl.gz;*.x3d;*.x3dv;*.x3dz;*.iv', options={'HIDDEN'})
    files: bpy.props.CollectionProperty(type=bpy.types.OperatorFileListElement, options={'HIDDEN', 'SKIP_SAVE'})
    directory: bpy.props.StringProperty(subtype='DIR_PATH', options={'HIDDEN', 'SKIP_SAVE'})
    unit: bpy.props.EnumProperty(name='Unit', items=UNITS, description='What one unit of the file is')
    up: bpy.props.EnumProperty(name='Up', items=AXES, description='Which axis of the file points up')
    pipeline: bpy.props.StringProperty(
        name='Passes', description='Passes to run, as for wrlkit convert -p: dedup,lod{ratios=0.3:0.1}')
    collections: bpy.props.BoolProperty(
        name='Groups as collections', default=True, description='Named groups of the file become collections')
    levels: bpy.props.EnumProperty(name='Levels of detail', items=LEVELS)
    lightmaps: bpy.props.BoolProperty(
        name='Baked light', default=True,
        description='Baked light in a second UV map and in the material; without, surfaces have their own colours and are lit by lamps')
    show_all: bpy.props.BoolProperty(name='Show all of Switches', description='Switches that are off show all their children')

    def execute(self, context):
        names = [f.name for f in self.files if f.name]
        paths = [pathlib.Path(self.directory) / n for n in names] or [pathlib.Path(self.filepath)]
        done = [self.import_one(context, p) for p in paths]
        return {'FINISHED'} if any(done) else {'CANCELLED'}

    def import_one(self, context, path):
        try:
            with tempfile.TemporaryDirectory(prefix='wrlkit-') as folder:
                target = pathlib.Path(folder) / 'world.glb'
                messages = program.convert(context, path, target, self.command_options())
                build(context, path.name.split('.')[0], target, self)
        except program.Failed as e:
            print(f'wrlkit: {e}')
            self.report({'ERROR'}, str(e))
            return False
        program.report(self, messages)
        return True

    def command_options(self):
        # Extras of geometry would outlive changes that are made to it here.
        options = ['--unit', self.unit, '--up', self.up, '--extras', 'facts', '--link', '--lightmap-as', 'moz' if self.lightmaps else 'base-color']
        if self.pipeline.strip():
            options += ['-p', self.pipeline.strip()]
        return options + ['--show-all'] * self.show_all


def build(context, name, path, options):
    """What a .glb of wrlkit has, as objects in a collection of that name."""
    file = glb.Glb(path)
    levels = glb.hang_levels(file) if options.levels == 'HIDDEN' else {}
    if options.levels == 'FINEST':
        glb.leave_out_unreached(file)
    glb.mark(file)
    file.write(path)
    known = set(bpy.data.objects)
    gltf_addon.read(path)
    objects, materials = found(file, set(bpy.data.objects) - known)
    light.add(file, materials, {o.data for o in objects.values() if o.type == 'MESH'})
    groups.collect(context, name, objects, levels, options.collections)


def found(file, made):
    """({node: object}, {material: materials}), by the numbers that they have in the file; Blender makes several of a material where
    only some meshes have colours."""
    objects, materials = {}, {}
    for o in made:
        if glb.NODE in o:
            node = o.pop(glb.NODE)
            objects[node] = o
            name = file.get('nodes')[node].get('name', '')
            if o.name != name:
                o[glb.NAMES] = json.dumps([o.name, name])
    for m in bpy.data.materials:
        if glb.MATERIAL in m:
            materials.setdefault(m.pop(glb.MATERIAL), []).append(m)
    return dict(sorted(objects.items())), materials
