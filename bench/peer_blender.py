"""Worlds to GLB by Blender in one process: the importer of X3D and VRML, the exporter of glTF. Prints "begun FILE" and "made FILE".

  blender --background --factory-startup --python-exit-code 1 --python bench/peer_blender.py -- LIST FOLDER
"""
import builtins
import pathlib
import sys

import bpy

# The importer opens files in a mode that Python 3.11, which Debian's Blender has, no longer knows.
builtin_open = builtins.open
builtins.open = lambda path, mode='r', *a, **k: builtin_open(path, mode.replace('U', ''), *a, **k)

listed, folder = sys.argv[sys.argv.index('--') + 1:]
for i, path in enumerate(pathlib.Path(listed).read_text().splitlines()):
    print('begun', path, flush=True)
    bpy.ops.wm.read_factory_settings(use_empty=True)
    try:
        bpy.ops.preferences.addon_enable(module='io_scene_x3d')
        bpy.ops.preferences.addon_enable(module='io_scene_gltf2')
        bpy.ops.import_scene.x3d(filepath=path)
        if not bpy.data.objects:
            continue
        bpy.ops.export_scene.gltf(filepath=f'{folder}/{i}.glb', export_format='GLB')
        print('made', path, flush=True)
    except Exception:
        pass
