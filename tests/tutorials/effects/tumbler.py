from tutorial import figure, near, status

USES = ['Mdt', 'Mcd', 'Mst']
IS_LONG = True
FRAMES = 100  # every one solves for a thousand rows


def check():
    """The motor turns the drum against the weight of the heap, no box gets out, and no energy comes from nowhere."""
    line = status(300)
    near(figure(line, 'drum'), 0.8, 0.05, 'the speed of the drum')
    assert figure(line, 'boxes inside') == 64, line
    assert figure(line, 'motion') < 64 * 27.3 * 9.81 * 3, line  # as if all fell from the axis
    assert 2 < figure(line, 'torque') <= 40, line  # the heap hangs on the rising side
    still = status(300, '3@150')
    near(figure(still, 'drum'), 0, 0.01, 'the speed of the drum that was stopped')
    assert figure(still, 'motion') < figure(line, 'motion') / 20 and figure(still, 'boxes inside') == 64, still
