#!/usr/bin/env python3
"""Baked light compared with that of Blender Cycles (3.4, `apt-get install blender`), over the same texels: CPU seconds and error.

  cycles_bake.py WRLKIT WORK [stairs,box,hall] [SAMPLES,...]

Three closed rooms lit by surfaces that emit: stairs with a gap behind them, a box with two blocks, a hall with pipes and 24 lamps.
wrlkit bakes each at several qualities, without and with its denoiser; Cycles bakes the texture coordinates that wrlkit made.
Two more bakes of Cycles with the most samples and different seeds are the reference: the mean of (x - A)(x - B) has no part of their
noise. In these two the lamps are cut into small triangles: Cycles 3.4 gives up to 4 % too little where a triangle that shines is near and
seen at a grazing angle (against Lambert's formula for a rectangle). Texels at the borders of charts, and those within something,
are left out, as programs differ in what they count there. CPU seconds are user and
system; of wrlkit the whole process, with reading and writing, of Cycles the call that bakes.

Prints a table. Needs numpy. Without Blender this says so."""
import itertools, json, math, os, pathlib, random, resource, shutil, struct, subprocess, sys

emission = 20  # emissiveColor is at most 1: radiance of a white lamp
side = 256


# ---- worlds ---------------------------------------------------------------------------------------------------------

def quads(faces, diffuse, emissive=None):
    """One Shape of four-cornered faces, each a list of points in counter-clockwise order."""
    points = [p for f in faces for p in f]
    index = ' '.join(f'{4 * i} {4 * i + 1} {4 * i + 2} {4 * i + 3} -1' for i in range(len(faces)))
    shine = f' emissiveColor {emissive} {emissive} {emissive}' if emissive else ''
    return ('Shape { appearance Appearance { material Material { diffuseColor %g %g %g%s } } geometry IndexedFaceSet { coord Coordinate { point [ %s ] } coordIndex [ %s ] } }\n'
            % (*diffuse, shine, ', '.join('%g %g %g' % tuple(p) for p in points), index))


def block(low, high, inward=False, without=''):
    """The faces of a box; `without` names sides such as 'y' (low) or 'Y' (high)."""
    faces = []
    for axis, name in enumerate('xyz'):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        for end in (0, 1):
            if (name.upper() if end else name) in without:
                continue
            corner = []
            for a, b in ((0, 0), (1, 0), (1, 1), (0, 1)):
                p = [0, 0, 0]
                p[axis] = (low, high)[end][axis]
                p[u], p[v] = (low, high)[a][u], (low, high)[b][v]
                corner.append(p)
            faces.append(corner if (end == 1) != inward else corner[::-1])
    return faces


def lamp(x, z, y, width, depth):
    """A plate that shines downwards, a little below y."""
    return quads([[[x, y, z], [x + width, y, z], [x + width, y, z + depth], [x, y, z + depth]]], (0, 0, 0), 1)


def stairs():
    grey = (0.7, 0.7, 0.72)
    text = quads(block((0, 0, 0), (6, 3.2, 4.5), inward=True), (0.85, 0.82, 0.75))
    for k in range(12):
        text += quads(block((1 + 0.3 * k, 0, 0.2), (1.3 + 0.3 * k, 0.17 * (k + 1), 1.4), without='y'), grey)
    text += quads(block((4.7, 0, 3.4), (5.5, 0.75, 4.1), without='y'), (0.75, 0.3, 0.2))
    text += quads(block((0.4, 0, 3.5), (0.9, 2, 4), without='y'), grey)
    return text + lamp(4, 2.5, 3.19, 0.9, 0.6) + lamp(1.6, 2, 2.3, 0.3, 0.3)


def box():
    text = quads(block((0, 0, 0), (5.5, 5.5, 5.6), inward=True, without='xX'), (0.87, 0.87, 0.87))
    walls = block((0, 0, 0), (5.5, 5.5, 5.6), inward=True, without='yYzZ')
    text += quads(walls[:1], (0.8, 0.25, 0.22)) + quads(walls[1:], (0.38, 0.7, 0.3))
    text += quads(block((0.8, 0, 3), (2.4, 1.65, 4.6), without='y'), (0.87, 0.87, 0.87))
    text += quads(block((3, 0, 1), (4.6, 3.3, 2.6), without='y'), (0.87, 0.87, 0.87))
    return text + lamp(2.1, 2.3, 5.49, 1.3, 1.05)


