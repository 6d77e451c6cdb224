from tutorial import figure, near, status, statuses

USES = ['Mdt', 'Mcd', 'Mst']
IS_LONG = True


def check():
    """The wall stands until the ball comes, and not after it; the joints of the chain stay closed in the blow."""
    before, after = status(60), status(600)
    assert figure(before, 'bricks standing') == 30, before
    assert figure(after, 'bricks standing') <= 20, after
    for line in before, after:
        assert figure(line, 'joints open at most') < 0.02, line
    near(figure(after, 'ball'), 2000 * 4 / 3 * 3.14159265 * 0.8 ** 3, 0.6, 'the mass of the ball')
    awake = ''.join('-' if figure(line, 'awake') <= 13 else '*' for line in statuses(2400)[1200:])
    assert max(map(len, awake.split('-'))) <= 60, 'the bricks do not rest within a second after the ball has brushed them'
    assert awake.count('-') > 0.8 * len(awake), 'the bricks do not rest but when the ball brushes them'
