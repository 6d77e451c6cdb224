#!/usr/bin/env python3
"""A real window in a virtual X server: does F1 show the help, do keys and mouse arrive, does the program end well?

usage: check_window.py <program> <png_check>      exit code 77: Xvfb or xdotool is not installed
"""
import os
import subprocess
import sys
import tempfile
import time

sys.dont_write_bytecode = True
from window import PATIENCE, Ended, Window, fail, server


def check(compare, question, *pictures):
    run = subprocess.run([compare, question, *pictures], capture_output=True, text=True, timeout=PATIENCE)
    print(f'{question} {" ".join(os.path.basename(p) for p in pictures)}: {run.stdout.strip()}{run.stderr}')
    return run.returncode == 0


def check_keys(program, compare, display, directory):
    window = Window(program, display, directory, '-gl', '-size', '480x360')
    name = window.find()
    window.expect('tick 3')
    window.send('key', 'F2')
    window.expect('-0001.png')
    window.send('key', 'F1')
    window.send('key', 'F2')
    window.expect('-0002.png')
    window.send('key', 'F1')
    window.send('key', 'Return')
    window.expect('reset at')
    window.send('mousemove', '--window', name, '200', '170', 'mousedown', '1')
    window.expect('pressed at 170')
    window.send('mousemove', '--window', name, '210', '190', 'mouseup', '1')
    window.expect('released at 190')
    window.send('windowsize', '--sync', name, '400', '300')
    window.send('mousemove', '--window', name, '100', '100')

    def resized():
        before = window.output().count('wrote')
        window.send('key', 'F2')
        window.wait_for('a picture', lambda: window.output().count('wrote') > before)
        return '(400x300)' in window.output()
    window.wait_for('a picture of the new size', resized)
    window.send('key', 'q')
    code = window.end()
    if code != 0:
        fail(f'the exit code after q is {code}:\n{window.output()}')
    if window.output().count('cleanup 0') != 1:
        fail(f'the cleanup did not run once:\n{window.output()}')
    before, after = (os.path.join(directory, f'test_viewer_program-000{i}.png') for i in (1, 2))
    if not check(compare, 'size', before, '480x360'):
        fail('F2 wrote a picture of another size')
    if check(compare, 'same', before, after):
        fail('F1 changed nothing')
    if not check(compare, 'help', before, after):
        fail('F1 showed no help')


def check_panels(program, display, directory):
    """F9 opens the panels; a click on one is the panel's and not the program's."""
    window = Window(program, display, directory, '-gl', '-size', '960x600')
    name = window.find()
    window.expect('tick 3')
    window.send('key', 'F9')
    window.expect('panel seen')
    window.send('mousemove', '--window', name, '690', '340', 'click', '1')
    window.expect('panel button')
    if 'pressed at' in window.output():
        fail('the program got the click on the panel too')
    window.send('mousemove', '--window', name, '480', '500', 'click', '1')
    window.expect('pressed at 500')
    window.send('key', 'Escape')
    if window.end() != 0 or window.output().count('cleanup 0') != 1:
        fail(f'after panels, the end is not as it should be:\n{window.output()}')


def check_early_end(program, directory):
    """A program that cannot open its window is reported at once, not after waiting for the window."""
    window = Window(program, ':65000', directory, '-gl')
    begin = time.monotonic()
    try:
        window.find()
    except Ended as ended:
        if time.monotonic() - begin < PATIENCE / 2 and 'ended with 1' in str(ended):
            return
    fail('a program without a display is not reported at once')


def check_frames(program, compare, display, directory):
    """A window that closes itself, and draws the same as a buffer."""
    for kind in ('-gl', '-osmesa'):
        window = Window(program, display, directory, kind, '-size', '320x240', '-frames', '20', '-screenshot',
                        f'frames{kind}.png', '-key', 'F3@1')
        if window.end() != 0:
            fail(f'{kind} -frames 20 ended with {window.process.returncode}:\n{window.output()}')
    if not check(compare, 'size', os.path.join(directory, 'frames-gl.png'), '320x240'):
        fail('-screenshot of a window has another size')
    if not check(compare, 'near', *(os.path.join(directory, f'frames{kind}.png') for kind in ('-gl', '-osmesa'))):
        fail('the window shows something else than the buffer')


def main():
    program, compare = (os.path.abspath(p) for p in sys.argv[1:3])
    with server() as display, tempfile.TemporaryDirectory() as directory:
        check_keys(program, compare, display, directory)
        check_panels(program, display, directory)
        check_early_end(program, directory)
        check_frames(program, compare, display, directory)
    print('the window works')


main()
