from tutorial import figure, near, status

USES = ['Mdt', 'Mcd', 'Mst']
IS_LONG = True
FRAMES = 600  # twice; the minute is run below


def check():
    """Belts carry boxes at their speed, hand them on at corners, all the way round; they sleep where belts stand."""
    line = status(60)
    near(figure(line, 'on the straight'), 1.5, 0.001, 'the speed of boxes')
    end = status(3600)
    assert figure(end, 'boxes on the belts') == 10 and figure(end, 'awake') == 10, end
    # 90 m, a lap is 20 to 24 m; it is counted as an angle, which on a square is off by .011 laps of the way at either end
    assert figure(end, 'laps') > 3.5 and figure(end, 'to') <= 4.5 + 2 * 0.0115, end
    assert figure(status(400, '3@300'), 'awake') == 0, 'boxes do not sleep on belts that stand still'
    near(figure(status(500, '3@300,3@450'), 'on the straight'), 1.5, 0.05, 'the speed of boxes that were woken')
    fast = status(200, ','.join(f'Up@{i}' for i in range(101, 111)))
    near(figure(fast, 'belts'), 2, 0.001, 'the speed of belts')
