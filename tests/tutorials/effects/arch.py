from tutorial import figure, status

USES = ['Mdt', 'Mcd', 'Mst']


def check():
    """The arch stands, with a weight on it too, and sleeps; without its keystone it falls."""
    for keys in '', '3@100':
        line = status(600, keys)
        assert abs(figure(line, 'sunk by')) < 0.05 and figure(line, 'awake') == 0, line
    line = status(900, '4@100')
    assert figure(line, 'sunk by') > 2000 and figure(line, 'motion') < 1, line
    assert abs(figure(status(1200, '3@100,4@300,Enter@900'), 'sunk by')) < 0.05, 'it does not stand when built again'
