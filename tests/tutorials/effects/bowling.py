from tutorial import figure, near, status

USES = ['Mdt', 'Mcd', 'Mst']
IS_LONG = True

RADIUS, FRICTION, SPEED, WAY = 0.108, 0.2, 7, 13  # m, m/s, m: as the tutorial has them


def throw(way, presses, frame):
    """-> the status line so many frames after a throw with a key pressed so often before."""
    keys = [f'{way}@{i}' for i in range(1, presses + 1)] + [f'Enter@{presses + 1}']
    return status(presses + 1 + frame, ','.join(keys))


def check():
    """The ball slides, then rolls, as the textbook says; a hook bends its way; pins stand, fall, and lie still."""
    slides = status(30)
    near(figure(slides, 'm to go,'), SPEED - FRICTION * 9.81 * 0.5, 0.002, 'the speed after half a second')
    assert figure(slides, 'slip') > 1, slides
    rolls = status(110)
    near(figure(rolls, 'm to go,'), 5 / 7 * SPEED, 0.002, 'the speed of rolling')
    assert figure(rolls, 'slip') < 0.002 and abs(figure(rolls, 'ball at')) < 0.002, rolls
    spun = throw('w', 15, 110)
    near(figure(spun, 'm to go,'), 5 / 7 * SPEED - 2 / 7 * RADIUS * 30, 0.003, 'the speed of rolling after backspin')
    assert figure(throw('a', 10, 100), 'ball at') < -0.1, 'no hook to the left'
    assert figure(throw('d', 10, 100), 'ball at') > 0.1, 'no hook to the right'
    assert figure(status(135), 'fallen') == 0, 'pins fall by themselves'
    end = status(900)
    # the ball may roll on, or spin on the spot, which nothing brakes, and keep one pin awake that it leans on
    assert figure(end, 'fallen') >= 7 and figure(status(3600), 'awake') <= 2, end
    assert figure(throw('d', 20, 400), 'fallen') == 0, 'the ball in the gutter fells pins'
