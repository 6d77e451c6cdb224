from tutorial import figure, status

USES = ['Mdt', 'Mcd', 'Mst']
IS_LONG = True


def check():
    """No joint opens, no limb stays beyond its limit; all tumble down, come to rest and sleep, and can be thrown."""
    end, thrown = status(1800), status(150, '3@100')
    for line in end, thrown:
        assert figure(line, 'joints open at most') < 0.01, line
        assert figure(line, 'limits passed by') < 0.25, line
    assert figure(end, 'now by') < 0.001 and figure(end, 'awake') == 0, end
    assert figure(end, 'lowest head at') < 1.5, end  # from 4.9 m and more
    assert figure(thrown, 'motion') > 1000, thrown
    status(230, 'Enter@200')  # built again in the midst of motion, without a warning
