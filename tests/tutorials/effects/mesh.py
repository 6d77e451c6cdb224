from tutorial import figure, status

USES = ['Mdt', 'Mcd', 'Mst']
FRAMES = 200


def check():
    """Balls stay out of the tube, but for the flats of its triangles, 9 mm; they come to lie."""
    early, late = status(100), status(900)
    for line in early, late:
        assert figure(line, 'deepest') < 0.015, line
    assert figure(late, 'motion') < figure(early, 'motion') / 10, (early, late)
