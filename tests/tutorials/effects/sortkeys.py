from tutorial import figure, status


def check():
    """With sort keys the order of creation leaves no trace; without, a rounding error grows into metres."""
    line = status(1800)
    assert 'same bits' in line and figure(line, 'the same for') == 1800, line
    assert figure(line, 'without keys:') > 0.1, line
    line = status(1800, '3@1')
    assert 'different' in line and figure(line, 'the same for') < 1799, line
    assert 'same bits' in status(1800, '3@1,3@5'), 'switched back on'
