#!/usr/bin/env python3
"""The controls of a demonstration program in a window: click, pull, orbit, frame, throw, and a slider of a panel.

usage: check_controls.py <program> <directory of window.py>      exit code 77: Xvfb or xdotool is not installed
"""
import os
import re
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, sys.argv[2])
from window import Window, fail, server


def value(window, what):
    """The last one that the program has told."""
    return float(re.findall(rf'^{what} (\S+)$', window.output(), flags=re.M)[-1])


def let_frames_pass(window):
    """A list opens in the frame after the click."""
    frame = value(window, 'frame')
    window.wait_for('three frames', lambda: value(window, 'frame') >= frame + 3)


def check(program, display, directory):
    # So many frames that they do not end; with the option each has one tick, which is how the test sees them pass.
    window = Window(program, display, directory, '-gl', '-size', '960x600', '-frames', '100000000')
    name = window.find('Karma controls test')
    at = lambda x, y: ('mousemove', '--window', name, str(x), str(y))
    window.expect('gravity -9.81')
    window.send(*at(480, 300), 'mousedown', '1')
    window.expect('selected 1')
    window.expect('held 1')
    angle = value(window, 'angle') if 'angle' in window.output() else 0.0
    window.send(*at(520, 290), 'mouseup', '1')
    window.expect('held 0')
    if 'angle' in window.output() and value(window, 'angle') != angle:
        fail('pulling a box turned the camera')
    window.send(*at(100, 100), 'mousedown', '1')
    window.send(*at(200, 100), 'mouseup', '1')
    window.wait_for('the camera turns', lambda: 'angle' in window.output())
    window.send('key', 'f')
    window.wait_for('the box is framed', lambda: value(window, 'distance') != 12)
    window.send('key', 'space')
    window.expect('bodies 3')
    check_panels(window, at)
    window.send('key', 'Escape')
    if window.end() != 0 or 'cleanup' not in window.output():
        fail(f'the program did not end well:\n{window.output()}')


def check_panels(window, at):
    """Every setting of the panel "Simulation"; and the report, which is on while its panel is seen."""
    def change(what, *places):
        """Clicks, one after the other, until the program tells of another value."""
        told = lambda: len(re.findall(rf'^{what} ', window.output(), flags=re.M))
        before = told()

        def ready():
            for x, y in places:
                window.send(*at(x, y), 'click', '1')
                let_frames_pass(window)
            return told() > before
        window.wait_for(f'{what} changes', ready)

    window.send('key', 'F9')
    change('substeps', (800, 414))
    change('solver', (740, 439), (710, 488))
    change('budget', (690, 464))
    change('sleeps', (690, 489))
    window.send(*at(750, 537), 'click', '1')
    change('friction', (760, 562))
    change('restitution', (760, 587))
    # In the panel "Viewer", the last of the panels' names.
    window.send(*at(690, 335), 'click', '1')
    window.expect('report 1')
    window.send(*at(800, 300), 'click', *['--repeat', '60', '4'])  # the column had scrolled to the report
    let_frames_pass(window)
    window.send(*at(690, 335), 'click', '1')
    window.wait_for('the report is off', lambda: value(window, 'report') == 0)
    # The first panel is "Simulation", its first line the slider of gravity.
    window.wait_for('the slider moves', lambda: window.send(*at(710, 389), 'mousedown', '1') is not None and
                    (window.send(*at(725, 389), 'mouseup', '1') or True) and value(window, 'gravity') > -9)


with server() as display, tempfile.TemporaryDirectory() as scratch:
    check(os.path.abspath(sys.argv[1]), display, scratch)
print('the controls work')
