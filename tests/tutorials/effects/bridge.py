from tutorial import figure, status

USES = ['Mdt', 'Mcd', 'Mst']
IS_LONG = True


def check():
    """The bridge catches what falls on it, its hinges and ropes hold, and all of it comes to rest and sleeps."""
    line = status(900)
    assert figure(line, 'boxes carried') >= 7, line
    assert figure(line, 'hinges open at most') < 0.02, line
    assert figure(line, 'ropes longer by') < 0.02, line
    assert 2.2 < figure(line, 'lowest plank at') < 2.6, line
    assert figure(line, 'motion') < 3, line
    assert figure(status(3600), 'awake') == 0, 'it does not fall asleep'
