import math
import re

from tutorial import figure, held, near, status, statuses

USES = ['Mdt', 'Mcd', 'Mst']
IS_LONG = True
BASE, RADIUS, MASS, INERTIA = 2.4, 0.36, 1000 + 4 * 20, 4 * 0.4 * 20 * 0.36**2  # m, m, kg, kg m^2
MANUAL = '3@1'  # stands still, and waits for the driver


def springs(line):
    return [float(x) for x in re.search(r'springs((?: [-+][0-9.]+)+)', line).group(1).split()]


def check():
    """The car stands on its springs, pulls as its engine does, drives straight, brakes, steers, backs, and jumps."""
    line = status(240, MANUAL)
    assert max(map(abs, springs(line))) <= 0.1, line
    near(figure(line, 'y'), RADIUS + 0.27, 0.001, 'the height at rest')
    assert figure(line, 'speed') < 1e-3 and figure(line, 'down') == 4, line
    pulls()
    brakes()
    turns()
    line = status(200, held('Down', 1, 200))
    assert figure(line, 'speed') < -5 and 'gear R' in line, line
    course()


def engine(turns):
    return 120 * (1 - ((turns - 4000) / 5000) ** 2)


def pulls():
    """In first gear: torque over ratio and radius, less the drag of the air; wheels have to be spun up as well."""
    v, dt = 0.0, 1 / 60
    for _ in range(120):
        turns = max(1000, v / RADIUS * 14 * 30 / math.pi)
        v += dt * (engine(turns) * 14 / RADIUS - 0.8 * v * v) / (MASS + INERTIA / RADIUS**2)
    line = status(140, MANUAL + ',' + held('Up', 21, 200))
    near(figure(line, 'speed'), v, 0.02 * v, 'the speed after 2 s of full throttle')
    near(figure(line, 'z'), -8, 0.01, 'the way to the side when driving straight on')


def brakes():
    """From second gear, by the torque of four brakes; the handbrake slides the rear wheels, then holds."""
    keys = MANUAL + ',' + held('Up', 1, 150) + ',' + held('Down', 160, 260)
    fast, slow = (figure(statuses(195, keys)[n - 1], 'speed') for n in (165, 195))
    near(fast - slow, 0.5 * 4 * 600 / RADIUS / (MASS + INERTIA / RADIUS**2), 0.06, 'what 0.5 s of braking takes away')
    stop = status(400, MANUAL + ',' + held('Up', 1, 100) + ',Space@110')
    assert abs(figure(stop, 'speed')) < 1e-3 and figure(stop, 'x') > -22, stop


def turns():
    """The steering says where the middle of the rear axle goes; the car's middle is half the base before it."""
    line = status(220, MANUAL + ',' + held('Up', 1, 80) + ',' + held('Left', 1, 300))
    rear = BASE / math.tan(math.radians(figure(line, 'steer')))
    radius = figure(line, 'speed') / math.radians(figure(line, 'turn'))
    near(figure(line, 'steer'), math.degrees(0.55), 0.01, 'the steering')
    near(radius, rear, 0.03 * rear, "the rear axle's radius")


def course():
    """By itself it jumps into the crates and drives on over the hills, not through the ground nor over the rim."""
    line = status(348)
    assert figure(line, 'down') == 0 and figure(line, 'y') > 1.6, line
    for frames in range(600, 3601, 1000):
        line = status(frames)
        x, y, z = (figure(line, name) for name in 'xyz')
        assert 0.3 < y < 6 and max(abs(x), abs(z)) < 65 and figure(line, 'speed') > 4, line
