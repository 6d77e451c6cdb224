import math
import re

from tutorial import near, status

TILT = ','.join(['Right@1'] * 6)  # to 60 degrees


def check():
    """No pendulum leaves its cone; in tilted cones they rest at the side, or at a soft one's balance."""
    for keys, fastest in ('', 4.3), (TILT, 6), ('4@100,4@200', 6):  # m/s, more than the energy allows
        for half, most in zip((15, 30, 50), figures(status(600, keys), 'most')):
            assert half - 0.5 < most <= half + beyond(half, fastest), f'{half}: {most} with "{keys}"'
    for half, angle in zip((15, 30, 50), figures(status(6000, TILT), r'(?<=\s{3})')):
        near(angle, half, 0.05, 'the angle at rest at the side')
    for half, angle in zip((15, 30, 50), figures(status(6000, TILT + ',3@1'), r'(?<=\s{3})')):
        near(angle, balance(half), 0.02, 'the angle at rest at the soft side')
    assert ' of 20,' in status(1, 'Up@1')


def beyond(half, speed):
    """A step along the tangent of the side ends so far outside, and a fifth of what has gathered is mended per step."""
    return math.degrees((speed / 60 / 1.8) ** 2 / (2 * math.tan(math.radians(half))) / 0.2) + 0.05


def figures(line, before):
    found = [float(x) for x in re.findall(before + r' ([0-9.]+)(?: of|    |$)', line, re.M)]
    assert len(found) == 3, (before, line)
    return found


def balance(half):
    """100 N m/rad against 1 kg at 1.8 m: 100 (a - half) = m g l sin(60 degrees - a), by bisection."""
    low, high = math.radians(half), math.radians(60)
    for _ in range(60):
        a = (low + high) / 2
        isBelow = 100 * (a - math.radians(half)) < 9.8 * 1.8 * math.sin(math.radians(60) - a)
        low, high = (a, high) if isBelow else (low, a)
    return math.degrees(low)
