from tutorial import figure, near, status

USES = ['Mdt', 'Mcd', 'Mst']
FRAMES = 600


def check():
    """Wheels stay in phase and fingers together, to and fro; the rope lifts the load."""
    for frames in 60, 120, 480, 1000:
        line = status(frames)
        assert figure(line, 'out of phase') < 1e-3, line
        assert figure(line, 'apart') < 1e-4, line
    near(figure(status(120), 'wheel'), 8, 0.1, 'the angle of the first wheel')
    near(figure(status(120), 'fingers'), 0.3, 0.01, 'the displacement of a finger')
    assert figure(status(60), 'load at') > figure(status(1), 'load at') + 0.1
