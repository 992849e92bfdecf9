"""File > Export > VRML97."""
import pathlib
import tempfile

import bpy
from bpy_extras.io_utils import ExportHelper

from . import glb, gltf_addon, light, program


class ExportVrml(bpy.types.Operator, ExportHelper):
    """Write VRML97 by the program wrlkit"""
    bl_idname = 'export_scene.wrlkit'
    bl_label = 'Export VRML97'

    filename_ext = '.wrl'
    filter_glob: bpy.props.StringProperty(default='*.wrl;*.wrz', options={'HIDDEN'})
    selection: bpy.props.BoolProperty(name='Selection only')
    modifiers: bpy.props.BoolProperty(name='Apply modifiers', default=True)
    animations: bpy.props.BoolProperty(name='Animations', default=True)
    pipeline: bpy.props.StringProperty(name='Passes', description='Passes to run, as for wrlkit convert -p')
    gzip: bpy.props.BoolProperty(name='Compressed', description='Compress the file (gzip), which browsers of VRML read')

    def execute(self, context):
        try:
            with tempfile.TemporaryDirectory(prefix='wrlkit-') as folder:
                source = pathlib.Path(folder) / 'world.glb'
                self.write_glb(source)
                options = ['--gzip'] * self.gzip + (['-p', self.pipeline.strip()] if self.pipeline.strip() else [])
                messages = program.convert(context, source, pathlib.Path(self.filepath), options)
        except program.Failed as e:
            print(f'wrlkit: {e}')
            self.report({'ERROR'}, str(e))
            return {'CANCELLED'}
        program.report(self, [{k: v for k, v in m.items() if k not in ('file', 'line', 'column')} for m in messages])
        return {'FINISHED'}

    def write_glb(self, path):
        with light.unlit(bpy.data.materials):
            gltf_addon.write(path, use_selection=self.selection, export_apply=self.modifiers, export_animations=self.animations)
        file = glb.Glb(path)
        light.write(file)
        glb.join_levels(file)
        glb.unmark(file)
        file.write(path)
