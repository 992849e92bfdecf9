#!/usr/bin/env python3
"""Worlds that want all the memory, all the time or all the stack; none may get them.

  tests/text/limits.py --wrlkit build/release/wrlkit              every case with every verb
  tests/text/limits.py --wrlkit ... --verbs cat,info gzip         cases whose name contains 'gzip'
  tests/text/limits.py --wrlkit ... --keep DIR                    leave the worlds in DIR

Each world is made on the fly and goes through check, cat, info and convert in 2 GB of address space and 30 CPU seconds. A run
passes when it ends without a signal, with exit code 0, 1 or 3, says what was dropped, and keeps the rest of the scene: behind
the bad part of a world stands a node with the name Rest.
"""
import argparse
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
import json
import math
import os
from pathlib import Path
import re
import signal
import struct
import subprocess
import sys
import tempfile
import threading
import zlib

HEADER = '#VRML V2.0 utf8\n'
REST = '\nDEF Rest Shape { geometry Box {} }\n'
HEADER_1 = '#VRML V1.0 ascii\n'
REST_1 = '\nDEF Rest Cube { }\n'
VERBS = ('check', 'cat', 'info', 'convert')
EXPANDING = ('check', 'info', 'convert')  # what expands prototypes and loads Inlines
MEMORY = 2 << 30
SECONDS = 30          # of the processor
LIMITED = ['prlimit', f'--as={MEMORY}', f'--cpu={SECONDS}', '--core=0']
PATIENCE = 20          # times as much on the clock, for machines that are busy
SMALL_JSON = 8 << 20   # bytes; larger ones are searched, not parsed
MESSAGE = re.compile(r'(error|warning|lost): .* \[([a-z0-9-]+)\](?:, \d+ in all)?$', re.M)


@dataclass
class Case:
    name: str
    make: callable          # (folder) -> the world to open
    reports: str = ''       # one of these messages, separated by '|', must come; empty: none has to
    rest: bool = True       # the rest of the scene can be told from the bad part
    verbs: tuple = VERBS    # where the message must come; the writers see less than check


def world(name, *parts, rest=REST, header=HEADER):
    """A case's make that writes one file; a part is a text or a pair of a text and how often it comes."""
    def make(folder):
        path = folder / f'{name}.wrl'
        with path.open('w') as out:
            out.write(header)
            for part in parts:
                write_part(out, part)
            out.write(rest)
        return path
    return make


def gltf(name, *parts):
    """The same for a glTF file."""
    def make(folder):
        path = folder / f'{name}.gltf'
        with path.open('w') as out:
            for part in parts:
                write_part(out, part)
        return path
    return make


def deep_gltf_nodes(n=100_000):
    nodes = [{'children': [i + 1]} for i in range(n)] + [{}]
    return json.dumps({'asset': {'version': '2.0'}, 'scenes': [{'nodes': [0]}], 'nodes': nodes})


def zeros_in_gltf(n=2000):
    """Accessors without data, of as many elements as one may have."""
    primitives = [{'attributes': {'POSITION': i}} for i in range(n)]
    accessors = [{'componentType': 5126, 'count': 10_000_000, 'type': 'VEC3'}] * n
    return json.dumps({'asset': {'version': '2.0'}, 'scenes': [{'nodes': [0]}], 'nodes': [{'mesh': 0}], 'meshes': [{'primitives': primitives}], 'accessors': accessors})


def instances_in_gltf():
    instancing = {'EXT_mesh_gpu_instancing': {'attributes': {'TRANSLATION': 1}}}
    accessors = [{'componentType': 5126, 'count': 3, 'type': 'VEC3'}, {'componentType': 5126, 'count': 16_000_000, 'type': 'VEC3'}]
    return json.dumps({'asset': {'version': '2.0'}, 'scenes': [{'nodes': [0]}], 'nodes': [{'mesh': 0, 'extensions': instancing}],
                       'meshes': [{'primitives': [{'attributes': {'POSITION': 0}}]}], 'accessors': accessors})


