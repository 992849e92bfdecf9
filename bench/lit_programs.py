#!/usr/bin/env python3
"""Ways to write baked light (--lightmap-as) by programs: rows of the table in docs/lighting.md; those of browsers come from
tests/browser/lit_matrix.mjs.

  bench/lit_programs.py --wrlkit build/release/wrlkit -o FOLDER [--world FILE]

Each cell is a picture from the first Viewpoint, FOLDER/PROGRAM_WAY.png, and its mean difference, in 255ths, from what `wrlkit render`
shows of base-color, where that shows the world. Programs: wrlkit render, view3dscene (Castle Game Engine, with xvfb) and Blender (Cycles).
"""
import argparse
import os
from pathlib import Path
import shutil
import subprocess
import sys

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / 'tests'))
from png import pixels  # noqa: E402

WAYS = ['base-color', 'emissive', 'occlusion', 'moz', 'extras']
WIDTH, HEIGHT = 320, 240
KEY = (217, 64, 166)  # the background, a colour that no wall has
BLENDER = '''
import bpy, numpy, sys
numpy.bool = bool  # the glTF importer of Debian's Blender asks for it; NumPy 1.24 has dropped it
glb, picture, width, height = sys.argv[sys.argv.index('--') + 1:]
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.import_scene.gltf(filepath=glb)
scene = bpy.context.scene
scene.camera = next(o for o in scene.objects if o.type == 'CAMERA')
scene.world = bpy.data.worlds.new('dark')
scene.render.engine, scene.cycles.samples, scene.cycles.device = 'CYCLES', 64, 'CPU'
scene.cycles.use_denoising = False
scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = int(width), int(height), 100
scene.view_settings.view_transform = 'Standard'
scene.render.image_settings.file_format, scene.render.filepath = 'PNG', picture
bpy.ops.render.render(write_still=True)
'''


def by_wrlkit(program, glb, picture):
    background = [str(c / 255) for c in KEY]
    return [program, 'render', '-q', glb, picture, '--width', WIDTH, '--height', HEIGHT, '--background', *background]


def by_castle(_, glb, picture):
    return ['xvfb-run', '-a', '-s', '-screen 0 1280x1024x24', 'view3dscene', '--hide-extras', '--hide-menu', '--no-sound',
            '--geometry', f'{WIDTH}x{HEIGHT}', '--anti-alias', '2', glb, '--screenshot', '0', picture]


def by_blender(_, glb, picture):
    return ['blender', '--background', '--factory-startup', '--python-expr', BLENDER, '--', glb, picture, WIDTH, HEIGHT]


PROGRAMS = {'wrlkit render': by_wrlkit, 'view3dscene': by_castle, 'blender': by_blender}


def colours(picture):
    step, data = pixels(picture)
    return [data[i:i + 3] for i in range(0, len(data), step)]


def difference(picture, reference):
    """Mean of the channels where the reference shows the world, in 255ths."""
    total, n = 0, 0
    for p, q in zip(colours(picture), colours(reference), strict=True):
        if tuple(q) == KEY:
            continue
        total, n = total + sum(abs(a - b) for a, b in zip(p, q)), n + 3
    return total / n


def cell(wrlkit, program, folder, way):
    picture = folder / f'{program.replace(" ", "_")}_{way}.png'
    words = PROGRAMS[program](wrlkit, folder / f'{way}.glb', picture)
    path = '/usr/bin:/bin'  # Blender's Python is the system's
    done = subprocess.run([str(w) for w in words], capture_output=True, text=True, errors='replace', timeout=600, env={**os.environ, 'PATH': path})
    if not picture.exists():
        print(f'{program}: {way}: {done.stderr.strip()[-200:]}', file=sys.stderr)
        return 'failed'
    return f'{difference(picture, folder / "wrlkit_render_base-color.png"):.1f}'


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--wrlkit', required=True)
    parser.add_argument('-o', '--output', type=Path, required=True)
    parser.add_argument('--world', default='corpus/paper/stairs_room.wrl')
    args = parser.parse_args()
    args.output.mkdir(parents=True, exist_ok=True)
    for way in WAYS:
        subprocess.run([args.wrlkit, 'convert', '-q', args.world, args.output / f'{way}.glb', '-p', 'lightmap{quality=draft}',
                        '--lightmap-as', way], check=True)
    print(f'| | {" | ".join(WAYS)} |\n|{"---|" * (len(WAYS) + 1)}')
    for program in PROGRAMS:
        there = program == 'wrlkit render' or shutil.which(program)
        cells = [cell(args.wrlkit, program, args.output, way) if there else 'not installed' for way in WAYS]
        print(f'| {program} | {" | ".join(cells)} |', flush=True)
    return 0


sys.exit(main())
