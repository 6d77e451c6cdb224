from tutorial import figure, status

USES = ['Mdt', 'Mcd', 'Mst']
IS_LONG = True
FRAMES = 600  # twice; the minute is run below


def check():
    """All marbles stay in the bowl and on its surface, lose their motion in rolling, and sleep; a blow lifts them."""
    early, late, end = status(120), status(900), status(4500)
    for line in early, late, end:
        assert figure(line, 'in the bowl') == 60, line
        assert figure(line, 'deepest') < 0.002, line
    assert figure(late, 'motion') < figure(early, 'motion') / 10, (early, late)
    assert figure(end, 'awake') == 0, end
    blown = status(710, '3@705')
    assert figure(blown, 'motion') > 100, blown
