from tutorial import figure, status

USES = ['Mdt', 'Mcd', 'Mst']
IS_LONG = True
FRAMES = 300  # all five hundred take a minute to fall, and longer than that to compute


def check():
    """The first stands for a second, is pushed, and the wave runs on; who waits sleeps."""
    assert figure(status(50), 'awake') == 0
    early, late = status(300), status(600)
    for line in early, late:
        assert figure(line, 'fallen') <= figure(line, 'awake') <= figure(line, 'fallen') + 4, line
    speed = (figure(late, 'fallen') - figure(early, 'fallen')) / 5
    assert 8 < speed < 12, f'{speed} dominoes a second'
