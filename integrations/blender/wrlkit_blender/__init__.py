"""VRML, X3D and Inventor in Blender, by the program wrlkit.

File > Import reads .wrl, .x3d, .x3dv and .iv: wrlkit converts them to glTF in a temporary folder, Blender's own importer reads that, and
what that does not know is added: levels of detail, baked light, groups as collections. File > Export goes the other way, to VRML97.
"""
bl_info = {
    'name': 'VRML, X3D and Inventor (wrlkit)',
    'author': 'wrlkit',
    'version': (0, 0, 0),  # of CMakeLists.txt
    'blender': (3, 3, 0),
    'location': 'File > Import, File > Export',
    'description': 'Reads VRML97, VRML 1.0, X3D and Inventor, writes VRML97, by the program wrlkit',
    'category': 'Import-Export',
}

import bpy

from . import export_vrml, import_vrml, program


class Preferences(bpy.types.AddonPreferences):
    bl_idname = __package__

    program: bpy.props.StringProperty(
        name='Program', subtype='FILE_PATH', description='The program wrlkit; empty: the one in PATH')

    def draw(self, context):
        self.layout.prop(self, 'program')
        try:
            self.layout.label(text=program.version(self.program), icon='CHECKMARK')
        except program.Failed as e:
            self.layout.label(text=str(e), icon='ERROR')


classes = (Preferences, import_vrml.ImportVrml, export_vrml.ExportVrml)


def import_entry(menu, context):
    menu.layout.operator(import_vrml.ImportVrml.bl_idname, text='VRML/X3D/Inventor (.wrl, .x3d, .x3dv, .iv)')


def export_entry(menu, context):
    menu.layout.operator(export_vrml.ExportVrml.bl_idname, text='VRML97 (.wrl)')


def register():
    for c in classes:
        bpy.utils.register_class(c)
    bpy.types.TOPBAR_MT_file_import.append(import_entry)
    bpy.types.TOPBAR_MT_file_export.append(export_entry)


def unregister():
    bpy.types.TOPBAR_MT_file_export.remove(export_entry)
    bpy.types.TOPBAR_MT_file_import.remove(import_entry)
    for c in reversed(classes):
        bpy.utils.unregister_class(c)
