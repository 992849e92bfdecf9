#!/usr/bin/env python3
"""The Blender add-on (integrations/blender): what Blender has after an import, and what comes out again.

  tests/blender_addon.py --wrlkit build/release/wrlkit

Makes the .zip, installs it in a Blender that has nothing else, and runs this file again within it. Skipped (77) without Blender.
"""
import argparse
import contextlib
import io
import json
import os
from pathlib import Path
import shutil
import subprocess
import sys
import tempfile

ROOT = Path(__file__).resolve().parents[1]
FEATURES = ROOT / 'corpus/features'

GROUPS = '''#VRML V2.0 utf8
Background { skyColor 0 0 0 }
DEF Area Transform { translation 0 0 3 children [
  DEF Pumps Group { children [
    DEF Pump Transform { translation 1 2 0 children Shape { appearance Appearance { material DEF Red Material { diffuseColor 1 0 0 } } geometry Box { size 2 4 6 } } }
    Shape { geometry Sphere { radius 0.5 } }
  ] }
  Anchor { url "http://example.org/manual" children DEF Valve Shape { appearance Appearance { material Material { } } geometry Cone { } } }
] }
'''


# ---- outside ----------------------------------------------------------------------------------------------------------

def outside():
    a = argparse.ArgumentParser()
    a.add_argument('--wrlkit', default='build/release/wrlkit')
    wrlkit = Path(a.parse_args().wrlkit).resolve()
    blender = shutil.which('blender')
    if not blender:
        print('no blender (apt install blender)')
        sys.exit(77)
    with tempfile.TemporaryDirectory() as folder:
        packed = subprocess.run([ROOT / 'script/blender-addon', folder], check=True, capture_output=True, text=True).stdout.strip()
        # Blender must not find the user's own settings.
        environment = {**os.environ, 'BLENDER_USER_SCRIPTS': folder, 'BLENDER_USER_CONFIG': folder, 'PATH': '/usr/bin:/bin'}
        inside = subprocess.run([blender, '-b', '--factory-startup', '--python-exit-code', '1', '--python', __file__, '--', wrlkit, packed, folder],
                                env=environment, capture_output=True, text=True, timeout=600)
        failed = inside.returncode or 'every check passed' not in inside.stdout
        print(inside.stdout[-6000:] + inside.stderr[-4000:] if failed else 'every check passed')
        sys.exit(bool(failed))


# ---- within Blender ---------------------------------------------------------------------------------------------------

