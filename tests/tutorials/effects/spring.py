import math

from tutorial import figure, near, status


def check():
    """The rod keeps its length, the string is never longer and pulls only when taut, the spring keeps time."""
    for frames in 60, 120, 300, 600:
        line = status(frames)
        near(figure(line, 'rod'), 2, 0.001, f'the rod after {frames} steps')
        assert figure(line, 'string') <= 2.02, line
        assert figure(line, 'elastic') > 2.01 or 'elastic %.3f m, 0.0 N' % figure(line, 'elastic') in line, line
    falls_freely(status(20), 20)
    assert figure(status(20, '4@1'), 'elastic') >= 1.999, 'the elastic with a hard lower stop was compressed'
    omega = math.sqrt(20)  # 1 kg on 20 N/m; hung up without damping, the spring swings by g / omega^2 either way
    swing = 120 * math.atan(omega / 120)  # its frequency by the midpoint rule
    for frames in 21, 63, 147, 231:
        expected = 2 + 9.8 / omega**2 * (1 - math.cos(swing * frames / 60))
        near(figure(status(frames, 'Left@1,Left@1,3@1'), 'spring'), expected, 0.006, f'the spring after {frames} steps')
    damped = status(1800, 'Up@1,Up@1,Up@1,Up@1' + ',Right@1' * 9 + ',3@1')
    near(figure(damped, 'spring'), 2 + 9.8 / 40, 0.001, 'the stiffer spring at rest')


def falls_freely(line, n):
    """While they are slack, string and elastic do nothing."""
    fallen = 9.8 * (n / 60) ** 2 / 2
    distance = math.hypot(2 * math.sin(2), -2 * math.cos(2) - fallen)
    near(figure(line, 'string'), distance, 0.001, 'the slack string')
    near(figure(line, 'elastic'), distance, 0.001, 'the slack elastic')
