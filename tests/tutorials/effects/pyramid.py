from tutorial import figure, near, status

USES = ['Mdt', 'Mcd', 'Mst']


def check():
    """The pyramid stands and sleeps, with a weight on it too; awake, the report tells of small errors, until it is at rest and
    is not solved any more."""
    for keys in 'Enter@1', '3@100', '':  # the last is with the weight, too
        line = status(500, keys)
        near(figure(line, 'top at'), 6, 0.001, 'the top')
        assert figure(line, 'awake') == 0 and figure(line, 'rows') == 0, line
    assert figure(status(115), 'awake') == 0 and figure(status(125), 'awake') == 56, 'the weight that comes by itself'
    line = status(12, '4@5,3@10')
    assert figure(line, 'rows') > 500, line  # iterations may be 0: where the last answer holds, nothing is solved
    assert figure(line, 'residual') < 1e-3 and figure(line, 'deepest') < 0.1, line  # the accuracy is 1.6e-3 m/s
    line = status(300, '4@5')
    near(figure(line, 'top at'), 6, 0.001, 'the top')
    assert figure(line, 'awake') == 56 and figure(line, 'rows') == 0, line
