from tutorial import figure, held, near, status

USES = ['Mdt', 'Mcd', 'Mst']


def check():
    """Loads carry the weight at rest; it flies over the ramp, stays upright on its round, and obeys the keys."""
    loads = figures('3@1', 200)
    near(sum(loads), 1216 * 9.81, 30, 'the sum of the loads at rest')
    assert figure(status(480), 'x') > 20, status(480)
    for frames in (1500, 3000):
        line = status(frames)
        assert max(abs(figure(line, 'x')), abs(figure(line, 'z'))) < 66 and min(figures('', frames)) > 0, line
    line = status(240, held('Up', 2, 150) + ',' + held('Down', 150, 239))
    near(float(line.split()[0]), 0, 1.5, 'the speed after braking')
    left, right = (figure(status(200, held('Up', 2, 200) + ',' + held(key, 60, 200)), 'z') for key in ('Left', 'Right'))
    assert left < -8.5 and right > -7.5, (left, right)


def figures(keys, frames):
    """-> the loads of the wheels."""
    words = status(frames, keys).split()
    at = words.index('loads')
    return [float(word) for word in words[at + 1:at + 5]]
