import math

from tutorial import figure, near, status


def check():
    """The rod's top stays on the path, or lags by v h / gamma; on the circle the load keeps its angle."""
    for keys, omega, radius in ('', 1, 2), ('Down@1,Down@1,Down@1', 0.7, 2), ('Up@1,Right@1,Right@1', 1.1, 2.5):
        expected = steady(omega, radius)
        for frames in 60, 600:
            line = status(frames, keys)
            near(figure(line, 'off the path by'), 0, 0.1, "the top's distance from the path in mm")
            near(figure(line, "rod's angle"), math.degrees(expected), 0.6, "the rod's angle")
            near(figure(line, 'force'), 500 * 9.8 / math.cos(expected), 50, 'the force')
    lag = status(60, '3@1')
    near(figure(lag, 'off the path by'), 2 / 60 / 0.2 * 1000, 5, 'the lag without velocity in mm')
    near(figure(status(600, '4@1'), 'off the path by'), 0, 0.1, "the top's distance from the eight in mm")


def steady(omega, radius):
    """The angle of a rod of 3 m that goes round with its top, which is the radius from the middle."""
    a = 0
    for _ in range(500):
        a = math.atan(omega**2 * (radius + 3 * math.sin(a)) / 9.8)
    return a
