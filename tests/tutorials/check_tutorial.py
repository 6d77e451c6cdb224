#!/usr/bin/env python3
"""One tutorial without a window: what holds for all of them, then the effect that this one promises.

usage: check_tutorial.py <program> <png_check> <frames> <single|double>

For all: so many frames (or FRAMES of effects/<name>.py, if that is fewer) without a warning, of 600 the same end on
one thread and on two, a picture of its own, F1 shows the help, and it contains no more of Karma than it uses. After
120 frames the bodies of those that are in states.txt are where they have been on every machine: `check_tutorial.py
... --state` prints the line for that file. The effect is checked by check() in effects/<name>.py, most often by the
figures of the status line, which a run without a window prints at its end. Effects that take long (IS_LONG) are not
checked where frames are fewer than 600. Fewer than 100 are for sanitizers, which find nothing in what is asserted:
two threads, a picture with the help, and the keys.
"""
import importlib
import os
import re
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
from tutorial import SIZE, look, picture, program, status


def check_all(effect):
    frames = frames_of(effect)
    end = status(frames)
    compared = min(frames, 600)
    assert status(compared) == status(compared, workers=2), 'on two threads it ends differently'
    assert not re.search(r'\b(nan|inf)\b', end, re.I), f'not finite: {end}'
    look('size', picture('all.png', 30), '%dx%d' % SIZE)
    look('help', 'all.png', picture('help.png', 30, '-key', 'F1@20'))
    symbols = subprocess.run(['nm', program], capture_output=True, text=True, check=True).stdout
    for library in {'Mdt', 'Mcd', 'Mst'} - set(getattr(effect, 'USES', ['Mdt'])):
        assert not re.search(f' [TtUu] {library}[A-Z]', symbols), f'it contains {library}, which it does not use'


def state():
    found = re.search(r'^state ([0-9a-f]{8})$', status(120), re.M)
    return found and found.group(1)


def check_state():
    """Whatever compiler, optimization and width of registers: FNV-1a of transforms and velocities, in the order of bodies."""
    name, column = os.path.basename(program), {'single': 1, 'double': 2}[sys.argv[4]]
    lines = [line.split() for line in open(os.path.join(os.path.dirname(os.path.abspath(__file__)), 'states.txt'))]
    for line in lines:
        if line[0] == name:
            assert state() == line[column], f'{name}: state {state()} after 120 frames, and not {line[column]}: if results ' \
                'were meant to change, say so in the commit and write the new state into tests/tutorials/states.txt'


def frames_of(effect):
    return min(int(sys.argv[3]), getattr(effect, 'FRAMES', sys.maxsize))


def press_all(effect):
    """Where the effect would take too long, as with sanitizers: what the keys do, at least."""
    status(frames_of(effect), '3@20,4@30,5@40,Up@45,Left@50,Enter@60')


def run_sanitized(effect):
    end = status(frames_of(effect), workers=2)
    assert not re.search(r'\b(nan|inf)\b', end, re.I), f'not finite: {end}'
    picture('help.png', 30, '-key', 'F1@20')
    press_all(effect)


if sys.argv[-1] == '--state':
    print(os.path.basename(program), state())
    sys.exit(0)
with tempfile.TemporaryDirectory() as directory:
    os.chdir(directory)
    try:
        effect = importlib.import_module('effects.' + os.path.basename(program))
        if int(sys.argv[3]) < 100:
            run_sanitized(effect)
            print('as it should be')
            sys.exit(0)
        check_all(effect)
        check_state()
        if getattr(effect, 'IS_LONG', False) and int(sys.argv[3]) < 600:
            press_all(effect)
        else:
            effect.check()
    except AssertionError as failure:
        print('FAILED:', failure)
        sys.exit(1)
print('as it should be')
