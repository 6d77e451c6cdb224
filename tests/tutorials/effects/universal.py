import math
import re

from tutorial import near, status


def check():
    """One joint: between cos b and 1 / cos b. Two: even, or, the second one turned by 90 degrees, the squares."""
    for keys, bend in ('', 40), ('Left@1,Left@1', 30), ('Right@1,Right@1,Right@1,Right@1', 60):
        c = math.cos(math.radians(bend))
        turns_between(status(600, keys), (c, 1 / c, 1, 1))
        turns_between(status(600, keys + ',3@1' if keys else '3@1'), (c, 1 / c, c**2, 1 / c**2))
    assert 'first 5.00 rad/s' in status(120, 'Up@1,Up@1,Up@1,Up@1')


def turns_between(line, expected):
    found = [float(x) for x in re.findall(r'(?:slowest|fastest) ([0-9.]+)', line)]
    assert len(found) == 4, line
    for value, limit in zip(found, expected):
        near(value, limit, 0.004 * limit**2, f'a limit of the speed in "{line}"')
