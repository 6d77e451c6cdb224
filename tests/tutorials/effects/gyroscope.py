from tutorial import figure, near, status


def check():
    """Precession as in the textbook, which is for fast tops: it leaves out terms of the order of (rate / spin)²; and the box
    turns over, first after 2.5 to 6 s, without losing energy."""
    for keys, spin in (('', 30), ('Up@1,Up@2', 50)):
        line = status(1200, keys)
        assert figure(line, 'spin') == spin
        rate = 2 * 9.8 * 0.9 / (0.5 * 2 * 0.8**2 * spin)
        near(figure(line, 'textbook says'), rate, 1e-3, "the textbook's rate")
        near(figure(line, 'goes round at'), rate, 0.02 * rate, 'the rate')
        assert figure(line, 'turned over') >= 3, line
        assert abs(figure(line, 'changed by')) < 1e-5, line
