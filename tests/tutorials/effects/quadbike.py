import math

from tutorial import figure, held, near, status

USES = ['Mdt', 'Mcd', 'Mst']
IS_LONG = True
MANUAL = '3@1'  # stands still, and waits for the rider
RADIUS, WHEEL_INERTIA, DENSITY = 0.25, 0.25, 600  # m, kg m^2, kg/m^3
LIMBS = [(0.12, 0.7, 0.439), (0.16, 0.6, 0.432), (0.2, 0.36, 0.532), (0.2, 0.18, 0.245)] + 2 * [
    (0.1, 0.1, 0.409), (0.08, 0.08, 0.320)]  # m
CARRIED = 150 + 1 + DENSITY * sum(x * y * z for x, y, z in LIMBS)  # kg: chassis, handlebars, rider
MASS = CARRIED + 4 * 10


def check():
    """It stands on its springs, pulls, brakes, steers; the bars follow, the rider leans and crouches, and stays on."""
    line = status(240, MANUAL)
    sag = CARRIED * 20 / 4 / 50000
    softness = 2e-4 * (CARRIED / 4 + 10) * 20 / 3600 / (10 / 60)  # of the contact and of the world, at this load
    near(figure(line, 'y'), 0.45 - sag - softness, 0.001, 'the height at rest')
    assert abs(figure(line, 'speed')) < 0.01, line
    pulls()
    brakes()
    turns()
    rides()


def pulls():
    """Two wheels of 200 N m, less the faster they turn; the wheels have to be spun up as well."""
    v = 0.0
    for _ in range(90):
        v += 2 * 200 * (1 - v / RADIUS / 60) / RADIUS / (MASS + 4 * WHEEL_INERTIA / RADIUS**2) / 60
    line = status(130, MANUAL + ',' + held('Up', 41, 300))
    near(figure(line, 'speed'), v, 0.04 * v, 'the speed after 1.5 s of full throttle')
    near(figure(line, 'z'), 0, 0.01, 'the way to the side when riding straight on')


def brakes():
    line = status(190, MANUAL + ',' + held('Up', 41, 140) + ',' + held('Down', 150, 176))
    assert abs(figure(line, 'speed')) < 0.6, line
    near(figure(line, 'turn'), 0, 0.5, 'the rate of turning when braking')


def turns():
    """Bars and wheels turn to the same side; the rider leans to it, by .035 rad for each m/s and input, and crouches."""
    keys = MANUAL + ',' + held('Up', 41, 160) + ','
    lines = [status(150, keys + held(key, 100, 160)) for key in ('Left', 'Right')]
    for line, side in zip(lines, (1, -1)):
        steer, lean = figure(line, 'steer'), figure(line, 'lean')
        near(figure(line, 'bars'), steer, 0.5, 'the angle of the bars')
        assert side * steer > 8 and side * figure(line, 'turn') > 20, line
        wanted = -steer / math.degrees(0.5) * math.degrees(min(0.035 * figure(line, 'speed'), 0.35))
        near(lean, wanted, 2, 'how far the rider leans')
        assert figure(line, 'knees') > 8, line
    near(figure(lines[0], 'lean'), -figure(lines[1], 'lean'), 0.05, 'leaning to the other side')


def rides():
    """By itself over the hills: it stays on its wheels and within the rim, and the rider holds on."""
    for frames in range(600, 3601, 1000):
        line = status(frames)
        x, y, z = (figure(line, name) for name in 'xyz')
        assert 0.2 < y < 5 and max(abs(x), abs(z)) < 66, line
        assert abs(figure(line, 'lean')) < 20 and -15 < figure(line, 'knees') < 40, line
