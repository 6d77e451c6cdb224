import math

from tutorial import figure, near, status


def check():
    """The motor holds the plate against gravity, drives it against a stop, and turns it round; stops hold it."""
    assert abs(figure(status(600), 'angle')) <= math.degrees(0.8) + 0.1
    near(figure(status(600, '3@1,4@1'), 'angle'), math.degrees(1.4), 0.1, 'the angle at the hard stop')
    torque = 20 - 9.8 * 1.5 * math.sin(1.4 + 0.09)  # what the spring has to bear; it comes to rest within 0.03 rad/s
    soft = figure(status(1800, '3@1,4@1,5@1'), 'angle')
    near(soft, math.degrees(1.4 + torque / 60), 0.5, 'the angle at the soft stop')
    near(figure(status(300, '3@1'), 'rate'), 3, 0.01, 'the rate of the free motor')