class Checks:
    def __init__(self, wrlkit, folder):
        self.wrlkit, self.folder = wrlkit, Path(folder)

    def world(self, text):
        path = self.folder / 'world.wrl'
        path.write_text(text)
        return path

    def read(self, path, **options):
        """Imports into an empty file; (result, what was printed)."""
        bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=False)
        said = io.StringIO()
        with contextlib.redirect_stdout(said):
            result = bpy.ops.import_scene.wrlkit(filepath=str(path), **options)
        return result, said.getvalue()

    def write(self, name, **options):
        path = self.folder / name
        assert bpy.ops.export_scene.wrlkit(filepath=str(path), **options) == {'FINISHED'}
        return path

    def info(self, path):
        return json.loads(subprocess.run([self.wrlkit, 'info', '--json', path], capture_output=True, text=True).stdout)

    def difference(self, a, b):
        """Mean of the difference of two pictures, in levels."""
        a, b = bpy.data.images.load(str(a)), bpy.data.images.load(str(b))
        a, b = numpy.array(a.pixels), numpy.array(b.pixels)
        return float(numpy.abs(a - b).reshape(-1, 4)[:, :3].mean()) * 255

    def draw(self, path, name):
        subprocess.run([self.wrlkit, 'render', '-q', path, self.folder / name, '--width', '200', '--height', '150'], check=True)
        return self.folder / name

    # -- the checks

    def groups_names_and_axes(self):
        self.read(self.world(GROUPS), pipeline='dedup')
        objects, collections = bpy.data.objects, bpy.data.collections
        assert {o.name for o in objects if o.type == 'MESH'} >= {'Pump', 'Valve'}, list(objects)
        assert sum(o.type == 'MESH' for o in objects) == 3
        assert [c.name for c in collections['world'].children] == ['Area'], list(collections)
        assert [c.name for c in collections['Area'].children] == ['Pumps']
        assert objects['Pump'].name in collections['Pumps'].objects and len(objects['Pump'].users_collection) == 1
        box = bounds(objects['Pump'])
        # VRML: x from 0 to 2, y from 0 to 4, z from 0 to 6; Blender: y is -z, z is y.
        assert numpy.allclose(box, [[0, -6, 0], [2, 0, 4]], atol=1e-5), box
        color = objects['Pump'].active_material.node_tree.nodes['Principled BSDF'].inputs['Base Color'].default_value
        assert numpy.allclose(color, (1, 0, 0, 1)), tuple(color)
        self.read(self.world(GROUPS), collections=False, unit='cm', up='z')
        assert [c.name for c in bpy.data.collections] == ['world']
        box = bounds(bpy.data.objects['Pump'])
        assert numpy.allclose(box, [[0, 0, 0], [0.02, 0.04, 0.06]], atol=1e-6), box

    def export_back(self):
        self.read(self.world(GROUPS))
        bpy.data.objects['Valve'].name = 'Gate valve'
        before, after = self.info(self.world(GROUPS)), self.info(self.write('out/back.wrl'))
        assert before['triangles'] == after['triangles']
        assert numpy.allclose(before['bounds']['min'], after['bounds']['min'], atol=1e-5)
        assert numpy.allclose(before['bounds']['max'], after['bounds']['max'], atol=1e-5)
        text = (self.folder / 'out/back.wrl').read_text()
        for part in ('DEF Area ', 'DEF Pumps ', 'DEF Pump ', 'DEF Gate_valve ', 'http://example.org/manual', 'diffuseColor 1 0 0', 'Background'):
            assert part in text, part
        for part in ('Node_', 'Mesh_', 'Material_', 'wrlkit'):
            assert part not in text, part
        bpy.ops.object.select_all(action='DESELECT')
        bpy.data.objects['Pump'].select_set(True)
        packed = self.write('pump.wrz', selection=True, gzip=True)
        assert packed.read_bytes()[:2] == b'\x1f\x8b' and self.info(packed)['triangles'] == 12

    def levels(self):
        lod = FEATURES / 'lod.wrl'
        self.read(lod)
        hidden = bpy.data.collections['lod levels']
        assert hidden.hide_viewport and hidden.hide_render
        assert [[o.type for o in c.objects] for c in hidden.children] == [['MESH', 'MESH'], ['EMPTY']], list(hidden.children)
        assert bpy.data.objects['Base.001'].parent == bpy.data.objects['Fine'].parent, 'levels stand where the finest one does'
        shown = [o for o in bpy.data.objects if o.type == 'MESH' and o.visible_get()]
        assert len(shown) == 3, shown
        text = self.write('lod.wrl').read_text()
        assert text.count('LOD {') == 2 and 'range [12 30]' in text and text.count('DEF Base ') == 3, text
        assert self.info(self.folder / 'lod.wrl')['triangles'] == self.info(lod)['triangles']
        self.read(lod, levels='FINEST')
        assert sum(o.type == 'MESH' for o in bpy.data.objects) == 3 and 'lod levels' not in bpy.data.collections

    def baked_light(self):
        world = FEATURES / 'lightmap.wrl'
        self.read(world)
        for name in ('Floor', 'Wall', 'Left', 'Right'):
            mesh = bpy.data.objects[name].data
            assert [layer.name for layer in mesh.uv_layers] == ['UVMap', 'Lightmap'], name
            mix = mesh.materials[0].node_tree.nodes['Baked light']
            assert mix.blend_type == 'MULTIPLY' and mix.outputs[0].is_linked
        uv = numpy.empty(2 * len(bpy.data.objects['Left'].data.loops), numpy.float32)
        bpy.data.objects['Left'].data.uv_layers['Lightmap'].data.foreach_get('uv', uv)
        assert uv.min() > 0 and uv.reshape(-1, 2)[:, 0].max() < 0.5, 'its part of the page'
        mean = self.difference(self.rendered('cycles.png'), self.draw(world, 'own.png'))
        assert mean < 2.5, f'pictures of Cycles and wrlkit are {mean} levels apart'
        mean = self.difference(self.draw(self.write('lit.wrl'), 'back.png'), self.folder / 'own.png')
        assert mean < 0.5, f'after the export, the picture is {mean} levels off'
        assert bpy.data.objects['Wall'].active_material.node_tree.nodes['Baked light'].outputs[0].is_linked
        self.read(world, lightmaps=False)
        assert not any('Baked light' in m.node_tree.nodes for m in bpy.data.materials)

    def rendered(self, name):
        scene = bpy.context.scene
        scene.render.engine, scene.cycles.samples, scene.cycles.use_denoising = 'CYCLES', 8, False
        scene.render.resolution_x, scene.render.resolution_y = 200, 150
        scene.view_settings.view_transform = 'Standard'
        scene.camera = next(o for o in bpy.data.objects if o.type == 'CAMERA')
        scene.world = bpy.data.worlds.new('Black')
        scene.world.color = (0, 0, 0)
        scene.render.filepath = str(self.folder / name)
        bpy.ops.render.render(write_still=True)
        return scene.render.filepath

    def other_formats(self):
        inventor = self.folder / 'cone.iv'
        inventor.write_text('#Inventor V2.1 ascii\nSeparator { Cone { } }\n')
        classic = self.folder / 'box.x3dv'
        classic.write_text('#X3D V3.3 utf8\nPROFILE Interchange\nShape { geometry Box { } }\n')
        for path in (ROOT / 'corpus/vrml1/Cube.wrl', ROOT / 'corpus/x3d/Box.x3d', inventor, classic):
            result, _ = self.read(path)
            assert result == {'FINISHED'} and any(o.type == 'MESH' for o in bpy.data.objects), path

    def messages(self):
        said = ''
        try:
            self.read(FEATURES / 'inline_missing.wrl')
        except RuntimeError as e:  # what a script gets of an ERROR; in the window it is shown
            said = str(e)
        assert 'not_there.wrl' in said and 'url-not-found' in said, said
        assert any(o.type == 'MESH' for o in bpy.data.objects), 'the rest is imported'
        broken = self.world('#VRML V2.0 utf8\nTransform { translation 1 2 3 children Shape { geometry Box { size 1 2 } } }\n')
        try:
            _, printed = self.read(broken)
            assert 'wrlkit: ' in printed, printed
        except RuntimeError as e:
            assert ':2:' in str(e), e
        for bad, part in ((self.folder / 'none.wrl', 'none.wrl'), (self.world(''), 'world.wrl')):
            try:
                self.read(bad)
                assert False, f'{bad} was imported'
            except RuntimeError as e:
                assert part in str(e), e
        preferences = bpy.context.preferences.addons['wrlkit_blender'].preferences
        for program, part in (('', 'is not found'), (str(self.folder / 'nothing'), 'is not a file')):
            preferences.program = program
            try:
                self.read(FEATURES / 'lod.wrl')
                assert False, 'imported without a program'
            except RuntimeError as e:
                assert part in str(e), e


def bounds(o):
    bpy.context.view_layer.update()
    points = numpy.array([o.matrix_world @ v.co for v in o.data.vertices])
    return [points.min(0), points.max(0)]


def within(wrlkit, packed, folder):
    bpy.ops.preferences.addon_install(filepath=packed)
    bpy.ops.preferences.addon_enable(module='wrlkit_blender')
    bpy.context.preferences.addons['wrlkit_blender'].preferences.program = wrlkit
    checks = Checks(wrlkit, folder)
    for check in (checks.groups_names_and_axes, checks.export_back, checks.levels, checks.baked_light, checks.other_formats, checks.messages):
        print('check:', check.__name__)
        check()
    print('every check passed')


try:
    import bpy
    import numpy
except ImportError:
    outside()
else:
    within(*sys.argv[sys.argv.index('--') + 1:])
