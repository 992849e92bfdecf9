#!/usr/bin/env python3
"""What `recognise` finds against what parts are.

  recognised_parts.py WRLKIT SHARED [huldra|plant|bytes]

huldra: the pipe supports of a real platform (SHARED/plants/huldra), whose truth lies next to them, in three forms: at
least 97 % by kind and size. plant: a plant of SHARED/bench/gen_plant.py, which is asked what it makes, in three forms:
at least 98 %, and no residual above a chord. bytes: one of 1.4 MB, made small with its parts recognised: at most 55,000
bytes, all names kept, nothing moved by more than a millimetre. Ends with 77 where SHARED is not there.
"""
import collections
import gzip
import importlib.util
import json
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.join(os.path.dirname(__file__), '..', 'corpus', 'generator'))
import census  # noqa: E402  (the second reader of VRML97)

DEFAULTS = {'radius': 1, 'height': 2, 'bottomRadius': 1, 'topRadius': 0, 'bendRadius': 2, 'angle': 1.570796,
            'innerRadius': 1, 'outerRadius': 2}


def numbers(fields, name, default=()):
    """Of a field of one tuple or of a list, with brackets or without."""
    return [v for some in census.many(fields[name]) for v in some] if name in fields else list(default)


def form_of(kind, fields):
    """Kind and sizes in a fixed order; none of other nodes."""
    def number(name, default=None):
        return numbers(fields, name, [DEFAULTS[name] if default is None else default])[0]

    def pair(name, default):
        return numbers(fields, name, default)

    if kind in ('Box', 'BoxForm'):
        return ('box', *sorted(pair('size', [2, 2, 2])))
    if kind in ('Cylinder', 'CylinderForm'):
        return ('cylinder', number('radius'), number('height'))
    if kind == 'TorusForm':
        return ('torus', number('bendRadius'), number('radius'), number('angle'))
    if kind == 'RectangularTorusForm':
        return ('rectangular-torus', number('innerRadius'), number('outerRadius'), number('height', 1),
                number('angle'))
    if kind == 'PyramidForm':
        return ('pyramid', *sorted(pair('bottomSize', [2, 2]) + pair('topSize', [0, 0])), number('height'))
    if kind == 'DishForm':
        return ('dish', number('radius'), number('height', 0.5))
    if kind == 'RingForm':
        return ('ring', number('innerRadius', 0.5), number('outerRadius', 1), number('height', 1))
    if kind == 'Extrusion':
        return ('prism', len(numbers(fields, 'crossSection')) // 2 - 1, spine_length(fields))
    if kind == 'PrismForm':
        return ('prism', len(numbers(fields, 'points')) // 2, number('height', 1))
    return None


def spine_length(fields):
    spine = numbers(fields, 'spine', [0, 0, 0, 0, 1, 0])
    return spine[4] - spine[1]


def matched(truth, found, tolerance):
    """How many of the one are among the other, each taken once."""
    left = found.copy()
    hits = 0
    missed = collections.Counter()
    for form, n in truth.items():
        for other in [f for f in left if f[0] == form[0] and len(f) == len(form)]:
            if n == 0:
                break
            if all(abs(a - b) <= max(tolerance, 0.002 * abs(a)) for a, b in zip(form[1:], other[1:])):
                taken = min(n, left[other])
                left[other] -= taken
                n -= taken
                hits += taken
        if n:
            missed[form] += n
    return hits, missed


def recognised(wrlkit, path, passes, folder):
    out = pathlib.Path(folder, 'out.wrl')
    report = subprocess.run([wrlkit, 'cat', path, '-p', passes, '--dump', '--stats'], check=True,
                            capture_output=True, text=True)
    out.write_text(report.stdout, encoding='utf8')
    residual = re.search(r'(\d+)\s+recognise\.largest-residual', report.stderr)
    geometries = [census.geometry(shape) for shape in census.shapes(out)]
    forms = collections.Counter(form_of(g.kind, g.fields) for g in geometries if g)
    del forms[None]
    return forms, int(residual[1]) * 1e-6 if residual else math.inf


def check(name, truth, found, residual, least, tolerance, most):
    hits, missed = matched(truth, found, tolerance)
    total = sum(truth.values())
    share = hits / total
    good = share >= least and residual <= most
    print(f'{name}: {hits} of {total} ({100 * share:.2f} %), largest residual {1000 * residual:.2f} mm'
          f'{"" if good else "  FAILED"}')
    for form, n in missed.most_common(6):
        print('   missed', n, *[v if isinstance(v, str) else round(v, 5) for v in form])
    return good


def huldra(wrlkit, shared, folder):
    kinds = {'box': lambda v: ('box', *sorted(v)), 'cylinder': lambda v: ('cylinder', *v),
             'rectangular-torus': lambda v: ('rectangular-torus', v[0], v[1], v[2], v[3] * 1000),
             # Between equal rectangles lies a box.
             'pyramid': lambda v: ('box', *sorted([v[0], v[1], v[6]])) if v[:2] == v[2:4] and v[4:6] == [0, 0]
             else ('pyramid', *sorted(v[:4]), v[6])}
    at = os.path.join(shared, 'plants', 'huldra')
    truth = collections.Counter()
    for row in json.load(gzip.open(os.path.join(at, 'supports.json.gz'))):
        if row['kind'] in kinds:
            truth[kinds[row['kind']](row['values'])] += 1
    good = True
    for form in ('indexed', 'soup', 'shapes'):
        passes = 'join,recognise' if form == 'shapes' else 'recognise'
        found, residual = recognised(wrlkit, os.path.join(at, f'supports_{form}.wrl.gz'), passes, folder)
        good &= check(f'huldra {form}', truth, found, residual, 0.97, 0.00025, 0.001)
    return good


def plant(wrlkit, shared, folder):
    spec = importlib.util.spec_from_file_location('gen_plant', os.path.join(shared, 'bench', 'gen_plant.py'))
    generator = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(generator)
    truth = collections.Counter()
    made = generator.Plant.part

    def part(self, key, make, *rest, **more):
        """What is made is noted, too."""
        made(self, key, make, *rest, **more)
        for form in plant_part(key, make()):
            truth[form] += 1

    generator.Plant.part = part
    good = True
    for form in ('', '--soup', '--explode'):
        truth.clear()
        path = os.path.join(folder, 'plant.wrl')
        sys.argv = ['gen_plant.py', path, '--size', '1M', *([form] if form else [])]
        with open(os.devnull, 'w', encoding='ascii') as nothing:
            sys.stdout, shown = nothing, sys.stdout
            generator.main()
            sys.stdout = shown
        with open(path + '.truth.json', 'w', encoding='ascii') as file:
            json.dump([[list(k), n] for k, n in truth.items()], file)
        passes = 'join,recognise' if form == '--explode' else 'recognise'
        found, residual = recognised(wrlkit, path, passes, folder)
        good &= check(f'plant {form or "indexed"}', truth, found, residual, 0.98, 0.0003, 0.002)
    return good


def bytes_of_plant(wrlkit, shared, folder):
    path, small = (os.path.join(folder, name) for name in ('small.wrl', 'small.glb'))
    subprocess.run([sys.executable, os.path.join(shared, 'bench', 'gen_plant.py'), path, '--size', '1.4M'], check=True,
                   stdout=subprocess.DEVNULL)
    subprocess.run([wrlkit, 'optimize', '-q', path, small, '--tolerance', '1mm', '--profile', 'cesium', '--recognise'],
                   check=True)
    made = subprocess.run([wrlkit, 'diff', '-q', '--json', path, small], capture_output=True, text=True, check=False)
    report = json.loads(made.stdout)
    size, far, missing = os.path.getsize(small), report['surface']['max'], report['names']['missing']
    good = size <= 55000 and far <= 0.001 and not missing
    print(f'bytes: {size}, {len(missing)} names missing, {1000 * far:.2f} mm{"" if good else "  FAILED"}')
    return good


def plant_part(key, mesh):
    """Forms of a part of gen_plant.py, by its key."""
    name, *v = key
    low = [min(p[k] for p in mesh[0]) for k in range(3)]
    size = [max(p[k] for p in mesh[0]) - low[k] for k in range(3)]
    if name in ('leg', 'col', 'beam'):
        return [('prism', 12, size[1])]
    if name == 'dome':
        return [('dish', v[0], v[0] / 2)]
    if name == 'elbow':
        return [('torus', round(v[0] * 3, 4), v[0], math.pi / 2)]
    if name == 'wheel':
        return [('torus', v[0] * 1.5, v[0] * .15, 2 * math.pi)]
    if name == 'flange':
        return [('ring', v[0], round(v[0] * 1.8 + .02, 4), .03)]
    if name == 'bolt':
        return [('cylinder', .012, .08), ('cylinder', .02, .015), ('cylinder', .02, .015)]
    if name == 'vbody':
        return [('cylinder', v[0] * 1.6, v[0] * 2), ('cylinder', v[0] * .9, v[0] * 3)]
    if name in ('plinth', 'gbar', 'gcross', 'lrail', 'tside', 'trung', 'slab'):
        return [('box', *sorted(size))]
    return [('cylinder', max(p[0] for p in mesh[0]), size[1])]


def main():
    wrlkit, shared, *only = sys.argv[1:]
    if not os.path.exists(os.path.join(shared, 'plants')):
        print('skipped:', shared, 'is not there')
        return 77
    with tempfile.TemporaryDirectory() as folder:
        checks = {'huldra': huldra, 'plant': plant, 'bytes': bytes_of_plant}
        chosen = [f for name, f in checks.items() if not only or name in only]
        return 0 if all([f(wrlkit, shared, folder) for f in chosen]) else 1


if __name__ == '__main__':
    sys.exit(main())
