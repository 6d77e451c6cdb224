from tutorial import figure, status


def check():
    """All 24 fall, all come to rest, a kick wakes one of them, and with a threshold of 0 none rests."""
    assert figure(status(20), 'enabled') == 24
    assert figure(status(400), 'enabled') == 0
    assert figure(status(405, '3@400'), 'enabled') == 1
    assert figure(status(700, '3@400'), 'enabled') == 0
    assert figure(status(700, 'Down@1'), 'enabled') == 24
    assert figure(status(900, 'Down@1,Up@600'), 'enabled') == 0
