from tutorial import figure, near, status


def check():
    """Speed = slip x the force that the contact passes, from the first step on; after slip x mass = 0.2 s that is the push.
    Without friction, speed = force x time / mass."""
    for frames in (1, 5, 40):
        line = status(frames)
        near(figure(line, 'blue:'), figure(line, 'drags with'), 1e-3, f'speed and force after {frames} steps')
        near(figure(line, 'on ice:'), frames / 60 / 0.2, 1e-3, f'the speed on ice after {frames} steps')
    line = status(120, 'Up@1,Right@2')
    near(figure(line, 'force'), 1.25, 0, 'the force')
    near(figure(line, 'blue:'), 1.25 * 1.25, 2e-3, 'the speed on slip')
    near(figure(status(200, '3@60'), 'blue:'), 0, 2e-3, 'the speed when it is let go')
