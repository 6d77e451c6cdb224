from tutorial import figure, status

USES = ['Mdt', 'Mcd', 'Mst']
FRAMES = 600


def check():
    """Boxes stay on the lift, and on the carousel until friction no longer holds them."""
    for frames in 60, 200, 600:
        line = status(frames)
        assert abs(figure(line, 'above the lift')) < 1e-3, line
        assert figure(line, 'on the carousel') == 4, line
