from tutorial import figure, status


def check():
    """30 contacts that carry and 10 between neighbours, 100 rows; the rows stay within the cap: friction goes first, then
    contacts. The pyramid stands while every contact is there, and sinks when too many are left out."""
    line = status(120)
    assert (figure(line, 'rows'), figure(line, 'with friction')) == (100, 30), line
    assert abs(figure(line, 'sunk by')) < 2e-3, line
    for downs, cap in ((2, 80), (6, 40)):
        line = status(120, ','.join(f'Down@{i + 1}' for i in range(downs)))
        assert figure(line, 'cap') == cap and figure(line, 'rows') <= cap, line
        assert figure(line, 'left out') == 0 and abs(figure(line, 'sunk by')) < 0.02, line
    line = status(120, ','.join(f'Down@{i + 1}' for i in range(9)))
    assert figure(line, 'rows') <= 10, line
    assert figure(line, 'left out') > 0 and figure(line, 'sunk by') > 0.2, line
