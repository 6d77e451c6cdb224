from tutorial import figure, near, status

WEIGHT, LOADED, MOTOR, STIFFNESS, BUFFER = 200 * 9.8, 350 * 9.8, 3000, 100000, -0.2


def check():
    """The motor accelerates with its force, keeps its speed and its floor; the stops hold, the buffers as springs."""
    near(figure(status(12, 'Up@1'), 'speed'), (MOTOR - WEIGHT) / 200 * 12 / 60, 0.006, 'the speed at first')
    near(figure(status(60, 'Up@1'), 'speed'), 2, 0.006, 'the speed on the way')
    rests_at(2.8, 'Up@1', 'floor 1')
    near(figure(status(600, 'Up@1'), 'held by'), WEIGHT, 1.1, 'the force at the floor')
    rests_at(5.9, 'Up@1,Up@1,Up@1', 'the upper stop')
    rests_at(BUFFER - WEIGHT / STIFFNESS, '3@1', 'the buffers')
    rests_at(BUFFER - LOADED / STIFFNESS, '3@1,4@1', 'the buffers with the load')
    rests_at(BUFFER - (WEIGHT + MOTOR) / STIFFNESS, 'Down@1', 'the buffers that the motor presses')
    rests_at(BUFFER - (LOADED - MOTOR) / STIFFNESS, 'Up@1,4@1', 'what the motor can do with the load')
    rests_at(2.8, 'Up@1,4@1,Right@1,Right@1', 'floor 1 with a stronger motor')


def rests_at(height, keys, what):
    near(figure(status(900, keys), 'height'), height, 0.001, f'the height at {what}')
