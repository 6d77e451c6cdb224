from tutorial import figure, near, status


def check():
    """The ball rolls at the end: its spin is speed / radius, and the friction has slowed it down."""
    line = status(330)
    near(figure(line, 'height'), 0, 0.011, 'the height')
    near(figure(line, 'spin'), figure(line, 'speed') / 0.6, 0.005 / 0.6 + 0.006, 'the spin')  # figures are rounded
    near(figure(line, 'speed'), 1.8 * 5 / 7, 0.02, 'the speed')  # of a ball that slid until it rolled
    assert figure(status(130, 'Down@1,Down@2,Down@3'), 'restitution') == 0.45
