import math

from tutorial import figure, near, status

USES = ['Mdt', 'Mcd', 'Mst']
IS_LONG = True
SLOPE, GRAVITY = 0.36, 9.81


def check():
    """Blocks slide as their friction has it; the gate sees who passes; hits are events."""
    line = status(60)
    for name, friction in ('ice', 0.02), ('wood', 0.25):
        # they fall the first millimetre
        near(figure(line, name), GRAVITY * (math.sin(SLOPE) - friction * math.cos(SLOPE)), 0.05, name)
    assert figure(line, 'rubber') < 1e-3, line
    assert figure(line, 'passed') == 0 and figure(line, 'in the gate') == 0, line
    line = status(3600)
    assert figure(line, 'passed') >= 8 and 0 <= figure(line, 'in the gate') <= 2, line
    assert figure(line, 'rubber') < 1e-3, line  # it holds for a minute
    assert figure(line, 'hits') > 20 and 1 < figure(line, 'hardest') < 30, line
    assert figure(status(3600, '3@1800'), 'hits') > figure(line, 'hits') + 5, 'the balls make no hits'
