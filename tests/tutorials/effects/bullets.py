from tutorial import figure, status

USES = ['Mdt', 'Mcd', 'Mst']
IS_LONG = True


def check():
    """Every ball is stopped by the wall, for a minute; without continuous motion nearly all of them go through."""
    for frames in 600, 3600:
        line = status(frames)
        shots = frames // 8
        assert figure(line, 'shots') == shots and figure(line, 'tunnels') == 0, line
        assert figure(line, 'stopped') >= shots - 2, line
        assert figure(line, 'fastest') == 600, line
    line = status(605, '3@4')
    assert figure(line, 'continuous') == 0 and figure(line, 'tunnels') > 0.8 * figure(line, 'shots'), line
