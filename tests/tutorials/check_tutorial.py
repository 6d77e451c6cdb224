#!/usr/bin/env python3
"""One tutorial without a window: what holds for all of them, then the effect that this one promises.

usage: check_tutorial.py <program> <png_check>

For all: 600 frames without a warning, the same end twice, a picture of its own, F1 shows the help, and it contains no
more of Karma than it uses. The effect is read from the status line, which a run without a window prints at its end.
"""
import math
import os
import re
import subprocess
import sys
import tempfile

program, png_check = (os.path.abspath(p) for p in sys.argv[1:3])
SIZE = (480, 300)


def run(*arguments):
    """-> the output of a run, which must end well."""
    done = subprocess.run([program, *arguments], capture_output=True, text=True, timeout=250)
    assert done.returncode == 0, f'{arguments}: exit code {done.returncode}\n{done.stdout}{done.stderr}'
    return done.stdout


def status(frames, keys=''):
    """-> the status line after so many frames."""
    return run('-null', '-frames', str(frames), *(['-key', keys] if keys else []))


def figure(line, name):
    """-> the number that stands after a name in a status line."""
    found = re.search(re.escape(name) + r' ([-+]?[0-9.]+(?:e[-+]?[0-9]+)?)', line)
    assert found, f'no "{name}" in: {line}'
    return float(found.group(1))


def near(value, expected, tolerance, what):
    assert abs(value - expected) <= tolerance, f'{what} is {value}, not {expected} (+-{tolerance})'


def picture(name, frames, *arguments):
    run('-osmesa', '-size', '%dx%d' % SIZE, '-frames', str(frames), '-screenshot', name, *arguments)
    return name


def look(question, a, b):
    done = subprocess.run([png_check, question, a, b], capture_output=True, text=True, timeout=60)
    assert done.returncode == 0, f'{question} {a} {b}: {done.stdout}{done.stderr}'


def check_all():
    end = status(600)
    assert end == status(600), 'two runs end differently'
    assert not re.search(r'\b(nan|inf)\b', end, re.I), f'not finite: {end}'
    look('size', picture('all.png', 30), '%dx%d' % SIZE)
    look('help', 'all.png', picture('help.png', 30, '-key', 'F1@20'))
    symbols = subprocess.run(['nm', program], capture_output=True, text=True, check=True).stdout
    assert not re.search(r' [TtUu] (Mcd|Mst)[A-Z]', symbols), 'it contains collision, which it does not use'


def project(point, look_at, distance, theta, phi, fov=0.7):
    """-> (x, y) in pixels and pixels per metre there: a camera that looks at a point from the given angles."""
    toward = [math.sin(theta) * math.cos(phi), math.sin(phi), math.cos(theta) * math.cos(phi)]
    right = [math.cos(theta), 0, -math.sin(theta)]
    up = [-math.sin(theta) * math.sin(phi), math.cos(phi), -math.cos(theta) * math.sin(phi)]
    offset = [p - q for p, q in zip(point, look_at)]
    dot = lambda a: sum(x * y for x, y in zip(a, offset))
    scale = SIZE[1] / 2 / math.tan(fov / 2) / (distance - dot(toward))
    return SIZE[0] / 2 + scale * dot(right), SIZE[1] / 2 - scale * dot(up), scale


def check_drop():
    """n steps of h fall g h^2 n (n + 1) / 2; the picture has the ball there."""
    line, fallen = status(60), 9.8 * 0.03**2 * 60 * 61 / 2
    near(figure(line, 'height'), 18 - fallen, 0.006, 'the height')
    near(figure(line, 'speed'), 9.8 * 1.8, 0.006, 'the speed')
    x, y, scale = project((0, 18 - fallen, 0), (0, 8.8, 0), 30, 0.5, 0.3)
    look('blue', picture('drop.png', 60, '-camera', '30,0.5,0.3'), f'{x},{y},{scale}')
    again = 18 - 9.8 * 0.03**2 * 28 * 29 / 2  # the 62nd step brought it to the ground
    near(figure(status(90), 'height'), again, 0.006, 'the height when it falls again')


def check_bounce():
    """The ball rolls at the end: its spin is speed / radius, and the friction has slowed it down."""
    line = status(330)
    near(figure(line, 'height'), 0, 0.011, 'the height')
    near(figure(line, 'spin'), figure(line, 'speed') / 0.6, 0.005 / 0.6 + 0.006, 'the spin')  # figures are rounded
    near(figure(line, 'speed'), 1.8 * 5 / 7, 0.02, 'the speed')  # of a ball that slid until it rolled
    assert figure(status(130, 'Down@1,Down@2,Down@3'), 'restitution') == 0.45


def check_hinge():
    """The motor holds the plate against gravity, drives it against a stop, and turns it round; stops hold it."""
    assert abs(figure(status(600), 'angle')) <= math.degrees(0.8) + 0.1
    near(figure(status(600, '3@1,4@1'), 'angle'), math.degrees(1.4), 0.1, 'the angle at the hard stop')
    torque = 20 - 9.8 * 1.5 * math.sin(1.4 + 0.09)  # what the spring has to bear; it comes to rest within 0.03 rad/s
    soft = figure(status(1800, '3@1,4@1,5@1'), 'angle')
    near(soft, math.degrees(1.4 + torque / 60), 0.5, 'the angle at the soft stop')
    near(figure(status(300, '3@1'), 'rate'), 3, 0.01, 'the rate of the free motor')


with tempfile.TemporaryDirectory() as directory:
    os.chdir(directory)
    try:
        check_all()
        globals()['check_' + os.path.basename(program)]()
    except AssertionError as failure:
        print('FAILED:', failure)
        sys.exit(1)
print('as it should be')
