"""The program wrlkit: where it is, one conversion, and what it said."""
import json
import pathlib
import shutil
import subprocess
import tempfile

import bpy

KINDS = {'error': 'ERROR', 'warning': 'WARNING', 'lost': 'INFO'}
MOST_REPORTS = 20  # of an operator; the console has all


class Failed(Exception):
    """Nothing could be made; the text says why."""


def find(preferred):
    """The path of the program; raises Failed."""
    if preferred:
        path = pathlib.Path(bpy.path.abspath(preferred))
        if not path.is_file():
            raise Failed(f'{path}, which the preferences of this add-on name, is not a file')
        return str(path)
    found = shutil.which('wrlkit')
    if not found:
        raise Failed('wrlkit is not found: install it, or say in the preferences of this add-on where it is')
    return found


def run(command):
    try:
        return subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True, errors='replace')
    except OSError as e:
        raise Failed(f'{command[0]} cannot be run: {e.strerror}')


def version(preferred):
    return run([find(preferred), '--version']).stdout.strip()


def preferred(context):
    """What the preferences say; nothing when the add-on's modules run without being installed."""
    addon = context.preferences.addons.get(__package__)
    return addon.preferences.program if addon else ''


def convert(context, source, target, options):
    """Runs `wrlkit convert`; returns the messages of its report. Raises Failed when nothing was made."""
    with tempfile.TemporaryDirectory(prefix='wrlkit-') as folder:
        report = pathlib.Path(folder) / 'report.json'
        done = run([find(preferred(context)), 'convert', str(source), str(target), '-q', '--report', str(report), *options])
        messages = json.loads(report.read_text(encoding='utf-8'))['messages'] if report.exists() else []
    if done.returncode not in (0, 1):
        errors = [text_of(m) for m in messages if m['severity'] == 'error']
        raise Failed('\n'.join(errors) or done.stderr.strip() or f'wrlkit ended with {done.returncode}')
    return messages


def text_of(message):
    place = ':'.join(str(message[k]) for k in ('file', 'line', 'column') if message.get(k))
    times = f" ({message['count']} times)" if message.get('count', 1) > 1 else ''
    return f"{place}: {message['text']}{times} [{message['name']}]" if place else f"{message['text']}{times} [{message['name']}]"


def report(operator, messages):
    """All messages to the console, the gravest as reports of the operator."""
    for m in messages:
        print(f"wrlkit: {m['severity']}: {text_of(m)}")
    order = list(KINDS)
    # Blender shows the last report at the bottom of its window.
    gravest = sorted(messages, key=lambda m: order.index(m['severity']))[:MOST_REPORTS]
    if len(messages) > len(gravest):
        operator.report({'INFO'}, f'{len(messages) - len(gravest)} more messages of wrlkit are in the console')
    for m in reversed(gravest):
        operator.report({KINDS[m['severity']]}, text_of(m))
