"""What the effects of tutorials are checked with. The program is the first argument of check_tutorial.py."""
import functools
import math
import os
import re
import subprocess
import sys

program, png_check = (os.path.abspath(p) for p in sys.argv[1:3])
SIZE = (480, 300)


def run(*arguments):
    """-> the output of a run, which must end well."""
    done = subprocess.run([program, *arguments], capture_output=True, text=True, timeout=250)
    assert done.returncode == 0, f'{arguments}: exit code {done.returncode}\n{done.stdout}{done.stderr}'
    return done.stdout


@functools.lru_cache(None)
def status(frames, keys='', workers=1):
    """-> the status line after so many frames, and a hash of the bodies' state. The same is run but once."""
    return run('-null', '-frames', str(frames), '-workers', str(workers), *(['-key', keys] if keys else []))


@functools.lru_cache(None)
def statuses(frames, keys=''):
    """-> the status line of each frame of one run; number 0 is of the first."""
    printed = run('-null', '-frames', str(frames), '-every', '1', *(['-key', keys] if keys else []))
    lines = [line for line in printed.splitlines() if not line.startswith('state ')]
    assert len(lines) == frames, f'-every 1 prints {len(lines)} lines in {frames} frames'
    return lines


def held(key, first, last):
    """-> what to press to hold a key from a frame on, up to the one before another."""
    return f'{key}@{first}-{last - 1}'


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


def project(point, look_at, distance, theta, phi, fov=0.7):
    """-> (x, y) in pixels and pixels per metre there: a camera that looks at a point from the given angles."""
    toward = [math.sin(theta) * math.cos(phi), math.sin(phi), math.cos(theta) * math.cos(phi)]
    right = [math.cos(theta), 0, -math.sin(theta)]
    up = [-math.sin(theta) * math.sin(phi), math.cos(phi), -math.cos(theta) * math.sin(phi)]
    offset = [p - q for p, q in zip(point, look_at)]
    dot = lambda a: sum(x * y for x, y in zip(a, offset))
    scale = SIZE[1] / 2 / math.tan(fov / 2) / (distance - dot(toward))
    return SIZE[0] / 2 + scale * dot(right), SIZE[1] / 2 - scale * dot(up), scale