def hall():
    chance = random.Random(3)
    colors = [(0.85, 0.45, 0.4), (0.45, 0.72, 0.45), (0.45, 0.58, 0.82), (0.87, 0.82, 0.45), (0.82, 0.82, 0.82)]
    text = quads(block((0, 0, 0), (24, 7, 16), inward=True), (0.75, 0.75, 0.75))
    for k in range(24):
        text += lamp(2 + 3.6 * (k % 6), 1.5 + 3.8 * (k // 6), 6.3, 0.6, 0.2)
    for k in range(150):
        axis, radius, length = chance.choice((0, 0, 1, 2)), chance.choice((0.06, 0.1, 0.18)), chance.uniform(1, 4)
        at = (chance.uniform(3, 20), chance.uniform(2.3, 4), chance.uniform(3, 13))
        turn = ('0 0 1 1.5708', '0 0 1 0', '1 0 0 1.5708')[axis]
        text += ('Transform { translation %g %g %g rotation %s children Shape { appearance Appearance { material Material { diffuseColor %g %g %g } } '
                 'geometry Cylinder { radius %g height %g } } }\n' % (*at, turn, *chance.choice(colors), radius, length))
    return text


worlds = {'stairs': stairs, 'box': box, 'hall': hall}


# ---- what wrlkit has baked ------------------------------------------------------------------------------------------

class Glb:
    """Triangles of a .glb in the world, with their normals, places in the lightmap and materials."""

    def __init__(self, path):
        data = pathlib.Path(path).read_bytes()
        length = struct.unpack_from('<I', data, 12)[0]
        self.json, self.bin = json.loads(data[20:20 + length]), data[28 + length:]
        self.points, self.normals, self.places, self.triangles, self.materials = [], [], [], [], []
        for n in self.json['scenes'][0]['nodes']:
            self.walk(n, [[float(i == j) for j in range(4)] for i in range(4)])

    def values(self, index):
        a = self.json['accessors'][index]
        view = self.json['bufferViews'][a['bufferView']]
        n = {'SCALAR': 1, 'VEC2': 2, 'VEC3': 3}[a['type']]
        code = {5121: 'B', 5123: 'H', 5125: 'I', 5126: 'f'}[a['componentType']]
        size = struct.calcsize(code) * n
        start, stride = view.get('byteOffset', 0) + a.get('byteOffset', 0), view.get('byteStride', size)
        return [struct.unpack_from(f'<{n}{code}', self.bin, start + i * stride) for i in range(a['count'])]

    @staticmethod
    def matrix(node):
        if 'matrix' in node:
            m = node['matrix']
            return [[m[4 * c + r] for c in range(4)] for r in range(4)]
        x, y, z, w = node.get('rotation', (0, 0, 0, 1))
        t, s = node.get('translation', (0, 0, 0)), node.get('scale', (1, 1, 1))
        r = [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
             [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
             [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]]
        return [[r[i][j] * s[j] for j in range(3)] + [t[i]] for i in range(3)] + [[0, 0, 0, 1]]

    def walk(self, index, above):
        node = self.json['nodes'][index]
        m, here = self.matrix(node), above
        here = [[sum(above[i][k] * m[k][j] for k in range(4)) for j in range(4)] for i in range(4)]
        for p in self.json['meshes'][node['mesh']]['primitives'] if 'mesh' in node else []:
            self.add(p, here)
        for child in node.get('children', []):
            self.walk(child, here)

    def add(self, primitive, m):
        material = self.json['materials'][primitive['material']]
        light = material.get('extras', {}).get('lightmap')
        first = len(self.points)
        for p in self.values(primitive['attributes']['POSITION']):
            self.points.append([sum(m[i][k] * p[k] for k in range(3)) + m[i][3] for i in range(3)])
        if 'NORMAL' in primitive['attributes']:  # frames of these worlds do not scale
            self.normals += [[sum(m[i][k] * n[k] for k in range(3)) for i in range(3)] for n in self.values(primitive['attributes']['NORMAL'])]
        else:
            self.normals += [(0, 0, 0)] * (len(self.points) - first)  # of the face
        if light:
            places = self.values(primitive['attributes'][f"TEXCOORD_{light.get('texCoord', 0)}"])
            move = light.get('extensions', {}).get('KHR_texture_transform', {})
            angle, scale, offset = move.get('rotation', 0), move.get('scale', (1, 1)), move.get('offset', (0, 0))
            c, s = math.cos(angle), math.sin(angle)
            for u, v in places:
                u, v = u * scale[0], v * scale[1]
                self.places.append((c * u + s * v + offset[0], -s * u + c * v + offset[1]))
        else:
            self.places += [(-1, -1)] * (len(self.points) - first)
        index = [i for i, in self.values(primitive['indices'])]
        color = tuple(material.get('pbrMetallicRoughness', {}).get('baseColorFactor', (1, 1, 1, 1))[:3])
        shine = tuple(material.get('emissiveFactor', (0, 0, 0)))
        for t in range(0, len(index), 3):
            self.triangles.append([first + i for i in index[t:t + 3]])
            self.materials.append((color, shine))


def bake(wrlkit, world, work, options):
    """CPU seconds. Once more, not counted, with a picture that is not cut to 8 bits."""
    def run(more):
        subprocess.run([wrlkit, 'convert', '-q', world, work / 'baked.glb', '--lightmap-as', 'extras', '-p', f'lightmap{{max-size={side},emission={emission},{options}{more}}}'], check=True)

    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    run('')
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    run(',exr=true')
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def inner_texels(glb, shape):
    """Those with three more texels around them that lie in triangles that face the same way. What a texel counts at the border of its chart
    differs by program; and Cycles looks only at the triangle in the middle of a texel, so texels on facets smaller than they are mean something else."""
    import numpy
    height, width = shape[:2]
    facing = numpy.zeros((height, width), int)  # number of the direction; 0: no triangle
    directions = {}
    y, x = numpy.mgrid[0:height, 0:width] + 0.5
    for t in glb.triangles:
        (ax, ay), (bx, by), (cx, cy) = [(glb.places[i][0] * width, glb.places[i][1] * height) for i in t]
        if min(ax, bx, cx) < 0:
            continue
        area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
        if not area:
            continue
        x0, x1, y0, y1 = int(min(ax, bx, cx)), int(max(ax, bx, cx)) + 2, int(min(ay, by, cy)), int(max(ay, by, cy)) + 2
        px, py = x[y0:y1, x0:x1], y[y0:y1, x0:x1]
        a = ((bx - px) * (cy - py) - (by - py) * (cx - px)) / area
        b = ((cx - px) * (ay - py) - (cy - py) * (ax - px)) / area
        p, q, r = [numpy.array(glb.points[i]) for i in t]
        across = numpy.cross(q - p, r - p)
        number = directions.setdefault(tuple(numpy.round(across / numpy.linalg.norm(across), 3)), len(directions) + 1)
        there = (a >= -1e-6) & (b >= -1e-6) & (a + b <= 1 + 1e-6)
        facing[y0:y1, x0:x1][there] = number
    inner = facing > 0
    for _ in range(3):
        around = inner.copy()
        for dy, dx in itertools.product((-1, 0, 1), repeat=2):
            around &= numpy.roll(numpy.roll(inner, dy, 0), dx, 1) & (numpy.roll(numpy.roll(facing, dy, 0), dx, 1) == facing)
        inner = around
    return inner


def lit(light):
    """Not within something, or between a lamp and its ceiling: there wrlkit takes the light of the texels around, Cycles none."""
    import numpy
    around = sum(numpy.roll(numpy.roll(light.mean(2), dy, 0), dx, 1) for dy, dx in itertools.product((-1, 0, 1), repeat=2)) / 9
    out = around > 0.02 * light.mean()
    for dy, dx in itertools.product((-2, 0, 2), repeat=2):
        out &= numpy.roll(numpy.roll(out, dy, 0), dx, 1)
    return out


def cut_lamps(glb, n):
    """Triangles that shine become n * n."""
    triangles, materials = [], []
    for t, m in zip(glb.triangles, glb.materials):
        if not max(m[1]) > 0:
            triangles.append(t)
            materials.append(m)
            continue
        a, b, c = [glb.points[i] for i in t]
        first, at = len(glb.points), {}
        for i, j in itertools.product(range(n + 1), repeat=2):
            if i + j <= n:
                at[i, j] = len(glb.points)
                glb.points.append([p + (q - p) * i / n + (r - p) * j / n for p, q, r in zip(a, b, c)])
        glb.normals += [(0, 0, 0)] * (len(glb.points) - first)
        glb.places += [(-1, -1)] * (len(glb.points) - first)
        for i, j in at:
            if i + j < n:
                triangles.append([at[i, j], at[i + 1, j], at[i, j + 1]])
            if i + j < n - 1:
                triangles.append([at[i + 1, j], at[i + 1, j + 1], at[i, j + 1]])
        materials += [m] * (n * n)
    glb.triangles, glb.materials = triangles, materials


# ---- within Blender -------------------------------------------------------------------------------------------------

def in_blender(arguments):
    import bpy, numpy
    glb, folder, jobs = Glb(arguments[0]), pathlib.Path(arguments[1]), json.loads(arguments[2])
    cut_lamps(glb, int(arguments[3]))
    for o in list(bpy.data.objects):
        bpy.data.objects.remove(o)
    picture = bpy.data.images.new('light', side, side, float_buffer=True, alpha=True)
    picture.colorspace_settings.name = 'Non-Color'
    mesh = bpy.data.meshes.new('world')
    mesh.from_pydata(glb.points, [], glb.triangles)
    numbers = {}
    for polygon, key in zip(mesh.polygons, glb.materials):
        if key not in numbers:
            numbers[key] = len(numbers)
            mesh.materials.append(material(bpy, key, picture))
        polygon.material_index = numbers[key]
        polygon.use_smooth = True
    mesh.use_auto_smooth = True
    mesh.normals_split_custom_set_from_vertices(glb.normals)
    layer = mesh.uv_layers.new(name='light')
    for loop in mesh.loops:
        u, v = glb.places[loop.vertex_index]
        layer.data[loop.index].uv = (u, 1 - v) if u >= 0 else (-2, -2)
    world = bpy.data.objects.new('world', mesh)
    scene = bpy.context.scene
    scene.collection.objects.link(world)
    bpy.context.view_layer.objects.active = world
    world.select_set(True)
    scene.world = bpy.data.worlds.new('dark')
    scene.world.use_nodes = True
    scene.world.node_tree.nodes['Background'].inputs[1].default_value = 0
    scene.render.engine = 'CYCLES'
    cycles = scene.cycles
    cycles.device, cycles.use_denoising, cycles.use_adaptive_sampling = 'CPU', False, False
    cycles.max_bounces = cycles.diffuse_bounces = 64
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = cycles.light_sampling_threshold = 0
    cycles.caustics_reflective = cycles.caustics_refractive = False

    def cpu():
        u = resource.getrusage(resource.RUSAGE_SELF)
        return u.ru_utime + u.ru_stime

    for path in folder.glob('*.exr'):  # no other reader of these is at hand
        numpy.save(path.with_suffix('.npy'), pixels_of(bpy.data.images.load(str(path)), numpy))
    cycles.samples = 1
    bpy.ops.object.bake(type='DIFFUSE', pass_filter={'DIRECT', 'INDIRECT'}, margin=0, use_clear=True)  # what is set up once
    for name, samples, seed in jobs:
        cycles.samples, cycles.seed = samples, seed
        start = cpu()
        bpy.ops.object.bake(type='DIFFUSE', pass_filter={'DIRECT', 'INDIRECT'}, margin=0, use_clear=True)
        seconds = cpu() - start
        numpy.save(folder / f'{name}.npy', pixels_of(picture, numpy))
        print(f'SECONDS {name} {seconds}', flush=True)


def pixels_of(image, numpy):
    """RGB, the highest row first."""
    pixels = numpy.empty(side * side * 4, numpy.float32)
    image.pixels.foreach_get(pixels)
    return pixels.reshape(side, side, 4)[::-1, :, :3].astype(numpy.float64)


def material(bpy, key, picture):
    color, shine = key
    m = bpy.data.materials.new('m')
    m.use_nodes = True
    nodes = m.node_tree.nodes
    nodes.clear()
    if max(shine) > 0:
        # `solid` faces shine to the front only; their backs are black.
        surface, front, back = nodes.new('ShaderNodeMixShader'), nodes.new('ShaderNodeEmission'), nodes.new('ShaderNodeEmission')
        front.inputs[0].default_value, front.inputs[1].default_value = (*shine, 1), emission
        back.inputs[1].default_value = 0
        m.node_tree.links.new(nodes.new('ShaderNodeNewGeometry').outputs['Backfacing'], surface.inputs[0])
        m.node_tree.links.new(front.outputs[0], surface.inputs[1])
        m.node_tree.links.new(back.outputs[0], surface.inputs[2])
    else:
        surface = nodes.new('ShaderNodeBsdfDiffuse')
        surface.inputs[0].default_value = (*color, 1)
    m.node_tree.links.new(surface.outputs[0], nodes.new('ShaderNodeOutputMaterial').inputs[0])
    target = nodes.new('ShaderNodeTexImage')
    target.image = picture
    nodes.active = target
    return m


# ---- the comparison -------------------------------------------------------------------------------------------------

def compare(wrlkit, work, name, samples):
    import numpy
    world = work / f'{name}.wrl'
    world.write_text('#VRML V2.0 utf8\n' + worlds[name]())
    settings = ['quality=draft,denoise=false', 'quality=draft', 'quality=normal,denoise=false', 'quality=normal', 'quality=high', 'quality=draft,error=0.05', 'error=0.02', 'error=0.01']
    ours = {}
    for k, s in enumerate(settings):
        ours[s] = bake(wrlkit, world, work, s)
        (work / 'baked.lightmap_0.exr').rename(work / f'{k}.exr')
    glb = Glb(work / 'baked.glb')
    most = max(samples)
    seconds = {}
    for pieces, jobs in (1, [(f'{name}_{n}', n, 1) for n in samples]), (16, [(f'{name}_a', most, 2), (f'{name}_b', most, 3)]):
        out = subprocess.run(['blender', '-b', '-noaudio', '-t', '1', '-P', __file__, '--', str(work / 'baked.glb'), str(work), json.dumps(jobs), str(pieces)],
                             check=True, capture_output=True, text=True).stdout
        seconds.update((line.split()[1], float(line.split()[2])) for line in out.splitlines() if line.startswith('SECONDS'))
    theirs = {n: numpy.load(work / f'{name}_{n}.npy') for n in samples}
    baked = {s: numpy.load(work / f'{k}.npy') for k, s in enumerate(settings)}
    a, b = [numpy.load(work / f'{name}_{k}.npy') for k in 'ab']
    known = numpy.isfinite(a + b + sum(theirs.values())).all(2)  # a texel of Cycles may be none
    a, b = numpy.nan_to_num(a), numpy.nan_to_num(b)
    inner = inner_texels(glb, a.shape) & lit(a + b) & known
    mean = (a + b)[inner].mean() / 2

    def error(x):
        square = ((x - a) * (x - b))[inner].mean()
        return math.copysign(math.sqrt(abs(square)), square) / mean

    print(f'{name}: {int(inner.sum())} texels; wrlkit is {100 * (baked["quality=high"][inner].mean() / mean - 1):+.2f} % as bright as Cycles', flush=True)
    print('| who | CPU s | relative RMSE |\n|---|---|---|')
    for n in samples:
        print(f'| Cycles, {n} samples | {seconds[f"{name}_{n}"]:.1f} | {100 * error(theirs[n]):.1f} % |')
    for s in settings:
        print(f'| wrlkit, {s.replace(",", ", ")} | {ours[s]:.2f} | {100 * error(baked[s]):.1f} % |', flush=True)


def main():
    if '--' in sys.argv:
        return in_blender(sys.argv[sys.argv.index('--') + 1:])
    if len(sys.argv) < 3 or not shutil.which('blender'):
        return print('skipped: needs WRLKIT WORK, and blender', file=sys.stderr)
    work = pathlib.Path(sys.argv[2])
    work.mkdir(parents=True, exist_ok=True)
    names = sys.argv[3].split(',') if len(sys.argv) > 3 else list(worlds)
    samples = [int(n) for n in sys.argv[4].split(',')] if len(sys.argv) > 4 else [16, 64, 256]
    for name in names:
        compare(os.path.abspath(sys.argv[1]), work, name, samples)


main()
