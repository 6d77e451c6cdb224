#!/usr/bin/env python3
"""The browser of tutorials: all of them one after the other without a window; and in one, which stays open.

usage: check_browser.py <program> <directory of window.py> <top of the sources>   exit code 77: no Xvfb or xdotool
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import time

sys.dont_write_bytecode = True
sys.path.insert(0, sys.argv[2])
from window import Window, fail, server

program = os.path.abspath(sys.argv[1])
names = sorted(path.name for path in (pathlib.Path(sys.argv[3]) / 'tutorials').iterdir()
               if path.is_dir() and path.name[0].isupper())


def check_all(directory):
    """A tour of all: each comes once, what it leaves behind is nothing (the sanitizer says), and it ends as alone."""
    run = subprocess.run([program, '-tour', '-null', '-frames', '10'], capture_output=True, text=True, cwd=directory)
    started = re.findall(r'^browser: (\w+)$', run.stdout + run.stderr, flags=re.M)
    if sorted(started) != names or run.returncode:
        fail(f'the browser has been through {started}, and ended with {run.returncode}:\n{run.stderr[-3000:]}')
    run = subprocess.run([program, 'Pyramid', '-null', '-frames', '30'], capture_output=True, text=True, cwd=directory)
    alone = subprocess.run([os.path.join(os.path.dirname(program), 'pyramid'), '-null', '-frames', '30'],
                           capture_output=True, text=True, cwd=directory)
    state = lambda output: re.findall(r'^state (\w+)$', output.stdout + output.stderr, flags=re.M)
    if run.returncode or state(run) != state(alone) or not state(run):
        fail(f'Pyramid ends with {state(run)} and {run.returncode}, alone with {state(alone)}')
    if subprocess.run([program, 'Nothing', '-null'], capture_output=True, cwd=directory).returncode != 2:
        fail('a tutorial that there is not')


def check_window(display, directory):
    os.environ['ASAN_OPTIONS'] = 'detect_leaks=0'  # the driver's; those of tutorials are looked for on the tour
    window = Window(program, display, directory, '-gl', '-size', '960x600')
    name = window.find('Karma tutorial: Drop')
    at = lambda x, y: ('mousemove', '--window', name, str(x), str(y))
    window.send('windowsize', '--sync', name, '900', '560')
    window.send('key', 'bracketright')
    window.expect('browser: Bounce')
    if window.find('Karma tutorial: Bounce') != name:
        fail('the next tutorial has another window')
    size = window.send('getwindowgeometry', name)
    if '900x560' not in ' '.join(size):
        fail(f'the next tutorial has another size: {size}')
    # The panel's first line: previous, restart, next.
    window.send(*at(736, 38), 'click', '1')
    window.wait_for('a restart', lambda: window.output().count('browser: Bounce') == 2)
    window.find('Karma tutorial: Bounce')
    window.send(*at(790, 38), 'click', '1')
    window.expect('browser: Stack')
    if window.find('Karma tutorial: Stack') != name:
        fail('after a click on next, another window')
    # A word of Spring's head alone finds it: the only line, below its category's title.
    def search(words, name):
        window.send(*at(690, 59), 'click', '1')
        time.sleep(1)  # frames pass, so that the field takes what is typed
        window.send('key', 'ctrl+a', 'BackSpace')
        window.send('type', words)
        time.sleep(1)
        window.send(*at(690, 104), 'click', '1')
        time.sleep(1)
        return f'browser: {name}\n' in window.output()[before:]
    before = len(window.output())
    window.wait_for('a search for Spring', lambda: search('rope taut', 'Spring'))
    window.find('Karma tutorial: Spring')
    before = len(window.output())
    window.wait_for('a search for Stack', lambda: search('stack', 'Stack'))
    window.find('Karma tutorial: Stack')
    before = len(window.output())
    # Stack has its context by MeAppStart: from there, too, one comes on.
    window.send('key', 'bracketright')
    window.wait_for('Hinge', lambda: 'browser: Hinge' in window.output()[before:])
    window.send('key', 'bracketleft')
    window.wait_for('Stack again', lambda: 'browser: Stack' in window.output()[before:])
    window.find('Karma tutorial: Stack')
    window.send('key', 'Escape')
    if window.end() != 0:
        fail(f'the browser ended with {window.process.returncode}:\n{window.output()}')


def check_list(display, directory):
    """The list begins with the line of the tutorial that runs in its middle: the next one is below it."""
    window = Window(program, display, directory, 'Ragdolls', '-gl', '-size', '960x600')
    name = window.find('Karma tutorial: Ragdolls')
    time.sleep(1)  # frames pass, in which the list is scrolled
    window.send('mousemove', '--window', name, '700', '215', 'click', '1')
    window.expect('browser: Car')
    window.find('Karma tutorial: Car')
    window.send('key', 'Escape')
    if window.end() != 0:
        fail(f'the browser ended with {window.process.returncode}:\n{window.output()}')


with tempfile.TemporaryDirectory() as scratch:
    check_all(scratch)
    with server() as x:
        check_window(x, scratch)
        check_list(x, scratch)
print('the browser works')
