from tutorial import figure, near, status, statuses

USES = ['Mdt', 'Mcd', 'Mst']
IS_LONG = True
FRAMES = 900  # the tower has fallen by then; its heap takes long to compute
HEIGHT, WEIGHT = 18 * 0.15, 600 * 0.25 * 0.15 * 0.75 * 9.81  # m, N of a plank


def check():
    """Any plank may go and the tower stands; not a second one beside it. The first begins to move at its friction."""
    line = status(600, 'Enter@1')
    near(figure(line, 'top at'), HEIGHT, 0.001, 'the top')
    assert figure(line, 'awake') == 0, line
    for key in '34':
        line = status(900, f'{key}@60')
        near(figure(line, 'top at'), HEIGHT, 0.001, f'the top after key {key}')
        assert figure(line, 'awake') == 0 and figure(line, 'off the middle by') < 0.02, line
    pulls()
    assert figure(status(FRAMES), 'top at') < 1.5, 'planks that are drawn by themselves do not bring it down'
    assert figure(status(1300, '3@60,4@800'), 'top at') < 1.5, 'the tower should have fallen'


def pulls():
    """Eight layers lie on the three planks of one: a third of their weight, and its own, press on the plank's sides. A tower
    that is built again is solved exactly from its first step. The pull exceeds the friction by what it grows in a frame."""
    friction, growth = 0.5 * (8 * WEIGHT + 9 * WEIGHT), 20000 * 0.1 / 60
    pull = [figure(line, 'pull') for line in statuses(117, 'Enter@1,3@60')]
    near(pull[-1], friction, 0.01 * friction, 'the pull of what slides steadily')
    assert max(pull) < 1.01 * friction + growth, f'the greatest pull is {max(pull)} N, the friction {friction:.0f} N'
