import math

from tutorial import figure, near, status

RATE, TILT = math.hypot(5, 7), math.atan2(7, 5)  # rad/s of the blow, and its axis from the vertical
STIFF = ','.join(['Left@1'] * 2 + ['Up@1'] * 12)  # no damping, 80 N m/rad


def check():
    """The rigid one does not turn, the spinning one only about its axis, the springy one rocks at its frequency."""
    for frames in 15, 45, 300, 600:
        line = status(frames)
        for name, value in ('rigid', 0), ('spinning', 0), ('spin', 5):
            near(figure(line, name), value, 0.02, f'{name} after {frames} steps')
    near(figure(status(15), 'free'), lean(RATE * 15 / 60), 0.05, 'the free one in its first flight')
    near(figure(status(15), 'height'), 6 * 0.25 - 9.8 * 0.25**2 / 2, 0.006, 'the height')
    omega = math.sqrt(80 / 0.2)
    for frames in 2, 5, 9, 14:
        leans = figure(status(frames, STIFF), 'springy')
        near(leans, lean(rocked(frames, omega)), 0.4, f'the springy one after {frames} steps')
    assert figure(status(1200), 'springy') < 0.1, 'the rocking did not die away'


def rocked(frames, omega, h=1 / 60):
    """The turn after the blow, by the midpoint rule."""
    rate, angle = RATE, 0
    for _ in range(frames):
        a = (omega * h / 2) ** 2
        last, rate = rate, (rate * (1 - a) - omega**2 * h * angle) / (1 + a)
        angle += h * (last + rate) / 2
    return angle


def lean(angle):
    """How far the upright axis leans after a turn about the axis of the blow."""
    return math.degrees(2 * math.asin(abs(math.sin(angle / 2)) * math.sin(TILT)))