def write_part(out, part):
    if isinstance(part, str):
        return out.write(part)
    text, times = part
    batch = max(1, min(times, (1 << 20) // len(text)))
    for _ in range(times // batch):
        out.write(text * batch)
    out.write(text * (times % batch))


def document(name, *parts):
    """A case's make that writes one X3D document, the rest of the scene behind the bad part."""
    def make(folder):
        path = folder / f'{name}.x3d'
        with path.open('w') as out:
            out.write('<X3D version="3.3" profile="Full"><Scene>\n')
            for part in parts:
                write_part(out, part)
            out.write('\n<Shape DEF="Rest"><Box/></Shape></Scene></X3D>\n')
        return path
    return make


def files(texts):
    """A case's make that writes several files; the first one is opened."""
    def make(folder):
        for name, text in texts.items():
            (folder / name).write_text(HEADER + text)
        return folder / next(iter(texts))
    return make


def gzip_bomb(folder):
    """About 10 GB of blanks in 10 MB, with the rest of the scene in front and behind."""
    path = folder / 'gzip_bomb.wrl'
    blanks = b' ' * (1 << 24)
    with path.open('wb') as out:
        pack = zlib.compressobj(9, zlib.DEFLATED, 31)
        out.write(pack.compress((HEADER + REST).encode()))
        # A full flush makes every block the same bytes, so one is packed and the others are copies.
        out.write(pack.flush(zlib.Z_FULL_FLUSH))
        block = pack.compress(blanks) + pack.flush(zlib.Z_FULL_FLUSH)
        for _ in range(600):
            out.write(block)
    return path


def doubling_protos():
    protos = 'PROTO P0 [] { Shape { geometry Box {} } }\n'
    protos += ''.join(f'PROTO P{i} [] {{ Group {{ children [ P{i - 1} {{}} P{i - 1} {{}} ] }} }}\n' for i in range(1, 41))
    return protos + 'P40 {}\n'


def doubling_protos_with_is():
    """The same with a field that goes down to the last node, so that no two of them can be shared."""
    protos = 'PROTO P0 [ field SFFloat r 1 ] { Shape { geometry Sphere { radius IS r } } }\n'
    protos += ''.join(f'PROTO P{i} [ field SFFloat r 1 ] {{ Group {{ children [ P{i - 1} {{ r IS r }} P{i - 1} {{ r IS r }} ] }} }}\n'
                      for i in range(1, 41))
    return protos + 'P40 { r 2 }\n'


def doubling_protos_with_bits(k=24):
    """The same with a value that is another one in each of the 2^23 instances: there is nothing to share."""
    fields = ' '.join(f'field SFBool b{j} FALSE' for j in range(k))
    protos = f'PROTO P0 [ {fields} ] {{ Shape {{ geometry Cone {{ side IS b0 bottom IS b1 }} }} }}\n'
    for i in range(1, k):
        same = ' '.join(f'b{j} IS b{j}' for j in range(k) if j != i)
        two = ' '.join(f'P{i - 1} {{ {same} b{i} {bit} }}' for bit in ('TRUE', 'FALSE'))
        protos += f'PROTO P{i} [ {fields} ] {{ Group {{ children [ {two} ] }} }}\n'
    return protos + f'P{k - 1} {{}}\n'


def doubling_events():
    """Each level passes an event on to two instances."""
    protos = 'PROTO P0 [ eventIn SFTime go ] { Group { children TimeSensor { set_startTime IS go } } }\n'
    protos += ''.join(f'PROTO P{i} [ eventIn SFTime go ] {{ Group {{ children [ P{i - 1} {{ go IS go }} P{i - 1} {{ go IS go }} ] }} }}\n'
                      for i in range(1, 41))
    return protos + 'DEF T TouchSensor {} DEF P P40 {}\nROUTE T.touchTime TO P.go\n'


def event_fan_out(n=3000):
    """One ROUTE that stands for n times n."""
    return ('PROTO P [ eventOut SFTime out ] { Group { children [ ' + 'TouchSensor { touchTime IS out }\n' * n + '] } }\n'
            'PROTO Q [ eventIn SFTime go ] { Group { children [ ' + 'TimeSensor { set_startTime IS go }\n' * n + '] } }\n'
            'DEF A P {} DEF B Q {}\nROUTE A.out TO B.go\n')


def deep_bodies():
    """Bodies of nine hundred nodes inside each other, which hold each other."""
    groups = 'Group { children ' * 900
    protos = 'PROTO P0 [] { Shape { geometry Box {} } }\n'
    protos += ''.join(f'PROTO P{i} [] {{ {groups} P{i - 1} {{}} {"}" * 900} }}\n' for i in range(1, 60))
    return protos + 'P59 {}\n'


def long_chain_of_protos():
    protos = 'PROTO P0 [] { Shape { geometry Box {} } }\n'
    protos += ''.join(f'PROTO P{i} [] {{ Group {{ children P{i - 1} {{}} }} }}\n' for i in range(1, 20_000))
    return protos + 'P19999 {}\n'


def uses_turned_round(n=5000):
    """Flat in the file, for each node comes before its USE; the body turns them round, so that each one holds the next."""
    fields = ''.join(f'field SFNode a{i} NULL\n' for i in range(n))
    body = ''.join(f'Group {{ children IS a{i} }}\n' for i in reversed(range(n)))
    uses = ''.join(f'a{i} DEF A{i} Group {{ children USE A{i - 1} }}\n' for i in range(1, n))
    return f'PROTO P [ {fields} ] {{ Group {{ children [ {body} ] }} }}\nP {{ a0 DEF A0 Shape {{}}\n{uses} }}\n'


def doubling_inlines():
    """Each file shows the next one ten times, and the last one has a ROUTE: no Inline can share it."""
    texts = {f'{i}.wrl': f'Inline {{ url "{i + 1}.wrl" }}\n' * 10 for i in range(12)}
    texts['0.wrl'] += REST
    texts['12.wrl'] = 'DEF C TimeSensor {} DEF T Shape { geometry Box {} } DEF S TouchSensor {}\nROUTE S.touchTime TO C.set_startTime\n'
    return texts


def world_1(name, *parts):
    """The same of VRML 1.0."""
    return world(name, *parts, rest=REST_1, header=HEADER_1)


def doubling_groups(changes):
    """Each group holds the one before twice, which changes the state: there are 2^40 of them."""
    text = f'DEF A0 Group {{ Cube {{ }} {changes} }}'
    for i in range(1, 41):
        text = f'DEF A{i} Group {{ {text} USE A{i - 1} }}'
    return text + '\n'


def doubling_uses():
    text = 'DEF A0 Shape { geometry Box {} }'
    for i in range(1, 41):
        text = f'DEF A{i} Group {{ children [ {text} USE A{i - 1} ] }}'
    return text + '\n'


def doubling_clip_planes():
    """Each group is met twice below, in another place: there are 2^40 sets of planes."""
    text = 'DEF A0 Shape { geometry Box {} }'
    for i in range(1, 41):
        text = f'DEF A{i} Group {{ children [ ClipPlane {{ plane 0 1 0 {i} }} {text} Transform {{ translation 0 1 0 children USE A{i - 1} }} ] }}'
    return text + '\n'


def long_contour(n=400_000):
    points = ''.join(f'{math.cos(i * math.tau / n) / 4 + 0.5} {math.sin(i * math.tau / n) / 4 + 0.5},' for i in range(n))
    return f"""Shape {{ geometry NurbsTrimmedSurface {{ uDimension 2 vDimension 2 uOrder 2 vOrder 2 uKnot [ 0 0 1 1 ] vKnot [ 0 0 1 1 ]
 uTessellation 100 vTessellation 100 controlPoint Coordinate {{ point [ 0 0 0, 1 0 0, 0 1 0, 1 1 0 ] }}
 trimmingContour Contour2D {{ children ContourPolyline2D {{ controlPoint [ {points} ] }} }} }} }}
"""


def wide_interface():
    fields = ''.join(f'field SFFloat f{i} {i}\n' for i in range(100_000))
    return 'PROTO Wide [\n' + fields + '] { Group {} }\nWide { f99999 1 }\n'


def large_polygon():
    """A comb: a concave polygon for which every naive ear search takes the longest."""
    n = 100_000
    points = ''.join(f'{i} 0 0,{i}.5 {1 + i % 7} 0,\n' for i in range(n - 1)) + f'{n} 0 0, {n // 2} -{n} 0'
    index = ' '.join(map(str, range(2 * n)))
    return (f'Shape {{ geometry IndexedFaceSet {{ convex FALSE coord Coordinate {{ point [ {points} ] }}\n'
            f'coordIndex [ {index} -1 ] }} }}\n')


def deep_inlines():
    """Files of nine hundred nodes inside each other, which show each other."""
    texts = {f'{i}.wrl': 'Group { children ' * 900 + f'Inline {{ url "{i + 1}.wrl" }}' + '}' * 900 for i in range(15)}
    texts['0.wrl'] += REST
    return texts | {'15.wrl': 'Shape { geometry Box {} }'}


def chain_of_inlines():
    """Files that show each other, more of them than may be inside each other."""
    texts = {f'{i}.wrl': f'Inline {{ url "{i + 1}.wrl" }}' for i in range(30)}
    texts['0.wrl'] += REST
    return texts | {'30.wrl': 'Shape { geometry Box {} }'}


HUGE = 2_000_000_000
TOO_DEEP = 'too-deep|unclosed|syntax'
CASES = [
    Case('nested_groups', world('nested_groups', ('Group { children ', 1_000_000), ('}', 1_000_000)), 'too-deep'),
    Case('proto_doubling', world('proto_doubling', doubling_protos()), 'expansion-limit', verbs=('convert',)),
    Case('proto_doubling_with_is', world('proto_doubling_with_is', doubling_protos_with_is()), 'expansion-limit', verbs=('convert',)),
    Case('proto_doubling_with_bits', world('proto_doubling_with_bits', doubling_protos_with_bits()), 'expansion-limit', verbs=EXPANDING),
    Case('proto_doubling_events', world('proto_doubling_events', doubling_events()), 'expansion-limit', verbs=EXPANDING),
    Case('proto_event_fan_out', world('proto_event_fan_out', event_fan_out()), 'expansion-limit', verbs=EXPANDING),
    Case('proto_deep_bodies', world('proto_deep_bodies', deep_bodies()), 'too-deep', verbs=EXPANDING),
    Case('proto_deep_body', world('proto_deep_body', 'PROTO P [] { ', ('Group { children ', 900), 'Shape { geometry Box {} }', ('}', 900), '}'),
         'no-gltf-depth', verbs=('convert',)),
    Case('proto_long_chain', world('proto_long_chain', long_chain_of_protos()), 'too-deep', verbs=EXPANDING),
    Case('proto_uses_turned_round', world('proto_uses_turned_round', uses_turned_round()), 'too-deep', verbs=EXPANDING),
    Case('proto_into_itself', world('proto_into_itself', 'PROTO P [ field MFNode n [] ] { Group { children IS n } }\n',
                                    'DEF G Group { children P { n USE G } }'), 'use-cycle', verbs=EXPANDING),
    Case('use_doubling', world('use_doubling', doubling_uses()), 'expansion-limit', verbs=('convert',)),
    Case('proto_ignores_fields', world('proto_ignores_fields', 'PROTO P [ field MFNode c [] ] { Group {} }\nP { c DEF Large Group { children [',
                                       ('Group {}\n', 20_000), '] } }\n', ('P { c USE Large }\n', 200_000), rest=''),
         'nothing-shown', rest=False, verbs=EXPANDING),
    Case('inline_itself', files({'self.wrl': 'Inline { url "self.wrl" }' + REST}), 'url-cycle', verbs=('info', 'convert')),
    Case('inline_each_other', files({'a.wrl': 'Inline { url "b.wrl" }' + REST, 'b.wrl': 'Inline { url "a.wrl" }'}),
         'url-cycle', verbs=('info', 'convert')),
    Case('inline_doubling', files(doubling_inlines()), 'expansion-limit', verbs=EXPANDING),
    Case('inline_chain', files(chain_of_inlines()), 'expansion-limit', verbs=EXPANDING),
    Case('inline_deep', files(deep_inlines()), 'too-deep', verbs=EXPANDING),
    Case('externproto_cycle',
         files({'a.wrl': 'EXTERNPROTO B [] "b.wrl#B"\nPROTO A [] { B {} }\nA {}' + REST,
                'b.wrl': 'EXTERNPROTO A [] "a.wrl#A"\nPROTO B [] { A {} }\n'}),
         'url-cycle|proto-cycle', verbs=('info', 'convert')),
    Case('gltf_deep', gltf('gltf_deep', '{"asset":{"version":"2.0"},"extras":', ('[', 5_000_000)), 'syntax', rest=False),
    Case('gltf_deep_nodes', gltf('gltf_deep_nodes', deep_gltf_nodes()), 'too-deep', rest=False),
    Case('gltf_zeros', gltf('gltf_zeros', zeros_in_gltf()), 'gltf-no-data', rest=False),
    Case('gltf_instances', gltf('gltf_instances', instances_in_gltf()), 'gltf-no-data|expansion-limit', rest=False),
    Case('gzip_bomb', gzip_bomb, 'gzip-bomb|too-large'),
    Case('huge_index',
         world('huge_index', 'Shape { geometry IndexedFaceSet { coord Coordinate { point [ 0 0 0 1 0 0 0 1 0 ] }',
               f' coordIndex [ 0 1 {HUGE} -1 0 1 2 -1 ] }} }}'), 'bad-index', verbs=('convert',)),
    Case('huge_image',
         world('huge_image', 'Shape { appearance Appearance { texture PixelTexture { image ', f'{HUGE} {HUGE} 3 0xff0000',
               ' } } geometry Sphere {} }'), 'missing-values|short-value|bad-value'),
    Case('huge_elevation_grid',
         world('huge_elevation_grid', f'Shape {{ geometry ElevationGrid {{ xDimension {HUGE} zDimension {HUGE}',
               ' height [ 0 1 2 3 ] } }'), 'short-height|degenerate-geometry', verbs=('info', 'convert')),
    Case('huge_extrusion', world('huge_extrusion', 'Shape { geometry Extrusion { crossSection [',
                                 *(f'{math.cos(i)} {math.sin(i)},' for i in range(2000)), '] spine [',
                                 *(f'0 {i} 0,' for i in range(1000)), '] } }'), 'expansion-limit', verbs=('convert',)),
    Case('clip_planes_doubling', world('clip_planes_doubling', doubling_clip_planes()), 'expansion-limit', verbs=('convert',)),
    Case('long_contour', world('long_contour', long_contour()), 'untrimmed', verbs=('convert',)),
    Case('unclosed_string', world('unclosed_string', 'WorldInfo { title "', ('x', 20_000_000)), 'unclosed-string', rest=False),
    Case('brackets', world('brackets', ('[', 5_000_000)), 'stray-token|unclosed|syntax', rest=False),
    Case('defs', world('defs', ('DEF a ', 1_000_000)), 'def-without-node|syntax|too-deep', rest=False),
    Case('nested_protos', world('nested_protos', ('PROTO P [] { ', 1_000_000), 'Group {}', ('}', 1_000_000)), 'too-deep'),
    Case('large_polygon', world('large_polygon', large_polygon())),
    Case('long_text', world('long_text', 'Shape { geometry Text { string "', ('xyz ', 500_000), '" } }')),
    Case('routes_to_nothing', world('routes_to_nothing', ('ROUTE a.b TO c.d\n', 1_000_000)), 'undefined-route'),
    Case('unknown_fields', world('unknown_fields', 'Group {', *(f' no{i} 1\n' for i in range(300_000)), '}'), 'unknown-field'),
    Case('script_fields', world('script_fields', 'Script {', *(f' field SFFloat f{i} 1\n' for i in range(100_000)), '}')),
    Case('wide_interface', world('wide_interface', wide_interface())),
    Case('nested_lists', world('nested_lists', 'Group { children ', ('[ ', 1_000_000), (']', 1_000_000), '}'), TOO_DEEP + '|stray-token'),
    Case('x3d_nested', document('x3d_nested', ('<Group>', 1_000_000), ('</Group>', 1_000_000)), 'too-deep'),
    Case('x3d_nested_protos', document('x3d_nested_protos', ('<ProtoDeclare name="P"><ProtoBody>', 300_000), ('</ProtoBody></ProtoDeclare>', 300_000)), 'too-deep'),
    Case('x3d_entities', document('x3d_entities', '<WorldInfo title="', ('&lol;', 2_000_000), '"/>'), 'xml-entity'),
    Case('x3d_attributes', document('x3d_attributes', '<Group', *(f' no{i}="1"' for i in range(100_000)), '/>'), 'unknown-field'),
    Case('x3d_indices', document('x3d_indices', f'<Shape><TriangleStripSet stripCount="{HUGE} {HUGE}"><Coordinate point="0 0 0 1 0 0 0 1 0"/></TriangleStripSet></Shape>')),
    Case('vrml1_nested', world_1('vrml1_nested', ('Separator { ', 1_000_000), ('}', 1_000_000)), 'too-deep'),
    Case('vrml1_doubling', world_1('vrml1_doubling', 'Separator {', doubling_groups(''), '}'), 'expansion-limit', verbs=('convert',)),
    Case('vrml1_doubling_place', world_1('vrml1_doubling_place', 'Separator {', doubling_groups('Translation { translation 1 0 0 }'), '}'),
         'expansion-limit', verbs=('convert',)),
    Case('vrml1_doubling_state', world_1('vrml1_doubling_state', 'Separator {', doubling_groups('Texture2Transform { translation 0.1 0 }'), '}'),
         'expansion-limit', verbs=('cat', 'convert')),
    Case('vrml1_doubling_lights', world_1('vrml1_doubling_lights', 'Separator {', doubling_groups('DirectionalLight { }'), '}'),
         'expansion-limit', verbs=('cat', 'convert')),
    Case('vrml1_lights_in_turn', world_1('vrml1_lights_in_turn', 'Separator {', ('DirectionalLight { } Cube { }\n', 20_000), '}'), 'too-deep',
         verbs=('cat', 'convert')),
    Case('vrml1_array', world_1('vrml1_array', f'Array {{ numElements1 {HUGE} numElements2 {HUGE} Cube {{ }} }}'), 'expansion-limit'),
    Case('vrml1_quad_mesh', world_1('vrml1_quad_mesh', f'Separator {{ Coordinate3 {{ point [ 0 0 0, 1 0 0 ] }} QuadMesh {{ verticesPerRow {HUGE} verticesPerColumn {HUGE} }}',
                                    f' FaceSet {{ startIndex {HUGE} numVertices [ {HUGE} ] }} PointSet {{ startIndex {HUGE} numPoints {HUGE} }} }}')),
    Case('vrml1_strays', world_1('vrml1_strays', ('[ ( | ~ = . ] ', 300_000)), 'stray-token|syntax|unclosed', rest=False),
    Case('unclosed_lists', world('unclosed_lists', 'Group { children ', ('[ ', 1_000_000)), TOO_DEEP + '|stray-token', rest=False),
]


def command(verb, path, out):
    return {'check': ['check', path], 'cat': ['cat', path, '-o', out / 'out.wrl'], 'info': ['info', path],
            'convert': ['convert', path, out / 'out.glb']}[verb]


class Faulty(Exception):
    pass


@dataclass
class Result:
    code: int
    seconds: float  # of the processor
    megabytes: int
    output: Path
    errors: str


def execute(wrlkit, verb, path, out):
    """Runs one verb; SIGKILL is the end of its time."""
    for old in out.glob('out.*'):
        old.unlink()
    stdout, stderr = out / 'stdout', out / 'stderr'
    with stdout.open('wb') as o, stderr.open('wb') as e:
        process = subprocess.Popen([*LIMITED, wrlkit, *command(verb, path, out)], cwd=path.parent, stdin=subprocess.DEVNULL,
                                   stdout=o, stderr=e)
        alarm = threading.Timer(SECONDS * PATIENCE, process.kill)
        alarm.start()
        _, status, usage = os.wait4(process.pid, 0)
        alarm.cancel()
    process.returncode = os.waitstatus_to_exitcode(status)
    written = {'cat': out / 'out.wrl', 'convert': out / 'out.glb'}.get(verb, stdout)
    errors = text_of(stderr) + (text_of(stdout) if verb == 'check' else '')
    return Result(process.returncode, usage.ru_utime + usage.ru_stime, usage.ru_maxrss >> 10, written, errors)


def text_of(path):
    with path.open('rb') as f:
        return f.read(4_000_000).decode('utf-8', 'replace')


def glb_json(path):
    with path.open('rb') as f:
        magic, _, _, length, kind = struct.unpack('<4sII I4s', f.read(20))
        assert magic == b'glTF' and kind == b'JSON'
        return f.read(length)


def has_rest(verb, output):
    """Whether the rest of the scene is there."""
    if not output.is_file() or not output.stat().st_size:
        return False
    if verb == 'cat':
        return b'DEF Rest Shape' in output.read_bytes()
    if verb == 'convert':
        text = glb_json(output)
        try:
            return b'"name":"Rest"' in text and (len(text) > SMALL_JSON or 'nodes' in json.loads(text))
        except RecursionError:
            raise Faulty('the JSON is nested deeper than a reader takes')
    return True


def complaint(case, verb, result):
    """What is wrong with this run; nothing: empty."""
    if result.code == -signal.SIGKILL:
        return f'takes longer than {SECONDS} s'
    if result.code < 0:
        return f'ends by {signal.Signals(-result.code).name}'
    if result.code not in (0, 1, 3):
        return f'exit code {result.code}'
    names = {m[2] for m in MESSAGE.finditer(result.errors)}
    if case.reports and verb in case.verbs and not names & set(case.reports.split('|')):
        return f'no {case.reports.replace("|", " or ")} among the messages: {", ".join(sorted(names)) or "none"}'
    if case.rest and verb in ('cat', 'convert') and not has_rest(verb, result.output):
        return f'the rest of the scene is missing (exit code {result.code})'
    if case.rest and verb == 'info' and not result.output.stat().st_size:
        return f'no output (exit code {result.code})'
    return ''


def run_case(case, folder, options):
    """Number of verbs that fail; prints a line for each."""
    inputs, out = folder / case.name, folder / f'{case.name}.out'
    inputs.mkdir()
    out.mkdir(exist_ok=True)
    path = case.make(inputs)
    failed = 0
    for verb in options.verbs:
        result = execute(options.wrlkit, verb, path, out)
        try:
            fault = complaint(case, verb, result)
        except Faulty as why:
            fault = str(why)
        failed += bool(fault)
        if fault or options.verbose:
            print(f'{"FAILED" if fault else "ok":7}{case.name:25}{verb:8}{result.seconds:6.1f} s{result.megabytes:6} MB  {fault}',
                  flush=True)
            if fault and (lines := result.errors.splitlines()):
                print('\n'.join('       ' + line[:200] for line in lines[:4]), flush=True)
    if not options.keep:
        for file in inputs.iterdir():
            file.unlink()
    return failed


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('cases', nargs='*', help='parts of the names of the cases to run')
    parser.add_argument('--wrlkit', type=Path, default=Path('build/release/wrlkit'), help='the program')
    parser.add_argument('--verbs', type=lambda text: text.split(','), default=list(VERBS), help='check,cat,info,convert')
    parser.add_argument('--keep', type=Path, help='an empty folder for the worlds, which stay there')
    parser.add_argument('--jobs', type=int, default=os.cpu_count(), help='cases at a time')
    parser.add_argument('--verbose', action='store_true', help='print the runs that pass, too')
    options = parser.parse_args()
    options.wrlkit = options.wrlkit.resolve()
    chosen = [c for c in CASES if not options.cases or any(word in c.name for word in options.cases)]
    with tempfile.TemporaryDirectory(prefix='limits_') as folder:
        with ThreadPoolExecutor(options.jobs) as pool:
            failed = sum(pool.map(lambda case: run_case(case, options.keep or Path(folder), options), chosen))
    runs = len(chosen) * len(options.verbs)
    print(f'{runs - failed} of {runs} runs passed')
    return 1 if failed or not runs else 0


if __name__ == '__main__':
    sys.exit(main())
