import sys

from tutorial import figure, near, status

USES = ['Mdt', 'Mcd', 'Mst']
FRAMES = 600


def check():
    """Where numbers have no digits left crates shake, and sink; where the origin has moved to, they are quiet."""
    line = status(300)
    if sys.argv[4] == 'double':
        for table in range(4):
            near(left(line, table), 9, 0, 'the number on the table')
            assert slip(line, table) < .05, line
        return
    for table, least, most in ((0, 0, .1), (1, .2, 10), (2, 4, 100)):
        near(left(line, table), 9, 0, 'the number on the table')
        assert least <= slip(line, table) <= most, line
    near(left(line, 3), 0, 0, 'the number on the farthest table')
    line = status(300, '3@150')
    assert slip(line, 1) < .1 and .2 < slip(line, 0), line
    assert left(line, 0) == left(line, 1) == 9, line
    line = status(500, '3@1,3@2,3@3,Enter@4')
    assert slip(line, 3) < .1 and left(line, 3) == 9 and left(line, 0) < 9, line


def left(line, table):
    return figure(line.split('    ')[table], 'km:')


def slip(line, table):
    return figure(line.split('    ')[table], 'of 9,')
