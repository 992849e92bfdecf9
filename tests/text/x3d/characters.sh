python3 - %t <<'PYTHON'
import os, re, subprocess, sys, xml.etree.ElementTree as tree
folder = sys.argv[1]
WORLD = '''#VRML V2.0 utf8
# comment@
PROTO P [ field SFString s "@" ] { WorldInfo { title IS s } }
P { s "@" }
WorldInfo { title "@" info [ "@" "b@" ] }
Anchor { url "a@.html" description "@" }
Script { url "javascript: function f() { return '@'; }" field SFString own "@" }
Unknown { text "@" }
Group { unknown@ "@" children Shape { geometry Text { string "@" } } }
'''
os.makedirs(folder, exist_ok=True)
odd = [chr(c) for c in range(1, 32) if c not in (9, 10, 13)] + ['\ufffe', '\uffff']
for c in odd:
    world = WORLD.replace('unknown@', 'unknown' + (c if c > ' ' else '')).replace('@', c)
    with open(f'{folder}/in.wrl', 'w', encoding='utf-8', newline='') as f:
        f.write(world)
    done = subprocess.run(['wrlkit', 'convert', f'{folder}/in.wrl', f'{folder}/out.x3d'], capture_output=True, text=True)
    text = open(f'{folder}/out.x3d', encoding='utf-8').read()
    tree.fromstring(text)
    said = re.search(r'lost: (\d+) characters that are invalid in XML', done.stderr)
    count = int(said[1]) if said else 0
    if count != text.count('\ufffd') or count < 12 or c in text:
        print(f'U+{ord(c):04X}: {count} reported, {text.count(chr(0xfffd))} written')
    subprocess.run(['wrlkit', 'convert', f'{folder}/in.wrl', f'{folder}/out.wrl'], capture_output=True)
    if open(f'{folder}/out.wrl', encoding='utf-8', newline='').read().count(c) < 12:
        print(f'U+{ord(c):04X}: not in VRML')
print(len(odd), 'characters')
PYTHON
