from tutorial import figure, near, status

USES = ['Mdt', 'Mcd', 'Mst']
IS_LONG = True


def check():
    """The house stands and sleeps; a pulled card takes a part of it down, and the ball all but the lowest storey."""
    for frames in 20, 3600:
        line = status(frames)
        near(figure(line, 'top at'), 1.497, 1e-4, 'the top')
        assert figure(line, 'moved') < 0.05, line
    assert figure(line, 'awake') == 0, line
    line = status(900, '4@60')
    assert figure(line, 'moved') > 300 and figure(line, 'awake') == 0, line
    line = status(900, '3@60')
    assert figure(line, 'top at') < 1.2 and figure(line, 'awake') <= 1, line  # the ball may roll on, by itself
    near(figure(status(1200, '3@60,Enter@900'), 'top at'), 1.497, 1e-4, 'the top of the house built again')
