from tutorial import figure, near, status


def check():
    """Friction mu brings a box to the belt's speed v within v / (mu g); then it moves along with it."""
    line = status(60)  # 1 s: the strong ones are there, the weak one is accelerated by 0.1 g
    near(figure(line, 'blue'), 0.1 * 9.8, 0.02, 'the speed of the first box')
    near(figure(line, 'orange'), 2, 0.002, 'the speed of the second box')
    near(figure(line, 'green'), 2, 0.002, 'the speed of the third box')
    line = status(180)
    near(figure(line, 'blue'), 2, 0.002, 'the speed of the first box in the end')
    near(figure(status(100, 'Down@1,Down@2'), 'green'), 1, 0.002, 'the speed on a slower belt')
