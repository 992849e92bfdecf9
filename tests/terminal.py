#!/usr/bin/env python3
"""What long work shows on a terminal, and what is left when the user ends it.

  tests/terminal.py --wrlkit build/release/wrlkit

Bakes corpus/plant/pump_room_primitives.wrl behind a pseudo terminal. Within three seconds the line must say what is done; once it has said how
much of it, by a percentage, Ctrl-C is pressed: the process must end by that signal, which shells show as 130, with the line cleared, and no
file may be left.
"""
import argparse, os, pathlib, pty, re, select, signal, sys, tempfile, time

project = pathlib.Path(__file__).resolve().parents[1]


def run(command, folder):
    """(seconds to the first line, all that was drawn, how the process ended); Ctrl-C at the first percentage."""
    process, terminal = pty.fork()
    if process == 0:
        os.chdir(folder)
        os.execv(command[0], command)
    begin, first, drawn, pressed = time.monotonic(), None, b'', False
    while time.monotonic() - begin < 120:
        if not select.select([terminal], [], [], 1)[0]:
            continue
        try:
            drawn += os.read(terminal, 65536)
        except OSError:  # Linux says so when the other end has gone
            break
        first = first or time.monotonic() - begin
        if not pressed and re.search(rb'\(\d+ %\), [\d.]+/s, [\d.]+ (s|min|h) left', drawn):
            os.write(terminal, b'\x03')
            pressed = True
    else:
        os.kill(process, signal.SIGKILL)  # it would wait for somebody to read what it draws
    return first, drawn, os.waitpid(process, 0)[1]


def main():
    a = argparse.ArgumentParser()
    a.add_argument('--wrlkit', default='build/release/wrlkit')
    wrlkit = str(pathlib.Path(a.parse_args().wrlkit).resolve())
    faults = []
    with tempfile.TemporaryDirectory() as folder:
        first, drawn, status = run([wrlkit, 'convert', str(project / 'corpus/plant/pump_room_primitives.wrl'), 'lit.wrl', '-p', 'lightmap{quality=high}'], folder)
        if first is None or first > 3:
            faults.append(f'the first line came after {first} s')
        if not os.WIFSIGNALED(status) or os.WTERMSIG(status) != signal.SIGINT:
            faults.append(f'the process ended with status {status}')
        if not drawn.endswith(b'\r\x1b[K'):
            faults.append(f'the line is left: {drawn[-80:]}')
        if left := os.listdir(folder):
            faults.append(f'files are left: {left}')
    print('\n'.join(faults) or f'said what is done after {first:.1f} s, ended cleanly')
    sys.exit(bool(faults))


main()
