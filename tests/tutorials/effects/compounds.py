from tutorial import figure, near, status

USES = ['Mdt', 'Mcd', 'Mst']


def check():
    """The bird sways about its centre of mass, which is found, and the tumblers get up; another centre lets it fall."""
    line = status(3000)
    near(figure(line, 'leans by'), 0, 3, 'the lean of the bird that stands')
    near(figure(line, 'upright'), 3, 0, 'the number of tumblers that have got up')
    near(figure(line, 'awake'), 0, 0, 'the number of bodies that never rest')
    line = status(1300, '3@200')
    assert figure(line, 'leans by') > 45, f'the bird stands without its weights: {line}'
