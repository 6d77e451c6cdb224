#!/usr/bin/env python3
"""Counts the instructions of twelve scenes by callgrind and prints which have changed by more than 5 %.

    check_instructions.py PROGRAM FILE [--keep]

FILE has the counts that are kept, and for which compiler and precision. Counts of other compilers differ: changes are
printed, and only a scene that cannot be run is an error. --keep writes FILE anew. Ends with 77 without valgrind."""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

LIMIT = .05
FRAMES = '30'
SCENES = ('pendulum', 'hinge', 'top', 'chain-10', 'chain-level', 'tumbling', 'heavy-1e6', 'tower', 'incline', 'rolling',
          'block', 'cradle')


def count(program, scene):
    """Instructions from start to end, None if it fails."""
    with tempfile.TemporaryDirectory() as directory:
        run = subprocess.run(['valgrind', '--tool=callgrind', f'--callgrind-out-file={directory}/out', program, scene,
                              FRAMES], capture_output=True, text=True, check=False)
    found = re.search(r'Collected : (\d+)', run.stderr)
    if run.returncode or not found:
        print(f'{scene} cannot be run:\n{run.stderr}')
        return None
    return int(found.group(1))


def kept(file):
    lines = [line.split() for line in file.read_text().splitlines() if line and not line.startswith('#')]
    return {scene: int(number) for scene, number in lines}


def keep(file, counts, compiler):
    head = ('# Instructions of the first half second of scenes, by callgrind, start of the program included.\n'
            f'# {compiler}\n# Made by tests/scenes/check_instructions.py --keep.\n')
    file.write_text(head + ''.join(f'{scene} {number}\n' for scene, number in counts.items()))


if not shutil.which('valgrind'):
    print('valgrind is not there')
    sys.exit(77)
program, file = sys.argv[1], pathlib.Path(sys.argv[2])
counts = {scene: count(program, scene) for scene in SCENES}
if None in counts.values():
    sys.exit(1)
if '--keep' in sys.argv:
    version = subprocess.run(['gcc', '--version'], capture_output=True, text=True, check=True).stdout.splitlines()[0]
    keep(file, counts, f'{version}, the preset ci (Release, checks on, single precision); a processor with AVX2')
before = kept(file)
print('\n'.join(line[2:] for line in file.read_text().splitlines() if line.startswith('# ')))
for scene, number in counts.items():
    change = number / before[scene] - 1
    print(f'{scene:12} {number:12} {change:+8.1%}{"   CHANGED" if abs(change) > LIMIT else ""}')
