from tutorial import figure, near, status

USES = ['Mdt', 'Mcd', 'Mst']
IS_LONG = True


def check():
    """The house stands and sleeps; a pulled card takes a part of it down, and the ball all but the lowest storey."""
    for frames in 20, 3600:
        line = status(frames, 'Enter@1')
        near(figure(line, 'top at'), 1.497, 1e-4, 'the top')
        assert figure(line, 'moved') < 0.05, line
    assert figure(line, 'awake') == 0, line
    assert figure(status(115), 'moved') < 0.05 and figure(status(180), 'moved') > 300, 'the ball that comes by itself'
    line = status(900, '4@60')
    assert figure(line, 'moved') > 300 and figure(line, 'awake') == 0, line
    # the ball may roll on; in single precision it lies on cards, which it pushes, and rolls off them at frame 690
    lines = [status(frames, '3@60') for frames in (900, 1200)]
    assert figure(lines[1], 'top at') < 1.2 and figure(lines[1], 'motion') < 1, lines
    near(figure(lines[1], 'moved'), figure(lines[0], 'moved'), 0.01, 'the farthest card')
    near(figure(status(1200, '3@60,Enter@900'), 'top at'), 1.497, 1e-4, 'the top of the house built again')
