from tutorial import figure, held, near, status, statuses

USES = ['Mdt', 'Mcd', 'Mst']


def check():
    """It stays upright over the ramp and on its round, leans into a curve as that wants, and obeys the keys."""
    for line in statuses(1500):
        assert abs(figure(line, 'lean')) < 50, line
    for frames in (480, 1500):
        line = status(frames)
        assert max(abs(figure(line, 'x')), abs(figure(line, 'z'))) < 66 and -0.5 < figure(line, 'y') < 8, line
    for key, side in (('Left', 1), ('Right', -1)):
        line = status(110, held('Up', 2, 60) + ',' + held(key, 60, 110))
        near(figure(line, 'lean'), figure(line, 'for the curve'), 2, 'the lean in a steady curve')
        assert side * figure(line, 'lean') < -3 or side * figure(line, 'lean') > 3, line
