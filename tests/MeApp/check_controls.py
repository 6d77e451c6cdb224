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
    """The pointer is moved, the button goes down and up, and a list opens: each in a frame of its own."""
    frame = value(window, 'frame')
    window.wait_for('six frames', lambda: value(window, 'frame') >= frame + 6)


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
    check_inspector(window, at)
    check_layers(window, at)
    window.send('key', 'Escape')
    if window.end() != 0 or 'cleanup' not in window.output():
        fail(f'the program did not end well:\n{window.output()}')


def changer(window, at):
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
    return change


def check_panels(window, at):
    """Every setting of the panel "Simulation"; and the report, which is on while its panel is seen."""
    change = changer(window, at)
    window.send('key', 'F9')
    let_frames_pass(window)
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
    def slide():
        window.send(*at(710, 389), 'mousedown', '1')
        let_frames_pass(window)
        window.send(*at(712, 389), 'mouseup', '1')
        let_frames_pass(window)
        return value(window, 'gravity') > -9
    window.wait_for('the slider moves', slide)


def check_inspector(window, at):
    """Settings of the box that was clicked: in the panel "Inspector", the last one when "Viewer" and "Simulation" are
    folded."""
    change = changer(window, at)
    for y in (18, 47):
        window.send(*at(800, y), 'click', '1')
        let_frames_pass(window)
    change('velocity', (790, 149))
    change('mass', (700, 124))
    if value(window, 'mass') > 4000:
        fail(f'the mass is {value(window, "mass")}')
    change('swept', (690, 249))
    change('friction', (790, 274))


def check_layers(window, at):
    """The arrows of contact forces are fitted to them, and made longer and shorter by hand."""
    change = changer(window, at)
    window.send(*at(800, 18), 'click', '1')
    let_frames_pass(window)
    window.send(*at(690, 310), 'click', '1')  # in "Viewer": the panel "Layers"
    let_frames_pass(window)
    window.send(*at(800, 300), 'click', *['--repeat', '60', '4'])
    for y in (18, 76):  # folds "Viewer" and "Inspector"
        window.send(*at(800, y), 'click', '1')
        let_frames_pass(window)
    change('forceLength', (690, 230))
    before = value(window, 'forceLength')
    change('forceLength', (705, 274))
    if not 1.9 * before < value(window, 'forceLength') < 2.6 * before:
        fail(f'forces became {value(window, "forceLength")} long from {before}')
    change('forceLength', (765, 274))
    change('selectedOnly', (690, 130))


with server() as display, tempfile.TemporaryDirectory() as scratch:
    check(os.path.abspath(sys.argv[1]), display, scratch)
print('the controls work')
