from tutorial import status

USES = ['Mdt', 'Mcd', 'Mst']
FRAMES = 250


def place(frames):
    """-> where the character is, m."""
    return [float(number) for number in status(frames).split()[1:4]]


def check():
    """On top of the stairs after 4 s, on the floor behind the ramp after 10 s, and on ground both times."""
    assert abs(place(250)[1] - 1.62) < 0.03, place(250)
    assert abs(place(600)[1] - 0.02) < 0.1 and place(600)[0] < -2, place(600)
    assert 'on ground' in status(250) and 'on ground' in status(600)
