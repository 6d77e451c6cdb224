from tutorial import figure, status

USES = ['Mdt', 'Mcd', 'Mst']


def check():
    """The arch stands, with a weight on it too, and sleeps; without its keystone it falls."""
    for keys in 'Enter@1', '3@100':
        line = status(600, keys)
        assert abs(figure(line, 'sunk by')) < 0.05 and figure(line, 'awake') == 0, line
    for keys in '4@100', '':  # by itself the weight comes after two seconds, and the keystone goes after five
        line = status(900, keys)
        assert figure(line, 'sunk by') > 2000 and figure(line, 'motion') < 1, line
    assert abs(figure(status(290), 'sunk by')) < 0.05 and figure(status(125), 'awake') == 16
    assert abs(figure(status(1200, '3@100,4@300,Enter@900'), 'sunk by')) < 0.05, 'it does not stand when built again'
