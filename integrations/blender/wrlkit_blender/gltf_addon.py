"""Blender's own importer and exporter of glTF."""
import contextlib

import bpy
import numpy


@contextlib.contextmanager
def _known_bool():
    """Debian 12 has Blender 3.4.1 with NumPy 1.24, which has no numpy.bool that the importer of 3.4 asks for."""
    missing = 'bool' not in vars(numpy)
    if missing:
        numpy.bool = bool
    try:
        yield
    finally:
        if missing:
            del numpy.bool


def read(path):
    with _known_bool():
        bpy.ops.import_scene.gltf(filepath=str(path))


def write(path, **options):
    with _known_bool():
        bpy.ops.export_scene.gltf(filepath=str(path), export_format='GLB', export_extras=True, export_cameras=True,
                                  export_lights=True, export_yup=True, **options)
