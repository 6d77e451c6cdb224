from tutorial import figure, near, status

USES = ['Mdt', 'Mcd', 'Mst']
FRAMES = 600


def check():
    """The tower stands until the bomb goes off, by itself; the wall shields, unless nothing does; a blow of 0 moves nothing."""
    line = status(80)
    near(figure(line, 'highest'), 3.8, .05, 'the height of the tower')
    near(figure(line, 'pushed'), 0, 0, 'the number pushed before the explosion')
    line = status(300)
    near(figure(line, 'pushed'), 64, 0, 'the number of crates pushed')
    near(figure(line, 'behind the wall'), 9, 0, 'the crates that stand behind the wall')
    assert figure(status(120), 'highest') > 5, status(120)
    line = status(300, '4@1')
    near(figure(line, 'pushed'), 73, 0, 'the number pushed where nothing shields')
    assert figure(line, 'behind the wall') < 6, line
    near(figure(status(150, ','.join(f'Down@{2 * i + 1}' for i in range(7))), 'highest'), 3.8, .05, 'the height after a blow of nothing')
