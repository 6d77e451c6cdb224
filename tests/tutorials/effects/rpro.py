import math
import re

from tutorial import figure, near, status

LIFT, BEND, LOAD = 0.6, -1.0, 6 * 9.8  # rad, rad, N: the animation stopped at its start


def check():
    """The arm follows the animation exactly as long as it is strong enough, else its torque is the strength."""
    for frames in 60, 300, 600:
        assert max(errors(status(frames, 'Enter@1'))) <= 0.05, 'it does not follow the animation'
    assert figure(status(200), 'shoulder off by') > 20, 'the weight that comes by itself'
    follows('5@1', 0)
    follows('5@1,3@1,Up@1', LOAD)
    line = status(3000, '5@1,3@1,Down@1,Down@1')
    assert figure(line, 'shoulder off by') > 20, f'not overpowered: {line}'
    near(figure(line, 'torque'), 150, 1, "the overpowered shoulder's torque")
    near_end = status(600, '5@1,3@1,Down@1,Down@1,3@300')
    assert max(errors(near_end)) <= 0.01, f'the arm did not come back without the weight: {near_end}'
    assert errors(status(62, '4@60'))[1] > 10 and max(errors(status(200, '4@60'))) <= 0.05, 'a stroke, and back again'


def errors(line):
    return [float(x) for x in re.findall(r'off by ([0-9.]+) deg', line)]


def follows(keys, load):
    """Statics: the weights of the parts and of the load at their arms."""
    upper, fore = 1.4 * math.cos(LIFT), 1.2 * math.cos(LIFT + BEND)  # m, how far out they reach
    elbow = 3 * 9.8 * fore / 2 + load * fore
    shoulder = elbow + 4 * 9.8 * upper / 2 + (3 * 9.8 + load) * upper
    line = status(3000, keys)
    assert max(errors(line)) <= 0.01, line
    for expected, found in zip((shoulder, elbow), re.findall(r'torque ([0-9.]+) of', line)):
        near(float(found), expected, 0.3, f'a torque in "{line}"')
