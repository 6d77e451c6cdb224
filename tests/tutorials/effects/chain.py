from tutorial import figure, near, status


def check():
    """The joints hold, however heavy the weight, and the hook carries it all when it hangs still."""
    for keys, mass in (('', 100), ('Up@1', 1000), ('Down@1', 10)):
        line = status(600, keys)
        assert figure(line, 'weight') == mass
        assert figure(line, 'gap') < 1e-4, line
        weight = 9.8 * (mass + 12)  # swinging from 0.6 rad, it pulls between cos 0.6 and 3 - 2 cos 0.6 times that
        assert 0.7 * weight < figure(line, 'hook') < 1.5 * weight, line
