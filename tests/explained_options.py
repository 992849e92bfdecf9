#!/usr/bin/env python3
"""What `wrlkit explain MESSAGE` advises can be typed: each option, pass and page that tools/verbs/message_help.def names is tried.

  tests/explained_options.py --wrlkit build/release/wrlkit
"""
import argparse, pathlib, re, subprocess, sys, tempfile

project = pathlib.Path(__file__).resolve().parents[1]
verbs = {'convert': ['out.glb'], 'render': ['out.png', '--width', '8', '--height', '8']}
usage = 2  # the exit code
world = '#VRML V2.0 utf8\nShape { geometry Box { } }\n'


def advice():
    """The name of each message, and why it comes and what to do."""
    text = (project / 'tools/verbs/message_help.def').read_text(encoding='utf-8')
    for name, rest in re.findall(r'^HELP\((\w+), (.*)\)$', text, re.MULTILINE):
        yield name, ' '.join(re.findall(r'"((?:[^"\\]|\\.)*)"', rest)[1:])


def run(words, folder):
    return subprocess.run(words, cwd=folder, capture_output=True, text=True, check=False)


def options(wrlkit, folder):
    """{option: (verb that has it, whether a word follows it)}"""
    out = {}
    for verb in reversed(verbs):
        for name, rest in re.findall(r'^ +(?:-\w,)?(--[a-z-]+)(.*)$', run([wrlkit, verb, '--help'], folder).stdout, re.MULTILINE):
            out[name] = verb, re.match(r' [A-Za-z]', rest) is not None and not rest.startswith(' Excludes')
    return out


def commands(wrlkit, text, known):
    """What a reader of `text` may type; None, and the option, where no verb has it."""
    for name, word in re.findall(r'(?<![\w-])(--[a-z-]+)(?: ([\w-]+(?:,[\w-]+)*))?', text):
        verb, takes_word = known.get(name, (None, False))
        words = [name, '.' if word == 'DIR' else word] if takes_word else [name]
        yield verb and [wrlkit, verb, 'in.wrl', *verbs[verb], *words], ' '.join(words)
    for passes in re.findall(r"-p '([^']+)'|-p ([a-z-]+)|(?<!['\w])([a-z0-9-]+\{[^}]*\})", text):
        words = ['-p', ''.join(passes)]
        yield [wrlkit, 'convert', 'in.wrl', 'out.glb', *words, '--print-pipeline'], ' '.join(words)
    for verb, word in re.findall(r'wrlkit (explain|passes) ([\w-]+)', text):
        yield [wrlkit, verb, word], f'wrlkit {verb} {word}'


def main():
    a = argparse.ArgumentParser()
    a.add_argument('--wrlkit', default='build/release/wrlkit')
    wrlkit = str(pathlib.Path(a.parse_args().wrlkit).resolve())
    faults, n = [], 0
    with tempfile.TemporaryDirectory() as folder:
        (pathlib.Path(folder) / 'in.wrl').write_text(world)
        known = options(wrlkit, folder)
        for name, text in advice():
            for command, words in commands(wrlkit, text, known):
                n += 1
                done = command and run(command, folder)
                if not done:
                    faults.append(f'{name}: no verb has {words}')
                elif done.returncode == usage:
                    faults.append(f'{name}: {words}: {done.stderr.strip()}')
    print(*faults, f'{n} options, passes and commands tried, {len(faults)} wrong', sep='\n')
    return bool(faults) or n < 20


if __name__ == '__main__':
    sys.exit(main())
