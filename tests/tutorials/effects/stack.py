from tutorial import figure, near, status

USES = ['Mdt', 'Mcd', 'Mst']


def check():
    """The tower stands and sleeps; a ball wakes it and brings it down."""
    line = status(900)
    near(figure(line, 'top at'), 20, 0.03, 'the top')
    assert figure(line, 'awake') == 0, line
    line = status(1000, '3@905')
    assert figure(line, 'awake') > 2, line
    assert figure(status(1500, '3@905'), 'top at') < 19, 'the ball has not brought it down'
