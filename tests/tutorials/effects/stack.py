from tutorial import figure, near, status

USES = ['Mdt', 'Mcd', 'Mst']


def check():
    """The tower stands and sleeps; a ball wakes it and brings it down, by itself after two seconds, or when it is thrown."""
    assert figure(status(119), 'motion') < 1 < figure(status(140), 'motion')
    assert figure(status(600), 'top at') < 19, 'the ball that is thrown by itself has not brought it down'
    assert figure(status(4800), 'awake') == 0, 'the ball rolls for ever'
    line = status(900, 'Enter@1')
    near(figure(line, 'top at'), 20, 0.03, 'the top')
    assert figure(line, 'awake') == 0, line
    line = status(1000, 'Enter@1,3@905')
    assert figure(line, 'awake') > 2, line
    assert figure(status(1500, 'Enter@1,3@905'), 'top at') < 19, 'the ball has not brought it down'
