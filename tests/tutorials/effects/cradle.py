from tutorial import figure, near, status

USES = ['Mdt', 'Mcd', 'Mst']
IS_LONG = True


def check():
    """As many balls leave as come in, each time; momentum and energy are kept, for a minute."""
    for released in 1, 2, 3, 4:
        keys = ','.join(f'3@{i}' for i in range(1, released))
        line = status(100 + released, keys)  # the first swing is over, the second has not begun
        assert figure(line, 'released') == released, line
        assert figure(line, 'most on the right') == released, line
        near(figure(line, 'J,'), 0, 0.01, 'energy (%)')
    before, after = status(60), status(75)  # around the first blow
    assert figure(before, 'on the right') == 0 and figure(after, 'momentum') > 100, (before, after)
    end = status(3600)
    assert figure(end, 'most on the right') == 1, end
    near(figure(end, 'J,'), 0, 0.05, 'energy (%)')
