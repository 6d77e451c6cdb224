import math
import re

from tutorial import figure, near, status, statuses

BASE, MASS, INERTIA, RADIUS = 2.4, 600 + 4 * 30, 4 * 0.4 * 30 * 0.45**2, 0.45  # m, kg, kg m^2, m
SLOW_LEFT = ','.join(['Down@1'] * 7 + ['Left@1'] * 6)  # 5.5 - 7 * 0.5 = 2 m/s, 6 * 0.05 = 0.3 rad


def check():
    """The engine accelerates the car, it drives straight, runs on its circle, brakes, and its springs carry it."""
    acceleration = 2 * 600 / RADIUS / (MASS + INERTIA / RADIUS**2)
    near(figure(status(60), 'speed'), acceleration, 0.02, 'the speed after 1 s')
    over_bumps = status(240)
    near(figure(over_bumps, 'speed'), 5.5, 0.03, 'the speed')
    near(figure(over_bumps, 'left'), 0, 0.002, 'the way to the left when driving straight on')
    turns()
    line = status(190, '4@100')
    near(figure(line, 'speed'), 0, 0.02, 'the speed after braking')
    near(figure(line, 'left'), 0, 0.002, 'the way to the left when braking')
    springs()
    for frames in 420, 1500:  # in the first half circle, now and one lap later
        line = status(frames)
        from_middle = math.hypot(figure(line, 'x') - 12, figure(line, 'left') - 8)
        near(from_middle, 8, 0.15, "the distance from the bend's middle")


def turns():
    """The steering says where the middle of the rear axle goes; the car's centre is half the base before it."""
    rear = BASE / math.tan(0.3)
    half = round(60 * math.pi * rear / 2)  # frames
    lines = statuses(300 + half, SLOW_LEFT)
    line, opposite = lines[299], lines[-1]
    near(figure(line, 'turns'), math.degrees(2 / rear), 0.1, 'the rate of turning')
    diameter = math.hypot(*(figure(line, name) - figure(opposite, name) for name in ('x', 'left')))
    near(diameter, 2 * math.hypot(rear, BASE / 2), 0.05, "the circle's diameter")


def heights(line):
    return [float(x) for x in re.search(r'suspension \(cm\)((?: [-+][0-9.]+)+)', line).group(1).split()]


def springs():
    """At rest the springs carry the car at height 0, shaken by the start; worn dampers let it go on swinging."""
    assert max(map(abs, heights(status(300, '4@1')))) <= 0.1
    swing = lambda keys: max(max(map(abs, heights(statuses(260, keys)[n - 1]))) for n in (240, 250, 260))
    good, worn = swing(''), swing('5@1')
    assert good < 1 and worn > 3, f'after the bumps: {good} cm with good dampers, {worn} cm with worn ones'
