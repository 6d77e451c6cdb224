from tutorial import figure, look, near, picture, project, status


def check():
    """n steps of h fall g (n h)^2 / 2, as free fall does; the picture has the ball there."""
    line, fallen = status(60), 9.8 * 1.8**2 / 2
    near(figure(line, 'height'), 18 - fallen, 0.006, 'the height')
    near(figure(line, 'speed'), 9.8 * 1.8, 0.006, 'the speed')
    x, y, scale = project((0, 18 - fallen, 0), (0, 8.8, 0), 30, 0.5, 0.3)
    look('blue', picture('drop.png', 60, '-camera', '30,0.5,0.3'), f'{x},{y},{scale}')
    again = 18 - 9.8 * (27 * 0.03) ** 2 / 2  # the 63rd step brought it to the ground
    near(figure(status(90), 'height'), again, 0.006, 'the height when it falls again')
