from tutorial import figure, near, status

USES = ['Mdt', 'Mcd', 'Mst']


def centre():
    """-> the height of the centre of mass above the feet, by the chair's measures."""
    seat, back, legs = 0.12, 0.1, 4 * 3.14159265 * 0.05 ** 2 * 0.9
    return (seat * 0.96 + back * 1.52 + legs * 0.45) / (seat + back + legs)


def check():
    """A chair that is put down stands on its feet; the thrown ones come to rest, not all of them upright."""
    line = status(30)
    near(figure(line, 'centre at'), centre(), 0.002, 'the centre of mass')
    line = status(900)
    assert figure(line, 'awake') == 0, line
    assert figure(line, 'upright') < 6, line
    assert figure(status(720, '3@700'), 'motion') > 100, 'the kick does not move them'
