from tutorial import figure, status


def check():
    """12 bodies in groups of three: 4 partitions; each link that is made or cut changes the number by one; and with the
    world putting things to rest, only the swinging group stays."""
    assert figure(status(10), 'partitions') == 4
    assert figure(status(20, '3@5,3@6'), 'partitions') == 2
    line = status(20, '3@5,3@6,3@7,3@8')  # nothing is left to join after three
    assert (figure(line, 'links'), figure(line, 'partitions')) == (11, 1), line
    assert figure(status(20, '4@5,4@6'), 'partitions') == 6
    line = status(60, '5@5')
    assert (figure(line, 'partitions'), figure(line, 'at rest')) == (1, 9), line
    line = status(3600, '5@5')
    assert (figure(line, 'partitions'), figure(line, 'at rest')) == (0, 12), line
    assert figure(status(3610, '5@5,Up@3605'), 'at rest') == 9
