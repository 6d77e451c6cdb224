import math

from tutorial import figure, near, status


def slide(slope, holding):
    """-> the speed after 1 s on a slope, degrees, against a friction of so much of the weight."""
    return max(0, 9.8 * (math.sin(math.radians(slope)) - holding))


def check():
    """The cone slides above atan(mu) = 25 degrees; the normal-force model holds slantwise up to sqrt(2) mu; the box model's
    bound does not know the slope."""
    mu = math.tan(math.radians(25))
    boxed = mu * math.cos(math.radians(25))  # of the weight
    for slope in (24, 26, 30):
        keys = ','.join(f'Up@{i + 1}' for i in range(slope - 24))
        line = status(60 + slope - 24, keys)
        assert figure(line, 'slope') == slope
        normal = math.cos(math.radians(slope))
        near(figure(line, 'cone'), slide(slope, mu * normal), 0.03, f'cone at {slope}')
        near(figure(line, 'normal force'), slide(slope, math.sqrt(2) * mu * normal), 0.03, f'normal force at {slope}')
        near(figure(line, 'box model'), slide(slope, boxed), 0.03, f'box model at {slope}')
    by_itself(mu, boxed)


def by_itself(mu, boxed):
    """24 degrees for 75 frames, then 30 and 36 for 210 each: of each one second."""
    for slope, frames in (24, 60), (30, 75 + 60), (36, 75 + 210 + 60), (24, 75 + 420 + 60):
        line = status(frames)
        assert figure(line, 'slope') == slope, line
        near(figure(line, 'cone'), slide(slope, mu * math.cos(math.radians(slope))), 0.05, f'by itself, cone at {slope}')
        near(figure(line, 'box model'), slide(slope, boxed), 0.05, f'by itself, box model at {slope}')
